"""MuJoCo's settings in space: each number with its reason, as attributes of the MJCF file."""

from collections.abc import Mapping
from typing import Any

from .....cases.scene import Scene
from ....engine import Choice, Start
from ...model.contact import HARDEST
from ...model.space.contact import RECIPES, chosen, recipe
from ...model.spatial_tree import spanning_tree
from ...model.tree import driven
from ..settings import TO_THE_END, at_step, defaults
from ..user_options import OWN, overlaid


def tuned(scene: Scene, tied_to: float, start: Start | None = None) -> list[Choice]:
    """The best recipe for the scene from any start; soft constraints follow the step `tied_to`."""
    return at_step(best(scene), tied_to)


def best(scene: Scene, start: Start | None = None) -> list[Choice]:
    """The best recipe for the scene in terms of h, as a user writes it."""
    choices = [
        Choice("option.integrator", "RK4", "fourth order; every other integrator is of the first"),
        Choice("option.jacobian", "dense", "small scenes; keeps 4.0.0's sparse solver out"),
    ]
    groups = soft(scene)
    if groups and not _solver(scene):
        choices.append(Choice("option.tolerance", 1e-14, "near rounding; 0 is five times slower"))
    choices += _solver(scene)
    if "connect" in groups:
        because = "8 h: forces 100 times nearer than with 2 h: stages jerk at the pin; places ∝ h²"
        choices += [
            Choice("connect.solref", ["8h", 1.0], because),
            Choice(
                "connect.solimp", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes: d = 0.9999"
            ),
        ]
    return choices + (recipe(scene) if scene.contacts else [])


def with_own(
    options: Mapping[str, Any],
    scene: Scene,
    start: Start,
    tied_to: float,
    because: str = OWN,
) -> list[Choice]:
    """The shipped setting, which follows no step, with other options on top: see the plane's."""
    groups, word = soft(scene), options.get("contacts")
    chosen_one = chosen(scene) if word == "scene" else word
    contacts = RECIPES[chosen_one](scene) if scene.contacts and chosen_one else []
    under, alone = defaults(groups, _solver(scene)), dict.fromkeys(scene.contacts, "pair")
    on_top = overlaid(under, options, groups, contacts, alone=alone, because=because)
    return at_step(on_top, tied_to)


def soft(scene: Scene) -> list[str]:
    """The groups of soft constraints in the scene."""
    loops = ["connect"] if spanning_tree(scene).loops else []
    return loops + (["pair"] if scene.contacts else [])


def _solver(scene: Scene) -> list[Choice]:
    """Solve to the end where a heavy mass would tell the solver that it has arrived."""
    heavy = any(driven(scene)) or bool(scene.drives)
    return [TO_THE_END] if soft(scene) and heavy else []
