"""A user's own options: which there are, and which values pymunk takes."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from ...plain_shapes import CUBE, PLAIN
from ..model.plain_shapes import SHAPES

BY_THE_SCENE = "scene"  # instead of a number: as many as the scene needs
CONSTRAINT = ("error_bias", "max_bias")
PROTOCOL = {
    "midpoint": "time.midpoint",
    "seed": "start.seed",
    "start_iterations": "start.iterations",
    "across": "slot.across",
    "reflects": "contact.reflects",
    "limit_bias": "limit.error_bias",
    "shapes": SHAPES,
}
"""What is done around the engine, with its name among a setting's numbers."""


@dataclass(frozen=True)
class _Number:
    """From the least to the largest value; scene: or the word that leaves it to the scene."""

    least: float
    largest: float = math.inf
    whole: bool = False
    scene: bool = False


# Outside of it pymunk aborts the process (iterations, biases) or silently does nonsense:
# collision_persistence = 0 lets everything fall through the floor.
_NUMBERS = {
    "step": _Number(math.ulp(0.0)),
    "iterations": _Number(1, 1e6, whole=True, scene=True),
    "damping": _Number(0),
    "error_bias": _Number(0, 1, scene=True),
    "max_bias": _Number(0),
    "collision_slop": _Number(0),
    "collision_bias": _Number(0, 1),
    "collision_persistence": _Number(1, 1e6, whole=True),
    "seed": _Number(0, 1e-3),  # deeper, what touches would be thrown out
    "start_iterations": _Number(1, 1e6, whole=True, scene=True),
    "limit_bias": _Number(0, 1, scene=True),
}
_SWITCHES = ("midpoint", "across", "reflects")
_NAMES = (*_NUMBERS, *_SWITCHES, "shapes")


def full(name: str) -> str:
    """The option's name among a setting's numbers: whose attribute it is."""
    return PROTOCOL.get(name) or f"{'constraint' if name in CONSTRAINT else 'space'}.{name}"


def check(options: Mapping[str, Any]) -> None:
    """Raises ValueError with all mistakes: unknown names with the nearest right one, and values."""
    mistakes = [text for name, value in options.items() for text in _mistakes(name, value)]
    if mistakes:
        raise ValueError("\n".join(mistakes))


def _mistakes(name: str, value: Any) -> Iterator[str]:
    if name not in _NAMES:
        close = get_close_matches(str(name), _NAMES, n=1)
        hint = f"did you mean {close[0]!r}?" if close else f"known: {', '.join(_NAMES)}"
        yield f"pymunk.{name}: unknown option; {hint}"
    elif name in _SWITCHES:
        if not isinstance(value, bool):
            yield f"pymunk.{name}: should be true or false, is {value!r}"
    elif name == "shapes":
        if value not in (PLAIN, CUBE):
            yield f"pymunk.shapes: should be {PLAIN} or {CUBE}, is {value!r}"
    elif not _right(name, value, _NUMBERS[name]):
        yield f"pymunk.{name}: should be {_what(name, _NUMBERS[name])}, is {value!r}"


def _right(name: str, value: Any, known: _Number) -> bool:
    if known.scene and value == BY_THE_SCENE:
        return True
    number = isinstance(value, int | float) and not isinstance(value, bool)
    finite = name == "max_bias" or (number and value < math.inf)
    within = number and finite and known.least <= value <= known.largest
    return within and (not known.whole or isinstance(value, int))


def _what(name: str, known: _Number) -> str:
    kind = "whole number" if known.whole else "number"
    if name == "step":
        return f"a {kind} above 0 seconds"
    to = f" to {known.largest:g}" if known.largest < math.inf else " on"
    return f"a {kind} from {known.least:g}{to}" + (", or scene" if known.scene else "")
