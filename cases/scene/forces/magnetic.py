"""The force of a magnetic field on a charge that a body carries in its centre."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

from ...fields.field import In
from ..point import CENTER, Anchor
from .element import Force


@dataclass(frozen=True)
class Magnetic(Force):
    """(2.49) V = ½ e B (y ẋ − x ẏ): F = e ṙ × B on the centre of a body, B along z everywhere."""

    word = "magnetic"
    works = False  # it is across the velocity
    body: str  # that carries the charge in its centre
    charge: Annotated[float, In("C")]  # e
    along_z: Annotated[float, In("T")]  # B

    def refers(self) -> tuple[Anchor, ...]:
        """The body's centre."""
        return (Anchor(self.body, CENTER),)

    def pace(self, mobility: Callable[[Anchor], float]) -> tuple[float, float]:
        """e B/m."""
        return abs(self.charge * self.along_z) * mobility(Anchor(self.body, CENTER)), 0.0
