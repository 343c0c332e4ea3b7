"""The comments of the MJCF file that a user pastes."""

import re
from collections.abc import Iterable, Sequence

import mujoco

from ...cases.fields.signal import Signal
from .force import BY_ITSELF

_SAID = (
    "what follows such a law in time is a control, which no MJCF file sets: start at the keyframe, "
    "and paste this callback, which is asked at every stage (set between steps it would be held)"
)
_CORNERS = "where a law jumps or bends our run holds its mean over that step, which is of 2nd order"


def commented(head: Iterable[str]) -> str:
    """Lines as comments, in which two hyphens would end one."""
    return "".join(f"<!-- {re.sub('-(?=-)', '- ', line)} -->\n" for line in head)


def controls(model: mujoco.MjModel, laws: Sequence[Signal]) -> str:
    """Python in a comment that sets the controls which do not follow by themselves; or nothing."""
    lines = [
        f"    data.ctrl[{i}] = {_at(law)}  # {model.actuator(i).name}"
        for i, law in enumerate(laws)
        if law.law not in BY_ITSELF
    ]
    if not lines:
        return ""
    begins = ["def control(model, data):", "    t = data.time"]
    code = ["import math", "import mujoco", "import numpy", *begins, *lines]
    said = [_SAID, _CORNERS] if any(law.corners for law in laws) else [_SAID]
    return commented(said) + "\n".join(
        ["<!--", *code, "mujoco.set_mjcb_control(control)", "-->", ""]
    )


def _at(law: Signal) -> str:
    """The factor of the law's amplitude at t."""
    times = [repr(time) for time in law.times]
    return {
        "sine": lambda: f"math.sin({law.angular_frequency!r} * t + {law.phase!r})",
        "step": lambda: f"1.0 if t >= {times[0]} else 0.0",
        "pulse": lambda: f"1.0 if {times[0]} <= t < {times[1]} else 0.0",
        "polynomial": lambda: " + ".join(f"{c!r} * t**{k}" for k, c in enumerate(law.values)),
        "table": lambda: f"numpy.interp(t, {list(law.times)!r}, {list(law.values)!r})",
    }[law.law]()
