"""pymunk's options: which there are, and a setting's numbers with the user's own among them."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

from pymunk.body import Body
from pymunk.constraints import GearJoint
from pymunk.space import Space

from ....cases.scene import Scene
from ...engine import Choice, Start
from ...options import STEP, SWITCH, Check, mistakes_in, number, word
from ...plain_shapes import CUBE, PLAIN
from ..model.contact import is_tip
from ..model.limit import eases
from ..model.plain_shapes import SHAPES
from ..model.slot import oblique
from .solver_iterations import Holding, holding

SHIPPED_STEP = 0.01  # s; pymunk has no step of its own, and its examples use 1/50 to 1/100
BY_THE_SCENE = "scene"  # instead of a number: as many as the scene needs


def _has_joints(scene: Scene) -> bool:
    return bool(scene.joints) or any(scene.limits())


def _touches(scene: Scene) -> bool:
    return bool(scene.pressed)


def _has_tips(scene: Scene) -> bool:
    return bool(scene.pairs) or any(is_tip(scene, contact) for contact in scene.contacts.values())


@dataclass(frozen=True)
class Option:
    """An option: its name among a setting's numbers, its values, and the scenes that feel it.

    A name of `space` or `constraint` is pymunk's attribute, with a default; others are what is done
    around the engine, which nobody does who does not ask for it.
    """

    name: str
    check: Check
    matters: Callable[[Scene], bool] = lambda scene: True


_SWEEPS = number(1, 1e6, whole=int, otherwise=BY_THE_SCENE)
_SHARE = number(0, 1, otherwise=BY_THE_SCENE)
# Outside of its bounds pymunk aborts the process (iterations, biases) or silently does nonsense:
# collision_persistence = 0 lets everything fall through the floor.
OPTIONS: Mapping[str, Option] = {
    "iterations": Option("space.iterations", _SWEEPS),
    "damping": Option("space.damping", number()),
    "error_bias": Option("constraint.error_bias", _SHARE, _has_joints),
    "max_bias": Option("constraint.max_bias", number(0, inf), _has_joints),
    "collision_slop": Option("space.collision_slop", number(), _touches),
    "collision_bias": Option("space.collision_bias", number(0, 1), _touches),
    "collision_persistence": Option(
        "space.collision_persistence", number(1, 1e6, whole=int), _touches
    ),
    "midpoint": Option("time.midpoint", SWITCH),
    # deeper, what touches would be thrown out
    "seed": Option("start.seed", number(0, 1e-3), _touches),
    "start_iterations": Option("start.iterations", _SWEEPS),
    "across": Option(
        "slot.across", SWITCH, lambda scene: any(oblique(scene, j) for j in scene.joints.values())
    ),
    "reflects": Option("contact.reflects", SWITCH, _has_tips),
    "limit_bias": Option("limit.error_bias", _SHARE, lambda scene: any(scene.limits())),
    "shapes": Option(SHAPES, word(PLAIN, CUBE)),
}
_mistakes = mistakes_in({"step": STEP, **{name: known.check for name, known in OPTIONS.items()}})


def check(options: Mapping[str, Any]) -> None:
    """Raises ValueError with all mistakes: unknown names with the nearest right one, and values."""
    if mistakes := [*_mistakes("pymunk", options)]:
        raise ValueError("\n".join(mistakes))


def defaults() -> dict[str, Any]:
    """As pymunk has them: some are single precision, and typed ones would change the motion."""
    parts = {"space": Space(), "constraint": GearJoint(Body(1, 1), Body(1, 1), 0.0, 1.0)}
    known = ((option.name, *option.name.split(".")) for option in OPTIONS.values())
    return {name: getattr(parts[part], what) for name, part, what in known if part in parts}


@dataclass(frozen=True)
class Numbers:
    """A setting's numbers for a scene, by the step [s].

    by_scene: the names of those that the scene decides; held: what it asks of its joints.
    """

    always: tuple[Choice, ...]
    by_scene: tuple[str, ...]
    held: Holding | None

    def __call__(self, step: float) -> Sequence[Choice]:
        """The numbers for a step [s]."""
        of_joints = self.held.choices(step) if self.held else []
        by_name = {choice.name: choice for choice in (*of_joints, eases(step))}
        asked = [by_name[name] for name in self.by_scene if name in by_name]
        return list({choice.name: choice for choice in (*self.always, *asked)}.values())

    @property
    def biased(self) -> bool:
        """Whether the bias of joints follows the step."""
        return "constraint.error_bias" in self.by_scene and bool(self.held and self.held.biased)

    @property
    def follows(self) -> bool:
        """Whether a number follows the step."""
        return self.biased or "limit.error_bias" in self.by_scene


def own(options: Mapping[str, Any], scene: Scene, start: Start) -> Numbers:
    """The shipped numbers with the user's own on top; with a rehearsal, if the scene decides."""
    felt = {name: known.name for name, known in OPTIONS.items() if known.matters(scene)}
    given = {felt[option]: value for option, value in options.items() if option in felt}
    by_scene = tuple(name for name, value in given.items() if value == BY_THE_SCENE)
    always = tuple(_chosen(felt.values(), given))
    return Numbers(always, by_scene, holding(scene, start) if by_scene else None)


def _chosen(names: Iterable[str], given: Mapping[str, Any]) -> Iterator[Choice]:
    """Choices of what is given, and of pymunk's attributes that are not."""
    shipped = defaults()
    for name in names:
        value = given.get(name, BY_THE_SCENE)
        if name in shipped and value == BY_THE_SCENE:
            yield Choice(name, shipped[name], "pymunk's default")
        elif value not in (False, BY_THE_SCENE) or name in shipped:
            yield Choice(name, value, "your own option")
