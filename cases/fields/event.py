"""Events: named instants of a motion, each told by one quantity and one rule."""

from dataclasses import dataclass
from typing import Literal

from ..trajectory import Array

Rule = Literal["stays zero", "leaves zero", "falls to zero", "rises to zero"]


@dataclass(frozen=True)
class Event:
    """When a quantity `stays zero`, `leaves zero`, or crosses zero, or `value` in its place."""

    quantity: str
    rule: Rule
    value: float = 0.0

    @property
    def crosses(self) -> bool:
        """Whether the quantity comes to the value from one side, wherever it goes then."""
        return self.rule in ("falls to zero", "rises to zero")

    def falling(self, samples: Array) -> Array:
        """(N,) a function of the samples that falls to zero where the quantity crosses."""
        return self.value - samples if self.rule == "rises to zero" else samples - self.value
