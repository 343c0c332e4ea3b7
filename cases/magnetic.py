"""The force of a magnetic field on a charge that a body carries in its centre."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated

from .body import Body
from .element import Force
from .language.grammar.field import In
from .point import CENTER, GROUND, Anchor


@dataclass(frozen=True)
class Magnetic(Force):
    """(2.49) V = ½ e B (y ẋ − x ẏ): F = e ṙ × B on the centre of a body, B along z everywhere."""

    word = "magnetic"
    body: str
    charge: Annotated[float, In("C")]
    along_z: Annotated[float, In("T")]

    def refers(self) -> tuple[Anchor, ...]:
        """The body's centre; the ground carries no charge."""
        return () if self.body == GROUND else (Anchor(self.body, CENTER),)

    def unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """The ground does not move."""
        return "acts on the ground; it acts on a body" if self.body == GROUND else None

    def pace(self, mobility: Callable[[Anchor], float]) -> tuple[float, float]:
        """e B/m."""
        return abs(self.charge * self.along_z) * sum(mobility(at) for at in self.refers()), 0.0
