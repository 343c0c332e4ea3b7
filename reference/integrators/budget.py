"""How long one reference may take, all of its motions together, by the clock of its own work.

What other processes and threads do takes nothing of it. The largest shipped case needs a thirtieth,
so no machine on which that runs at all refuses one; what overruns is refused, and never another
number.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from time import monotonic, thread_time
from typing import TypeVar

from .now import NOW, doing, reached

SHOWN = 100  # ways: of fewer nobody need be told
ANSWERS = ("the motion", "its second answer", "its third answer", "a further answer")

T = TypeVar("T")


class Endless(Exception):
    """A motion that has used up the budget.

    time: how far it got [s]; among: what may do one thing or another there, if that is it.
    """

    def __init__(self, seconds: float, among: Sequence[str] = ()) -> None:
        far = f" of {NOW.end:.4g}" if NOW.end else ""
        ways = ", where what touches and rubs may go on in very many ways" if among else ""
        super().__init__(f"reached t = {NOW.at:.4g}{far} s after {seconds:g} s of work{ways}")
        self.time, self.among = NOW.at, among


_budget: ContextVar[tuple[float, float, float]] = ContextVar(
    "budget", default=(math.inf, math.inf, math.inf)
)
"""Seconds, when they end on the thread's own clock, and before when they cannot on any."""


@contextmanager
def budget(seconds: float) -> Iterator[None]:
    """Lets the integrations within take so long together."""
    token = _budget.set((seconds, thread_time() + seconds, monotonic() + seconds))
    try:
        yield
    finally:
        _budget.reset(token)


def motion(begin: float, until: float) -> None:
    """Notes that a motion begins that leads from one time to the other [s], with its name."""
    NOW.motions += 1
    doing(ANSWERS[min(NOW.motions, len(ANSWERS)) - 1], begin, until)


def spend(at: float, among: Sequence[str] = ()) -> None:
    """Says how far the work is. Raises Endless where the budget is used up."""
    reached(at)
    seconds, end, soonest = _budget.get()
    # A thread works no longer than it lasts; in some containers its own clock takes 0.2 ms to read.
    if monotonic() > soonest and thread_time() > end:
        raise Endless(seconds, among)


def tries(ways: Iterable[T], among: Sequence[str]) -> Iterator[T]:
    """Yields the ways in which it may go on at an instant, as far as the budget reaches.

    among: what may do one thing or another. Raises Endless.
    """
    before = NOW.what
    try:
        for k, way in enumerate(ways, start=1):
            spend(NOW.at, among)
            if k > SHOWN:
                NOW.what = f"{before}, way {k} to go on there"
            yield way
    finally:
        NOW.what = before
