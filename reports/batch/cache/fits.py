"""Whether what was read is what was asked for: bytes may be whole, and say something else."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np


def fits(value: Any, kind: Any) -> bool:
    """Whether the value is of that kind, as an annotation says it, with all that it holds."""
    made, of = _parted(kind)
    if kind is Any:
        return True
    if made in (Union, UnionType):
        return any(fits(value, one) for one in of)
    if made is Literal:
        return value in of
    if kind is None or kind is type(None):
        return value is None
    if made is float:  # JSON has one kind of number
        return isinstance(value, float | int) and not isinstance(value, bool)
    if made is int:
        return isinstance(value, int) and not isinstance(value, bool)
    if made is np.ndarray:
        return isinstance(value, np.ndarray)
    if made is tuple:
        return isinstance(value, tuple) and _all(value, of)
    if isinstance(made, type) and issubclass(made, Mapping):
        return isinstance(value, dict) and _mapped(value, *of)
    if made in (list, frozenset):
        return isinstance(value, made) and all(fits(one, of[0]) for one in value)
    if not isinstance(value, made):
        return False
    return not is_dataclass(made) or all(
        fits(getattr(value, name), its) for name, its in _hints(made).items()
    )


def returned(function: Any) -> Any:
    """The type that a function says it returns; Any where it does not say."""
    try:
        return get_type_hints(function).get("return", Any)
    except (TypeError, NameError):  # a partial, or something of a test's
        return Any


def _all(value: tuple[Any, ...], of: tuple[Any, ...]) -> bool:
    if of[1:] == (...,):
        return all(fits(one, of[0]) for one in value)
    return len(value) == len(of) and all(map(fits, value, of))


def _mapped(value: Mapping[Any, Any], key: Any, held: Any) -> bool:
    return all(fits(k, key) and fits(v, held) for k, v in value.items())


@cache
def _parted(kind: Any) -> tuple[Any, tuple[Any, ...]]:
    """Takes an annotation apart: `tuple[float, ...]` → tuple and (float, ...)."""
    return get_origin(kind) or kind, get_args(kind)


@cache
def _hints(kind: type) -> Mapping[str, Any]:
    hints = get_type_hints(kind)
    return {field.name: hints[field.name] for field in fields(kind)}
