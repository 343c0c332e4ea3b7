"""Numbers that follow the step h, as recipes and users write them: `2h`, `-1/h`, `-0.25/h2`."""

import re
from collections.abc import Callable
from functools import lru_cache
from typing import Any

FORMS = "such as 2h, -1/h or -0.25/h2, where h is the step"
_MOST = 1e100  # of h, and of what h or its square divides: no step makes that infinite
_FORM = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(h|/\s*h|/\s*h(?:2|²))")


def at(value: Any, step: float) -> Any:
    """The value at a step [s], and each entry of a list; whatever follows no step is left."""
    if isinstance(value, list | tuple):
        return [at(entry, step) for entry in value]
    if not isinstance(value, str):
        return value
    follows = _read(value)
    return follows(step) if follows else value


def tied(value: Any) -> bool:
    """Whether it is a text that follows the step."""
    return isinstance(value, str) and _read(value) is not None


@lru_cache(maxsize=1024)
def _read(text: str) -> Callable[[float], float] | None:
    """The function of h that a text says; None: it says none. Nothing is evaluated."""
    match = _FORM.fullmatch(text.strip())
    if match is None or abs(float(match[1])) > _MOST:
        return None
    factor, power = float(match[1]), match[2].replace(" ", "")
    return {
        "h": lambda h: factor * h,
        "/h": lambda h: factor / h,
    }.get(power, lambda h: factor / h**2)
