"""A slide that viscous friction (2.86) of an exponent α below 1 stops, in a finite time.

| element | state    | what holds     | what ends it, falling to zero |
|---------|----------|----------------|-------------------------------|
| slide   | slides ± | its friction   | its speed: stops              |
| slide   | sticks   | no slip        | what pushes it: slips         |

No force is left to hold it.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ....cases.scene import Scene
from ....cases.scene.forces.drag import Viscous
from ....cases.scene.forces.force import of_kind
from ..constraints.constraint import Constraint
from ..constraints.contact import at_rest
from ..kinematics.kinematics import Layout
from .element import Element, State

ROUNDING = 1e-15  # of weights and of m v²/l: a level slide has some angle, rounded
# Of the speed at the start: an integrator's rounding keeps a speed from falling any further, while
# the way that is left, v^{2−α} m/((2 − α) d), is lost in the rounding of the place.
LEAST = 1e-14


@dataclass(frozen=True, kw_only=True)
class Stopping(Element):
    """A slide that viscous friction stops.

    oils: its viscous friction, and `exponent` the smallest of theirs. least: a speed [m/s] that is
    none. room: what rounding makes along the slide of weights, and of what else keeps all bodies on
    their ways [N], which sets nothing off.
    """

    oils: tuple[str, ...]
    exponent: float
    least: float
    room: float

    def slowing(self, speed: float) -> float:
        """(2.86) |v|^{1−α}, which falls evenly where v̇ = −(d/m) v^α: v has no slope there."""
        above = speed - self.least
        return math.copysign(abs(above) ** (1.0 - self.exponent), above)

    def idle(self, state: State) -> tuple[str, ...]:
        """Its friction, at rest: with its steep root rounding of the speed would be a force."""
        return self.oils if state == "sticks" else ()

    def constraints(self, state: State) -> list[Constraint]:
        """Nothing, or no slip."""
        return [self.tangent] if state == "sticks" else []

    def margins(self, forces: Mapping[str, float]) -> tuple[float, float]:
        """(2.86) ∓F_a [N]: anything that pushes sets it off."""
        F_a = -forces[f"{self.name}.friction"]
        room = max(self.room, ROUNDING * max(map(abs, forces.values())))
        return room - F_a, room + F_a


def stopping(scene: Scene, where: Layout, speed: float) -> Iterator[Stopping]:
    """The slides without dry friction; speed [m/s] at the start, of anything."""
    oils = list(of_kind(Viscous, scene.forces.values()))
    lengths = [abs(x) for b in scene.bodies.values() for p in b.points.values() for x in p]
    turning = speed * speed / (max(lengths, default=0.0) or 1.0)
    force = math.hypot(*scene.gravity) + turning
    force *= sum(body.mass for body in scene.bodies.values())
    for joint in scene.joints.values():
        mine = [force for force in oils if force.joint == joint.name]
        exponent = min((force.exponent for force in mine), default=1.0)
        if joint.dry_friction is None and exponent < 1.0:
            yield Stopping(
                name=joint.name, slip=at_rest(joint, where),
                oils=tuple(force.name for force in mine), exponent=exponent,
                least=LEAST * (speed or 1.0), room=ROUNDING * force,
            )  # fmt: skip
