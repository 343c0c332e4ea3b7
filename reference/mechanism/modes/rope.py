"""A rope (2.14) on one side: nothing while it is slack, and taut no farther than its length.

It comes taut by an impact, as what lands on a floor without a rebound.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from ....cases.scene import Scene
from ....cases.scene.forces.rope import Rope
from ..constraints.constraint import Constraint
from ..constraints.constraint_terms import FIRST, SECOND, Distance
from ..kinematics.kinematics import Layout
from .unilateral_limit import Limit


@dataclass(frozen=True, kw_only=True)
class Roped(Limit):
    """A rope's end."""

    endings: tuple[str, str] = ("slackens", "tightens")

    def amiss(self, depth: float, speed: float) -> str:
        if depth:
            return f"{self.name} starts {depth * 1e3:.3g} mm longer than it is"
        return f"{self.name} starts taut, and with its ends parting by {speed:.3g} m/s"

    @property
    def pulls(self) -> str:
        return f"{self.name} would have to push"


def taut(rope: Rope, where: Layout) -> Constraint:
    """(2.14) −λ = −L; its multiplier pulls both ends together."""
    row = (Distance(FIRST, SECOND),)
    return Constraint(rope.name, (rope.a, rope.b), (row,), (("force",),), (-rope.length,), where)


def roped(scene: Scene, where: Layout) -> Iterator[Roped]:
    """Yields an element for each rope of the scene."""
    for rope in scene.ropes():
        yield Roped(
            name=rope.name, quantity=f"{rope.name}.force", normal=taut(rope, where),
            plane="end of its length",
        )  # fmt: skip
