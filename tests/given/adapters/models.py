"""Two models of MuJoCo, field by field."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np


def fields(thing: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Every number and array of a compiled model, its options and statistics too."""
    for name in dir(thing):
        if name.startswith("_"):
            continue
        value = getattr(thing, name)
        if isinstance(value, np.ndarray | int | float | bytes):
            yield prefix + name, value
        elif type(value).__name__.startswith("Mj") and prefix == "":
            yield from fields(value, f"{name}.")


def differing(a: mujoco.MjModel, b: mujoco.MjModel) -> list[str]:
    """The names of those that are not the same."""
    both = list(zip(fields(a), fields(b), strict=True))
    assert len(both) > 300
    return [name for (name, x), (_, y) in both if not np.array_equal(x, y)]
