"""The engines, found by the entry point group `textmech.engines`.

An engine's package is imported when the engine is asked for, and not before.
"""

from collections.abc import Collection, Iterator, Mapping
from contextlib import nullcontext
from functools import cache
from importlib.metadata import Distribution, EntryPoint, entry_points
from typing import Any, cast

from .engine import Engine, Maker
from .probe import error_text, guarded, restored, unsound, why_not

GROUP = "textmech.engines"
SETTINGS = ("shipped", "recommended", "tuned")  # what an engine may offer
TAKEN = ("book", "reference")  # words that stand for something else in the reports


class Broken(Exception):
    """An engine is installed and cannot be imported."""


def names() -> tuple[str, ...]:
    """The installed engines, sorted."""
    return tuple(sorted(_found()))


def foreign(name: str) -> bool:
    """Whether it is somebody else's, and may do anything."""
    return name in _found() and not _found()[name].value.startswith(f"{__name__}.")


def settings(name: str) -> tuple[str, ...]:
    """The names of the settings that the engine offers, in its order. Raises KeyError, Broken."""
    return _maker(name).offers


def place(setting: str) -> float:
    """Where a setting stands among others: the user's own, and any, before the tuned one."""
    return SETTINGS.index(setting) if setting in SETTINGS else SETTINGS.index("tuned") - 0.5


def make(name: str, setting: str, options: Mapping[str, Any] | None = None) -> Engine:
    """An engine by its name and setting; any other name is that of the user's own options.

    Raises KeyError, Broken, and ValueError for options that the engine does not have.
    """
    maker = _maker(name)
    engine, error = guarded(lambda: maker(setting, options or {}))
    if isinstance(error, ValueError):
        raise error
    if error is not None:
        raise Broken(f"{name} cannot be made: {error_text(error)}") from error
    what, error = guarded(lambda: unsound(engine, name, setting))
    if what or error is not None:
        raise Broken(f"{name} cannot be used: {what or error_text(error)}") from error
    return engine


def distribution(name: str) -> Distribution | None:
    """The installed distribution with the engine's entry point; None where there is none."""
    point = _found().get(name)
    return None if point is None else point.dist


class Known(Mapping[str, tuple[str, ...] | None]):
    """Every engine's settings by its name, for which it is imported; None: it cannot be.

    only: those that are worth an import; of others nothing is known.
    """

    def __init__(self, only: Collection[str] = ()) -> None:
        self._only = only

    def __getitem__(self, name: str) -> tuple[str, ...] | None:
        if self._only and name not in self._only:
            return None
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
    """By names that a case can write; of two with one name, what Python would import first."""
    points: dict[str, EntryPoint] = {}
    for point in entry_points(group=GROUP):
        if point.name.isidentifier() and point.name not in TAKEN:
            points.setdefault(point.name, point)
    return points


@cache
def _maker(name: str) -> Maker:
    point = _found()[name]
    why = why_not(point, SETTINGS) if foreign(name) else ""
    with restored() if foreign(name) else nullcontext():
        maker, error = (None, None) if why else guarded(point.load)
    if why or error is not None:
        why = why or error_text(error)
        raise Broken(f"{name} ({point.value}) cannot be imported: {why}") from error
    offers, _ = guarded(lambda: getattr(maker, "offers", None))
    sound = isinstance(offers, tuple) and all(isinstance(offer, str) for offer in offers)
    if not (sound and offers and set(offers) <= set(SETTINGS)):
        what = f"its `offers` should be a tuple of {' and '.join(SETTINGS)}, is {offers!r}"
        raise Broken(f"{name} ({point.value}) is no engine: {what}")
    return cast(Maker, maker)
