"""A user's own options as numbers of pymunk's, and the tuned recipe's numbers as such options."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ....cases.scene import Scene
from ...engine import Choice, Start
from ..model.contact import is_tip
from ..model.limit import eases
from ..model.slot import oblique
from .options import BY_THE_SCENE, PROTOCOL, full
from .recipe import recipe
from .settings import DEFAULT, defaults
from .solver_iterations import Holding, holding

_BECAUSE = "your own option"


@dataclass(frozen=True)
class Own:
    """The shipped numbers with the user's own on top; held: what the scene itself asks for."""

    always: tuple[Choice, ...]
    by_scene: tuple[str, ...]
    held: Holding | None

    def __call__(self, step: float) -> Sequence[Choice]:
        """The numbers for a step [s]."""
        left = (*(self.held.choices(step) if self.held else ()), eases(step))
        told = {choice.name: choice for choice in left}
        asked = {name: told[name] for name in self.by_scene if name in told}
        return list(({choice.name: choice for choice in self.always} | asked).values())

    @property
    def biased(self) -> bool:
        """Whether the bias of joints follows the step."""
        left = "constraint.error_bias" in self.by_scene
        return left and self.held is not None and self.held.biased

    @property
    def follows(self) -> bool:
        """Whether a number follows the step."""
        return self.biased or "limit.error_bias" in self.by_scene


def own(options: Mapping[str, Any], scene: Scene, start: Start) -> Own:
    """With a rehearsal, if an option leaves its number to the scene."""
    left = [full(name) for name, value in options.items() if value == BY_THE_SCENE]
    by_scene = [name for name in left if _matters(name, scene)]
    always = (*_shipped(scene, options), *_around(scene, options))
    return Own(always, tuple(by_scene), holding(scene, start) if by_scene else None)


def _shipped(scene: Scene, options: Mapping[str, Any]) -> Iterator[Choice]:
    """Attributes of the Space and of constraints, as pymunk or the user has them."""
    named = {full(name): x for name, x in options.items() if x != BY_THE_SCENE}
    for name, value in defaults().items():
        if _matters(name, scene):
            because = _BECAUSE if name in named else DEFAULT
            yield Choice(name, named.get(name, value), because)


def _around(scene: Scene, options: Mapping[str, Any]) -> Iterator[Choice]:
    """Choices of what is done around the engine, which nobody does who does not ask for it."""
    for option, name in PROTOCOL.items():
        value = options.get(option)
        if value not in (None, False, BY_THE_SCENE) and _matters(name, scene):
            yield Choice(name, value, _BECAUSE)


def _matters(name: str, scene: Scene) -> bool:
    if name.startswith("constraint."):
        return bool(scene.joints) or any(scene.limits())
    if name.startswith("limit."):
        return any(scene.limits())
    if "collision" in name or name == "start.seed":
        return bool(scene.pressed)
    if name == "contact.reflects":
        tips = any(is_tip(scene, contact) for contact in scene.contacts.values())
        return tips or bool(scene.pairs)
    if name == "slot.across":
        return any(oblique(scene, joint) for joint in scene.joints.values())
    return True


def as_options(scene: Scene, start: Start) -> dict[str, Any]:
    """The tuned recipe as own options; what it finds in the scene is left to the scene."""
    best = recipe(scene, start)
    named = {name: option for option, name in PROTOCOL.items()}
    found = {named.get(c.name, c.name.partition(".")[2]): c.value for c in best.always}
    if best.limited:
        found["limit_bias"] = BY_THE_SCENE
    if best.held is None:
        return found
    found |= dict.fromkeys(("iterations", "start_iterations"), BY_THE_SCENE)
    if scene.joints or any(scene.limits()):
        found["error_bias"] = BY_THE_SCENE if best.held.biased else 0.0
    return found
