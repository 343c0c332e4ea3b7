"""MuJoCo's settings: each number with its reason, as attributes of the MJCF file.

A recipe is a function of the scene and of the step its tied numbers follow.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from ....cases.scene import Scene
from ...engine import Choice, Start
from ...foot_contact import strides
from ...step_scaled import at
from ..model.contact import HARDEST, chosen, recipe, recipes
from ..model.loops import recipe as rods
from ..model.planes import met
from ..model.rope import recipe as ropes
from ..model.stops import recipe as stops
from ..model.tree import driven, spanning_tree
from .user_options import OWN, key, overlaid

SHIPPED_STEP = 2e-3  # s, the default of <option timestep>
_DEFAULT = "MuJoCo's default"
RECOMMENDED: Mapping[str, Any] = {
    "integrator": "implicitfast",
    "cone": "elliptic",
    "impratio": 10.0,
    "solref": [0.005, 1.0],
}
"""What MuJoCo's own documentation advises for new models, as a user writes it: of solref[0] it says
0.004 to 0.01 s, and of solimp to keep it."""
GUIDE = "the recommended initial value: MuJoCo 4.0.0's documentation, Modeling, Model tuning"
TO_THE_END = Choice(
    "option.tolerance", 0.0, "MuJoCo scales it by the mass, and a driven point's is 1e15"
)


def shipped(scene: Scene) -> list[Choice]:
    """MuJoCo's defaults for the scene, which a user gets who changes nothing."""
    choices = [
        Choice("option.integrator", "Euler", _DEFAULT),
        Choice("option.cone", "pyramidal", _DEFAULT),
        *_solver(scene),
    ]
    for group in soft(scene):
        choices += [
            Choice(key(group, "solref"), [0.02, 1.0], _DEFAULT),
            Choice(key(group, "solimp"), [0.9, 0.95, 0.001, 0.5, 2.0], _DEFAULT),
        ]
    return choices


def tuned(scene: Scene, tied_to: float, start: Start | None = None) -> list[Choice]:
    """The best recipe for the scene and its start; soft constraints follow the step `tied_to`."""
    return at_step(best(scene, start), tied_to)


def best(scene: Scene, start: Start | None = None) -> list[Choice]:
    """The best recipe for the scene and its start in terms of h, as a user writes it."""
    choices = [
        Choice("option.integrator", "RK4", "fourth order; every other integrator is of the first"),
        Choice("option.jacobian", "dense", "small scenes; keeps 4.0.0's sparse solver out"),
    ]
    if soft(scene):
        close = Choice("option.tolerance", 1e-14, "near rounding; 0 is five times slower")
        choices += _solver(scene) or [close]
    for group in ("connect", "slide"):
        if group in soft(scene):
            choices += [
                Choice(key(group, "solref"), [f"{_STIFF[group]}h", 1.0], _BECAUSE[group]),
                Choice(
                    key(group, "solimp"),
                    [HARDEST, HARDEST, 0.001],
                    "the hardest MuJoCo takes: d = 0.9999",
                ),
            ]
    if "slide" in soft(scene):
        choices.append(Choice("option.noslip_iterations", 5, "what sticks does not creep"))
    for more in _of_elements(scene, start):
        known = {choice.name for choice in choices}
        choices += [choice for choice in more if choice.name not in known]
    return choices


def _of_elements(scene: Scene, start: Start | None) -> Iterator[list[Choice]]:
    """The recipes of what gives way, each in a file of its own."""
    gives = soft(scene)
    if "rod" in gives:
        yield rods()
    if "rope" in gives:
        yield ropes()
    if "stop" in gives:
        yield stops([*scene.stops()])
    if met(scene):
        yield recipe(scene, start)


def at_step(choices: Sequence[Choice], h: float) -> list[Choice]:
    """The choices at the step h [s]."""
    return [replace(choice, value=at(choice.value, h)) for choice in choices]


# The time constant of a soft constraint in steps.
_STIFF = {"connect": 8, "slide": 2}
_BECAUSE = {
    "connect": "8 h: forces 10 times nearer than with 4 h (in space 100 times than with 2 h), as "
    "stages jerk at the pin; places ∝ h²",
    "slide": "the stiffest that stays stable: 2 h",
}


def _solver(scene: Scene) -> list[Choice]:
    """Solve to the end where a driven point's mass would tell the solver that it has arrived."""
    heavy = any(driven(scene)) or bool(scene.drives)
    return [TO_THE_END] if soft(scene) and heavy else []


def only_slides(scene: Scene) -> bool:
    """Whether they are those of dry slides alone."""
    return soft(scene) == ["slide"]


def soft(scene: Scene) -> list[str]:
    """The groups of soft constraints in the scene."""
    closing = spanning_tree(scene).loops
    pins = strides(scene) or any(not joint.swings for joint in closing)
    loops = ["connect"] if pins else []
    loops += ["rod"] if any(joint.swings for joint in closing) else []
    dry = ["slide"] if any(joint.dry_friction for joint in scene.joints.values()) else []
    ropes = ["rope"] if any(scene.ropes()) else []
    ropes += ["stop"] if any(scene.stops()) else []
    return loops + dry + ropes + (["pair"] if met(scene) else [])


def with_own(
    options: Mapping[str, Any], scene: Scene, start: Start, tied_to: float, because: str = OWN
) -> list[Choice]:
    """The shipped setting with other options on top: the user's own, or what `because` says."""
    word = options.get("contacts")
    chosen_one = chosen(scene, start) if word == "scene" else word
    contacts = recipes(scene)[chosen_one](scene) if met(scene) and chosen_one else []
    under = shipped(scene)
    on_top = overlaid(under, options, soft(scene), contacts, alone=alone(scene), because=because)
    return at_step(on_top, tied_to)


def alone(scene: Scene) -> dict[str, str]:
    """By name, the group of each contact or joint's stops that may have numbers of its own."""
    touching = {one.name: "pair" for one in met(scene)}
    return touching | {stops.name: "stop" for stops in scene.stops()}
