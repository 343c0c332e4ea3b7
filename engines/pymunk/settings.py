"""pymunk as shipped, and with a user's own options: attributes of its Space and constraints."""

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


def shipped(scene: Scene) -> list[Choice]:
    """What a user gets who changes nothing."""
    return with_own({}, scene)


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
    if "collision" in name:
        return bool(scene.pressed)
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
