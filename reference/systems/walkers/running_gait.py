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

from ...system import Array, Guard, Load, Pose, Vector
from ..pendula.elastic_pendulum import ElasticPendulum
from .spring_mass_jump import SpringMassJump

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
