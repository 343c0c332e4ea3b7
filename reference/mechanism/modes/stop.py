"""Stops of a joint's turn (2.14): φ − low ≥ 0 and high − φ ≥ 0, each a row that only pushes."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ....cases.scene import Scene
from ....cases.scene.forces.stops import Stops
from ..constraints.constraint import Constraint
from ..constraints.constraint_terms import FIRST, SECOND, Turning
from ..kinematics.kinematics import Layout
from .unilateral_limit import Limit


@dataclass(frozen=True, kw_only=True)
class Stopped(Limit):
    """One of two."""

    endings: tuple[str, str] = ("leaves", "strikes")

    def amiss(self, depth: float, speed: float) -> str:
        if depth:
            return f"{self.name} is passed by {math.degrees(depth):.3g}° at the start"
        return f"{self.name} is where it starts, and it turns into it with {speed:.3g} rad/s"

    @property
    def pulls(self) -> str:
        return f"{self.name} would have to hold what leaves it"


def stopped(scene: Scene, where: Layout) -> Iterator[Stopped]:
    """Yields an element for each side of each stop of the scene."""
    for stops in scene.stops():
        for side, (sense, at) in stops.sides.items():
            name = f"{stops.name}.{side}"
            yield Stopped(
                name=name, quantity=name, normal=ended(scene, stops, side, sense, at, where),
                restitution=stops.restitution, plane=f"{side} stop",
            )  # fmt: skip


def ended(
    scene: Scene, stops: Stops, side: str, sense: float, at: float, where: Layout
) -> Constraint:
    """(2.14) ±(φ_B − φ_A) = ±φ₀; its multiplier is a moment on the second part, or the opposite."""
    joint = scene.joints[stops.joint]
    row = (Turning(SECOND, sense), Turning(FIRST, -sense))
    ends, held = (joint.a, joint.b), (sense * at,)
    return Constraint(stops.name, ends, (row,), ((side,),), held, where)
