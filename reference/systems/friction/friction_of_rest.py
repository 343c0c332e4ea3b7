"""Block on a floor, drawn slowly by a spring dynamometer: fig 2.23, and fig 2.24 as its motion.

q = (x₁,). The end of the spring is at x₀ = u t. What the dynamometer shows grows to μ_s m g while
nothing moves; then the block jumps, and it shows less.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from ...system import Array, Guard, System
from .dynamometer import Dynamometer
from .stick_slip import modes, possible

G = 9.80665  # m/s²


@dataclass(frozen=True)
class FrictionOfRest(System):
    """m [kg], c [N/m], end moved with u > 0 [m/s], coefficients μ_s ≥ μ_k of the floor."""

    m: float
    c: float
    u: float
    mu_s: float
    mu_k: float

    def __post_init__(self) -> None:
        drawn, N, names = self.drawn, self.m * G, ("touch.tangent", "touch.normal")
        on_guide = modes(self.m, drawn.pull, drawn.dry)
        by_name = {name: replace(mode, N=N, names=names) for name, mode in on_guide.items()}
        object.__setattr__(self, "modes", by_name)

    @cached_property
    def drawn(self) -> Dynamometer:
        """(2.87) The same with F = μ F_N, F_N = m g [N]."""
        F, Fs = (mu * self.m * G for mu in (self.mu_k, self.mu_s))
        return Dynamometer(self.m, self.c, self.u, F, F, Fs, Fs)

    def start(self) -> tuple[str, Array, Array]:
        """At rest, the spring without force."""
        return self.drawn.start()

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.89) `slips` and `stops`."""
        return self.drawn.guards(mode)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) F_a within the static friction where it sticks."""
        return possible(self.modes[mode], self.drawn.dry, t, q, v) if mode == "stuck" else None

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.98) of the dynamometer with these forces of friction."""
        return self.drawn.closed_form(t)

    def closed_events(self, until: float) -> list[tuple[str, float]] | None:
        """(2.98) slips at μ_s m g/(c u), and after every rest."""
        return self.drawn.closed_events(until)
