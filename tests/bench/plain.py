"""A plain loop: what a user would write for a motion, with none of an adapter's code."""

from collections.abc import Callable
from dataclasses import dataclass

from textmech.engines.engine import Start


@dataclass(frozen=True)
class Plain:
    """A plain loop at its start: `take` takes n steps, `states` tells where all bodies then are."""

    take: Callable[[int], None]
    states: Callable[[], Start]


Begin = Callable[[float], Plain]
"""Builds a plain loop for a step [s]; or, called once more, does of that only what another step
asks for. A user's step need not be as good as the adapter's: of first order will do."""
