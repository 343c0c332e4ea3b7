"""Where the bodies and the points of a scene are at one state, and how they move: all at once."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from .....cases.scene import GROUND, Anchor, Scene
from .attitude import matrices, skew
from .coordinates import SpatialCoordinates

UPRIGHT, NONE = np.array([1.0, 0.0]), np.zeros(1)  # behind q and v, for what does not turn or move


@dataclass(frozen=True)
class Bodies:
    """The state of each body, and last of the ground: R (K, 3, 3), r, ṙ, ω in its own axes (K, 3).

    wound: what counts the turns of joints, behind the bodies' coordinates.
    """

    R: Any
    r: Any
    r_dot: Any
    omega: Any
    wound: Any

    @cached_property
    def spin(self) -> Any:
        """ω (K, 3) in ground axes."""
        return carried(self.R, self.omega)

    @cached_property
    def moves(self) -> Any:
        """(K, 9, 3): R, R [ω]× and R [ω]× [ω]×, what makes d, ω × d and ω × (ω × d) of x."""
        turn = skew(self.omega)
        once = self.R @ turn
        return np.concatenate((self.R, once, once @ turn), axis=1)


@dataclass(frozen=True)
class Points:
    """(2.1) r = r_c + d, d = E x; (2.6) ṙ = ṙ_c + ω × d; and ω × (ω × d) of (2.7): (P, 3) each."""

    r: Any
    r_dot: Any
    d: Any
    turning: Any

    def between(self, count: int) -> Any:
        """(count, 3) each: r, ṙ and ω × (ω × d) of the last so many points less the first's."""
        return tuple(x[count:] - x[:count] for x in (self.r, self.r_dot, self.turning))


class Layout:
    """The bodies of a scene by number, the ground being the last, and named points of them."""

    def __init__(self, where: SpatialCoordinates) -> None:
        self.where, self.scene = where, where.scene
        self.numbers = {name: k for k, name in enumerate((*where.columns, GROUND))}
        at = list(where.columns.values())
        one, zero, none = len(where.names), len(where.names) + 1, where.size
        self._r = _places([c.r for c in at], (zero,) * 3)
        self._attitude = _places([c.attitude for c in at], (one, zero, zero, zero))
        self._r_dot = _places([c.r_dot for c in at], (none,) * 3)
        self._omega = _places([c.omega for c in at], (none,) * 3)

    def bodies(self, q: Any, v: Any) -> Bodies:
        """At q (m,), with what counts turns behind it or without, and v (n,)."""
        m = len(self.where.names)
        wound, q, v = q[m:], np.concatenate((q[:m], UPRIGHT)), np.concatenate((v, NONE))
        R = matrices(q[self._attitude])
        return Bodies(R, q[self._r], v[self._r_dot], v[self._omega], wound)

    def attached(self, anchors: Sequence[Anchor]) -> "Attached":
        """Points by name, ready to be asked where they are."""
        return Attached(self.scene, self.numbers, anchors)


class Fixed:
    """Vectors x (P, 3), fixed in the bodies of these numbers (P,)."""

    def __init__(self, body: Any, x: Any) -> None:
        self.body, self.x = np.asarray(body, np.intp), np.asarray(x, float).reshape(-1, 3)
        self._column = self.x[:, :, None]

    def at(self, bodies: Bodies) -> Any:
        """(P, 3, 3): d in ground axes, ω × d, and ω × (ω × d)."""
        return (bodies.moves.take(self.body, axis=0) @ self._column).reshape(-1, 3, 3)


class Attached:
    """Some points of bodies and of the ground."""

    def __init__(self, scene: Scene, numbers: dict[str, int], anchors: Sequence[Anchor]) -> None:
        self.body = np.array([numbers[at.body] for at in anchors], np.intp)
        self.x = np.array([_own(scene, at) for at in anchors], float).reshape(-1, 3)
        self.velocity = np.array([_driven(scene, at) for at in anchors], float).reshape(-1, 3)
        self.arms = Fixed(self.body, self.x)
        self._driven = bool(self.velocity.any())

    def at(self, t: Any, bodies: Bodies) -> Points:
        """(2.1), (2.6) and the part of (2.7) that ω alone gives."""
        moved = self.arms.at(bodies)
        d, turning = moved[:, 0], moved[:, 2]
        r = bodies.r.take(self.body, axis=0) + d
        r_dot = bodies.r_dot.take(self.body, axis=0) + moved[:, 1]
        if self._driven:
            r, r_dot = r + self.velocity * t, r_dot + self.velocity
        return Points(r, r_dot, d, turning)


def carried(R: Any, x: Any) -> Any:
    """(K, 3): each vector of body axes in ground axes."""
    return (R @ x[:, :, None])[:, :, 0]


def back(R: Any, x: Any) -> Any:
    """(K, 3): each vector of ground axes in body axes."""
    return (x[:, None, :] @ R)[:, 0, :]


def _places(begins: Sequence[int | None], otherwise: tuple[int, ...]) -> Any:
    """Where each body's entries stand, last the ground's: `otherwise` where it has none."""
    width = len(otherwise)
    rows = [otherwise if begin is None else range(begin, begin + width) for begin in begins]
    return np.array([*map(tuple, rows), otherwise], np.intp)


def _own(scene: Scene, at: Anchor) -> Sequence[float]:
    return (
        scene.points[at.point].at if at.body == GROUND else scene.bodies[at.body].points[at.point]
    )


def _driven(scene: Scene, at: Anchor) -> Sequence[float]:
    """Velocities of the ground's points are given with three entries, or not at all."""
    velocity = scene.points[at.point].velocity if at.body == GROUND else ()
    return velocity if any(velocity) else (0.0, 0.0, 0.0)
