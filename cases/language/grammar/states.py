"""A claim about states as a case file writes it, in place of a start and a duration."""

from typing import Annotated

from pydantic import AfterValidator, Field

from ...fields.field import In
from ...fields.part import Part
from ...fields.words import wrong
from ...scene.states import Span, States

MOST = 10_000  # states of a file: a minute of its reference


def _ordered(span: Span) -> Span:
    if span[0] > span[1]:
        raise wrong(f"should be a list [low, high], is [{span[0]:g}, {span[1]:g}]")
    return span


_Number = Annotated[float, In("1")]
_Span = Annotated[tuple[_Number, _Number], AfterValidator(_ordered)]


def _few(count: int) -> int:
    if count > MOST:
        raise wrong(f"must be at most {MOST}, is {count}")
    return count


class Drawn(Part):
    """So many unrelated states, with every coordinate drawn evenly from a span, in SI."""

    random: Annotated[int, AfterValidator(_few)] = Field(ge=3, description="how many")
    seed: int = Field(ge=0, description="of the random numbers: another one draws other states")
    q: _Span = Field(description="from which the places are drawn, [low, high] in m and rad")
    q_dot: _Span = Field(description="from which the rates are drawn")
    q_ddot: _Span = Field((0.0, 0.0), description="from which the accelerations are drawn")

    @property
    def states(self) -> States:
        """As a noun."""
        return States(self.random, self.seed, self.q, self.q_dot, self.q_ddot)
