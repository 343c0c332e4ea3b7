"""Hand-derived motion of a ball on a rope: in flight while the rope is slack, else on a circle.

q = (x, y) of the ball, from the fixed point to which the rope is tied, y upward. The rope has no
mass, does not stretch and only pulls. Where it tightens, the ball loses its velocity along the
rope, in an impact without rebound; where its force falls to zero the ball flies again.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector
from ..quadrature import integral

G = 9.80665  # m/s²
PANELS = 8  # of the quadrature that gives the time at which the rope slackens
BELOW = 1e-9  # of the length, or of the weight for a force: what rounding may be off by


@dataclass(frozen=True)
class _Ball(Mode):
    """One mode of a ball of m [kg] on a rope of L [m]: in flight, or on its circle if `taut`."""

    m: float
    L: float
    taut: bool

    coordinates = ("x", "y")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"ball": Mass(self.m, None)})

    def _pull(self, q: Array, v: Array) -> float:
        """(2.23) along the rope: F = m (v² − g y)/L where it is taut [N]."""
        return self.m * (float(v @ v) - G * float(q[1])) / self.L if self.taut else 0.0

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.23) m r̈ = m g − F r/|r| [m/s²], (2,)."""
        pull = self._pull(q, v) / self.m / math.sqrt(float(q @ q))
        return np.array([-pull * q[0], -G - pull * q[1]])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) λ = F where it is taut [N]."""
        return {"rope.force": self._pull(q, v)} if self.taut else {}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ṙ² [J]."""
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g y [J]."""
        return self.m * G * q[1]

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) L − √(x² + y²) = 0 where it is taut [m]."""
        return np.array([self.L - np.sqrt(q[0] ** 2 + q[1] ** 2)]) if self.taut else np.zeros(0)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.55) −r/|r|: λ pulls towards the point."""
        row = -q[:2] / np.sqrt(q[0] ** 2 + q[1] ** 2)
        return row[None, :] if self.taut else np.zeros((0, 2))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) r = (x, y)."""
        return {"ball": (q[0], q[1], 0.0, v[0], v[1], 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight."""
        return [Load("ball", (float(q[0]), float(q[1])), (0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """Returns the cut through the rope, whose force is along it, if it is taut."""
        x, y = q.tolist()
        away = math.hypot(x, y)
        pull = (-x / away, -y / away)
        return [Cut(("rope.force",), None, "ball", (x, y), (pull,))] if self.taut else []


@dataclass(frozen=True)
class BallOnRope(System):
    """Ball of m [kg] on a rope of L [m] that starts at (x0, y0) [m] with (vx0, vy0) [m/s].

    Its modes are `flies` and `swings`, and its events `tightens` and `slackens`.
    """

    m: float
    L: float
    x0: float
    y0: float
    vx0: float
    vy0: float

    def __post_init__(self) -> None:
        if math.hypot(self.x0, self.y0) > self.L * (1 + BELOW):
            raise ValueError(f"the ball must start within the rope's length, {self.L} m")
        modes = {"flies": _Ball(self.m, self.L, False), "swings": _Ball(self.m, self.L, True)}
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """The given place and velocity: in `swings` at the rope's end, else in `flies`."""
        at_its_end = math.hypot(self.x0, self.y0) > self.L * (1 - BELOW)
        state = np.array([self.x0, self.y0]), np.array([self.vx0, self.vy0])
        return "swings" if at_its_end else "flies", *state

    def guards(self, mode: str) -> Sequence[Guard]:
        """Returns what ends the mode: `tightens`, where |r| = L, or `slackens`, where F = 0."""
        if mode == "flies":
            slack = lambda t, q, v: self.L - math.sqrt(float(q @ q))  # noqa: E731
            return (Guard("tightens", slack, self._caught),)
        pull = lambda t, q, v: self.modes[mode].reactions(t, q, v)["rope.force"]  # noqa: E731
        return (Guard("slackens", pull, lambda t, q, v: ("flies", q, v)),)

    def _caught(self, t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
        """(2.22) the rope's impulse m Δṙ is along it: what is left is ṙ − (ṙ·n) n, |r| = L."""
        n = q / math.sqrt(float(q @ q))
        return "swings", self.L * n, v - (v @ n) * n

    def closed_events(self, until: float) -> list[tuple[str, float]] | None:
        """Names and times [s] of the events if it is dropped from rest, or struck where it hangs.

        None of other throws, which have no such form here.
        """
        if (self.vx0, self.vy0) == (0.0, 0.0):
            return _until(until, [("tightens", self._dropped())])
        hangs = self.x0 == self.vy0 == 0.0 and abs(self.y0 + self.L) <= BELOW * self.L
        return self._struck(until) if hangs else None

    def _dropped(self) -> float:
        """When [s] it tightens, y₀ − ½ g t² = −√(L² − x₀²); it then swings low, and stays taut."""
        return math.sqrt(2 * (self.y0 + math.sqrt(self.L**2 - self.x0**2)) / G)

    def _struck(self, until: float) -> list[tuple[str, float]] | None:
        """The events after it is struck with v₀ where it hangs; None if more follow than these two.

        With θ from hanging: F = 0 where cos θ = (2 g − v₀²/L)/(3 g), and |r| = L again 4 v_y/g
        later, v_y being upward where it slackens.  For there, F = 0 makes r̈ = g also along the
        rope: |r|² − L² begins with t³, (ṙ·g) t³ + ¼ g² t⁴.
        """
        square = self.vx0**2 / self.L
        if not 2 * G < square < 5 * G:  # it swings below the point, or goes round for ever
            return []
        top = math.acos((2 * G - square) / (3 * G))  # θ where it slackens, above the point
        slack = float(
            integral(
                lambda theta: 1 / np.sqrt((square - 2 * G * (1 - np.cos(theta))) / self.L),
                top,
                PANELS,
            )
        )
        speed = math.sqrt(-G * self.L * math.cos(top))  # of F = 0: m v²/L = −m g cos θ
        v_x, v_y = speed * math.cos(top), speed * math.sin(top)
        flight = 4 * v_y / G
        x, y = self.L * math.sin(top) + v_x * flight, -self.L * math.cos(top) - v_y * flight
        events = [("slackens", slack), ("tightens", slack + flight)]
        swings = (v_x * y + 3 * v_y * x) / self.L  # across the rope, v_y − g t being −3 v_y
        if swings**2 / 2 + G * y > 0 and until > slack + flight:
            return None  # it has the energy to come above the point again, and may slacken there
        return _until(until, events)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """Why it cannot be so: in flight |r| ≤ L must hold, on the rope F ≥ 0, but for rounding."""
        if mode == "flies":
            longer = math.sqrt(float(q @ q)) - self.L
            return f"the rope is {longer:.3g} m too long" if longer > BELOW * self.L else None
        pull = self.modes[mode].reactions(t, q, v)["rope.force"]
        return f"the rope pushes with {-pull:.3g} N" if pull < -BELOW * self.m * G else None


def _until(until: float, events: list[tuple[str, float]]) -> list[tuple[str, float]]:
    """Returns the events whose time [s] is not after `until`."""
    return [(name, t) for name, t in events if t <= until]
