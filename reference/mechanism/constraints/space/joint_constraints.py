"""Constraints of joints, contacts and drives in space, as data: rows of constraints by kind.

A joint is read through what it leaves free: shifts along lines of its first part, then up to
three turns. Axes are those that `Joint` states.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .....cases.fields.signal import Signal
from .....cases.scene import Anchor, Scene
from .....cases.scene.chain import across
from .....cases.scene.joint import Joint
from .....cases.scene.rotation import Vector3


@dataclass(frozen=True)
class Together:
    """Three rows: r_B − r_A = 0; the multipliers are the force on B, in ground axes."""

    part: str
    a: Anchor
    b: Anchor


@dataclass(frozen=True)
class Line:
    """One row: u·(r_B − r_A) = 0, u fixed in the first part; λ u is the force on B."""

    part: str
    a: Anchor
    b: Anchor
    u: Vector3


@dataclass(frozen=True)
class Dot:
    """One row: u·w = c, u fixed in a and w in b; λ w × u is the moment on b."""

    part: str
    a: str
    b: str
    u: Vector3
    w: Vector3
    c: float


@dataclass(frozen=True)
class Rim:
    """Three rows: the lowest point of a rim or a sphere rests on the floor z = 0 (2.19).

    Known are their rates alone, but for the height. The multipliers are the floor's force.
    """

    part: str
    body: str
    radius: float
    axle: Vector3 | None  # None: a sphere


@dataclass(frozen=True)
class Drive:
    """One row: a freedom's rate is prescribed, m·ω_rel or u·ṙ_rel = g(t) (2.55).

    of: the axes of all turns (or one line of a shift) and which of them is driven; λ is what the
    drive exerts along it. A turn's first axis is fixed in a, its last in b.
    """

    part: str
    quantity: str  # the rate: `q1.omega`
    name: str  # of the reaction: `torque`, `theta_torque`, `x_force`
    a: Anchor
    b: Anchor
    shift: Vector3 | None
    shifts: tuple[Vector3, ...]
    turns: tuple[Vector3, ...]
    number: int  # of the driven turn
    rate: Signal


@dataclass(frozen=True)
class Blade:
    """One row: a point does not move across a heading, or upward (2.15).

    along: the long axis in the axes of the body, whose shadow is the heading; None: upward.
    """

    part: str
    name: str  # of the reaction: `force`, to the left of the heading, or `normal`
    at: Anchor
    along: Vector3 | None


@dataclass(frozen=True)
class Pivot:
    """Three rows: a point rests on the floor z = 0; the multipliers are the floor's force."""

    part: str
    at: Anchor


Held = Together | Line | Dot | Rim | Pivot | Drive | Blade


def scene_constraints(scene: Scene) -> list[Held]:
    """List of all constraints of a scene, in its order."""
    found: list[Held] = []
    for joint in scene.joints.values():
        found += jointed(joint, scene)
    for contact in scene.contacts.values():
        if contact.ideal == "pivot":
            found.append(Pivot(contact.name, contact.at))
            continue
        body = scene.bodies[contact.body]
        assert body.radius is not None  # only what is round rolls
        found.append(Rim(contact.name, contact.body, body.radius, body.axle))
    for edge in scene.constraints.values():
        found.append(Blade(edge.name, "force", edge.at, edge.along))
        if edge.kept:
            found.append(Blade(edge.name, "normal", edge.at, None))
    found += [driven(scene, quantity, law) for quantity, law in scene.drives.items()]
    return found


def jointed(joint: Joint, scene: Scene) -> Iterator[Held]:
    """(2.14) What a joint does not leave free."""
    shifts = [freedom.axis for freedom in joint.shifts]
    if shifts:
        for u in across(shifts):
            yield Line(joint.name, joint.a, joint.b, _numbers(u))
    else:
        yield Together(joint.name, joint.a, joint.b)
    bodies = [scene.bodies[at.body] for at in (joint.a, joint.b) if at.body in scene.bodies]
    if joint.holds_attitude and all(body.turns for body in bodies):
        yield from _unturned(joint)


def _unturned(joint: Joint) -> Iterator[Dot]:
    a, b, name = joint.a.body, joint.b.body, joint.name
    axes = [np.asarray(freedom.axis) for freedom in joint.turns]
    if len(axes) == 2:
        u, w = axes
        yield Dot(name, a, b, _numbers(u), _numbers(w), float(u @ w))
    elif len(axes) == 1:
        for u in across([_numbers(axes[0])]):
            yield Dot(name, a, b, _numbers(u), _numbers(axes[0]), 0.0)
    else:
        for i in range(3):
            u, w = np.eye(3)[i], np.eye(3)[(i + 1) % 3]
            yield Dot(name, a, b, _numbers(u), _numbers(w), 0.0)


def driven(scene: Scene, quantity: str, law: Signal) -> Drive:
    """A prescribed rate. Raises ValueError of three turns: the middle axis is fixed in no part."""
    part, _, rate = quantity.partition(".")
    joint = scene.joints[part]
    freedom = joint.rates[rate]
    turns = tuple(f.axis for f in joint.turns)
    if freedom.kind == "turn" and len(turns) > 2:
        raise ValueError(f"{quantity}: of three turns none can be driven")
    return Drive(
        part, quantity, freedom.effort, joint.a, joint.b,
        freedom.axis if freedom.kind == "shift" else None,
        tuple(f.axis for f in joint.shifts), turns,
        joint.turns.index(freedom) if freedom.kind == "turn" else 0, law,
    )  # fmt: skip


def _numbers(vector: object) -> Vector3:
    x, y, z = np.asarray(vector, dtype=float).tolist()
    return x, y, z
