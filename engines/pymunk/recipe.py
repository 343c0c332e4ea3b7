"""The tuned recipe: each number with its reason, as attributes of pymunk's Space and constraints.

`start.seed`, `start.iterations` and `time.midpoint` are what is done around the engine, see run.py.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from ...cases.scene import Scene
from ..engine import Choice, Start
from .holding import Holding, holding

_MIDPOINT = Choice(
    "time.midpoint",
    True,
    "pymunk drifts, then kicks: started h/2 back and read h/2 ahead this is position Verlet, "
    "of second order",
)
_SEED = Choice(
    "start.seed",
    1e-9,
    "a circle that only touches falls freely for one step; 1e-9 m is above rounding and "
    "below every reach",
)
_SLOP = Choice(
    "space.collision_slop",
    1e-6,
    "so deep a body rests after an impact; above the seed, or the contact opens every few steps",
)


@dataclass(frozen=True)
class Recipe:
    """The best numbers for a scene, by the step [s]."""

    always: tuple[Choice, ...]
    held: Holding | None

    def __call__(self, step: float) -> Sequence[Choice]:
        """The numbers for a step [s]."""
        return [*self.always, *(self.held.choices(step) if self.held else [])]

    @property
    def follows(self) -> bool:
        """Whether a number follows the step."""
        return self.held is not None and self.held.biased


def recipe(scene: Scene, start: Start) -> Recipe:
    """The best recipe; what nothing would feel is left as it is shipped."""
    always = [_MIDPOINT]
    if scene.contacts:
        always.append(_SEED)
    if any(contact.switches for contact in scene.contacts.values()):
        always.append(_SLOP)
    return Recipe(tuple(always), holding(scene, start))
