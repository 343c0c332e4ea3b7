"""A rope between two points: without mass, and never longer than it is."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, ClassVar

from ...fields.field import In
from ...fields.kind import Fields
from ...trajectory import Array
from ..motion import Motion
from ..point import Anchor
from .element import Limit


@dataclass(frozen=True)
class Rope(Limit):
    """(2.14) on one side, λ ≤ L: it pulls where it is taut, and is slack where λ < L.

    Where it comes taut its ends keep no velocity along it that would part them: the impact is
    plastic.
    """

    word = "rope"
    measured = "length"
    given: ClassVar[Mapping[str, tuple[str, ...]]] = {"force": ("force",)}
    a: Anchor  # one end
    b: Anchor  # the other
    length: Annotated[float, In("m", above=0)]  # L

    @property
    def sides(self) -> dict[str, tuple[float, float]]:
        """It pulls where it is as long as it can be."""
        return {"force": (-1.0, self.length)}

    def refers(self) -> tuple[Anchor, ...]:
        """Its two ends."""
        return (self.a, self.b)

    def quantities(self) -> dict[str, Fields]:
        """length and gap [m], how far its ends are apart and how much is slack; its force [N]."""
        apart: Fields = {"length": ("m", "coordinate"), "gap": ("m", "residual")}
        return {self.name: {**apart, "force": ("N", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) length or gap [m]; KeyError of its force, which only a producer knows."""
        length, _ = motion.line(self.a, self.b)
        return {"length": length, "gap": self.length - length}[field]

    def numbers(self) -> dict[str, float]:
        """L."""
        return {"length": self.length}
