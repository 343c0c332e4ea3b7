"""The constraints that a scene has for good: its joints, its edges, and contacts that only roll.

A joint is read through what it leaves free: to turn, to shift along one line.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from ....cases.scene import GROUND, Edge, Joint, Scene, Signal, Vector
from ..kinematics.coordinates import Coordinates
from .constraint import Constraint
from .constraint_terms import (
    FIRST,
    SECOND,
    Along,
    Carried,
    Distance,
    Given,
    Line,
    Term,
    Turning,
    X,
    Y,
    opposite,
)
from .contact import normal, tangent

Held = tuple[tuple[Term, ...], tuple[str, ...], float]  # a row, its reactions, where it is held


def constraints(
    scene: Scene, where: Coordinates, start: Sequence[float] | None = None
) -> list[Constraint]:
    """The constraints that always hold; without a start, rolling is known as a rate only."""
    found = []
    for joint in scene.joints.values():
        held = jointed(joint, where)
        if start is not None:
            held = _rolling(held, start) if held.held is None else _on_its_turn(held, start)
        found.append(held)
    found += [edged(edge, where) for edge in scene.constraints.values()]
    found += [driven(scene, quantity, law, where) for quantity, law in scene.drives.items()]
    for contact in scene.contacts.values():
        if contact.switches:
            continue  # what it holds, and when, is for its modes to say
        rolls = tangent(contact, where)
        found += [normal(contact, where), rolls if start is None else _rolling(rolls, start)]
    return found


def jointed(joint: Joint, where: Coordinates) -> Constraint:
    """(2.14) What a joint does not leave free: to shift along its line, to turn, to come nearer."""
    if joint.swings:
        row, at = (Distance(FIRST, SECOND),), None if joint.length is None else (-joint.length,)
        return Constraint(joint.name, (joint.a, joint.b), (row,), (("fx", "fy"),), at, where)
    held = [across(joint.along)] if joint.shifts else [together(X, "fx"), together(Y, "fy")]
    bodies = [where.scene.bodies[end.body] for end in (joint.a, joint.b) if end.body != GROUND]
    if not joint.turns and all(body.turns for body in bodies):
        held.append(unturned(joint.angle))
    rows, names, places = zip(*held, strict=True)
    return Constraint(joint.name, (joint.a, joint.b), rows, names, places, where)


def edged(edge: Edge, where: Coordinates) -> Constraint:
    """(2.15) n·ṙ_P = 0, n to the left of the blade; with a prescribed speed, u·ṙ_P = s(t) too."""
    rows: list[tuple[Term, ...]] = [(Carried(FIRST, edge.across),)]
    names = [("force",)]
    if edge.speed is not None:
        rows.append((Carried(FIRST, edge.along), Given(edge.speed)))
        names.append(("drive",))
    return Constraint(edge.name, (edge.at,), tuple(rows), tuple(names), None, where)


def driven(scene: Scene, quantity: str, law: Signal, where: Coordinates) -> Constraint:
    """(2.15) ω_B − ω_A = s(t), λ being the torque on B; or d/dt u·(r_B − r_A) = s(t), λ along u."""
    part, _, rate = quantity.rpartition(".")
    joint = scene.joints[part]
    row: tuple[Term, ...]
    if rate == "omega":
        row, names = (Turning(SECOND), Turning(FIRST, -1.0), Given(law, angular=True)), ("torque",)
    else:
        row, names = (Line(FIRST, SECOND, joint.along), Given(law)), ("fx", "fy", "drive")
    return Constraint(part, (joint.a, joint.b), (row,), (names,), None, where)


def gliding(edge: Edge, speed: float, where: Coordinates) -> Constraint:
    """u·ṙ_P = speed [m/s] at the start only: nothing holds it later."""
    row = (Carried(FIRST, edge.along), Given(Signal("constant", (speed,))))
    return Constraint(edge.name, (edge.at,), (row,), ((),), None, where)


def together(u: Vector, name: str) -> Held:
    """u·(r_B − r_A) = 0; λ is the force along u."""
    return (Along(SECOND, u), Along(FIRST, opposite(u))), (name,), 0.0


def across(along: Vector) -> Held:
    """n·(r_B − r_A) = 0, n fixed in the first part and ⊥ `along`; the force is λ n."""
    return (Line(FIRST, SECOND, (-along[1], along[0])),), ("fx", "fy"), 0.0


def unturned(angle: float) -> Held:
    """φ_B − φ_A = angle [rad]; λ is the moment."""
    return (Turning(SECOND), Turning(FIRST, -1.0)), ("torque",), angle


def _on_its_turn(joint: Constraint, start: Sequence[float]) -> Constraint:
    """Held angles on the turn at which the start stands: 370° is held as well as 10°."""
    assert joint.held is not None
    rows = zip(joint.held, joint.f(0.0, start), joint.angular, strict=True)
    turned = (at + round(f / math.tau) * math.tau if angle else at for at, f, angle in rows)
    return replace(joint, held=tuple(turned))


def _rolling(part: Constraint, start: Sequence[float]) -> Constraint:
    """x_c − R φ = C₁ (2.17), with the book's clockwise φ: C₁ is known once the start is.

    So is the length of a rod that nobody gave.
    """
    return replace(part, held=tuple(part.places(0.0, start)))
