"""Constraints and states of two bodies that touch each other: as a contact on a plane.

The body a is touched on its rim or on a face, b touches it with a rim of radius R or a point (R is
0). n is the normal, from a to b, and u has n to its left.
"""

from collections.abc import Iterator

from ....cases.scene import CENTER, Anchor, Scene
from ....cases.scene.pair import Pair
from ..constraints.constraint import Constraint
from ..constraints.constraint_terms import FIRST, SECOND, Apart, Around, Line, Term, Turning
from ..kinematics.kinematics import Layout
from .element import Element, Touching


def paired(scene: Scene, where: Layout) -> Iterator[Element]:
    """Yields an element for each pair of the scene."""
    for pair in scene.pairs.values():
        yield Touching(
            name=pair.name,
            normal=apart(pair, where),
            slip=along(pair, where),
            static=pair.static,
            kinetic=pair.kinetic,
            restitution=pair.restitution,
            frictionless=pair.static == 0.0,
            plane=pair.on,
            two=True,
        )


def apart(pair: Pair, where: Layout) -> Constraint:
    """(2.14) Closed, |r_b − r_a| = R + R_a of two rims, n·(r_P − r_a) = R on a face; λ pushes."""
    row: tuple[Term, ...] = (Apart(FIRST, SECOND),)
    if pair.face:
        row = (Line(FIRST, SECOND, pair.side.normal),)
    bodies = where.scene.bodies
    held = (pair.radius(bodies) + pair.reach(bodies),)
    return Constraint(pair.name, _ends(pair), (row,), (("normal",),), held, where)


def along(pair: Pair, where: Layout) -> Constraint:
    """(2.15) Nothing slips where both touch; λ is the friction on b.

    On a rim u·(ṙ_b − ṙ_a) + R ω_b + R_a ω_a = 0; on a face d/dt u·(r_P − r_a) + R (ω_b − ω_a) = 0,
    u fixed in a.
    """
    R, R_a = pair.radius(where.scene.bodies), pair.reach(where.scene.bodies)
    row: tuple[Term, ...]
    row = (Around(FIRST, SECOND), Turning(SECOND, R), Turning(FIRST, R_a))
    if pair.face:
        row = (Line(FIRST, SECOND, pair.side.along), Turning(SECOND, R), Turning(FIRST, -R))
    return Constraint(pair.name, _ends(pair), (row,), (("tangent",),), None, where)


def _ends(pair: Pair) -> tuple[Anchor, Anchor]:
    return pair.corner if pair.face else Anchor(pair.touched, CENTER), pair.at
