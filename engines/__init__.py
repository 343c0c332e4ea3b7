"""The engines: the only list of them. An engine's package is imported when it is asked for."""

from collections.abc import Mapping
from typing import Any

from .engine import Engine

NAMES = ("mujoco", "pymunk")
SETTINGS = ("shipped", "tuned")


def engine(name: str, setting: str, options: Mapping[str, Any] | None = None) -> Engine:
    """An engine by its name and setting; `own` takes the user's options.

    Raises ValueError for options that the engine does not have.
    """
    if name == "mujoco":
        from .mujoco import MuJoCo

        return MuJoCo(setting, options or {})
    if name == "pymunk":
        from .pymunk import Pymunk

        return Pymunk(setting, options or {})
    raise KeyError(name)
