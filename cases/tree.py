"""A user's own model as plain numbers: a kinematic tree with its springs, dampers and actuators.

Whoever compiled it, an engine or a person, the numbers are enough to write its equations down, in
`reference/formalisms/tree_equations.py`, without a word of that engine.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from .trajectory import Array

Kind = Literal["free", "ball", "slide", "hinge"]
WIDTH: dict[Kind, tuple[int, int]] = {
    "free": (7, 6),
    "ball": (4, 3),
    "slide": (1, 1),
    "hinge": (1, 1),
}
"""By a joint's kind how many numbers of q and of v it has."""
SHIFTS: dict[Kind, int] = {"free": 3, "ball": 0, "slide": 1, "hinge": 0}
"""By a joint's kind how many of its v, the first ones, are no turns."""


@dataclass(frozen=True)
class TreeJoint:
    """A joint: how one body moves against its parent; several of a body act in their order.

    anchor: a point (3,) [m] of the body, through which the axis goes; axis: a unit vector (3,) in
    the body's axes; q, v: its first places. zero: the q at which the body stands as it was placed.
    A free joint's q are r (3,) of the body's origin and a quaternion (w, x, y, z), its v are ṙ in
    ground axes and ω in body axes; a ball's are the quaternion and ω.
    """

    name: str
    kind: Kind
    q: int
    v: int
    anchor: Array
    axis: Array
    zero: float = 0.0


@dataclass(frozen=True)
class Link:
    """A rigid body: where it is placed in its parent, and its mass.

    parent: its number, −1 for the ground. place (3,) [m] and attitude (4,): its frame in the
    parent's. centre (3,) [m]: the centre of mass, and J (3, 3) [kg m²] about that, both in the
    body's own axes. lifted: the share of its weight that is compensated.
    """

    name: str
    parent: int
    place: Array
    attitude: Array
    mass: float
    centre: Array
    J: Array
    joints: Sequence[TreeJoint] = ()
    lifted: float = 0.0


@dataclass(frozen=True)
class Line:
    """A fixed tendon: a length that is a sum of coordinates, ℓ = Σ coefficient q.

    spring: between these two lengths it is slack; stiffness [N/m], damping [N s/m], armature [kg].
    """

    name: str
    coefficients: Array  # (n,), of the v that change it
    spring: tuple[float, float]
    stiffness: float
    damping: float
    armature: float


@dataclass(frozen=True)
class Motor:
    """An actuator without a state: force = gain u + b₀ + b₁ ℓ + b₂ ℓ̇, clamped, times its moments.

    moments (n,): ∂ℓ/∂q̇. gain (3,): g₀ + g₁ ℓ + g₂ ℓ̇; bias (3,). u: the number of its control.
    control and force: within which limits they are held.
    """

    name: str
    moments: Array
    u: int
    gain: Array
    bias: Array
    control: tuple[float, float]
    force: tuple[float, float]


@dataclass(frozen=True)
class Tree:
    """All numbers of a model with n velocities v and m coordinates q.

    springs: by joint's first v the stiffness and the q (one, or a quaternion's four) of rest.
    armature, damping: (n,). clamped: (n, 2) what the motors may exert on each v together.
    weight_by_motors (n,) bool: whether the compensated weight counts as a motor's.
    """

    links: Sequence[Link]
    n: int
    gravity: Array
    armature: Array
    damping: Array
    springs: Sequence[tuple[TreeJoint, float, Array]] = ()
    lines: Sequence[Line] = ()
    motors: Sequence[Motor] = ()
    clamped: Array | None = None
    weight_by_motors: Array | None = None
    unread: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """What the model has beside, in words, by the part of the equations that lacks it."""

    @property
    def joints(self) -> list[TreeJoint]:
        """All joints, in the order of their links."""
        return [joint for link in self.links for joint in link.joints]

    @cached_property
    def places(self) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
        """(n,): of each velocity of a hinge or slide its coordinate; of others the first."""
        places = np.zeros(self.n, dtype=np.intp)
        for joint in self.joints:
            places[joint.v : joint.v + WIDTH[joint.kind][1]] = joint.q
        return places

    @cached_property
    def carried(self) -> Array:
        """(links, n): 1 where a velocity moves the link, 0 elsewhere."""
        rows = np.zeros((len(self.links), self.n))
        for row, link in zip(rows, self.links, strict=True):
            row[:] = rows[link.parent] if link.parent >= 0 else 0.0
            for joint in link.joints:
                row[joint.v : joint.v + WIDTH[joint.kind][1]] = 1.0
        return rows

    @cached_property
    def before(self) -> Array:
        """(n, n): 1 where the second velocity moves the axis of the first, 0 elsewhere.

        They are numbered from the ground outwards. A turn about three axes moves none of them
        against the body, which carries them.
        """
        rows = np.zeros((self.n, self.n))
        for row, link in zip(self.carried, self.links, strict=True):
            for joint in link.joints:
                turns, end = joint.v + SHIFTS[joint.kind], joint.v + WIDTH[joint.kind][1]
                rows[joint.v : turns, : joint.v] = row[: joint.v]
                rows[turns:end, :turns] = row[:turns]
        return rows

    def named(self, k: int) -> str:
        """Returns whose velocity the k-th is: a joint's name, and of several which of them."""
        joint = next(j for j in reversed(self.joints) if j.v <= k)
        return joint.name if WIDTH[joint.kind][1] == 1 else f"{joint.name} ({k - joint.v + 1})"


MASS, BIAS, PASSIVE, DRIVEN = "mass matrix", "bias", "passive forces", "actuator forces"
PARTS = (MASS, BIAS, PASSIVE, DRIVEN)
"""Of M v̇ + bias = passive + actuator forces + those of constraints."""
CONSTRAINTS, MOTION = "constraints", "motion"
"""What is compared beside them: forces where constraints act, and the motion where none does."""
