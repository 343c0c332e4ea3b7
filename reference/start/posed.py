"""The start of joints: places and rates of the second part against the first, where given.

They hold at the start only.
"""

from collections.abc import Iterator

from ...cases.case import Case
from ...cases.scene import Joint, Signal
from ..mechanism.constraints.constraint import Constraint
from ..mechanism.constraints.constraint_terms import FIRST, SECOND, Given, Line, Term, Turning
from ..mechanism.kinematics.coordinates import Coordinates

Row = tuple[Term, ...]


def posed(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """φ_B − φ_A = angle, u·(r_B − r_A) = shift."""
    for joint, rows in _of_joints(case, ("angle", "shift")):
        for row, place in rows:
            yield Constraint(joint.name, (joint.a, joint.b), (row,), ((),), (place,), where)


def moving(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """ω_B − ω_A = omega, d/dt u·(r_B − r_A) = speed."""
    for joint, rows in _of_joints(case, ("omega", "speed")):
        for row, rate in rows:
            given = Given(Signal("constant", (rate,)), angular=row[0].angular)
            yield Constraint(joint.name, (joint.a, joint.b), ((*row, given),), ((),), None, where)


def silent(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """ω_B − ω_A and d/dt u·(r_B − r_A) of joints that give the place of these, and not the rate."""
    for name, start in case.initial.items():
        joint = case.scene.joints.get(name)
        for place, rate in (("angle", "omega"), ("shift", "speed")):
            if joint and place in start.given and rate not in start.given:
                row = turned() if place == "angle" else shifted(joint)
                yield Constraint(joint.name, (joint.a, joint.b), (row,), ((),), None, where)


def _of_joints(
    case: Case, fields: tuple[str, str]
) -> Iterator[tuple[Joint, list[tuple[Row, float]]]]:
    """For each joint: the rows for a turn and for a shift that are given, with their numbers."""
    for name, joint in case.scene.joints.items():
        start = case.initial.get(name)
        terms: tuple[Row, Row] = turned(), shifted(joint)
        given = start.given if start else {}
        pairs = zip(terms, fields, strict=True)
        yield joint, [(row, given[field]) for row, field in pairs if field in given]


def turned() -> Row:
    """φ_B − φ_A."""
    return Turning(SECOND), Turning(FIRST, -1.0)


def shifted(joint: Joint) -> Row:
    """u·(r_B − r_A), u fixed in the first part."""
    return (Line(FIRST, SECOND, joint.along),)
