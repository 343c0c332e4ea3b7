"""Limits that hold on one side and slip along nothing: a rope's end, and the stops of a joint.

| limit | open | nothing        | its gap: it is struck        |
| limit | acts | the gap stays 0 | its force, the multiplier: it lets go |
"""

from dataclasses import dataclass

from ..constraints.constraint import Constraint
from .element import Element, State


@dataclass(frozen=True, kw_only=True)
class Limit(Element):
    """It shares its friction with nothing: it has none. quantity: the reaction of its row."""

    quantity: str
    rest: tuple[State, ...] = ("acts",)

    @property
    def push(self) -> str:
        return self.quantity

    @property
    def together(self) -> tuple[str, str]:
        """Alone."""
        return self.name, ""

    def held(self, state: State) -> list[Constraint]:
        """Nothing, or its row."""
        return [self.normal] if state == "acts" and self.normal is not None else []
