"""Joints in space: each is the freedoms that it leaves, in their order from the first part on."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar, Literal

import numpy as np

from ...fields.kind import WORK, Fields
from ...trajectory import Array
from .. import chain
from ..chain import Turns
from ..counting import counted, nearest
from ..frame import SPACE
from ..joint import Freedom
from ..motion import Motion
from ..point import GROUND, Anchor
from ..rotation import UPRIGHT, turned

_FORCES: Fields = {
    "fx": ("N", "force"),  # what the first part exerts on the second, in ground axes
    "fy": ("N", "force"),
    "fz": ("N", "force"),
    "force": ("N", "force"),  # its magnitude
    "gap": ("m", "residual"),  # constraint drift
}
_MOMENTS: Fields = {
    "mx": ("N m", "force"),  # the same about the second point
    "my": ("N m", "force"),
    "mz": ("N m", "force"),
    "moment": ("N m", "force"),
}
HELD = (*_FORCES, *_MOMENTS, *WORK)
"""Names of what can be observed of any joint: no freedom has these names."""


@dataclass(frozen=True)
class SpatialJoint:
    """A joint in space between points of two parts; it leaves some freedoms.

    Shifts come before turns; without a turn the axes of both parts are parallel. What is not left
    free is held. begins: by the name of a turn, the angle [rad] near which the start has it: an
    attitude tells it but for whole turns, and of three turns in two ways.
    """

    dry_friction: ClassVar[None] = None  # nothing rubs in space
    swings: ClassVar[bool] = False  # nor is there a massless rod
    name: str
    kind: Literal["hinge", "ball", "universal", "slide", "weld", "freedoms"]  # the file's word
    a: Anchor  # the point of the first part
    b: Anchor  # the point of the second part: reactions are what it takes from the first
    freedoms: tuple[Freedom, ...]  # all that it leaves: an engine needs no more than these
    begins: Mapping[str, float] = field(default_factory=dict)

    @property
    def word(self) -> str:
        """The key under which a case file names its two points."""
        return "of" if self.kind == "freedoms" else self.kind

    @property
    def shifts(self) -> tuple[Freedom, ...]:
        return tuple(f for f in self.freedoms if f.kind == "shift")

    @property
    def turns(self) -> tuple[Freedom, ...]:
        """Up to three turns in their order, or one ball."""
        return tuple(f for f in self.freedoms if f.kind != "shift")

    @property
    def holds_attitude(self) -> bool:
        """Whether it leaves fewer than three turns."""
        return len(self.turns) < 3 and not any(f.kind == "ball" for f in self.freedoms)

    @property
    def counts(self) -> bool:
        """Whether a turn of it has a name, so that whole turns matter."""
        return any(f.kind == "turn" and f.name for f in self.freedoms)

    @property
    def named(self) -> tuple[Freedom, ...]:
        """The freedoms that can be observed and started by their names."""
        return tuple(f for f in self.freedoms if f.name)

    @property
    def rates(self) -> dict[str, Freedom]:
        """The named freedoms by the names of their rates, which can be prescribed."""
        return {f.rate: f for f in self.named}

    def turning(self, name: str) -> int:
        """The number of a turn among its freedoms: by its name, or by none where it is `angle`.

        Raises ValueError where there is no such turn.
        """
        return [f.name if f.kind == "turn" else None for f in self.freedoms].index(name or "angle")

    def refers(self) -> tuple[Anchor, ...]:
        """The points it joins, in the order of the file."""
        return (self.a, self.b)

    def quantities(self) -> dict[str, Fields]:
        """Its reactions, its gap, and its coordinates with their rates."""
        coordinates = {name: of for f in self.named for name, of in f.coordinate.items()}
        moments = _MOMENTS if self.holds_attitude else {}
        return {self.name: {**_FORCES, **moments, **coordinates}}

    def components(self, field: str) -> tuple[str, ...]:
        """The reactions that a producer gives, from which a force or moment follows."""
        if field in ("force", "moment"):
            return tuple(f"{field[0]}{axis}" for axis in "xyz")
        return (field,)

    def numbers(self) -> dict[str, float]:
        return {}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) what follows from the states and the given reactions; else KeyError."""
        if field in ("force", "moment"):
            parts = [motion.reaction(f"{self.name}.{name}") for name in self.components(field)]
            return np.linalg.norm(parts, axis=0)
        if field == "gap":
            return self._gap(motion)
        names = [f.name for f in self.freedoms]
        rates = [f.rate for f in self.freedoms]
        if field not in (*names, *rates):
            raise KeyError(f"{self.name}.{field}")
        which = field in rates
        return self.coordinates(motion)[which][:, (names, rates)[which].index(field)]

    def turn(self, motion: Motion, freedom: str) -> tuple[Array, Array]:
        """(N,) the angle [rad] of a turn, its whole turns counted, and its rate [rad/s]."""
        at = self.turning(freedom)
        angles, rates = self.coordinates(motion)
        return angles[:, at], rates[:, at]

    def power(self, motion: Motion) -> Array:
        """(N,) what the drives of its rates do [W]."""
        driven = [f for f in self.named if f"{self.name}.{f.rate}" in motion.drives]
        efforts = [motion.reaction(f"{self.name}.{f.effort}") for f in driven]
        speeds = [self.observe(motion, f.rate) for f in driven]
        return np.sum(np.multiply(efforts, speeds), axis=0)

    def _gap(self, motion: Motion) -> Array:
        """How far the second point is from where the freedoms let it be [m]."""
        d = (motion.point(self.b) - motion.point(self.a))[:, :3]
        q, _ = axes_of(motion, self.a.body)
        for freedom in chain.orthogonal([f.axis for f in self.shifts]):
            u = turned(q, freedom)
            d = d - np.sum(d * u, axis=1, keepdims=True) * u
        return np.linalg.norm(d, axis=1)

    def coordinates(self, motion: Motion) -> tuple[Array, Array]:
        """(N, K) the place [m or rad] of each freedom, and its rate; nan of a ball.

        Whole turns are those that the motion tells, or counted along its samples from the start.
        """
        first, second = (axes_of(motion, at.body) for at in (self.a, self.b))
        d = motion.point(self.b) - motion.point(self.a)
        shifts = chain.shifted([f.axis for f in self.shifts], d[:, :3], d[:, 3:], *first)
        if any(f.kind == "ball" for f in self.freedoms):
            return np.hstack([shifts[0], none := np.full((len(d), 1), np.nan)]), np.hstack(
                [shifts[1], none]
            )
        turns = self._turned(motion, *first, *second)
        return np.hstack([shifts[0], turns.angles]), np.hstack([shifts[1], turns.rates])

    def turned(self, motion: Motion) -> Turns:
        """Its turns by themselves, of which none is a ball's."""
        first, second = (axes_of(motion, at.body) for at in (self.a, self.b))
        return self._turned(motion, *first, *second)

    def _turned(self, motion: Motion, *axes: Array) -> Turns:
        ways = chain.turned_by([f.axis for f in self.turns], *axes)
        told = motion.trajectory.near.get(self.name)
        if told is not None:
            return nearest(ways, told)
        return counted(ways, motion.trajectory.times, self.begun)

    @property
    def begun(self) -> list[float | None]:
        """Near which angle each turn begins, as far as that is said."""
        return [self.begins.get(f.name) for f in self.turns]


def axes_of(motion: Motion, body: str) -> tuple[Array, Array]:
    """Attitude (N, 4) and ω (N, 3), in its own axes, of a part; the ground's axes stand still.

    A particle has no axes of its own: its states hold the ground's.
    """
    n = len(motion.trajectory.times)
    if body == GROUND:
        return np.tile(UPRIGHT, (n, 1)), np.zeros((n, 3))
    states = motion.trajectory.states[body]
    return states[:, SPACE.attitude], states[:, SPACE.spin]
