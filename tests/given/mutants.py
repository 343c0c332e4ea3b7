"""Planted mistakes: a mode or a system with some of its methods replaced."""

from collections.abc import Callable
from copy import copy
from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

from textmech.reference.system import Mode, Only, System

from .laws.spatial_laws import matrix

Kind = TypeVar("Kind", Mode, System)


def mutant(sound: Kind, **methods: Callable[..., Any]) -> Kind:
    """The same mode or system with some of its methods replaced."""
    cls: Any = type(sound)
    known = {field.name: getattr(sound, field.name) for field in fields(cls)}
    return type(f"Mutant{cls.__name__}", (cls,), methods)(**known)


def sound(mode: Any, name: str) -> Callable[..., Any]:
    """A method as it is without the mistake, inside of one that takes its place."""
    return getattr(super(type(mode), mode), name)


def transposed(self: Any, *given: Any) -> Any:
    """Poses in space with E as ground axes in body axes: the conjugate quaternions."""
    poses = sound(self, "poses")(*given)
    return {name: (*pose[:4], *(-x for x in pose[4:7]), *pose[7:]) for name, pose in poses.items()}


def in_ground_axes(self: Any, *given: Any) -> Any:
    """Poses in space with ω in ground axes; what has no attitude stays."""
    poses = dict(sound(self, "poses")(*given))
    for name in self.masses:
        spin = matrix(poses[name][3:7]) @ np.array(poses[name][10:])
        poses[name] = (*poses[name][:10], *spin)
    return poses


def too_fast(self: Any, *given: Any) -> Any:
    """5 % on the accelerations."""
    return 1.05 * sound(self, "accelerations")(*given)


def with_mode(system: System, name: str, mode: Mode) -> System:
    """The system with another mode in place of the one of this name."""
    if isinstance(system, Only):
        return Only(mode)
    changed = copy(system)
    object.__setattr__(changed, "modes", {**system.modes, name: mode})
    return changed
