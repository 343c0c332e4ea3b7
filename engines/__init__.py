"""The engines, found by the entry point group `textmech.engines`.

An engine's package is imported when the engine is asked for, and not before.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from .engine import Engine, Maker

GROUP = "textmech.engines"
OWN = "own"  # the setting of a user's own options, which every engine has


class Broken(Exception):
    """An engine is installed and cannot be imported."""


def names() -> tuple[str, ...]:
    """The installed engines, sorted."""
    return tuple(sorted(_found()))


def settings(name: str) -> tuple[str, ...]:
    """What the engine offers, in its order. Raises KeyError, Broken."""
    return _maker(name).offers


def make(name: str, setting: str, options: Mapping[str, Any] | None = None) -> Engine:
    """An engine by its name and setting; `own` takes the user's options.

    Raises KeyError, Broken, and ValueError for options that the engine does not have.
    """
    return _maker(name)(setting, options or {})


class Known(Mapping[str, tuple[str, ...] | None]):
    """Every engine's settings by its name, for which it is imported; None: it cannot be."""

    def __getitem__(self, name: str) -> tuple[str, ...] | None:
        try:
            return settings(name)
        except Broken:
            return None

    def __iter__(self) -> Iterator[str]:
        return iter(names())

    def __len__(self) -> int:
        return len(names())


@cache
def _found() -> Mapping[str, EntryPoint]:
    """The first of a name stands: what is first on the path is what Python would import."""
    found: dict[str, EntryPoint] = {}
    for point in entry_points(group=GROUP):
        found.setdefault(point.name, point)
    return found


@cache
def _maker(name: str) -> Maker:
    point = _found()[name]
    try:
        return point.load()
    except Exception as error:  # whatever a package does while it is imported
        why = f"{type(error).__name__}: {error}"
        raise Broken(f"{name} ({point.value}) cannot be imported: {why}") from error
