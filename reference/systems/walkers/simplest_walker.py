"""The simplest walker (Garcia et al. 1998): two massless legs, a hip M, feet of mass m, m/M → 0.

q = (θ, φ): the standing leg against the normal of the slope, counter-clockwise, as in their paper,
and from the swinging leg to it.  Down the slope θ falls.  Midway the swinging leg passes through
the floor; its foot strikes where φ = 2θ in front.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...system import Array, Guard, Mode, System

G = 9.80665  # m/s²


@dataclass(frozen=True)
class _Stance(Mode):
    """On one leg. In the limit the swinging foot feels the hip, which does not feel it."""

    l: float
    gamma: float

    coordinates = ("theta", "phi")

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) θ̈ = k sin(θ − γ), φ̈ = θ̈ + θ̇² sin φ − k cos(θ − γ) sin φ, k = g/l; (2,)."""
        (theta, phi), (theta_dot, _), k = q.tolist(), v.tolist(), G / self.l
        turning = k * math.sin(theta - self.gamma)
        pulled = theta_dot**2 - k * math.cos(theta - self.gamma)
        return np.array([turning, turning + pulled * math.sin(phi)])


@dataclass(frozen=True)
class SimplestWalker(System):
    """l [m], slope gamma [rad]; after a strike θ = theta0 [rad] and θ̇ = w0 < 0 [rad/s]."""

    l: float
    gamma: float
    theta0: float
    w0: float

    def __post_init__(self) -> None:
        stance = _Stance(self.l, self.gamma)
        object.__setattr__(self, "modes", {"lifts": stance, "swings": stance})

    def start(self) -> tuple[str, Array, Array]:
        """Just after a strike."""
        return "lifts", *self._after(self.theta0, self.w0)

    def _after(self, theta: float, theta_dot: float) -> tuple[Array, Array]:
        """φ = 2θ, φ̇ = (1 − cos 2θ) θ̇: the foot that lets go does not yet move across its leg."""
        q = np.array([theta, 2 * theta])
        return q, np.array([theta_dot, (1 - math.cos(2 * theta)) * theta_dot])

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.27) `strikes` where 2θ − φ falls through 0: θ := −θ, θ̇ := θ̇ cos 2θ.

        It is 0 after a strike, too, and falls at first, while the foot behind is lifted.
        """
        if mode == "lifts":
            rises = lambda t, q, v: float(q[1] - 2 * q[0])  # noqa: E731
            return (Guard(None, rises, lambda t, q, v: ("swings", q, v)),)

        def struck(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            theta = float(q[0])
            return "lifts", *self._after(-theta, float(v[0]) * math.cos(2 * theta))

        return (Guard("strikes", lambda t, q, v: float(2 * q[0] - q[1]), struck),)
