"""Ladder that slides down between a smooth wall and a smooth floor, and leaves the wall.

q = (x, φ): the middle of the slender bar is x from the wall and a sin φ above the floor, a = l/2,
where φ is its angle with the floor.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector
from ..quadrature import integral

G = 9.80665  # m/s²
PANELS = 8  # of the time at which it leaves: the integrand is smooth, and this is beyond rounding


@dataclass(frozen=True)
class _Ladder(Mode):
    """On the floor, and leaning on the wall or not."""

    m: float
    l: float  # the book's letter
    leans: bool

    coordinates = ("x", "phi")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"rod": Mass(self.m, self._J)})

    @property
    def _J(self) -> float:
        """(2.32) J₃₃ = m l²/12 [kg m²]."""
        return self.m * self.l**2 / 12

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) (J + m a²) φ̈ = −m g a cos φ, x = a cos φ; alone ẍ = 0 and
        (J + m a² cos² φ) φ̈ = m a² φ̇² cos φ sin φ − m g a cos φ [m/s², rad/s²], (2,).
        """
        a, cos, sin = self.l / 2, math.cos(q[1]), math.sin(q[1])
        if self.leans:
            turning = -3 * G * cos / (2 * self.l)
            return np.array([-a * (sin * turning + cos * v[1] ** 2), turning])
        torque = self.m * a * cos * (a * v[1] ** 2 * sin - G)
        return np.array([0.0, torque / (self._J + self.m * (a * cos) ** 2)])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) N_foot = m (g + ÿ), y = a sin φ; N_top = m ẍ [N]."""
        along, turning = self.accelerations(t, q, v)
        rising = self.l / 2 * (math.cos(q[1]) * turning - math.sin(q[1]) * v[1] ** 2)
        return {"foot.normal": self.m * (G + rising), "top.normal": self.m * along}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m (ẋ² + a² φ̇² cos² φ) + ½ J φ̇² [J]."""
        up = self.l / 2 * np.cos(q[1]) * v[1]
        return (self.m * (v[0] ** 2 + up**2) + self._J * v[1] ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g a sin φ [J]."""
        return self.m * G * self.l / 2 * np.sin(q[1])

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) x − a cos φ = 0 where it leans: the upper end is at the wall [m]."""
        return np.array([q[0] - self.l / 2 * np.cos(q[1])]) if self.leans else np.zeros(0)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẋ + a φ̇ sin φ = 0 where it leans: λ is the wall's force."""
        return np.array([[1.0, self.l / 2 * np.sin(q[1])]]) if self.leans else np.zeros((0, 2))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, a sin φ), turned clockwise by φ: the bar starts at the wall."""
        a = self.l / 2
        return {"rod": (q[0], a * np.sin(q[1]), -q[1], v[0], a * np.cos(q[1]) * v[1], -v[1])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight at the middle."""
        middle = (float(q[0]), self.l / 2 * math.sin(q[1]))
        return [Load("rod", middle, (0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The lower end, and where it leans the upper one: both are smooth."""
        x, along, up = float(q[0]), self.l / 2 * math.cos(q[1]), self.l * math.sin(q[1])
        foot = Cut(("foot.normal",), None, "rod", (x + along, 0.0), ((0.0, 1.0),))
        top = Cut(("top.normal",), None, "rod", (x - along, up), ((1.0, 0.0),))
        return [foot, top] if self.leans else [foot]


@dataclass(frozen=True)
class SlidingLadder(System):
    """m [kg], l [m], released at rest at the angle 0 < phi0 < 90° [rad] with the floor."""

    m: float
    l: float
    phi0: float

    def __post_init__(self) -> None:
        if not 0.0 < self.phi0 < math.pi / 2:
            raise ValueError(f"the ladder must lean on the wall: 0 < phi0 < 90°, not {self.phi0}")
        modes = {name: _Ladder(self.m, self.l, name == "leans") for name in ("leans", "slides")}
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """At rest at phi0."""
        return "leans", np.array([self.l / 2 * math.cos(self.phi0), self.phi0]), np.zeros(2)

    def guards(self, mode: str) -> Sequence[Guard]:
        """N_top = 0: it leaves the wall."""
        if mode == "slides":
            return ()
        push = lambda t, q, v: self.modes["leans"].reactions(t, q, v)["top.normal"]  # noqa: E731
        return (Guard("top opens", push, lambda t, q, v: ("slides", q, v)),)

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """(2.51) φ̇² = 3 g (sin φ₀ − sin φ)/l gives N_top = 0 at sin φ = ⅔ sin φ₀.

        t = ∫ dφ/φ̇ with φ = φ₀ − s²: 2 s/√(…) has a limit at s = 0, where the root is s √(…).
        """
        leaves = math.asin(2 * math.sin(self.phi0) / 3)

        def rate(s: Array) -> Array:
            drop = 2 * np.sin(s**2 / 2) * np.cos(self.phi0 - s**2 / 2)  # sin φ₀ − sin φ
            return 2 * s / np.sqrt(3 * G * drop / self.l)

        time = float(integral(rate, math.sqrt(self.phi0 - leaves), PANELS))
        return [("top opens", time)] if time <= until else []

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """N_foot > 0, and above the floor."""
        if q[1] <= 0.0:
            return "the ladder lies on the floor"
        normal = self.modes[mode].reactions(t, q, v)["foot.normal"]
        return None if normal > 0.0 else f"the floor would have to pull: {normal:.3g} N"
