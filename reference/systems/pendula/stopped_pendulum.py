"""A bar about its end O that swings against a stop, and is thrown back by it or rests there.

q = (φ,), the angle of the bar against the x axis; the stop is at φ = `low`, and the bar above it.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class _Bar(Mode):
    """It swings, or rests on the stop at φ = low."""

    m: float
    l: float  # the book's letter
    low: float
    rests: bool

    coordinates = ("phi",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"bar": Mass(self.m, self.m * self.l**2 / 12)})

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.34), (2.35) ⅓ m l² φ̈ = −½ m g l cos φ, 0 at rest [rad/s²], (1,)."""
        return np.array([0.0 if self.rests else -1.5 * G / self.l * math.cos(q[0])])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23), (2.27) F = m r̈_c − m g [N]; at rest the stop's M = ½ m g l cos φ [N m]."""
        rate, change = float(v[0]), float(self.accelerations(t, q, v)[0])
        cos, sin, arm = math.cos(q[0]), math.sin(q[0]), self.m * self.l / 2
        forces = {
            "hinge.fx": -arm * (sin * change + cos * rate**2),
            "hinge.fy": arm * (cos * change - sin * rate**2) + self.m * G,
        }
        return forces | ({"stop.low": arm * G * cos} if self.rests else {})

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ⅙ m l² φ̇² [J]."""
        return self.m * self.l**2 / 6 * v[0] ** 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ m g l sin φ [J]."""
        return self.m * G * self.l / 2 * np.sin(q[0])

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) φ = low at rest [rad]."""
        return np.array([q[0] - self.low]) if self.rests else np.zeros(0)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) φ̇ = 0 at rest: λ is the stop's moment."""
        return np.ones((1, 1)) if self.rests else np.zeros((0, 1))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = ½ l (cos φ, sin φ)."""
        x, y = self.l / 2 * np.cos(q[0]), self.l / 2 * np.sin(q[0])
        return {"bar": (x, y, q[0], -y * v[0], x * v[0], v[0])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight at the centre."""
        x, y, *_ = self.poses(t, q, v)["bar"]
        return [Load("bar", (float(x), float(y)), (0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The hinge, with the stop's moment at rest."""
        names = ("hinge.fx", "hinge.fy", *(("stop.low",) if self.rests else ()))
        return [Cut(names, None, "bar", (0.0, 0.0), moment=self.rests)]


@dataclass(frozen=True)
class StoppedPendulum(System):
    """Bar of m [kg] and l [m], let go at phi0 > low [rad]; the stop throws back with e of ω."""

    m: float
    l: float
    phi0: float
    low: float
    e: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.e <= 1.0:
            raise ValueError(f"the restitution must lie between 0 and 1, not {self.e}")
        if not -math.pi / 2 <= self.low < self.phi0 < math.pi / 2:
            raise ValueError("the stop must be on the right of O, and the bar start above it")
        modes = {"swings": self._bar(False), "rests": self._bar(True)}
        object.__setattr__(self, "modes", modes)

    def _bar(self, rests: bool) -> _Bar:
        return _Bar(self.m, self.l, self.low, rests)

    def start(self) -> tuple[str, Array, Array]:
        """At rest at phi0."""
        return "swings", np.array([self.phi0]), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """`strikes` where φ = low: φ̇ := −e φ̇; with e = 0, and where strikes pile up, it rests."""
        if mode == "rests":
            return ()

        def then(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return "swings" if self.e else "rests", np.array([self.low]), -self.e * v

        def rests(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return "rests", np.array([self.low]), np.zeros(1)

        return (Guard("strikes", lambda t, q, v: float(q[0]) - self.low, then, rests),)

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """The strikes up to `until`, as far as they are told apart."""
        strikes = []
        for t in self._strikes():
            if t > until or (strikes and t - strikes[-1][1] < 1e-3 * until):
                break
            strikes.append(("strikes", t))
        return strikes

    def _strikes(self) -> Iterator[float]:
        """sin(θ/2) = k sin ψ, θ from hanging: from the top, ψ = ½ π, on it takes (K − F(ψ))/Ω.

        Ω² = 3 g/(2 l), and θ̇ = 2 Ω k cos ψ. With e of it k² is s² + e² (k² − s²), s = sin(θ/2) at
        the stop, and it comes back after twice as long as it takes from the top.
        """
        from scipy.special import ellipkinc

        Omega = math.sqrt(1.5 * G / self.l)
        s, square = (math.sin((phi + math.pi / 2) / 2) for phi in (self.low, self.phi0))
        square, t, ways = square**2, 0.0, 1
        while True:
            psi = math.asin(s / math.sqrt(square))
            t += ways * float(ellipkinc(math.pi / 2, square) - ellipkinc(psi, square)) / Omega
            yield t
            if not self.e:
                return
            square, ways = s**2 + self.e**2 * (square - s**2), 2

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """φ ≥ low, but for rounding."""
        passed = self.low - float(q[0])
        return f"the bar is {passed:.3g} rad beyond the stop" if passed > 1e-12 else None
