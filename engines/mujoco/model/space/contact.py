"""MuJoCo's recipes for the floor z = 0: a sphere that rolls, a disk on its rim, and a pivot.

MuJoCo asks of a contact the acceleration d (−b v − k r) + (1 − d) a, and leaves out that the
touching point wanders over the body (J̇ v): a disk that steers slips by h J̇ v, so that its error is
of first order, whatever the integrator. Who takes J̇ v from `efc_aref` in the control callback, and
an impratio of 1e8, has the second order (tested beside this, in test_wandering.py).
"""

from collections.abc import Callable, Mapping

from .....cases.scene import Scene
from .....cases.scene.contact import Contact
from ....engine import Choice, Start
from ..contact import HARDEST, SOFTEST


def recipe(scene: Scene) -> list[Choice]:
    """The contacts' numbers."""
    return RECIPES[chosen(scene)](scene)


def chosen(scene: Scene, start: Start | None = None) -> str:
    """Which of the recipes the scene needs, from any start."""
    rims = any(contact.rim or contact.ideal == "pivot" for contact in scene.contacts.values())
    return "rim" if rims else "roll"


def met(scene: Scene) -> list[Contact]:
    """The contacts that MuJoCo has as its own: all of the scene."""
    return list(scene.contacts.values())


def closed(scene: Scene, start: Start) -> bool:
    """Whether anything lies on the floor: all that touches does, from the start on."""
    return bool(scene.contacts)


def worth(scene: Scene) -> list[str]:
    """Which of the recipes may do something for the scene."""
    return list(RECIPES) if scene.contacts else []


def _sphere(scene: Scene) -> list[Choice]:
    return [
        Choice("pair.solref", ["2h", 1.0], "the stiffest that stays stable: 2 h"),
        Choice("pair.solimp", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes: d = 0.9999"),
        Choice("option.impratio", 100.0, "less creep; from 1e4 on Newton stops early"),
        *_EITHER,
    ]


def _rim(scene: Scene) -> list[Choice]:
    """Measured on steady circles of a coin that leans by 8, 30 and 70 degrees, and on its fall."""
    return [
        Choice(
            "pair.solref",
            ["-0.1/h2", "-0.4/h"],
            "k = 0.1/h², b = 0.4/h: stiffer, the normal force of what tilts is 10 times worse",
        ),
        Choice(
            "pair.solimp",
            [SOFTEST, SOFTEST, 0.001],
            "the softest MuJoCo takes; with d = 0.9999 a disk that falls flutters, N is 13 N off",
        ),
        Choice(
            "pair.solreffriction",
            [-1.0, f"{-2 * SOFTEST}/h"],
            "b = 2/h (times d, by which MuJoCo divides): slip h J̇ v/2; RK4 is stable up to 2.8/h",
        ),
        Choice("option.impratio", 1e6, "makes up for the soft d; Newton bears it"),
        *_EITHER,
    ]


_EITHER = (
    Choice("option.cone", "elliptic", "the pyramid's friction depends on the direction"),
    Choice(
        "flag.diagexact",
        "enable",
        "or d, k and b are those of a mean inertia over x, y and z, at another attitude",
    ),
)
RECIPES: Mapping[str, Callable[[Scene], list[Choice]]] = {"roll": _sphere, "rim": _rim}
"""By the word that an own option calls them."""
