"""A rope (2.14) on one side: nothing while it is slack, and taut no farther than its length.

| rope | open | nothing | gap L − λ: tightens                |
| rope | acts | λ = L   | its force, the multiplier: slackens |

It comes taut by an impact, as what lands on a floor without a rebound.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from ...cases.rope import Rope
from ...cases.scene import Scene
from .constraint import Constraint
from .coordinates import Coordinates
from .element import Element, State
from .rows import FIRST, SECOND, Distance


@dataclass(frozen=True, kw_only=True)
class Roped(Element):
    """A rope, which slips along nothing."""

    rest: tuple[State, ...] = ("acts",)
    endings: tuple[str, str] = ("slackens", "tightens")

    @property
    def push(self) -> str:
        return f"{self.name}.force"

    @property
    def together(self) -> tuple[str, str]:
        """It shares its friction with nothing: it has none."""
        return self.name, ""

    def amiss(self, depth: float, speed: float) -> str:
        if depth:
            return f"{self.name} starts {depth * 1e3:.3g} mm longer than it is"
        return f"{self.name} starts taut, and with its ends parting by {speed:.3g} m/s"

    @property
    def pulls(self) -> str:
        return f"{self.name} would have to push"

    def held(self, state: State) -> list[Constraint]:
        """Nothing, or its length."""
        return [self.normal] if state == "acts" and self.normal is not None else []


def taut(rope: Rope, where: Coordinates) -> Constraint:
    """(2.14) −λ = −L; its multiplier pulls both ends together."""
    row = (Distance(FIRST, SECOND),)
    return Constraint(rope.name, (rope.a, rope.b), (row,), (("force",),), (-rope.length,), where)


def roped(scene: Scene, where: Coordinates) -> Iterator[Roped]:
    """All of the scene."""
    for rope in scene.ropes():
        yield Roped(name=rope.name, normal=taut(rope, where), plane="end of its length")
