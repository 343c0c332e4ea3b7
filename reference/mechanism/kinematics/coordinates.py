"""Maximal coordinates: where each body's x, y and angle stand in q, and its points' kinematics."""

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....cases.scene import GROUND, Anchor, Scene, Signal, Vector
from ...system import Pose
from .signal import signal, slope

ORIGIN = (0.0, 0.0)


class Point(NamedTuple):  # made at every evaluation: a frozen dataclass costs three times as much
    """(2.1) r = r_c + d, d = E x and (2.6) ṙ = ṙ_c + ω × d of a point; all ground axes."""

    r: tuple[Any, Any]
    r_dot: tuple[Any, Any]
    d: tuple[Any, Any]  # from the centre of mass to the point
    omega: Any
    angle: Any
    xy: int | None  # where the body's x stands in q; y follows; None on the ground
    phi: int | None  # where its angle stands; None for the ground and for particles


class Attached(NamedTuple):
    """A point on its body, in body axes from the centre of mass; or one of the ground."""

    xy: int | None
    phi: int | None
    at: Vector | None  # None: a particle, or the centre of mass itself
    velocity: Vector = (0.0, 0.0)  # of a point of the ground
    moves: Signal | None = None  # how far such a point is away, if by a law


@dataclass(frozen=True)
class Coordinates:
    """q = (x, y, angle) of each body in the scene's order; a particle has no angle."""

    scene: Scene

    @cached_property
    def columns(self) -> dict[str, tuple[int, int | None]]:
        """body → (index of x, index of the angle or None)."""
        at, columns = 0, {}
        for body in self.scene.bodies.values():
            columns[body.name] = (at, at + 2 if body.turns else None)
            at += 3 if body.turns else 2
        return columns

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The coordinate at each place of q, as a quantity: `crank.x`, `crank.angle`."""
        return tuple(self._names())

    def _names(self) -> Iterator[str]:
        for body in self.scene.bodies.values():
            yield from (f"{body.name}.x", f"{body.name}.y")
            if body.turns:
                yield f"{body.name}.angle"

    @cached_property
    def inner(self) -> dict[str, int]:
        """Where the inner states of forces stand, behind the bodies' coordinates."""
        return {name: len(self.names) + i for i, name in enumerate(self.scene.inner())}

    @cached_property
    def turning(self) -> NDArray[np.bool_]:
        """Which coordinates are angles, (n,)."""
        return np.array([name.endswith(".angle") for name in self.names])

    @cached_property
    def masses(self) -> list[float]:
        """The diagonal of the mass matrix: m, m, J for each body."""
        return [
            entry
            for body in self.scene.bodies.values()
            for entry in (body.mass, body.mass, *body.inertia)
        ]

    def poses(self, q: Any, v: Any) -> dict[str, Pose]:
        """(2.8) R_k, E_k of each body: its entries of q and v (n,), a particle's angle being 0."""
        return {
            name: (
                q[xy],
                q[xy + 1],
                0.0 if phi is None else q[phi],
                v[xy],
                v[xy + 1],
                0.0 if phi is None else v[phi],
            )
            for name, (xy, phi) in self.columns.items()
        }

    def place(self, poses: Mapping[str, Pose]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """q and v (n,) of given poses; behind the bodies' coordinates the inner states."""
        q, v = np.zeros(len(self.masses) + len(self.inner)), np.zeros(len(self.masses))
        for name, place in self.inner.items():
            q[place] = poses[name][0]
        for name, (xy, phi) in self.columns.items():
            x, y, angle, vx, vy, omega = poses[name]
            q[xy : xy + 2], v[xy : xy + 2] = (x, y), (vx, vy)
            if phi is not None:
                q[phi], v[phi] = angle, omega
        return q, v

    def velocities(self, poses: Mapping[str, Pose]) -> Any:
        """v (n,) of given poses, real or complex."""
        found: list[Any] = []
        for name, (_, phi) in self.columns.items():
            found += poses[name][3 : 5 if phi is None else 6]
        return np.array(found)

    @cached_property
    def attached(self) -> dict[tuple[str, str], Attached]:
        """Each point on its body, by the names of body and point."""
        ground = {
            (GROUND, name): Attached(None, None, point.at, point.velocity, point.moves)
            for name, point in self.scene.points.items()
        }
        return ground | {
            (body.name, name): Attached(*self.columns[body.name], at if any(at) else None)
            for body in self.scene.bodies.values()
            for name, at in body.points.items()
        }

    def point(self, anchor: Anchor, t: Any, q: Sequence[Any], v: Sequence[Any]) -> Point:
        """Where a named point is, and how it moves."""
        return moved(self.attached[anchor.body, anchor.point], t, q, v)


def moved(point: Attached, t: Any, q: Sequence[Any], v: Sequence[Any]) -> Point:
    """(2.1) r = r_c + d and (2.6) ṙ = ṙ_c + ω × d, for q and v as lists of numbers."""
    xy, phi, at, velocity, moves = point
    if xy is None:
        (x, y), (u, w) = at or ORIGIN, velocity
        if moves is not None:
            (dx, dy), rate = signal(moves, t), slope(moves, t)
            return Point((x + dx, y + dy), rate, ORIGIN, 0.0, 0.0, None, None)
        return Point((x + u * t, y + w * t), velocity, ORIGIN, 0.0, 0.0, None, None)
    r, r_dot = (q[xy], q[xy + 1]), (v[xy], v[xy + 1])
    if phi is None:
        return Point(r, r_dot, ORIGIN, 0.0, 0.0, xy, None)
    angle, omega = q[phi], v[phi]
    if at is None:
        return Point(r, r_dot, ORIGIN, omega, angle, xy, phi)
    cos, sin = trigonometry(angle)
    dx, dy = cos * at[0] - sin * at[1], sin * at[0] + cos * at[1]
    return Point(
        (r[0] + dx, r[1] + dy),
        (r_dot[0] - omega * dy, r_dot[1] + omega * dx),
        (dx, dy),
        omega,
        angle,
        xy,
        phi,
    )


def trigonometry(angle: Any) -> tuple[Any, Any]:
    """cos and sin of a float, or of a complex number while a derivative is taken."""
    if isinstance(angle, complex):
        return cmath.cos(angle), cmath.sin(angle)
    return math.cos(angle), math.sin(angle)
