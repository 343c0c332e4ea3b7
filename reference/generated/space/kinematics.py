"""Where the bodies and the points of a scene are at one state, and how they move: all at once."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....cases.scene import GROUND, Anchor
from ....cases.space.scene import SpatialScene
from .attitude import cross, matrices
from .coordinates import SpatialCoordinates


@dataclass(frozen=True)
class Bodies:
    """Of each body, and last of the ground: R (K, 3, 3), r, ṙ, ω in its own axes (K, 3)."""

    R: Any
    r: Any
    r_dot: Any
    omega: Any

    @property
    def spin(self) -> Any:
        """ω (K, 3) in ground axes."""
        return carried(self.R, self.omega)


@dataclass(frozen=True)
class Points:
    """(2.1) r = r_c + d, d = E x; (2.6) ṙ = ṙ_c + ω × d; and ω × (ω × d) of (2.7): (P, 3) each."""

    r: Any
    r_dot: Any
    d: Any
    turning: Any


class Layout:
    """The bodies of a scene by number, the ground being the last, and named points of them."""

    def __init__(self, where: SpatialCoordinates) -> None:
        self.where, self.scene = where, where.scene
        self.numbers = {name: k for k, name in enumerate((*where.columns, GROUND))}
        at = list(where.columns.values())
        turning = [k for k, columns in enumerate(at) if columns.attitude is not None]
        self._turning = np.array(turning, np.intp)
        self._r = np.array([range(c.r, c.r + 3) for c in at], np.intp).reshape(-1, 3)
        self._r_dot = np.array([range(c.r_dot, c.r_dot + 3) for c in at], np.intp).reshape(-1, 3)

    def bodies(self, q: Any, v: Any) -> Bodies:
        """At q (m,) and v (n,)."""
        K, kind = len(self.numbers), np.result_type(q, v)
        R = np.zeros((K, 3, 3), kind)
        R[:] = np.eye(3)
        r, r_dot, omega = (np.zeros((K, 3), kind) for _ in range(3))
        r[:-1], r_dot[:-1] = q[self._r], v[self._r_dot]
        if len(self._turning):
            R[self._turning] = matrices(q[self.where.attitudes])
            omega[self._turning] = v[self.where.spins]
        return Bodies(R, r, r_dot, omega)

    def attached(self, anchors: Sequence[Anchor]) -> "Attached":
        """Points by name, ready to be asked where they are."""
        return Attached(self.scene, self.numbers, anchors)


class Attached:
    """Some points of bodies and of the ground."""

    def __init__(
        self, scene: SpatialScene, numbers: dict[str, int], anchors: Sequence[Anchor]
    ) -> None:
        self.body = np.array([numbers[at.body] for at in anchors], np.intp)
        self.x = np.array([_own(scene, at) for at in anchors], float).reshape(-1, 3)
        self.velocity = np.array([_driven(scene, at) for at in anchors], float).reshape(-1, 3)
        self._driven = bool(self.velocity.any())

    def at(self, t: Any, bodies: Bodies) -> Points:
        """(2.1), (2.6) and the part of (2.7) that ω alone gives."""
        R, omega = bodies.R[self.body], bodies.omega[self.body]
        turning = cross(omega, self.x)
        d, d_dot = carried(R, self.x), carried(R, turning)
        r, r_dot = bodies.r[self.body] + d, bodies.r_dot[self.body] + d_dot
        if self._driven:
            r, r_dot = r + self.velocity * t, r_dot + self.velocity
        return Points(r, r_dot, d, carried(R, cross(omega, turning)))


def carried(R: Any, x: Any) -> Any:
    """(K, 3): each vector of body axes in ground axes."""
    return np.matmul(R, x[:, :, None])[:, :, 0]


def back(R: Any, x: Any) -> Any:
    """(K, 3): each vector of ground axes in body axes."""
    return np.matmul(x[:, None, :], R)[:, 0, :]


def _own(scene: SpatialScene, at: Anchor) -> Sequence[float]:
    return (
        scene.points[at.point].at if at.body == GROUND else scene.bodies[at.body].points[at.point]
    )


def _driven(scene: SpatialScene, at: Anchor) -> Sequence[float]:
    """Velocities of the ground's points are given with three entries, or not at all."""
    velocity = scene.points[at.point].velocity if at.body == GROUND else ()
    return velocity if any(velocity) else (0.0, 0.0, 0.0)
