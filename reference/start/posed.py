"""The start of joints: places and rates of the second part against the first, where given.

They hold at the start only.
"""

from collections.abc import Iterator

from ...cases.case import Case
from ...cases.scene import Joint, Signal
from ...cases.scene.joint import Freedom
from ..mechanism.constraints.constraint import Constraint
from ..mechanism.constraints.constraint_terms import FIRST, SECOND, Given, Line, Term, Turning
from ..mechanism.kinematics.coordinates import Coordinates

Row = tuple[Term, ...]


def posed(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """φ_B − φ_A = angle, u·(r_B − r_A) = shift."""
    for joint, freedom in _freedoms(case):
        given = case.initial[joint.name].given
        if freedom.name in given:
            row, place = difference(freedom), given[freedom.name]
            yield Constraint(joint.name, (joint.a, joint.b), (row,), ((),), (place,), where)


def moving(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """ω_B − ω_A = omega, d/dt u·(r_B − r_A) = speed."""
    for joint, freedom in _freedoms(case):
        rate = case.initial[joint.name].given.get(freedom.rate)
        if rate is not None:
            row = difference(freedom)
            given = Given(Signal("constant", (rate,)), angular=row[0].angular)
            yield Constraint(joint.name, (joint.a, joint.b), ((*row, given),), ((),), None, where)


def silent(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """ω_B − ω_A and d/dt u·(r_B − r_A) of joints that give the place of these, and not the rate."""
    for joint, freedom in _freedoms(case):
        given = case.initial[joint.name].given
        if freedom.name in given and freedom.rate not in given:
            row = difference(freedom)
            yield Constraint(joint.name, (joint.a, joint.b), (row,), ((),), None, where)


def _freedoms(case: Case) -> Iterator[tuple[Joint, Freedom]]:
    """Yields the freedoms that have names, of the joints by which a part starts."""
    for joint in case.scene.joints.values():
        if joint.name in case.initial:
            yield from ((joint, freedom) for freedom in joint.rates.values())


def difference(freedom: Freedom) -> Row:
    """φ_B − φ_A, or u·(r_B − r_A) with u fixed in the first part."""
    if freedom.kind == "shift":
        return (Line(FIRST, SECOND, freedom.axis),)
    return Turning(SECOND), Turning(FIRST, -1.0)
