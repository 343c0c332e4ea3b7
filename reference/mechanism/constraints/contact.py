"""Constraints of a contact on a plane or a joint at rest, and friction when it does not rest.

A plane of the ground has the unit normal n, and u along it with n to its left; of the floor they
are y and x. R is the radius of a rim (0 for a particle or a point of a bar), whose lowest point
touches.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ....cases.scene import CENTER, Contact, Joint
from ...coverage import equation
from ..kinematics.kinematics import Layout
from .constraint import Constraint
from .constraint_terms import FIRST, SECOND, Along, Line, Term, Turning


def normal(contact: Contact, where: Layout) -> Constraint:
    """A closed contact: the lowest point stays on the plane, n·r_P − R = n·r₀; λ is its force."""
    (x, y), plane = contact.plane.at, contact.plane
    held = (plane.normal[0] * x + plane.normal[1] * y + _radius(contact, where),)
    row = (Along(FIRST, plane.normal),)
    return Constraint(contact.name, (contact.at,), (row,), (("normal",),), held, where)


@equation
def tangent(contact: Contact, where: Layout) -> Constraint:
    """(2.16) u·ṙ_P + R ω = 0: it sticks, a rim: it rolls, somewhere; λ is the friction force."""
    row = (Along(FIRST, contact.plane.along), Turning(FIRST, _radius(contact, where)))
    return Constraint(contact.name, (contact.at,), (row,), (("tangent",),), None, where)


def foot(contact: Contact, where: Layout) -> Constraint:
    """Where along its plane the point is that a foot has to be ahead of; nothing holds it."""
    assert contact.ahead_of is not None
    at, row = contact.ahead_of, (Along(FIRST, contact.plane.along),)
    return Constraint(str(at), (at,), (row,), ((),), None, where)


def at_rest(joint: Joint, where: Layout) -> Constraint:
    """A slide at rest, somewhere: d/dt u·(r_B − r_A) = 0, u fixed in the first part; λ along u.

    A pin at rest: φ̇_B − φ̇_A = 0; λ is a moment.
    """
    row: tuple[Term, ...] = (Turning(SECOND), Turning(FIRST, -1.0))
    names: tuple[str, ...] = ("friction",)
    if joint.shifts:
        row, names = (Line(FIRST, SECOND, joint.along),), ("fx", "fy", "friction")
    return Constraint(joint.name, (joint.a, joint.b), (row,), (names,), None, where)


def _radius(contact: Contact, where: Layout) -> float:
    """[m] of the rim: a disk named by its centre touches with it."""
    radius = where.scene.bodies[contact.body].radius
    return radius if radius is not None and contact.at.point == CENTER else 0.0


@dataclass(frozen=True)
class Coulomb:
    """A contact that slides: λ_t = factor λ_n, by (2.87) factor = −μ sign(slip)."""

    normal: Constraint
    tangent: Constraint
    factor: float


@dataclass(frozen=True)
class Braking:
    """A joint that moves: its friction on the second part, along +u [N] or about +z [N m]."""

    along: Constraint  # that would hold it at rest
    force: Callable[[float, Any, Any], float]
