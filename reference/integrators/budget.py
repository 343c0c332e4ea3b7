"""How much one reference may cost, all of its motions together.

What a case asks for is estimated when it is loaded. This is the net below: a motion that turns out
to need ever more steps ends with a message, and the same one on every machine, for not the clock
is asked but evaluations, each at what it takes on a common one.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace
from itertools import islice
from typing import TypeVar

from ...cases.language.check.cost import about
from .now import NOW, doing, reached

PATIENCE = 15.0  # s of a motion, before it is asked where it leads: twice what a shipped one takes
WINDOW = 5.0  # s: where its latest part leads is asked, which after a stiff first moment is faster
TWICE = 2.0  # the first motion of a reference has another answer beside it, which takes as long
SHOWN = 100  # ways: of fewer nobody need be told
MANY = 10**6  # ways: more are not counted beforehand, which takes a second
ANSWERS = ("the motion", "its second answer", "its third answer", "a further answer")

T = TypeVar("T")


class Endless(Exception):
    """A motion that would use up more than the budget.

    time: how far it got [s], until: where it should lead, needs: what all would take [s], or
    nothing where nobody knows. ways: more than so many would have to be tried there, if that is it,
    and among what.
    """

    def __init__(
        self,
        evaluations: int,
        time: float,
        until: float,
        needs: float | None,
        ways: int = 0,
        among: Sequence[str] = (),
    ) -> None:
        far = f" of {until:.4g}" if until else ""
        more = f" and needs {about(needs)}" if needs else ""
        if ways:
            more = f", where what touches and rubs may go on in more than {ways} ways"
        super().__init__(f"reached t = {time:.4g}{far} s after {evaluations} evaluations{more}")
        self.time, self.ways, self.among = time, ways, among


@dataclass
class _Purse:
    """Seconds, and what an evaluation costs; of the motion that is followed, where it stood."""

    given: float
    price: float
    spent: float = 0.0
    evaluations: int = 0
    motions: int = 0
    begin: float = 0.0
    until: float = 0.0
    before: float = 0.0  # spent when the motion began
    marks: tuple[tuple[float, float], ...] = ((0.0, 0.0),)  # spent and t, lately

    def paid(self, evaluations: int, seconds: float) -> None:
        """Takes what an instant costs, which says nothing of the pace."""
        self.evaluations += evaluations
        self.spent, self.before = self.spent + seconds, self.before + seconds
        self.marks = tuple((spent + seconds, t) for spent, t in self.marks)

    def needs(self, time: float) -> float | None:
        """Seconds that all takes if the motion goes on like that; None: it is too early to say."""
        marks = self.marks
        if self.spent >= marks[-1][0] + WINDOW:
            self.marks = (*marks[-1:], (self.spent, time))
        if self.spent - self.before < PATIENCE or not self.until > self.begin:
            return None
        pace = min((self.spent - s) / max(time - t, 1e-300) for s, t in marks if s < self.spent)
        return self.spent + (self.until - time) * pace


_purse: ContextVar[_Purse | None] = ContextVar("purse", default=None)


@contextmanager
def budget(seconds: float, price: float) -> Iterator[None]:
    """Lets the integrations within take so long together; price: of an evaluation of slopes [s]."""
    token = _purse.set(_Purse(seconds, price))
    try:
        yield
    finally:
        _purse.reset(token)


def apart(price: float) -> None:
    """The motions that follow are another island's, of which an evaluation has another price."""
    if (purse := _purse.get()) is not None:
        purse.price, purse.motions = price, 0


def motion(begin: float, until: float) -> None:
    """A motion begins that leads from one time to the other [s]; for whoever waits it is named."""
    before = 0
    if (purse := _purse.get()) is not None:
        purse.begin, purse.until, purse.before = begin, until, purse.spent
        before, purse.motions = purse.motions, purse.motions + 1
        purse.marks = ((purse.spent, begin),)
    doing(ANSWERS[min(before, len(ANSWERS) - 1)], begin, until)


def spend(evaluations: int, time: float) -> None:
    """Takes them from the budget, if there is one. Raises Endless where it cannot be enough."""
    reached(time)
    purse = _purse.get()
    if purse is None:
        return
    purse.evaluations += evaluations
    purse.spent += evaluations * purse.price
    needs = purse.needs(time)
    if needs is not None and purse.motions == 1:
        needs *= TWICE
    if purse.spent > purse.given or (needs is not None and needs > purse.given):
        raise Endless(purse.evaluations, time, purse.until, needs)


def tries(ways: Callable[[], Iterator[T]], each: int, among: Sequence[str]) -> Iterator[T]:
    """The ways in which it may go on at an instant, each tried for so many evaluations.

    among: what may do one thing or another. Raises Endless before the first one, if there are more
    than can be paid.
    """
    purse, before = _purse.get() or _Purse(math.inf, 0.0), replace(NOW)
    price = each * purse.price
    room = (purse.given - purse.spent) / price if price else math.inf
    most = int(min(max(room, 0.0), MANY))
    count = sum(1 for _ in islice(ways(), most + 1))
    if count > SHOWN:
        which = "the" if count <= most else f"more than {most}"
        doing(f"{before.what} at {before.at:.4g} s, {which} ways to go on", end=count, unit="")
    try:
        for tried, way in enumerate(ways()):
            if tried > room or count > room:
                raise Endless(purse.evaluations, before.at, purse.until, None, most, among)
            purse.paid(each, price)
            if count > SHOWN:
                reached(tried)
            yield way
    finally:
        if count > SHOWN:
            vars(NOW).update(vars(before))
