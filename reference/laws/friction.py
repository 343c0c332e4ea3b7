"""The book's friction laws: viscous, Coulomb with stiction, and what approximates the latter.

Forces [N] on the body; v [m/s] is its velocity, F_a [N] all that acts on it but friction. The
approximations blow v = 0 up to the band |v| ≤ Δ; as printed they disagree on the band's edges and
on those of the static friction (at v = 0, F_a = 6 = F_s₊, F₊ = 3: −6, −3 and −4.5).
"""

import math
from collections.abc import Callable
from dataclasses import astuple, dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..coverage import Numbered, equation
from ..system import Array

Interval = Callable[[float, float, Any], Any]  # h(a, b, x): 1 between a and b, else 0


@dataclass(frozen=True)
class Dry(Numbered):
    """F₋, F₊ against sliding to −x and +x, and the bounds F_s₋, F_s₊ of stiction [N], all ≥ 0.

    Stiction below the sliding friction is refused: (2.89) would then start a body and stop it in
    the same instant.
    """

    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float

    def __post_init__(self) -> None:
        if not all(force >= 0.0 for force in astuple(self)):
            raise ValueError(f"friction must not be negative: {self}")
        if self.F_minus > self.Fs_minus or self.F_plus > self.Fs_plus:
            raise ValueError(f"kinetic friction must not be above static friction: {self}")

    def sticks(self, F_a: float) -> bool:
        """(2.89) −F_s₋ ≤ F_a ≤ F_s₊: the band is closed."""
        return -self.Fs_minus <= F_a <= self.Fs_plus


@equation
def viscous(F: Callable[[Array], float], v: ArrayLike) -> Array:
    """(2.83), (2.84) F_fr = −F(v) v/|v|, and 0 at v = 0, (k,) [N]; v (k,)."""
    v = np.asarray(v, dtype=np.float64)
    return -F(v) * v / math.sqrt(v @ v) if v.any() else np.zeros_like(v)


@equation
def power_law(d: float, alpha: float, v: float) -> float:
    """(2.85), (2.86) F_fr = −d |v|^α sign(v), α > 0 [N]; with α < 1 it stops in finite time."""
    if not alpha > 0.0:
        raise ValueError(f"the exponent of viscous friction must be positive, not {alpha}")
    return -d * math.copysign(abs(v) ** alpha, v)


@equation
def coulomb(mu: float, F_N: float, v: float) -> float:
    """(2.87) F_fr = −μ F_N sign(v) [N], v ≠ 0: at v = 0 it says nothing, and that is refused."""
    if v == 0.0:
        raise ValueError("(2.87) says nothing at v = 0: use the law with stiction (2.89)")
    return -mu * F_N * math.copysign(1.0, v)


@equation
def stiction(dry: Dry, v: float, F_a: float) -> float:
    """(2.89) F₋, v < 0; −F₊, v > 0; v = 0: −F_a if it sticks, F₋ (F_a < −F_s₋), −F₊ else [N]."""
    return velocity_dependent(lambda _: dry.F_minus, lambda _: dry.F_plus, dry, v, F_a)


@equation
def velocity_dependent(
    F_minus: Callable[[float], float],
    F_plus: Callable[[float], float],
    dry: Dry,
    v: float,
    F_a: float,
) -> float:
    """(2.90) F₋(v), v < 0; −F₊(v), v > 0; at v = 0 as (2.89), F₋ and F₊ being the limits [N]."""
    if v != 0.0:
        return F_minus(v) if v < 0.0 else -F_plus(v)
    if dry.sticks(F_a):
        return -F_a
    return dry.F_minus if F_a < 0.0 else -dry.F_plus


@equation
def stribeck(F: float, F_s: float, v_s: float, v: float) -> float:
    """(2.90) F(v) = F + (F_s − F) e^{−|v|/v_s} [N]: fig 2.25 as Tustin (1947) has it.

    From F_s at rest it falls to F, most of it over the speed v_s [m/s].
    """
    return F + (F_s - F) * math.exp(-abs(v) / v_s)


@equation
def karnopp(dry: Dry, Delta: float, v: float, F_a: float) -> float:
    """(2.91) (2.89) with its branch of v = 0 for |v| ≤ Δ [N]: a body that sticks keeps its v."""
    return stiction(dry, 0.0 if abs(v) <= Delta else v, F_a)


@equation
def h_interval(a: float, b: float, x: float) -> float:
    """(2.92) h = 1, a ≤ x < b; 0 else."""
    return 1.0 if a <= x < b else 0.0


@equation
def h_signs(a: float, b: float, x: float) -> float:
    """(2.93) h = ½ (sign(x − a) + sign(b − x)): ½ at a and at b."""
    return float(np.sign(x - a) + np.sign(b - x)) / 2.0


@equation
def H(A: float) -> Interval:
    """(2.96) H(a, b, x) = ½ (tanh A(x − a) + tanh A(b − x))."""
    return lambda a, b, x: (np.tanh(A * (x - a)) + np.tanh(A * (b - x))) / 2.0


@equation
def boxcar(dry: Dry, Delta: float, v: Any, F_a: Any, *, h: Interval = h_signs) -> Any:
    """(2.94) F_fr = −F_a h(−Δ,Δ,v) h(−F_s₋,F_s₊,F_a) + F₋{…} − F₊{…} [N]."""
    inside = h(-Delta, Delta, v)
    backward = h(-math.inf, -Delta, v) + inside * h(-math.inf, -dry.Fs_minus, F_a)
    forward = h(Delta, math.inf, v) + inside * h(dry.Fs_plus, math.inf, F_a)
    stuck = inside * h(-dry.Fs_minus, dry.Fs_plus, F_a)
    return -F_a * stuck + dry.F_minus * backward - dry.F_plus * forward


@equation
def smooth(dry: Dry, Delta: float, A: float, v: Any, F_a: Any) -> Any:
    """(2.95) is (2.94) with H (2.96) for h [N]; inside the band it cancels F_a but never rests."""
    return boxcar(dry, Delta, v, F_a, h=H(A))
