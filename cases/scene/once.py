"""Remembers what many ask of a scene: it is made once, kept with the scene, and goes with it."""

from collections.abc import Callable
from functools import wraps
from typing import TypeVar

from . import Scene

Made = TypeVar("Made")


def once(make: Callable[[Scene], Made]) -> Callable[[Scene], Made]:
    """Returns the function as one that makes its answer once for each scene.

    The answer is handed out as it is: whoever asks does not change it.
    """
    name = f"{make.__module__}.{make.__qualname__}"

    @wraps(make)
    def known(scene: Scene) -> Made:
        kept = vars(scene)  # as functools.cached_property does
        if name not in kept:
            kept[name] = make(scene)
        return kept[name]

    return known
