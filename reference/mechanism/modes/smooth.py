"""A mechanism whose slides have the smooth law of dry friction (2.95): one mode, and stiff."""

import math
from collections.abc import Callable, Collection, Sequence
from typing import Any

import numpy as np

from ....cases.scene import DryFriction, Scene, Smooth
from ...coverage import equation
from ...laws.friction import Dry, smooth
from ...system import Array
from ..constraints.constraint import Constraint, row
from ..constraints.contact import Braking, Coulomb
from .element import Smoothed, dry
from .mode import Multibody
from .shared_friction import Shared


class SmoothMultibody(Multibody):
    """The mechanism at rest along its slides, moved by what (2.95) leaves of the active forces.

    Within the bands friction cancels the active force. In doubles their difference would be noise
    larger than what the motion out of the band grows from, so it is never formed.
    """

    stiff = True

    def __init__(
        self,
        scene: Scene,
        start: tuple[Array, Array],
        slides: Sequence[Smoothed],
        *,
        held: Sequence[Constraint] = (),
        braking: Sequence[Braking] = (),
        coulomb: Sequence[Coulomb] = (),
        shared: Sequence[Shared] = (),
        slack: Collection[str] = (),
        base: Multibody | None = None,
    ) -> None:
        self._laws = [_dry(slide.friction) for slide in slides]
        self._parts: tuple[Array, Array] | None = None  # of rows that are always the same
        self._rests = [slide.tangent for slide in slides]
        resting = [*held, *self._rests]
        self._resting = Multibody(
            scene, start, held=resting, braking=braking, coulomb=coulomb, slack=slack, base=base
        )
        self.rubbing = [Braking(part, self._friction(k)) for k, part in enumerate(self._rests)]
        super().__init__(
            scene, start, held=held, braking=[*braking, *self.rubbing], coulomb=coulomb,
            shared=shared, slack=slack, base=base,
        )  # fmt: skip

    def solve(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        """(2.60) at rest along the slides, and with F_a + F_fr along them: q̈ and λ are sums."""
        a, multipliers = self._resting.solve(t, q, v)
        a = self._without_rounding(t, q, v, a)
        along = np.zeros(len(q))
        for k, part in enumerate(self._rests):
            f, g, _ = row(part, t, q, v)
            F_a = -float(multipliers[self._r + k])
            along += _remaining_force(*self._laws[k], float(f @ v) - g, F_a) * f
        free = along / self._M
        if not self._r:
            return a + free, multipliers[:0]
        held = self._held(t, q, v)
        more = held.solve(-held.along(free))
        return a + free + held.pulled(more), multipliers[: self._r] + more

    def _without_rounding(self, t: float, q: Array, v: Array, a: Array) -> Array:
        """f_a q̈ᵃ = γ without the rounding of forces that cancel: a block held at rest has q̈ = 0."""
        rows, _, gamma = self._resting.rows(t, q, v)
        by_rows, beside = self._parts or _split(rows, self._M)
        if self._resting.holding.rows.constant:
            self._parts = by_rows, beside
        held = by_rows @ gamma
        return held + beside @ (a - held)

    def _friction(self, k: int) -> Callable[[float, Array, Array], float]:
        """(2.95) F_fr of the k-th slide; F_a is what would hold it at rest."""

        def force(t: float, q: Array, v: Array) -> float:
            multipliers = self._resting.solve(t, q, v)[1]
            F_a = -float(multipliers[len(multipliers) - len(self._rests) + k])
            f, g, _ = row(self._rests[k], t, q, v)
            F, law = self._laws[k]
            return float(smooth(F, law.band, law.sharpness, float(f @ v) - g, F_a))

        return force


def _dry(friction: DryFriction) -> tuple[Dry, Smooth]:
    assert friction.smooth is not None
    return dry(friction), friction.smooth


def _split(rows: Array, M: Array) -> tuple[Array, Array]:
    """Matrices from γ to q̈, (n, r), and from any q̈ to the part the rows leave free, (n, n)."""
    free = np.linalg.svd(rows)[2][len(rows) :]
    weighed = free * M
    by_rows: Any = rows.T @ np.linalg.inv(rows @ rows.T)
    beside: Any = free.T @ np.linalg.solve(weighed @ free.T, weighed)
    return by_rows, beside


@equation
def _remaining_force(F: Dry, law: Smooth, v: float, F_a: float) -> float:
    """(2.95) F_a + F_fr = F_a (1 − h_v h_F) + F₋ {…} − F₊ {…} [N], h = 1 − below − above."""
    slower, faster = _outside(law.sharpness, v, law.band, law.band)
    weaker, stronger = _outside(law.sharpness, F_a, F.Fs_minus, F.Fs_plus)
    inside = 1.0 - slower - faster
    free = slower + faster + inside * (weaker + stronger)
    backward, forward = slower + inside * weaker, faster + inside * stronger
    return F_a * free + F.F_minus * backward - F.F_plus * forward


@equation
def _outside(A: float, x: float, low: float, high: float) -> tuple[float, float]:
    """(2.96) ½ (1 − tanh A (x + low)) and ½ (1 + tanh A (x − high)), however small."""
    return _logistic(-2 * A * (x + low)), _logistic(2 * A * (x - high))


def _logistic(z: float) -> float:
    """1 / (1 + e^{−z}) = ½ (1 + tanh ½ z), without overflow."""
    small = math.exp(-abs(z))
    return (small if z < 0 else 1.0) / (1.0 + small)
