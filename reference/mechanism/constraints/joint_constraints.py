"""The constraints that a scene has for good: its joints, its edges, drives, and what only rolls.

A joint is read through what it leaves free: to shift along lines of its first part, and to turn.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ....cases.scene import GROUND, Contact, Edge, Joint, Scene, Signal, Vector
from ....cases.scene.chain import orthogonal_complement as completing
from ....cases.scene.joint import Freedom
from ...coverage import equation
from ..kinematics.frame import PLANE
from ..kinematics.kinematics import Layout
from .constraint import Constraint
from .constraint_terms import (
    FIRST,
    SECOND,
    Along,
    Carried,
    Distance,
    Dot,
    Given,
    Heading,
    Line,
    Lowest,
    Numbers,
    Term,
    Turn,
    Turning,
    opposite,
)
from .contact import normal, tangent

Held = tuple[tuple[Term, ...], tuple[str, ...], float]  # a row, its reactions, where it is held
FORCES, MOMENTS, FLOOR = ("fx", "fy", "fz"), ("mx", "my", "mz"), ("fx", "fy", "normal")
UP = (0.0, 0.0, 1.0)


def constraints(
    scene: Scene, where: Layout, start: Sequence[float] | None = None
) -> list[Constraint]:
    """The constraints that always hold; without a start, rolling is known as a rate only."""
    if where.frame is not PLANE:
        return list(_in_space(scene, where))
    parts = []
    for joint in scene.joints.values():
        held = jointed(joint, where)
        if start is not None:
            held = _rolling(held, start) if held.held is None else _on_its_turn(held, start)
        parts.append(held)
    parts += [edged(edge, where) for edge in scene.constraints.values()]
    parts += [driven(scene, quantity, law, where) for quantity, law in scene.drives.items()]
    for contact in scene.contacts.values():
        if contact.switches:
            continue  # what it holds, and when, is for its modes to say
        rolls = tangent(contact, where)
        parts += [normal(contact, where), rolls if start is None else _rolling(rolls, start)]
    return parts


@equation
def jointed(joint: Joint, where: Layout) -> Constraint:
    """(2.14) What a joint does not leave free: to shift along its line, to turn, to come nearer."""
    if joint.swings:
        row, at = (Distance(FIRST, SECOND),), None if joint.length is None else (-joint.length,)
        return Constraint(joint.name, (joint.a, joint.b), (row,), (("fx", "fy"),), at, where)
    held = [across(joint.along)] if joint.shifts else list(together(where))
    if not joint.turns and _turn(joint, where):
        held.append(unturned(joint.angle))
    return _held_by(joint, held, where)


def _held_by(joint: Any, held: Sequence[Held], where: Layout) -> Constraint:
    """The constraint that has these rows."""
    rows, names = tuple(row for row, _, _ in held), tuple(names for _, names, _ in held)
    places = tuple(place for _, _, place in held)
    return Constraint(joint.name, (joint.a, joint.b), rows, names, places, where)


@equation
def edged(edge: Edge, where: Layout) -> Constraint:
    """(2.15) n·ṙ_P = 0, n to the left of the blade; with a prescribed speed, u·ṙ_P = s(t) too."""
    rows: list[tuple[Term, ...]] = [(Carried(FIRST, edge.across),)]
    names = [("force",)]
    if edge.speed is not None:
        rows.append((Carried(FIRST, edge.along), Given(edge.speed)))
        names.append(("drive",))
    return Constraint(edge.name, (edge.at,), tuple(rows), tuple(names), None, where)


@equation
def driven(scene: Scene, quantity: str, law: Signal, where: Layout) -> Constraint:
    """(2.15) ω_B − ω_A = s(t), λ being the torque on B; or d/dt u·(r_B − r_A) = s(t), λ along u."""
    part, _, rate = quantity.rpartition(".")
    joint = scene.joints[part]
    freedom = joint.rates[rate]
    row: tuple[Term, ...]
    if freedom.kind == "turn":
        row, names = (Turning(SECOND), Turning(FIRST, -1.0), Given(law, angular=True)), ()
    else:
        row, names = (Line(FIRST, SECOND, joint.along), Given(law)), ("fx", "fy")
    names = ((*names, freedom.effort),)
    return Constraint(part, (joint.a, joint.b), (row,), names, None, where, quantity)


def gliding(edge: Edge, speed: float, where: Layout) -> Constraint:
    """u·ṙ_P = speed [m/s] at the start only: nothing holds it later."""
    row = (Carried(FIRST, edge.along), Given(Signal("constant", (speed,))))
    return Constraint(edge.name, (edge.at,), (row,), ((),), None, where)


def together(where: Layout) -> Iterator[Held]:
    """Yields r_B − r_A = 0 along each axis e of the ground; λ is the force along it."""
    for e, name in zip(where.frame.axes, FORCES, strict=False):
        yield (Along(SECOND, tuple(e)), Along(FIRST, opposite(e))), (name,), 0.0


def across(along: Vector) -> Held:
    """n·(r_B − r_A) = 0, n fixed in the first part and ⊥ `along`; the force is λ n."""
    return (Line(FIRST, SECOND, (-along[1], along[0])),), ("fx", "fy"), 0.0


def unturned(angle: float) -> Held:
    """φ_B − φ_A = angle [rad]; λ is the moment."""
    return (Turning(SECOND), Turning(FIRST, -1.0)), ("torque",), angle


def _turn(joint: Any, where: Layout) -> bool:
    """Whether both parts have an attitude that could be held."""
    bodies = [where.scene.bodies[end.body] for end in (joint.a, joint.b) if end.body != GROUND]
    return all(body.turns for body in bodies)


def _on_its_turn(joint: Constraint, start: Sequence[float]) -> Constraint:
    """Held angles on the turn at which the start stands: 370° is held as well as 10°."""
    assert joint.held is not None
    rows = zip(joint.held, joint.f(0.0, start), joint.angular, strict=True)
    turned = (
        at + round(f / math.tau) * math.tau if angle and at is not None else at
        for at, f, angle in rows
    )
    return replace(joint, held=tuple(turned))


def _rolling(part: Constraint, start: Sequence[float]) -> Constraint:
    """x_c − R φ = C₁ (2.17), with the book's clockwise φ: C₁ is known once the start is.

    So is the length of a rod that nobody gave.
    """
    return replace(part, held=tuple(part.places(0.0, start)))


# In space.


def _in_space(scene: Any, where: Layout) -> Iterator[Constraint]:
    """Yields the constraints in the order of the scene."""
    for joint in scene.joints.values():
        yield _jointed(joint, where)
    for contact in scene.contacts.values():
        yield _standing(contact, where)
    for edge in scene.constraints.values():
        yield _bladed(edge, where)
    for quantity, law in scene.drives.items():
        yield _driven(scene, quantity, law, where)


@equation
def _jointed(joint: Joint, where: Layout) -> Constraint:
    """(2.14) Where the freedoms do not let the second part be.

    Its point is on the lines u of the shifts, or at the first point; attitudes are held by products
    of axes.
    """
    shifts = [freedom.axis for freedom in joint.shifts]
    held: list[Held] = list(together(where))
    if shifts:
        held = [((Line(FIRST, SECOND, _numbers(u)),), FORCES, 0.0) for u in completing(shifts)]
    if joint.holds_attitude and _turn(joint, where):
        for u, w, c in _unturned(joint):
            held.append(((Dot(FIRST, SECOND, u, w),), MOMENTS, c))
    return _held_by(joint, held, where)


def _unturned(joint: Joint) -> Iterator[tuple[Numbers, Numbers, float]]:
    """Yields u, fixed in the first part, w in the second, and what u·w stays (2.14)."""
    axes = [np.asarray(freedom.axis) for freedom in joint.turns]
    if len(axes) == 2:
        u, w = axes
        yield _numbers(u), _numbers(w), float(u @ w)
    elif len(axes) == 1:
        for u in completing([joint.turns[0].axis]):
            yield _numbers(u), _numbers(axes[0]), 0.0
    else:
        for i in range(3):
            yield _numbers(np.eye(3)[i]), _numbers(np.eye(3)[(i + 1) % 3]), 0.0


@equation
def _standing(contact: Contact, where: Layout) -> Constraint:
    """(2.19) What touches the floor z = 0 keeps its height, and slips nowhere.

    It is the lowest point of a rim or a sphere that rolls, or the point of a pivot.
    """

    def along(u: Numbers) -> Term:
        if contact.ideal == "pivot":
            return Along(FIRST, u)
        body = where.scene.bodies[contact.body]
        return Lowest(FIRST, body.radius, body.axle, u)

    rows = tuple((along(tuple(e)),) for e in where.frame.axes)
    names = tuple((name,) for name in FLOOR)
    return Constraint(contact.name, (contact.at,), rows, names, (None, None, 0.0), where)


@equation
def _bladed(edge: Edge, where: Layout) -> Constraint:
    """(2.15) A point does not move across a heading; or upward, where its height is kept."""
    rows: list[tuple[Term, ...]] = [(Heading(FIRST, edge.along),)]
    names = [("force",)]
    if edge.kept:
        rows.append((Along(FIRST, UP),))
        names.append(("normal",))
    return Constraint(edge.name, (edge.at,), tuple(rows), tuple(names), None, where)


@equation
def _driven(scene: Any, quantity: str, law: Signal, where: Layout) -> Constraint:
    """(2.15), (2.55) A freedom's rate is prescribed; λ is what the drive exerts along it.

    Raises ValueError of three turns: the middle axis is fixed in no part.
    """
    part, _, rate = quantity.partition(".")
    joint: Joint = scene.joints[part]
    freedom = joint.rates[rate]
    row: tuple[Term, ...]
    if freedom.kind == "shift":
        row, names = (Line(FIRST, SECOND, _dual(joint, freedom)), Given(law)), FORCES
    else:
        if len(joint.turns) > 2:
            raise ValueError(f"{quantity}: of three turns none can be driven")
        row, names = (turning(joint, freedom), Given(law, angular=True)), MOMENTS
    names = ((freedom.effort, *names),)
    return Constraint(part, (joint.a, joint.b), (row,), names, None, where, quantity)


def turning(joint: Joint, freedom: Freedom) -> Turn:
    """The rate of one of a joint's turns."""
    axes = [f.axis for f in joint.turns]
    if len(axes) == 1:
        return Turn(FIRST, SECOND, axes[0], axes[0], (1.0, 0.0))
    c = float(np.dot(axes[0], axes[1]))
    own, other = 1 / (1 - c * c), -c / (1 - c * c)
    weights = (own, other) if joint.turns.index(freedom) == 0 else (other, own)
    return Turn(FIRST, SECOND, axes[0], axes[-1], weights)


def _dual(joint: Joint, freedom: Freedom) -> Numbers:
    """The vector whose product with a sum of shifts is the driven one's share."""
    axes = np.array([f.axis for f in joint.shifts], float)
    return _numbers(np.linalg.pinv(axes.T)[joint.shifts.index(freedom)])


def _numbers(vector: object) -> Numbers:
    return tuple(np.asarray(vector, dtype=float).tolist())
