"""The constraints of a disk that rolls on the floor y = 0, written as those of joints are."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

Numbers = Sequence[Any]


@dataclass(frozen=True)
class Touch:
    """A disk on the floor: y − R = 0, the second of (2.18)."""

    part: str
    xy: int
    R: float
    size: int = 1

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.18) y_c − R = 0."""
        return [q[self.xy + 1] - self.R]

    def fill(self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int) -> None:
        """(2.16) ẏ_c = 0."""
        rows[at, self.xy + 1] = 1

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: here λ is the normal force."""
        return {f"{self.part}.normal": multipliers[0]}


@dataclass(frozen=True)
class Roll:
    """Rolling on the floor: x + R φ = C₁ (φ counter-clockwise), the first of (2.17)."""

    part: str
    xy: int
    phi: int
    R: float
    C1: float | None  # known once the start is
    size: int = 1

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.17) x_c − R φ = C₁ with the book's clockwise φ."""
        assert self.C1 is not None
        return [q[self.xy] + self.R * q[self.phi] - self.C1]

    def fill(self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int) -> None:
        """(2.16) ẋ_c = R φ̇ with the book's clockwise φ."""
        rows[at, self.xy] = 1
        rows[at, self.phi] = self.R

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: here λ is the friction force."""
        return {f"{self.part}.tangent": multipliers[0]}
