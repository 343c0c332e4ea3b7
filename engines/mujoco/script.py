"""The comments of the MJCF file that a user pastes."""

import re
from collections.abc import Iterable, Sequence

import mujoco

from ...cases.signal import Signal

_SAID = (
    "what follows a sine is a control, which no MJCF file sets: start at the keyframe, and paste "
    "this callback, which is asked at every stage (set between steps it would be held)"
)


def commented(head: Iterable[str]) -> str:
    """Lines as comments, in which two hyphens would end one."""
    return "".join(f"<!-- {re.sub('-(?=-)', '- ', line)} -->\n" for line in head)


def controls(model: mujoco.MjModel, laws: Sequence[Signal]) -> str:
    """Python in a comment that sets those of the actuators whose laws are sines; or nothing."""
    lines = [
        f"    data.ctrl[{i}] = math.sin({law.angular_frequency!r} * data.time + {law.phase!r})"
        f"  # {model.actuator(i).name}"
        for i, law in enumerate(laws)
        if law.law == "sine"
    ]
    if not lines:
        return ""
    code = ["import math", "import mujoco", "def control(model, data):", *lines]
    return commented([_SAID]) + "\n".join(
        ["<!--", *code, "mujoco.set_mjcb_control(control)", "-->", ""]
    )
