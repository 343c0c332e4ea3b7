"""Disk dropped on the floor without spin: it bounces with restitution e, or it stays (e = 0).

q = (h,), the height of its lowest point: h = y − R. In y, whose ε is that of R, a late and slow
bounce would be found to 1e-11 s only.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import EARLY, LAST, Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class _Disk(Mode):
    """In flight, or at rest on the floor."""

    m: float
    R: float
    rests: bool

    coordinates = ("h",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"wheel": Mass(self.m, self.m * self.R**2 / 2)})

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) ḧ = −g, 0 at rest [m/s²], (1,)."""
        return np.array([0.0 if self.rests else -G])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) λ = m g at rest, nothing in flight [N]: the floor's force on the wheel."""
        return {"touch.tangent": 0.0, "touch.normal": self.m * G if self.rests else 0.0}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ḣ² [J]."""
        return self.m * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g (R + h) [J]."""
        return self.m * G * (self.R + q[0])

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) h = 0 at rest [m]."""
        return np.array([q[0]]) if self.rests else np.zeros(0)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ḣ = 0 at rest: λ is the normal force."""
        return np.ones((1, 1)) if self.rests else np.zeros((0, 1))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (0, R + h)."""
        return {"wheel": (0.0, self.R + q[0], 0.0, 0.0, v[0], 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight at the centre."""
        return [Load("wheel", (0.0, self.R + float(q[0])), (0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The lowest point: nothing may push it sideways, and at rest the floor carries it."""
        low = (0.0, float(q[0]))
        if self.rests:
            return [Cut(("touch.tangent", "touch.normal"), None, "wheel", low)]
        return [Cut(("touch.tangent",), None, "wheel", low, ((1.0, 0.0),))]


@dataclass(frozen=True)
class BouncingDisk(System):
    """m [kg], R [m], restitution 0 ≤ e ≤ 1, dropped with its centre at y0 > R [m]."""

    m: float
    R: float
    e: float
    y0: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.e <= 1.0:
            raise ValueError(f"the restitution must lie between 0 and 1, not {self.e}")
        if not self.y0 > self.R:
            raise ValueError(f"the disk must start above the floor: y0 = {self.y0}, R = {self.R}")
        modes = {"flight": _Disk(self.m, self.R, False), "rest": _Disk(self.m, self.R, True)}
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """At rest at y0."""
        return "flight", np.array([self.y0 - self.R]), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """ḣ := −e ḣ where h = 0: `bounces`, and `lands` if e = 0."""
        if mode == "rest":
            return ()

        def then(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return "flight" if self.e else "rest", np.zeros(1), -self.e * v

        def rests(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return "rest", np.zeros(1), np.zeros(1)

        name = "bounces" if self.e else "lands"
        return (Guard(name, lambda t, q, v: float(q[0]), then, rests),)

    def _falls(self, until: float) -> list[float]:
        """Impacts at t₁ = √(2 (y₀ − R)/g), and each next one 2 eᵏ t₁ later, up to their limit."""
        t1 = math.sqrt(2 * (self.y0 - self.R) / G)
        times, flight = [t1], 2 * self.e * t1
        while times[-1] < times[-1] + flight <= until:
            times.append(times[-1] + flight)
            flight *= self.e
        return [time for time in times if time <= until]

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.18) h = y₀ − R − ½ g t²; after the k-th impact h = v τ − ½ g τ², v = eᵏ g t₁."""
        falls = self._falls(t)
        if not falls:
            return np.array([self.y0 - self.R - G * t**2 / 2]), np.array([-G * t])
        up, tau = self.e ** len(falls) * G * falls[0], t - falls[-1]
        if tau >= 2 * up / G:
            return np.zeros(1), np.zeros(1)
        return np.array([up * tau - G * tau**2 / 2]), np.array([up - G * tau])

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """The impacts up to `until`, but of those that pile up only the ones we tell apart."""
        name, falls = "bounces" if self.e else "lands", self._falls(until)
        for k in range(2, len(falls) if self.e < 1.0 else 0):
            flight = 2 * self.e ** (k + 1) * falls[0]
            if flight <= LAST * until or flight <= EARLY * until * (1 - self.e):
                return [(name, t) for t in falls[: k + 1]]
        return [(name, t) for t in falls]

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """h ≥ 0: the contact does not penetrate, but for rounding."""
        depth = -float(q[0])
        return f"the disk is {depth:.3g} m below the floor" if depth > 1e-12 * self.R else None
