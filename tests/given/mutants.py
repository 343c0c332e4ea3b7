"""Planted mistakes: a mode or a system with some of its methods replaced."""

from collections.abc import Callable
from copy import copy
from dataclasses import fields
from typing import Any, TypeVar

from textmech.reference.system import Mode, Only, System

Kind = TypeVar("Kind", Mode, System)


def mutant(sound: Kind, **methods: Callable[..., Any]) -> Kind:
    """The same mode or system with some of its methods replaced."""
    cls: Any = type(sound)
    known = {field.name: getattr(sound, field.name) for field in fields(cls)}
    return type(f"Mutant{cls.__name__}", (cls,), methods)(**known)


def with_mode(system: System, name: str, mode: Mode) -> System:
    """The system with another mode in place of the one of this name."""
    if isinstance(system, Only):
        return Only(mode)
    changed = copy(system)
    object.__setattr__(changed, "modes", {**system.modes, name: mode})
    return changed
