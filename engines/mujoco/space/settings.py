"""MuJoCo's settings in space: each number with its reason, as attributes of the MJCF file."""

from collections.abc import Mapping
from typing import Any

from ....cases.space.scene import SpatialScene
from ...engine import Choice, Start
from ..contact import HARDEST
from ..settings import TO_THE_END, defaults, overlaid
from ..tree import driven
from .contact import recipe
from .tree import spanning_tree


def tuned(scene: SpatialScene, tied_to: float, start: Start | None = None) -> list[Choice]:
    """The best recipe for the scene from any start; soft constraints follow the step `tied_to`."""
    choices = [
        Choice("option.integrator", "RK4", "fourth order; every other integrator is of the first"),
        Choice("option.jacobian", "dense", "small scenes; keeps 4.0.0's sparse solver out"),
    ]
    soft = soft_groups(scene)
    if soft and not _solver(scene):
        choices.append(Choice("option.tolerance", 1e-14, "near rounding; 0 is five times slower"))
    choices += _solver(scene)
    if "connect" in soft:
        because = "8 h: forces 100 times nearer than with 2 h: stages jerk at the pin; places ∝ h²"
        choices += [
            Choice("connect.solref", [8 * tied_to, 1.0], because),
            Choice(
                "connect.solimp", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes: d = 0.9999"
            ),
        ]
    return choices + recipe(scene, tied_to)


def with_own(options: Mapping[str, Any], scene: SpatialScene, tied_to: float) -> list[Choice]:
    """The shipped setting, which follows no step, with the user's own options on top."""
    soft = soft_groups(scene)
    return overlaid(defaults(soft, _solver(scene)), options, soft)


def soft_groups(scene: SpatialScene) -> list[str]:
    """The groups of soft constraints in the scene."""
    loops = ["connect"] if spanning_tree(scene).loops else []
    return loops + (["pair"] if scene.contacts else [])


def _solver(scene: SpatialScene) -> list[Choice]:
    """Solve to the end where a heavy mass would tell the solver that it has arrived."""
    heavy = any(driven(scene)) or bool(scene.drives)
    return [TO_THE_END] if soft_groups(scene) and heavy else []
