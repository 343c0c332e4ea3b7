"""Examples 2.3 and 2.4 under the smooth law of friction (2.95): stiff, and without any event.

q = (x,). The active force is F_a = r t − c x: a push that grows (r = −b, c = 0), or a spring c
whose end moves with u (r = c u).
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...laws.friction import Dry, smooth
from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector


def _half(y: float) -> float:
    """½ (1 − tanh y) = e^{−2y}/(1 + e^{−2y}) = 1/(1 + e^{2y}), to all digits however small."""
    small = math.exp(-2 * abs(y))
    return (small if y > 0.0 else 1.0) / (1 + small)


class _Block(Mode):
    """m [kg], c [N/m], r [N/s], the bounds of the friction [N], Δ [m/s] and A of (2.95)."""

    m: float
    c: float
    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float
    Delta: float
    A: float
    dry: Dry

    coordinates = ("x",)
    stiff = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"block": Mass(self.m, None)})
        dry = Dry(self.F_minus, self.F_plus, self.Fs_minus, self.Fs_plus)
        object.__setattr__(self, "dry", dry)

    @property
    def r(self) -> float:
        """How fast the active force grows [N/s]."""
        raise NotImplementedError

    def start(self) -> tuple[Array, Array]:
        """At rest at x = 0."""
        return np.zeros(1), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.95) m v̇ = F_a (p + n + h (P + N)) + F₋ (p + h P) − F₊ (n + h N) [m/s²], (1,).

        Of the velocity's band, p is what lies below, n above and h inside; of the static
        friction's, P below and N above. That F_fr cancels F_a inside both bands is done by hand:
        in doubles their difference is noise, and the motion that leaves the band grows out of
        forces far below it (at v = 0 of e^{−2AΔ} F_a, 4e-44 F_a in the book's examples).
        """
        x, x_dot = float(q[0]), float(v[0])
        F_a, dry = self.r * t - self.c * x, self.dry
        p, n = self._beyond(x_dot, self.Delta, self.Delta)
        P, N = self._beyond(F_a, dry.Fs_minus, dry.Fs_plus)
        h = 1 - p - n
        active = F_a * (p + n + h * (P + N))
        return np.array([(active + dry.F_minus * (p + h * P) - dry.F_plus * (n + h * N)) / self.m])

    def _beyond(self, x: float, below: float, above: float) -> tuple[float, float]:
        """½ (1 − tanh A(x + below)), ½ (1 + tanh A(x − above)): how far x is out of its band."""
        return _half(self.A * (x + below)), _half(self.A * (above - x))

    def _friction(self, t: float, x: float, x_dot: float) -> float:
        """(2.95) F_fr [N]."""
        return float(smooth(self.dry, self.Delta, self.A, x_dot, self.r * t - self.c * x))

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.95) the guide's force on the block [N]."""
        return {"guide.fx": self._friction(t, float(q[0]), float(v[0])), "guide.fy": 0.0}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẋ² [J]."""
        return self.m * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ c x² [J]; what the time brings is in Q."""
        return self.c * q[0] ** 2 / 2

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = r t + F_fr [N], (1,)."""
        return np.array([self.r * t + self._friction(t, float(q[0]), float(v[0]))])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, 0)."""
        return {"block": (q[0], 0.0, 0.0, v[0], 0.0, 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """The active force and the friction."""
        x = float(q[0])
        forces = (self.r * t, -self.c * x, self._friction(t, x, float(v[0])))
        return [Load("block", (x, 0.0), (force, 0.0)) for force in forces]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The guide, across."""
        return [Cut(("guide.fy",), None, "block", (float(q[0]), 0.0), ((0.0, 1.0),))]


@dataclass(frozen=True)
class SmoothGrowingForce(_Block):
    """Example 2.3: m [kg], b [N/s], frictions [N], Δ [m/s] and A of (2.95)."""

    m: float
    b: float
    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float
    Delta: float
    A: float

    c = 0.0

    @property
    def r(self) -> float:
        """(2.97) F_a = −b t."""
        return -self.b


@dataclass(frozen=True)
class SmoothDynamometer(_Block):
    """Example 2.4: m [kg], c [N/m], u [m/s], frictions [N], Δ [m/s] and A of (2.95)."""

    m: float
    c: float
    u: float
    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float
    Delta: float
    A: float

    @property
    def r(self) -> float:
        """(2.98) F_a = c (u t − x)."""
        return self.c * self.u
