"""Which numbered equations a case really uses: those whose function runs, not those it claims.

A method of a `Numbered` class, or a function marked as an `equation`, stands for those that open
its docstring: `(2.44) d/dt ∂T/∂q̇ − …`. They are noted whenever it runs.
"""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cached_property, wraps
from types import FunctionType
from typing import Any, TypeVar, cast

_OPENING = re.compile(r"\s*(?:\(2\.\d+\)(?:[-–](?:\(2\.\d+\))?)?(?:,| and)?\s*)+")
_NUMBER = re.compile(r"2\.\d+")
_ran: set[frozenset[str]] = set()  # what ran since the innermost `noting` began

Marked = TypeVar("Marked", bound=Callable[..., Any])


def equations(docstring: str | None) -> list[str]:
    """The equations a docstring opens with: "(2.23), (2.27) …" → ["2.23", "2.27"]."""
    opening = _OPENING.match(docstring or "")
    return _NUMBER.findall(opening.group()) if opening else []


def equation(function: Marked) -> Marked:
    """Returns the function, whose equations are noted when it runs.

    Under `python -OO` there are none to be noted: docstrings are gone.
    """
    numbers, note = frozenset(equations(function.__doc__)), _ran.add

    @wraps(function)
    def noted(*args: Any, **named: Any) -> Any:
        note(numbers)
        return function(*args, **named)

    return cast("Marked", noted)


class Numbered:
    """Base of classes whose methods note their equations: the docstring decides which do."""

    __slots__ = ()

    def __init_subclass__(cls, **named: Any) -> None:
        super().__init_subclass__(**named)
        for name, member in list(vars(cls).items()):
            if equations(getattr(member, "__doc__", None)):
                setattr(cls, name, _noting(member))


def _noting(member: Any) -> Any:
    """A method, or what a property or a static method is made of, as an `equation`."""
    if isinstance(member, FunctionType):
        return equation(member)
    if isinstance(member, property):
        return property(equation(cast("Callable[..., Any]", member.fget)))
    if isinstance(member, staticmethod | classmethod):
        return type(member)(equation(member.__func__))
    if isinstance(member, cached_property):
        member.func = equation(member.func)
        return member
    raise TypeError(f"{member!r} opens with an equation, and cannot be noted")


@contextmanager
def noting() -> Iterator[set[str]]:
    """The equations of what runs inside, filled in at the end."""
    numbers, before = set[str](), set(_ran)
    _ran.clear()
    try:
        yield numbers
    finally:
        numbers.update(*_ran)
        _ran.update(before)
