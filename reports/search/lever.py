"""What can be changed between two recipes, each as a whole: knobs of the engine, and the step."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import ceil, log2
from typing import Any

from ...engines.knobs import Options, merged
from .candidate import Candidate

NEAR = 1e-9  # of a halving: a ratio of two steps that is a power of two up to rounding


@dataclass(frozen=True, eq=False)
class Lever:
    """words: what it is changed to, fit for a sentence. finer: it is the step."""

    words: str
    options: Options = field(default_factory=dict[str, Any])
    finer: bool = False


Turned = tuple[Lever, ...]
"""Levers that are changed together, in the order of the list."""


@dataclass(frozen=True)
class Field:
    """All levers between two recipes, and where they begin.

    base: options and step before any is changed. steps: from the base's down to the finest, each
    half of the one before.
    """

    base: Candidate
    levers: Sequence[Lever]
    steps: Sequence[float]

    def candidate(self, turned: Iterable[Lever]) -> Candidate:
        """With these changed: the finest step if it is one of them."""
        turned = list(turned)
        step = self.steps[-1] if any(lever.finer for lever in turned) else self.base.step
        options = merged(self.base.options, *(lever.options for lever in turned))
        return Candidate.of(options, step)


def halved(step: float, least: float) -> list[float]:
    """Steps [s] from the first by halves, until one is at most the least."""
    count = max(0, ceil(log2(step / least) - NEAR))
    return [step / 2**k for k in range(count + 1)]
