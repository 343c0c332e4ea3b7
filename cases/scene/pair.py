"""Contacts of two bodies: a rim, a particle or a point of one, on the rim or a face of another.

The geometry of the contact is here (gap, normal, slip), as it follows from a motion; its forces
are known to whoever computes the motion. "Touching" is the body of the point `at`, "touched" the
other one, which has the rim or the face.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..fields.kind import Fields
from ..trajectory import ANGLE, OMEGA, VX, VY, Array, X, Y
from .body import Body
from .motion import Motion
from .point import CENTER, Anchor, Vector

_PAIR: Fields = {
    "normal": ("N", "force"),  # on what touches, away from what is touched
    "tangent": ("N", "force"),  # on what touches, along what has the normal to its left
    "slip": ("m/s", "residual"),  # of the body that touches, where it does
    "gap": ("m", "residual"),  # between both
}


ROUNDING = 1e-9  # of a face's length: a corner exactly at its end, as of equal blocks, is on it


@dataclass(frozen=True)
class Face:
    """A side of a block: its corners by name, and its outward unit normal in the block's axes.

    The ends stand so that the normal is to the left of the way from the first to the second.
    """

    ends: tuple[str, str]
    normal: Vector

    @property
    def along(self) -> Vector:
        """The unit vector with the normal to its left, from the first end to the second."""
        return (self.normal[1], -self.normal[0])


FACES = {
    "top": Face(("upper_left", "upper_right"), (0.0, 1.0)),
    "bottom": Face(("lower_right", "lower_left"), (0.0, -1.0)),
    "left": Face(("lower_left", "upper_left"), (-1.0, 0.0)),
    "right": Face(("upper_right", "lower_right"), (1.0, 0.0)),
}


@dataclass(frozen=True)
class Pair:
    """A contact of two bodies: what touches, and the body that it touches, on its rim or a face.

    As a contact on a plane it opens, slides and sticks or rolls. Its forces are those on what
    touches: along the normal, which points to it, and along what has the normal to its left.
    """

    name: str
    at: Anchor  # a disk is named by its centre and touches with its rim
    touched: str  # a body
    face: str | None  # of a block; None: it is touched on its rim
    static: float  # coefficient of friction; at least `kinetic`
    kinetic: float  # coefficient of friction where it slides
    restitution: float = 0.0  # speed after an impact over that before

    @property
    def body(self) -> str:
        """The name of the body that touches."""
        return self.at.body

    def refers(self) -> tuple[Anchor, ...]:
        """Returns the point that touches, and the centre of the body that is touched."""
        return self.at, Anchor(self.touched, CENTER)

    @property
    def on(self) -> str:
        """Where it touches, in words: `rim of drum`, `top of table`."""
        return f"rim of {self.touched}" if self.face is None else f"{self.face} of {self.touched}"

    @property
    def switches(self) -> bool:
        """Whether it has states, which change: open, sliding, sticking. Every pair has."""
        return True

    @property
    def friction(self) -> float:
        """The coefficient of an engine that has only one for rest and motion: the kinetic one."""
        return self.kinetic

    @property
    def side(self) -> Face:
        """The face that is touched; only where `face` is not None."""
        assert self.face is not None
        return FACES[self.face]

    @property
    def corner(self) -> Anchor:
        """The first end of the face that is touched: a point of its line."""
        return Anchor(self.touched, self.side.ends[0])

    def radius(self, bodies: Mapping[str, Body]) -> float:
        """Radius [m] of the rim that touches; 0 of a particle or a point."""
        radius = bodies[self.body].radius
        return radius if radius is not None and self.at.point == CENTER else 0.0

    def reach(self, bodies: Mapping[str, Body]) -> float:
        """Radius [m] of the rim that is touched; 0 of a face."""
        return 0.0 if self.face else bodies[self.touched].radius or 0.0

    def quantities(self) -> dict[str, Fields]:
        """Its reactions, how fast it slips on the other body, and the gap between both."""
        return {self.name: _PAIR}

    def numbers(self) -> dict[str, float]:
        """The coefficient of friction: what the audit reads back from an engine."""
        return {"friction": self.friction}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) the `gap` [m] or the `slip` [m/s] along a motion; of any other field KeyError."""
        if field not in ("gap", "slip"):
            raise KeyError(f"{self.name}.{field}")
        return (
            self.normal_and_gap(motion)[1] if field == "gap" else self.slip_and_gap_rate(motion)[0]
        )

    def place(self, motion: Motion) -> Array:
        """(N, 2) where it touches [m], in ground axes; while open, its point that is nearest."""
        touching: Array = motion.point(self.at)[:, :2]
        return touching - self.radius(motion.bodies) * self.normal_and_gap(motion)[0]

    def slip_and_gap_rate(self, motion: Motion) -> tuple[Array, Array]:
        """(N,) each: how fast [m/s] it slips along the tangent, and how fast the gap grows."""
        normal, place, states = (
            self.normal_and_gap(motion)[0],
            self.place(motion),
            motion.trajectory.states,
        )
        moves = _moves(states[self.body], place) - _moves(states[self.touched], place)
        # The tangent is (n_y, −n_x): the normal turned by −90°.
        slip = moves[:, 0] * normal[:, 1] - moves[:, 1] * normal[:, 0]
        return slip, np.sum(moves * normal, axis=1)

    def normal_and_gap(self, motion: Motion) -> tuple[Array, Array]:
        """(N, 2) the unit normal in ground axes, to what touches, and (N,) the gap [m]."""
        place = motion.point(self.at)[:, :2]
        if self.face is None:
            apart = place - motion.point(Anchor(self.touched, CENTER))[:, :2]
            distance = np.hypot(*apart.T)
            both = self.radius(motion.bodies) + self.reach(motion.bodies)
            return apart / distance[:, None], distance - both
        angle = motion.trajectory.states[self.touched][:, ANGLE]
        (x, y), cos, sin = self.side.normal, np.cos(angle), np.sin(angle)
        normal = np.stack([cos * x - sin * y, sin * x + cos * y], axis=1)
        apart = place - motion.point(self.corner)[:, :2]
        return normal, np.sum(normal * apart, axis=1) - self.radius(motion.bodies)

    def beyond(self, motion: Motion) -> NDArray[np.bool_]:
        """(N,) whether the touching point or centre is past an end of the face, along its line."""
        return np.minimum(*self.margins(motion)) < 0

    def margins(self, motion: Motion) -> tuple[Array, Array]:
        """(N,) each: from the two ends of the face to what touches, as shares of its length.

        Negative where it is past an end.
        """
        first, last = (motion.point(Anchor(self.touched, end))[:, :2] for end in self.side.ends)
        along = last - first
        share = np.sum((motion.point(self.at)[:, :2] - first) * along, axis=1)
        share /= np.sum(along * along, axis=1)
        return share + ROUNDING, 1 - share + ROUNDING


def _moves(states: Array, place: Array) -> Array:
    """(N, 2): the velocity [m/s] that a body's states (N, 6) have at the place (N, 2) (2.6)."""
    turn, (x, y) = states[:, OMEGA], (place - states[:, [X, Y]]).T
    return states[:, [VX, VY]] + np.stack([-turn * y, turn * x], axis=1)
