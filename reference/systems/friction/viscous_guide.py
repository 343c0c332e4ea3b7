"""Block on a guide with linear viscous friction that differs with the direction (figure 2.20).

q = (x,). Under a sine force it drifts the way that brakes it less; under a force that grows it
moves at once, where dry friction would hold it (Exercise 2.6).
"""

import math
from dataclasses import dataclass
from itertools import count
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

# In a period, for the next zero of v. What is shorter than a look, as a dip of v where d is small,
# lies beside a whole period T after the last zero, and there v is below zero by u (1 − e^{−kT}).
LOOKS = 64
HALVINGS = 60  # of a look: to the last digit


class ViscousGuide(Mode):
    """m [kg] against −d₊ v forward and −d₋ v backward [N s/m], from rest at x = 0, and F_a(t)."""

    m: float
    d_minus: float
    d_plus: float

    coordinates = ("x",)

    def F_a(self, t: Any) -> Any:
        """(2.88) All else that acts along the guide [N]."""
        raise NotImplementedError

    def d(self, v: Any) -> float:
        """d₋ or d₊ [N s/m], by the direction of v."""
        return self.d_plus if np.real(v) > 0.0 else self.d_minus

    def start(self) -> tuple[Array, Array]:
        """At rest at x = 0."""
        return np.zeros(1), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.85), (2.88) m v̇ = F_a − d₋ v, v < 0; F_a − d₊ v, v > 0 [m/s²], (1,)."""
        return np.array([(self.F_a(t) - self.d(v[0]) * v[0]) / self.m])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) the guide bears nothing: all acts along it."""
        return {"guide.fy": 0.0}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẋ² [J]."""
        return self.m * v[0] ** 2 / 2

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46), (2.47) D = ½ d ẋ² [W]."""
        return self.d(v[0]) * v[0] ** 2 / 2

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = F_a [N], (1,)."""
        return np.array([self.F_a(t)])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, 0)."""
        return {"block": (q[0], 0.0, 0.0, v[0], 0.0, 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """The force F_a and the friction."""
        x, x_dot = float(q[0]), float(v[0])
        forces = (self.F_a(t), -self.d(x_dot) * x_dot)
        return [Load("block", (x, 0.0), (force, 0.0)) for force in forces]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The guide holds the block across it only."""
        return [Cut(("guide.fy",), None, "block", (float(q[0]), 0.0), ((0.0, 1.0),))]


@dataclass(frozen=True)
class ViscousGrowingForce(ViscousGuide):
    """The force −b t, b > 0 [N/s], as that of Example 2.3 on the block that dry friction holds."""

    m: float
    b: float
    d_minus: float
    d_plus: float

    def __post_init__(self) -> None:
        if not self.b > 0.0:
            raise ValueError(f"the force grows with b > 0, not {self.b}")
        object.__setattr__(self, "masses", {"block": Mass(self.m, None)})

    def F_a(self, t: Any) -> Any:
        """(2.97) F_a = −b t [N]."""
        return -self.b * t

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.88) v = −(b/d₋) (t − τ (1 − e^{−t/τ})), τ = m/d₋: it moves at once. x = ∫ v dt."""
        tau, rate = self.m / self.d_minus, self.b / self.d_minus
        gone = -tau * math.expm1(-t / tau)
        return np.array([-rate * (t * t / 2 - tau * (t - gone))]), np.array([-rate * (t - gone)])


@dataclass(frozen=True)
class ViscousDrift(ViscousGuide):
    """The force A sin w t [N], w [rad/s]."""

    m: float
    A: float
    w: float
    d_minus: float
    d_plus: float

    def __post_init__(self) -> None:
        if not (self.A != 0.0 and self.w > 0.0):
            raise ValueError(f"the force swings with A ≠ 0 and w > 0, not {self.A} and {self.w}")
        object.__setattr__(self, "masses", {"block": Mass(self.m, None)})
        object.__setattr__(self, "_known", [(0.0, 0.0, 1 if self.A > 0 else -1)])

    def F_a(self, t: Any) -> Any:
        """(2.88) F_a = A sin w t [N]."""
        return self.A * np.sin(self.w * t)

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.88) solved from one zero of v to the next, see `_after`."""
        begun = next(piece for piece in reversed(self._pieces_until(t)) if piece[0] <= t)
        x, v = self._after(*begun, t)
        return np.array([x]), np.array([v])

    def _after(self, t0: float, x0: float, way: int, t: float) -> tuple[float, float]:
        """(2.88) v = u(t) − u(t₀) e^{−k(t−t₀)}, u = A (k sin wt − w cos wt)/(m (k² + w²)), k = d/m.

        With m v = ∫ F_a − d x there is no second integral to take:
        d (x − x₀) = (A/w)(cos wt₀ − cos wt) − m v.
        """
        d = self.d_plus if way > 0 else self.d_minus
        k = d / self.m

        def u(t: float) -> float:
            turned = k * math.sin(self.w * t) - self.w * math.cos(self.w * t)
            return self.A * turned / (self.m * (k * k + self.w * self.w))

        v = u(t) - u(t0) * math.exp(-k * (t - t0))
        given = self.A / self.w * (math.cos(self.w * t0) - math.cos(self.w * t))
        return x0 + (given - self.m * v) / d, v

    def _pieces_until(self, t: float) -> list[tuple[float, float, int]]:
        """Where each piece begins: t₀, x₀ and the sign of v."""
        known: list[tuple[float, float, int]] = getattr(self, "_known")  # noqa: B009
        while known[-1][0] <= t:
            known.append(self._next(*known[-1]))
        return known

    def _next(self, t0: float, x0: float, way: int) -> tuple[float, float, int]:
        """The next zero of v: the first of a grid beyond it, then by halving."""
        look = 2 * math.pi / (self.w * LOOKS)
        i = next(i for i in count(1) if way * self._after(t0, x0, way, t0 + i * look)[1] < 0.0)
        low, high = t0 + (i - 1) * look, t0 + i * look
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            turned = way * self._after(t0, x0, way, middle)[1] < 0.0
            low, high = (low, middle) if turned else (middle, high)
        return high, self._after(t0, x0, way, high)[0], -way
