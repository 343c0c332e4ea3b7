"""MuJoCo's settings: each number with its reason, as attributes of the MJCF file.

A recipe is a function of the scene and of the step its tied numbers follow.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from ...cases.scene import Scene
from ..engine import Choice, Start
from .contact import HARDEST, recipe
from .options import SOFT, as_written
from .tree import driven, spanning_tree

SHIPPED_STEP = 2e-3  # s, the default of <option timestep>
_DEFAULT = "MuJoCo's default"
TO_THE_END = Choice(
    "option.tolerance", 0.0, "MuJoCo scales it by the mass, and a driven point's is 1e15"
)


def shipped(scene: Scene, tied_to: float) -> list[Choice]:
    """What a user gets who changes nothing."""
    return defaults(_soft(scene), _solver(scene))


def defaults(soft: Sequence[str], solver: Sequence[Choice]) -> list[Choice]:
    """MuJoCo's numbers, for groups of soft constraints; solver: what no setting leaves out."""
    choices = [
        Choice("option.integrator", "Euler", _DEFAULT),
        Choice("option.cone", "pyramidal", _DEFAULT),
        *solver,
    ]
    for group in soft:
        choices += [
            Choice(_key(group, "solref"), [0.02, 1.0], _DEFAULT),
            Choice(_key(group, "solimp"), [0.9, 0.95, 0.001, 0.5, 2.0], _DEFAULT),
        ]
    return choices


def tuned(scene: Scene, tied_to: float, start: Start | None = None) -> list[Choice]:
    """The best recipe for the scene and its start; soft constraints follow the step `tied_to`."""
    choices = [
        Choice("option.integrator", "RK4", "fourth order; every other integrator is of the first"),
        Choice("option.jacobian", "dense", "small scenes; keeps 4.0.0's sparse solver out"),
    ]
    if _soft(scene):
        choices.append(Choice("option.tolerance", 1e-14, "near rounding; 0 is five times slower"))
    choices += _solver(scene)
    for group in ("connect", "slide"):
        if group in _soft(scene):
            choices += [
                Choice(_key(group, "solref"), [_STIFF[group] * tied_to, 1.0], _BECAUSE[group]),
                Choice(
                    _key(group, "solimp"),
                    [HARDEST, HARDEST, 0.001],
                    "the hardest MuJoCo takes: d = 0.9999",
                ),
            ]
    if "slide" in _soft(scene):
        choices.append(Choice("option.noslip_iterations", 5, "what sticks does not creep"))
    if scene.pressed:
        known = {choice.name for choice in choices}
        choices += [c for c in recipe(scene, tied_to, start) if c.name not in known]
    return choices


# The time constant of a soft constraint in steps.
_STIFF = {"connect": 8, "slide": 2}
_BECAUSE = {
    "connect": "8 h: forces 10 times nearer than with 4 h, as stages jerk at the pin; places ∝ h²",
    "slide": "the stiffest that stays stable: 2 h",
}


def _key(group: str, name: str) -> str:
    """As MJCF spells it: a joint's own friction has names of its own."""
    return f"slide.{name}friction" if group == "slide" else f"{group}.{name}"


def _solver(scene: Scene) -> list[Choice]:
    """Solve to the end where a driven point's mass would tell the solver that it has arrived."""
    heavy = any(driven(scene)) or bool(scene.drives)
    return [TO_THE_END] if _soft(scene) and heavy else []


def ties(scene: Scene) -> bool:
    """Whether the tuned recipe has numbers that follow the step."""
    return bool(_soft(scene))


def only_slides(scene: Scene) -> bool:
    """Whether they are those of dry slides alone."""
    return _soft(scene) == ["slide"]


def _soft(scene: Scene) -> list[str]:
    """The groups of soft constraints in the scene."""
    loops = ["connect"] if spanning_tree(scene).loops else []
    dry = ["slide"] if any(joint.dry_friction for joint in scene.joints.values()) else []
    return loops + dry + (["pair"] if scene.pressed else [])


def with_own(options: Mapping[str, Any], scene: Scene, tied_to: float) -> list[Choice]:
    """The shipped setting with the user's own options on top."""
    return overlaid(shipped(scene, tied_to), options, _soft(scene))


def overlaid(
    under: Sequence[Choice], options: Mapping[str, Any], soft: Sequence[str]
) -> list[Choice]:
    """Choices with the user's own options on top."""
    because = "your own option"
    choices = {choice.name: choice for choice in under}
    for name, value in options.items():
        if name in SOFT:
            named = [_key(group, name) for group in soft]
        else:
            named = [] if name == "step" else [f"option.{name}"]
        choices |= {key: Choice(key, as_written(name, value), because) for key in named}
    return list(choices.values())
