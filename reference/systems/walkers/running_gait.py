"""Running as a point mass on a leg that only presses (fig 2.15): four steps, each on a foot ahead.

On a foot the mass is an elastic pendulum that stands: q = (λ, φ), from that foot; in flight from
the next one.  The leg has no mass.  Where the gait repeats itself, to swing it forward to the angle
alpha in each flight is to set its feet so far apart.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Guard, Load, Pose, System, Vector
from ..pendula.elastic_pendulum import ElasticPendulum

# Long jump as a point mass on a spring (fig 2.15, Blickhan & Seyfarth): stance, then flight.
#
# On its leg the mass is an elastic pendulum that stands: q = (λ, φ), from the foot.


class _Jumper(ElasticPendulum):
    """On the leg, or in flight (c = 0)."""

    body = "jumper"


@dataclass(frozen=True)
class SpringMassJump(System):
    """m [kg] on a leg c [N/m], l0 [m] that touches down at alpha [rad] with vx0, vy0 [m/s]."""

    m: float
    c: float
    l0: float
    alpha: float
    vx0: float
    vy0: float

    def __post_init__(self) -> None:
        if not self._leaning() < 0.0:
            raise ValueError("the leg must be shortened at touch-down: vx0, vy0 point away from it")
        stiffness = {"stance": self.c, "flight": 0.0}
        leg = self.l0, self.l0, self.alpha
        modes = {mode: _Jumper(self.m, c, *leg) for mode, c in stiffness.items()}
        object.__setattr__(self, "modes", modes)

    def _leaning(self) -> float:
        """λ̇ at touch-down [m/s]."""
        return self.vx0 * math.cos(self.alpha) + self.vy0 * math.sin(self.alpha)

    def start(self) -> tuple[str, Array, Array]:
        """The leg at its rest length, in the direction alpha from the foot."""
        across = self.vy0 * math.cos(self.alpha) - self.vx0 * math.sin(self.alpha)
        q, v = [self.l0, self.alpha], [self._leaning(), across / self.l0]
        return "stance", np.array(q), np.array(v)

    def guards(self, mode: str) -> Sequence[Guard]:
        """Where λ passes λ₀: `takes off`, and `touches down` if the mass falls back on its leg."""
        if mode == "stance":
            off = lambda t, q, v: self.l0 - float(q[0])  # noqa: E731
            return (Guard("takes off", off, lambda t, q, v: ("flight", q, v)),)
        down = lambda t, q, v: float(q[0]) - self.l0  # noqa: E731
        return (Guard("touches down", down, lambda t, q, v: ("stance", q, v)),)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """λ ≤ λ₀ in stance, λ ≥ λ₀ in flight, but for rounding: the leg does not pull."""
        over = float(q[0]) / self.l0 - 1.0
        if (over if mode == "stance" else -over) > 1e-12:
            return f"the leg is {over:.3g} of its rest length longer in {mode}"
        return None


STEPS = 4


@dataclass(frozen=True)
class _Runner(ElasticPendulum):
    """On a foot at `foot` [m], or in flight (c = 0)."""

    foot: float

    body = "jumper"

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x_k + λ cos φ, λ sin φ)."""
        x, *others = super().poses(t, q, v)[self.body]
        return {self.body: (self.foot + x, *others)}  # type: ignore[dict-item]

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, (2.82) spring F = −c (λ − λ₀) along itself, where the mass is."""
        x, y, *_ = self.poses(t, q, v)[self.body]
        return [Load(self.body, (float(x), float(y)), w.force) for w in super().loads(t, q, v)]


@dataclass(frozen=True)
class RunningGait(SpringMassJump):
    """A jump after which the mass lands on its leg again: the feet are at 0 and x2, x3, x4 [m]."""

    x2: float
    x3: float
    x4: float

    def __post_init__(self) -> None:
        super().__post_init__()
        leg = self.l0, self.l0, self.alpha
        modes = {
            f"{mode} {k}": _Runner(self.m, c, *leg, foot)
            for mode, c in (("stance", self.c), ("flight", 0.0))
            for k, foot in enumerate(self.feet, start=1)
        }
        object.__setattr__(self, "modes", modes)

    @property
    def feet(self) -> tuple[float, ...]:
        """x_k [m]."""
        return 0.0, self.x2, self.x3, self.x4

    def start(self) -> tuple[str, Array, Array]:
        """The start of the jump, in the mode on the first foot."""
        _, q, v = super().start()
        return "stance 1", q, v

    def guards(self, mode: str) -> Sequence[Guard]:
        """Where λ passes λ₀: `takes off` to the next foot, and `touches down` on it."""
        where, k = mode.split()[0], int(mode.split()[1])
        if where == "stance":
            following = min(k + 1, STEPS)
            off = lambda t, q, v: self.l0 - float(q[0])  # noqa: E731
            leap = lambda t, q, v: (f"flight {following}", *self._seen(k, following, q, v))  # noqa: E731
            return (Guard("takes off", off, leap),)
        down = lambda t, q, v: float(q[0]) - self.l0  # noqa: E731
        return (Guard("touches down", down, lambda t, q, v: (f"stance {k}", q, v)),)

    def _seen(self, k: int, other: int, q: Array, v: Array) -> tuple[Array, Array]:
        """λ, φ and their rates from another foot than the k-th."""
        x, y, _, x_dot, y_dot, _ = self.modes[f"flight {k}"].poses(0.0, q, v)["jumper"]
        x = x - self.feet[other - 1]
        l = math.hypot(x, y)
        turning = (x * y_dot - y * x_dot) / l**2
        return np.array([l, math.atan2(y, x)]), np.array([(x * x_dot + y * y_dot) / l, turning])

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """λ ≤ λ₀ on the one foot in stance, λ ≥ λ₀ from all others, but for rounding."""
        k = int(mode.split()[1])
        for other in range(1, STEPS + 1):
            over = float(self._seen(k, other, q, v)[0][0]) / self.l0 - 1.0
            stands = mode == f"stance {other}"
            if (over if stands else -over) > 1e-12:
                return f"the leg to foot {other} is {over:.3g} of its rest length longer in {mode}"
        return None
