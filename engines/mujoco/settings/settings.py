"""MuJoCo's settings: each number with its reason, as attributes of the MJCF file.

A recipe is a function of the scene and of the step its tied numbers follow.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from ....cases.scene import Scene
from ...engine import Choice, Start
from ...step_scaled import at
from ..model.contact import chosen, recipes
from ..model.planes import met
from ..model.tree import driven
from .groups import groups, single
from .options import OWN, overlaid

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
    "option.tolerance", 0.0, "MuJoCo scales residuals by the mass, and a driven point's is 1e15 kg"
)


def shipped(scene: Scene) -> list[Choice]:
    """MuJoCo's defaults for the scene, which a user gets who changes nothing."""
    choices = [
        Choice("option.integrator", "Euler", _DEFAULT),
        Choice("option.cone", "pyramidal", _DEFAULT),
        *_solver(scene),
    ]
    for group in groups(scene):
        choices += [
            Choice(group.key("solref"), [0.02, 1.0], _DEFAULT),
            Choice(group.key("solimp"), [0.9, 0.95, 0.001, 0.5, 2.0], _DEFAULT),
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
    if groups(scene):
        close = Choice("option.tolerance", 1e-14, "near rounding; 0 is five times slower")
        choices += _solver(scene) or [close]
    for group in groups(scene):
        known = {choice.name for choice in choices}
        choices += [c for c in group.recipe(scene, start) if c.name not in known]
    return choices


def at_step(choices: Sequence[Choice], h: float) -> list[Choice]:
    """The choices at the step h [s]."""
    return [replace(choice, value=at(choice.value, h)) for choice in choices]


def _solver(scene: Scene) -> list[Choice]:
    """Solve to the end where a driven point's mass would tell the solver that it has arrived."""
    heavy = any(driven(scene)) or bool(scene.drives)
    return [TO_THE_END] if groups(scene) and heavy else []


def only_slides(scene: Scene) -> bool:
    """Whether dry joints alone give way in the scene."""
    return [group.word for group in groups(scene)] == ["slide"]


def with_own(
    options: Mapping[str, Any], scene: Scene, start: Start, tied_to: float, because: str = OWN
) -> list[Choice]:
    """The shipped setting with other options on top: the user's own, or what `because` says."""
    word = options.get("contacts")
    word = chosen(scene, start) if word == "scene" else word
    contacts = recipes(scene)[word](scene) if met(scene) and word else []
    on_top = overlaid(shipped(scene), options, groups(scene), contacts, single(scene), because)
    return at_step(on_top, tied_to)
