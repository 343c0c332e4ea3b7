"""How much one reference may cost, all of its motions together.

What a case asks for is estimated when it is loaded. This is the net below: a motion that turns out
to need ever more steps ends with a message, and the same one on every machine.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


class Endless(Exception):
    """A motion that has used up the budget; `time` [s] is how far it got."""

    def __init__(self, evaluations: float, time: float) -> None:
        super().__init__(f"takes more than {evaluations:.3g} evaluations")
        self.time = time


@dataclass
class _Purse:
    given: float
    left: float


_purse: ContextVar[_Purse | None] = ContextVar("purse", default=None)


@contextmanager
def budget(evaluations: float) -> Iterator[None]:
    """Lets the integrations within take so many evaluations of slopes, together."""
    token = _purse.set(_Purse(evaluations, evaluations))
    try:
        yield
    finally:
        _purse.reset(token)


def spend(evaluations: int, time: float) -> None:
    """Takes them from the budget, if there is one. Raises Endless where nothing is left."""
    purse = _purse.get()
    if purse is not None:
        purse.left -= evaluations
        if purse.left < 0:
            raise Endless(purse.given, time)
