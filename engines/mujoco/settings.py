"""MuJoCo's settings: each number with its reason, as attributes of the MJCF file.

A recipe is a function of the scene and of the step its tied numbers follow.
"""

from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any

from cases.scene import Scene
from engines.engine import Choice
from engines.mujoco.tree import spanning_tree

SHIPPED_STEP = 2e-3  # s, the default of <option timestep>
_DEFAULT = "MuJoCo's default"


def shipped(scene: Scene, tied_to: float) -> list[Choice]:
    """What a user gets who changes nothing."""
    choices = [
        Choice("option.integrator", "Euler", _DEFAULT),
        Choice("option.cone", "pyramidal", _DEFAULT),
    ]
    for group in _soft(scene):
        choices += [
            Choice(f"{group}.solref", [0.02, 1.0], _DEFAULT),
            Choice(f"{group}.solimp", [0.9, 0.95, 0.001, 0.5, 2.0], _DEFAULT),
        ]
    return choices


def tuned(scene: Scene, tied_to: float) -> list[Choice]:
    """The best recipe for the scene; soft constraints follow the step `tied_to`."""
    choices = [
        Choice("option.integrator", "RK4", "fourth order; every other integrator is of the first"),
        Choice("option.jacobian", "dense", "small scenes; keeps 4.0.0's sparse solver out"),
    ]
    if _soft(scene):
        choices += [
            Choice(
                "option.tolerance", 1e-14, "near rounding; 0 gives the same motion, five times slower"
            ),
        ]
    for group in _soft(scene):
        choices += [
            Choice(f"{group}.solref", [2 * tied_to, 1.0], "the stiffest that stays stable: 2 h"),
            Choice(
                f"{group}.solimp", [0.9999, 0.9999, 0.001], "the hardest MuJoCo takes: d = 0.9999"
            ),
        ]
    if scene.contacts:
        choices += [
            Choice("option.cone", "elliptic", "the pyramid's friction depends on the direction"),
            Choice("option.impratio", 100.0, "less creep; from 1e4 on Newton stops early"),
        ]
    return choices


def ties(scene: Scene) -> bool:
    """Whether the tuned recipe has numbers that follow the step."""
    return bool(_soft(scene))


def _soft(scene: Scene) -> list[str]:
    """The groups of soft constraints in the scene."""
    loops = ["connect"] if spanning_tree(scene).loops else []
    return loops + (["pair"] if scene.contacts else [])


# What a user's own options may be, with the values that are right.
_WORDS = {
    "integrator": ("Euler", "RK4", "implicit", "implicitfast", "discrete"),
    "cone": ("pyramidal", "elliptic"),
    "jacobian": ("dense", "sparse", "auto"),
    "solver": ("PGS", "CG", "Newton"),
}
_WHOLE = ("iterations", "ls_iterations", "noslip_iterations")
_REAL = ("tolerance", "ls_tolerance", "noslip_tolerance", "impratio")
_SOFT = {"solref": (2,), "solimp": (3, 5)}
_NAMES = ("step", *_WORDS, *_WHOLE, *_REAL, *_SOFT)


def own(options: Mapping[str, Any]) -> None:
    """Checks a user's own options.

    Raises ValueError with all mistakes: unknown names with the nearest right one, and values.
    """
    mistakes = [mistake for name, value in options.items() if (mistake := _mistake(name, value))]
    if mistakes:
        raise ValueError("\n".join(mistakes))


def _mistake(name: str, value: Any) -> str | None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if name not in _NAMES:
        close = get_close_matches(name, _NAMES, n=1)
        hint = f"did you mean {close[0]!r}?" if close else f"known: {', '.join(_NAMES)}"
        return f"mujoco.{name}: unknown option; {hint}"
    if name in _WORDS and value not in _WORDS[name]:
        return f"mujoco.{name}: should be one of {', '.join(_WORDS[name])}, is {value!r}"
    if name in _WHOLE and not (number and value == int(value) and value >= 0):
        return f"mujoco.{name}: should be a whole number of at least 0, is {value!r}"
    if name in _REAL and not (number and 0 <= value < float("inf")):
        return f"mujoco.{name}: should be a number of at least 0, is {value!r}"
    if name == "step" and not (number and 0 < value < float("inf")):
        return f"mujoco.step: should be a positive number of seconds, is {value!r}"
    if name in _SOFT:
        sizes = " or ".join(str(size) for size in _SOFT[name])
        numbers = isinstance(value, list) and all(
            isinstance(x, int | float) and abs(x) < float("inf") for x in value
        )
        if not numbers or len(value) not in _SOFT[name]:
            return f"mujoco.{name}: should be a list of {sizes} finite numbers, is {value!r}"
    return None


def with_own(options: Mapping[str, Any], scene: Scene, tied_to: float) -> list[Choice]:
    """The shipped setting with the user's own options on top."""
    because = "your own option"
    choices = {choice.name: choice for choice in shipped(scene, tied_to)}
    for name, value in options.items():
        if name in _SOFT:
            named = [f"{group}.{name}" for group in _soft(scene)]
        else:
            named = [] if name == "step" else [f"option.{name}"]
        choices |= {key: Choice(key, value, because) for key in named}
    return list(choices.values())
