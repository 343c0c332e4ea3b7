"""Muscles between two points (figure 2.17): what contracts with a spring in series, one beside."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

from ...fields.field import In
from ...fields.kind import Fields
from ...trajectory import Array
from ..motion import Motion
from ..point import Anchor
from .element import Force


@dataclass(frozen=True)
class Contracting(Force):
    """A muscle; the length u of what contracts is an inner state, with a start and its own rate.

    The spring in series has the rest of the length λ between the two points, unstretched at 0, and
    pulls with c_s (λ − u), as what contracts does; beside both c_p (λ − λ₀) pulls or pushes.
    """

    inner: ClassVar[str] = "contractile_length"
    a: Anchor  # one end
    b: Anchor  # the other
    isometric: Annotated[float, In("N", above=0)]  # F₀
    series_stiffness: Annotated[float, In("N/m", above=0)]  # c_s
    parallel_stiffness: Annotated[float, In("N/m", least=0)]  # c_p
    rest_length: Annotated[float, In("m", least=0)]  # λ₀ of the spring beside
    contractile_length: Annotated[float, In("m", above=0)]  # u at the start

    @property
    def begins(self) -> float:
        """u at the start [m]."""
        return self.contractile_length

    def refers(self) -> tuple[Anchor, ...]:
        """Its two ends."""
        return (self.a, self.b)

    def quantities(self) -> dict[str, Fields]:
        """length and contractile_length [m], and force [N], positive when it pulls."""
        lengths: Fields = dict.fromkeys(("length", self.inner), ("m", "coordinate"))
        return {self.name: {**lengths, "force": ("N", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) one of them; u as the producer gives it."""
        length, _ = motion.line(self.a, self.b)
        if field == "length":
            return length
        u = motion.reaction(f"{self.name}.{self.inner}")
        series, parallel = self.series_stiffness, self.parallel_stiffness
        return (
            u
            if field == self.inner
            else series * (length - u) + parallel * (length - self.rest_length)
        )

    def power(self, motion: Motion) -> Array:
        """−F λ̇, of all three."""
        _, rate = motion.line(self.a, self.b)
        return -self.observe(motion, "force") * rate

    def potential(self, motion: Motion) -> Array:
        """(2.45) ½ c_s (λ − u)² + ½ c_p (λ − λ₀)²."""
        length, _ = motion.line(self.a, self.b)
        series = length - motion.reaction(f"{self.name}.{self.inner}")
        beside = length - self.rest_length
        return (self.series_stiffness * series**2 + self.parallel_stiffness * beside**2) / 2


@dataclass(frozen=True)
class Muscle(Contracting):
    """Hill's: (F + a)(v + b) = (F₀ + a) b of the shortening speed v = −u̇, F > −a of any sign of v.

    Above F₀ it lengthens, on the same hyperbola.
    """

    word = "muscle"
    hill_a: Annotated[float, In("N", above=0)]  # a
    hill_b: Annotated[float, In("m/s", above=0)]  # b


@dataclass(frozen=True)
class LinearMuscle(Contracting):
    """F = F₀ − b v of the shortening speed v = −u̇."""

    word = "linear_muscle"
    damping: Annotated[float, In("N s/m", above=0)]  # b
