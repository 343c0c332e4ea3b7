"""A spring that only presses or only pulls: (2.82) on one side of its rest length, else slack.

| spring | acts  | F = −c (λ − λ₀) | λ passes λ₀: slackens |
| spring | slack | nothing         | λ passes λ₀: tightens |

At λ₀ its force is zero on both sides, so q̇ and q̈ go through the event, and the rates of q̈ jump.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from ....cases.scene import Scene
from ....cases.scene.forces.force import Spring
from ...system import Array
from ..constraints.constraint import Constraint, row
from ..constraints.constraint_terms import FIRST, SECOND, Apart
from ..kinematics.kinematics import Layout
from .element import Element, State

OTHER: dict[State, State] = {"acts": "slack", "slack": "acts"}
HAPPENS: dict[State, str] = {"acts": "slackens", "slack": "tightens"}  # where the state ends


@dataclass(frozen=True, kw_only=True)
class OneSided(Element):
    """The spring, and how far it is from acting; `line`: its length over λ₀."""

    spring: Spring
    line: Constraint

    @property
    def way(self) -> float:
        """1 if it is slack when longer than λ₀, −1 if when shorter."""
        return 1.0 if self.spring.only == "compression" else -1.0

    def slack(self, t: float, q: Array) -> float:
        """± (λ − λ₀) [m], positive where it does not act."""
        return float(self.way * self.line.f(t, q.tolist())[0])

    def slackens(self, t: float, q: Array, v: Array) -> float:
        """± λ̇ [m/s], λ̇ = Δ·Δ̇/λ."""
        f, g, _ = row(self.line, t, q, v)
        return self.way * float(f @ v - g)

    def began(self, q: Array, v: Array, near: float) -> State:
        """Its state at the start; within `near` [m] of λ₀, by where it goes."""
        gap = self.slack(0.0, q)
        if abs(gap) > near:
            return "slack" if gap > 0.0 else "acts"
        return "slack" if self.slackens(0.0, q, v) >= 0.0 else "acts"

    def ends(self, state: State, t: float, q: Array) -> float:
        """The length [m] that falls through zero where the state ends."""
        return self.slack(t, q) if state == "slack" else -self.slack(t, q)


def one_sided(scene: Scene, where: Layout) -> Iterator[OneSided]:
    """Yields an element for each one-sided spring of the scene."""
    for spring in scene.one_sided():
        yield OneSided(name=spring.name, spring=spring, line=_line(spring, where))


def _line(spring: Spring, where: Layout) -> Constraint:
    """λ − λ₀, which nothing holds."""
    ends, held = (spring.a, spring.b), (spring.rest_length,)
    return Constraint(spring.name, ends, ((Apart(FIRST, SECOND),),), ((),), held, where)
