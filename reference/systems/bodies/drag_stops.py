"""Hand-derived motion of a block along a guide whose drag is a power α of its speed (2.86).

No other force acts along the guide, and there is no weight. q = (x,), along the guide.

With α ≥ 1 it never stops; with α < 1 it does, in a finite time, and then rests: viscous friction
has no stiction, but nothing moves it (erratum 14).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

NOISE = 1e-12  # of v₀: two integrators differ by no more in a speed that falls to zero


@dataclass(frozen=True)
class Slowing(Mode):
    """Block of m [kg] against d |v|^α [N], d [N] being the force at 1 m/s; held, if it `rests`."""

    m: float
    d: float
    alpha: float
    rests: bool = False

    coordinates = ("x",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"block": Mass(self.m, None)})

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.86), (2.88) m v̇ = −d |v|^α sign(v), 0 where it rests [m/s²], (1,)."""
        return np.array([0.0 if self.rests else self._force(float(v[0])) / self.m])

    def _force(self, v: float) -> float:
        """Returns the drag [N] along the guide at this velocity."""
        return -self.d * math.copysign(abs(v) ** self.alpha, v)

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) The guide bears nothing, and what rests needs no force to rest."""
        return {"guide.fx": 0.0, "guide.fy": 0.0} if self.rests else {"guide.fy": 0.0}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẋ² [J]."""
        return self.m * v[0] ** 2 / 2

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = d |ẋ|^{α+1}/(α + 1) [W], Q = −∂D/∂ẋ; |ẋ| is √ẋ², for ẋ may be complex."""
        if self.rests:
            return 0.0 * v[0]  # of the type of v: complex while a derivative is taken
        return self.d * (v[0] * v[0]) ** ((self.alpha + 1) / 2) / (self.alpha + 1)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẋ = 0 where it rests."""
        return np.ones((1, 1)) if self.rests else np.zeros((0, 1))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, 0)."""
        return {"block": (q[0], 0.0, 0.0, v[0], 0.0, 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.86) the friction of the guide, along it."""
        return [Load("block", (float(q[0]), 0.0), (self._force(float(v[0])), 0.0))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """Returns the guide's cut: it holds the block across itself, at rest also along itself."""
        at = (float(q[0]), 0.0)
        if self.rests:
            return [Cut(("guide.fx", "guide.fy"), None, "block", at)]
        return [Cut(("guide.fy",), None, "block", at, ((0.0, 1.0),))]


@dataclass(frozen=True)
class DragStops(System):
    """Block of m [kg], drag d [N] at 1 m/s, exponent α > 0, thrown with v0 > 0 [m/s] from x = 0.

    Its mode `moves` ends, where α < 1, with the event `stops`, after which it is at `rest`.
    """

    m: float
    d: float
    alpha: float
    v0: float

    def __post_init__(self) -> None:
        if not (self.alpha > 0.0 and self.v0 > 0.0 and self.d > 0.0):
            raise ValueError("it slows down with d > 0, alpha > 0 and v0 > 0")
        modes = {"moves": Slowing(self.m, self.d, self.alpha)}
        if self.stops:
            modes["rest"] = Slowing(self.m, self.d, self.alpha, rests=True)
            # How far apart in time two answers have the stop: the speed has no slope there.
            object.__setattr__(self, "blurred", self._until(NOISE * self.v0))
        object.__setattr__(self, "modes", modes)

    @property
    def stops(self) -> bool:
        """Whether it comes to rest in a finite time."""
        return self.alpha < 1.0

    def _until(self, v: float) -> float:
        """(2.88) v^{1−α} = (1 − α) (d/m) (t_s − t): t_s − t [s], from the speed v to rest."""
        return v ** (1 - self.alpha) * self.m / (self.d * (1 - self.alpha))

    def start(self) -> tuple[str, Array, Array]:
        """The mode `moves`, x = 0 and v₀."""
        return "moves", np.zeros(1), np.array([self.v0])

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.86) `stops` where v falls to zero, with α < 1."""
        if mode == "rest" or "rest" not in self.modes:
            return ()
        rest = np.zeros(1)
        return (Guard("stops", lambda t, q, v: float(v[0]), lambda t, q, v: ("rest", q, rest)),)

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.88) v^{1−α} = v₀^{1−α} − (1 − α) k t, x = (v₀^{2−α} − v^{2−α})/((2 − α) k), k = d/m.

        α = 1: v = v₀ e^{−kt}, x = (v₀ − v)/k. α = 2: v = v₀/(1 + v₀ k t), x = ln(1 + v₀ k t)/k.
        """
        k, v0, alpha = self.d / self.m, self.v0, self.alpha
        if alpha == 1.0:
            v, x = v0 * math.exp(-k * t), -v0 / k * math.expm1(-k * t)
        elif alpha == 2.0:
            v, x = v0 / (1 + v0 * k * t), math.log1p(v0 * k * t) / k
        else:
            power = max(0.0, v0 ** (1 - alpha) - (1 - alpha) * k * t)
            v = power ** (1 / (1 - alpha))
            x = (v0 ** (2 - alpha) - v ** (2 - alpha)) / ((2 - alpha) * k)
        return np.array([x]), np.array([v])

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """(2.88) stops at t_s = v₀^{1−α}/((1 − α) k), if α < 1."""
        t_s = self._until(self.v0) if self.stops else math.inf
        return [("stops", t_s)] if t_s <= until else []
