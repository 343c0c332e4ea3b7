"""pymunk's settings: each number with its reason, as attributes of its Space and constraints.

`start.seed` and `time.midpoint` are what is done around the engine, see run.py.
"""

import math
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any

from pymunk.body import Body
from pymunk.constraints import GearJoint
from pymunk.space import Space

from ...cases.scene import Scene
from ..engine import Choice

SHIPPED_STEP = 0.01  # s; pymunk has no step of its own, and its examples use 1/50 to 1/100
_DEFAULT = "pymunk's default"
_TUNED = [
    Choice(
        "time.midpoint",
        True,
        "pymunk drifts, then kicks: started h/2 back and read h/2 ahead this is position Verlet, "
        "of second order",
    ),
    Choice(
        "constraint.error_bias",
        0.0,
        "the whole gap is closed in one step, as in SHAKE: second order; the default closes "
        "6.3 h of it, and takes kinetic energy of first order with it",
    ),
    Choice(
        "start.seed",
        1e-9,
        "a circle that only touches falls freely for one step; 1e-9 m is above rounding and "
        "below every reach",
    ),
]
_SLOP = Choice(
    "space.collision_slop",
    1e-6,
    "so deep a body rests after an impact; above the seed, or the contact opens every few steps",
)
_IMPACT = (
    "an impact on jointed bodies starts its sweeps from nothing: measured, 10 leave an error that "
    "no smaller step removes, and 300 none"
)


def shipped(scene: Scene) -> list[Choice]:
    """What a user gets who changes nothing."""
    return with_own({}, scene)


def tuned(scene: Scene) -> list[Choice]:
    """The best recipe; no number follows the step."""
    because = (
        "with error_bias = 0 a sweep short of convergence is unstable, the more the smaller the "
        "step; measured: chains of n pins need n²/4, loops of four and five pins settle with 30"
    )
    iterations = Choice("space.iterations", max(30, len(scene.joints) ** 2), because)
    if scene.joints and any(contact.switches for contact in scene.contacts.values()):
        iterations = Choice("space.iterations", max(300, iterations.value), _IMPACT)
    landing = [_SLOP] if any(contact.switches for contact in scene.contacts.values()) else []
    return [c for c in (*_TUNED, *landing, iterations) if _matters(c.name, scene)]


def with_own(options: Mapping[str, Any], scene: Scene) -> list[Choice]:
    """The shipped setting with the user's own options on top."""
    named = {_full(name): value for name, value in options.items() if name != "step"}
    return [
        Choice(name, named.get(name, value), "your own option" if name in named else _DEFAULT)
        for name, value in _defaults().items()
        if _matters(name, scene)
    ]


def _defaults() -> dict[str, Any]:
    """As pymunk has them: some are single precision, and typed ones would change the motion."""
    space, joint = Space(), GearJoint(Body(1.0, 1.0), Body(1.0, 1.0), 0.0, 1.0)
    owners = {"space": space, "constraint": joint}
    return {
        _full(name): getattr(owners[_full(name).partition(".")[0]], name)
        for name in _OPTIONS
        if name != "step"
    }


def _matters(name: str, scene: Scene) -> bool:
    if name.startswith("constraint."):
        return bool(scene.joints)
    if "collision" in name or name == "start.seed":
        return bool(scene.contacts)
    return True


# What a user's own options may be: a whole number or not, the least and the largest value.
# Outside of it pymunk aborts the process (iterations, biases) or silently does nonsense:
# collision_persistence = 0 lets everything fall through the floor.
_OPTIONS: dict[str, tuple[bool, float, float]] = {
    "step": (False, math.ulp(0.0), math.inf),
    "iterations": (True, 1, 1e6),
    "damping": (False, 0, math.inf),
    "error_bias": (False, 0, 1),
    "max_bias": (False, 0, math.inf),
    "collision_slop": (False, 0, math.inf),
    "collision_bias": (False, 0, 1),
    "collision_persistence": (True, 1, 1e6),
}


def own(options: Mapping[str, Any]) -> Mapping[str, Any]:
    """A user's own options, checked.

    Raises ValueError with all mistakes: unknown names with the nearest right one, and values.
    """
    mistakes = [text for name, value in options.items() if (text := _mistake(name, value))]
    if mistakes:
        raise ValueError("\n".join(mistakes))
    return dict(options)


def _mistake(name: str, value: Any) -> str | None:
    if name not in _OPTIONS:
        close = get_close_matches(str(name), _OPTIONS, n=1)
        hint = f"did you mean {close[0]!r}?" if close else f"known: {', '.join(_OPTIONS)}"
        return f"pymunk.{name}: unknown option; {hint}"
    whole, least, largest = _OPTIONS[name]
    number = isinstance(value, int | float) and not isinstance(value, bool)
    finite = name == "max_bias" or (number and value < math.inf)
    if number and finite and least <= value <= largest and (not whole or isinstance(value, int)):
        return None
    kind = "whole number" if whole else "number"
    if name == "step":
        limits = "above 0 seconds"
    else:
        limits = f"from {least:g}" + (f" to {largest:g}" if largest < math.inf else " on")
    return f"pymunk.{name}: should be a {kind} {limits}, is {value!r}"


def _full(name: str) -> str:
    return f"constraint.{name}" if name in ("error_bias", "max_bias") else f"space.{name}"
