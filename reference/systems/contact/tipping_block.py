"""Block that stands on two corners, is pushed at its top, and tips about the corner in front.

q = (α,): the slope of the diagonal from the corner in front, which sticks, to the corner that is
pushed. It runs through the middle, d = ½ √(w² + H²) from the corner; α₀ = arctan H/w.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class _Block(Mode):
    """On both corners, or on the one in front."""

    m: float
    w: float
    H: float
    b: float
    stands: bool

    coordinates = ("alpha",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"box": Mass(self.m, self._J)})
        if self.stands:  # horizontally the floor gives −b t in all, which corner how much is open
            object.__setattr__(self, "undetermined", ("left.tangent", "right.tangent"))

    @property
    def _J(self) -> float:
        """(2.32) J₃₃ = m (w² + H²)/12 [kg m²]."""
        return self.m * (self.w**2 + self.H**2) / 12

    @property
    def _alpha0(self) -> float:
        """Where it stands [rad]."""
        return math.atan2(self.H, self.w)

    def _arm(self, alpha: Any) -> tuple[Any, Any]:
        """How far the middle is behind the corner, and how high [m]."""
        d = math.hypot(self.w, self.H) / 2
        return d * np.cos(alpha), d * np.sin(alpha)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.34) ⅓ m (w² + H²) α̈ = b t 2 y − m g a, a behind and y above the corner [rad/s²], (1,);
        α̈ = 0 where it stands.
        """
        if self.stands:
            return np.zeros(1)
        behind, high = self._arm(float(q[0]))
        torque = 2 * self.b * t * high - self.m * G * behind
        return np.array([3 * torque / (self.m * (self.w**2 + self.H**2))])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) N_left = ½ m g − b t H/w and the rest in front; tipping N = m (g + ÿ),
        T = m ẍ − b t [N].
        """
        if self.stands:
            left = self.m * G / 2 - self.b * t * self.H / self.w
            right = self.m * G - left
            return {"left.normal": left, "right.normal": right, "floor.tangent": -self.b * t}
        (behind, high), turning = self._arm(float(q[0])), self.accelerations(t, q, v)[0]
        along = high * turning + behind * v[0] ** 2
        up = behind * turning - high * v[0] ** 2
        normal, tangent = self.m * (G + up), self.m * along - self.b * t
        return {"left.normal": 0.0, "right.normal": normal, "right.tangent": tangent}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ (J + ¼ m (w² + H²)) α̇² [J]."""
        return (self._J + self.m * (self.w**2 + self.H**2) / 4) * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g y [J]."""
        return self.m * G * self._arm(q[0])[1]

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = b t 2 y: the corner that is pushed is twice as high as the middle [N m]."""
        return np.array([2 * self.b * t * self._arm(q[0])[1]])

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) w sin(α − α₀) = 0 where it stands: the other corner is on the floor [m]."""
        return np.array([self.w * np.sin(q[0] - self._alpha0)]) if self.stands else np.zeros(0)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) w α̇ cos(α − α₀) = 0 where it stands: λ is the force on the other corner."""
        if not self.stands:
            return np.zeros((0, 1))
        return np.array([[self.w * np.cos(q[0] - self._alpha0)]])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (w/2 − a, y), angle α₀ − α: at first the middle of the bottom is at 0."""
        behind, high = self._arm(q[0])
        turned = self._alpha0 - q[0]
        return {"box": (self.w / 2 - behind, high, turned, high * v[0], behind * v[0], -v[0])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight at the middle, push at the upper corner behind."""
        behind, high = map(float, self._arm(float(q[0])))
        return [
            Load("box", (self.w / 2 - behind, high), (0.0, -self.m * G)),
            Load("box", (self.w / 2 - 2 * behind, 2 * high), (self.b * t, 0.0)),
        ]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The corner in front, and where it stands the other: what it takes along is in the sum."""
        axes = ((1.0, 0.0), (0.0, 1.0))
        along = "floor.tangent" if self.stands else "right.tangent"
        right = Cut((along, "right.normal"), None, "box", (self.w / 2, 0.0), axes)
        left = Cut(("left.normal",), None, "box", (-self.w / 2, 0.0), ((0.0, 1.0),))
        return [left, right] if self.stands else [right]


@dataclass(frozen=True)
class TippingBlock(System):
    """m [kg], w and H [m], push b t with b [N/s] at the upper corner behind, friction mu [1]."""

    m: float
    w: float
    H: float
    b: float
    mu: float

    def __post_init__(self) -> None:
        if not self.b > 0.0:
            raise ValueError(f"the push grows with b > 0, not {self.b}")
        if not self.mu > self.w / (2 * self.H):
            raise ValueError(
                f"with mu = {self.mu} it slides before it tips: mu > w/(2 H) = "
                f"{self.w / (2 * self.H):.6g}"
            )
        sizes = (self.m, self.w, self.H, self.b)
        modes = {name: _Block(*sizes, name == "stands") for name in ("stands", "tips")}
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """At rest on both corners, the push begins at zero."""
        return "stands", np.array([math.atan2(self.H, self.w)]), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """N_left = 0: it tips."""
        if mode == "tips":
            return ()
        push = lambda t, q, v: self.modes["stands"].reactions(t, q, v)["left.normal"]  # noqa: E731
        return (Guard("tips", push, lambda t, q, v: ("tips", q, v)),)

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """(2.23) b t H = ½ m g w."""
        time = self.m * G * self.w / (2 * self.b * self.H)
        return [("tips", time)] if time <= until else []

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) |T| ≤ μ N, N > 0, and not yet on its side."""
        if q[0] >= math.atan2(self.H, self.w) + math.pi / 2:
            return "the block lies on its side"
        along = "floor.tangent" if mode == "stands" else "right.tangent"
        forces = self.modes[mode].reactions(t, q, v)
        normal, tangent = forces["right.normal"] + forces["left.normal"], forces[along]
        if abs(tangent) > self.mu * normal:
            return f"sticking takes {abs(tangent):.6g} N, there is {self.mu * normal:.6g}"
        return None
