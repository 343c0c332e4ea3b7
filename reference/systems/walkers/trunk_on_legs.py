"""Trunk on two legs that only press (fig 2.16): trot, where it heaves, and bound, where it pitches.

q = (y, φ) of a slender bar, whose centre is guided along x = 0. The legs are springs without mass,
from its ends to feet at x = ∓ l/2.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²
ENDS = {"hind": -0.5, "fore": 0.5}  # s: of l from the centre, along the bar


@dataclass(frozen=True)
class _Trunk(Mode):
    """On some of its legs."""

    m: float
    l: float
    c: float
    l0: float
    legs: tuple[str, ...]

    coordinates = ("y", "phi")

    @property
    def J(self) -> float:
        """J = m l²/12 [kg m²]."""
        return self.m * self.l**2 / 12

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"trunk": Mass(self.m, self.J)})

    def leg(self, name: str, q: Vector) -> tuple[Any, Any, Any]:
        """(2.1) Δ = (s l (cos φ − 1), y + s l sin φ) from a leg's foot to its hip, and λ = |Δ|."""
        s = ENDS[name] * self.l
        x, y = s * (np.cos(q[1]) - 1.0), q[0] + s * np.sin(q[1])
        return x, y, np.sqrt(x * x + y * y)

    def _pushes(self, q: Array) -> Iterator[tuple[float, float, float]]:
        """(2.82) F_x, F_y of each leg that presses [N], and its moment M_c [N m]."""
        for name in self.legs:
            x, y, length = self.leg(name, q)
            push = self.c * (self.l0 - length) / length
            s = ENDS[name] * self.l
            cos, sin = math.cos(q[1]), math.sin(q[1])
            yield push * x, push * y, s * push * (cos * y - sin * x)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.23), (2.34) m ÿ = −m g + Σ F_y, J φ̈ = Σ s l (F_y cos φ − F_x sin φ), (2,)."""
        pushes = list(self._pushes(q))
        up, turning = sum(y for _, y, _ in pushes), sum(M for *_, M in pushes)
        return np.array([up / self.m - G, turning / self.J])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) the guide holds against what the legs push along x [N]."""
        return {"guide.fx": -sum(x for x, *_ in self._pushes(q))}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m ẏ² + ½ J φ̇² [J]."""
        return (self.m * v[0] ** 2 + self.J * v[1] ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g y + Σ ½ c (λ − λ₀)² [J]."""
        stored = sum(self.c * (self.leg(name, q)[2] - self.l0) ** 2 / 2 for name in self.legs)
        return self.m * G * q[0] + stored

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (0, y), turned by φ."""
        return {"trunk": (0.0, q[0], q[1], 0.0, v[0], v[1])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight at the centre, (2.82) the legs at their hips."""
        loads = [Load("trunk", (0.0, float(q[0])), (0.0, -self.m * G))]
        for name, (x, y, _) in zip(self.legs, self._pushes(q), strict=True):
            foot = ENDS[name] * self.l
            dx, dy, _ = self.leg(name, q)
            loads.append(Load("trunk", (foot + float(dx), float(dy)), (float(x), float(y))))
        return loads

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The guide holds the centre sideways only."""
        return [Cut(("guide.fx",), None, "trunk", (0.0, float(q[0])), ((1.0, 0.0),))]


MODES = {"flight": (), "hind": ("hind",), "fore": ("fore",), "stance": ("hind", "fore")}


@dataclass(frozen=True)
class TrunkOnLegs(System):
    """m [kg], l [m] on legs c [N/m], l0 [m], released in flight at y0 [m], phi0 [rad]."""

    m: float
    l: float
    c: float
    l0: float
    y0: float
    phi0: float
    w0: float  # φ̇ at the start [rad/s]

    def __post_init__(self) -> None:
        modes = {n: _Trunk(self.m, self.l, self.c, self.l0, legs) for n, legs in MODES.items()}
        object.__setattr__(self, "modes", modes)
        if any(self._free(leg, np.array([self.y0, self.phi0])) <= 0.0 for leg in ENDS):
            raise ValueError("the trunk must start in flight, both legs longer than l0")

    def _free(self, leg: str, q: Array) -> float:
        """λ − λ₀ [m] of a leg."""
        return float(self.modes["flight"].leg(leg, q)[2]) - self.l0  # type: ignore[attr-defined]

    def start(self) -> tuple[str, Array, Array]:
        """Neither rising nor falling, and pitching."""
        return "flight", np.array([self.y0, self.phi0]), np.array([0.0, self.w0])

    def guards(self, mode: str) -> Sequence[Guard]:
        """Each leg lifts off where λ rises to λ₀, and touches down where it falls to it."""
        return [self._guard(mode, leg) for leg in ENDS]

    def _guard(self, mode: str, leg: str) -> Guard:
        pressed = leg in MODES[mode]
        legs = {*MODES[mode]} ^ {leg}
        after = next(name for name, those in MODES.items() if {*those} == legs)
        way = -1.0 if pressed else 1.0
        return Guard(
            f"{leg} {'lifts off' if pressed else 'touches down'}",
            lambda t, q, v: way * self._free(leg, q),
            lambda t, q, v: (after, q, v),
        )

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """λ ≤ λ₀ of a leg that presses, λ ≥ λ₀ of the others, but for rounding."""
        for leg in ENDS:
            over = self._free(leg, q) / self.l0
            if (over if leg in MODES[mode] else -over) > 1e-12:
                return f"the {leg} leg is {over:.3g} of its rest length longer in {mode}"
        return None
