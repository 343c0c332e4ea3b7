"""Lists the changes between two recipes, each as a whole: knobs of the engine, and the step."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import ceil, log2
from typing import Any

from ....engines.knobs import Knob, Options, merged, short_value
from .candidate import Candidate

NEAR = 1e-9  # of a halving: a ratio of two steps that is a power of two up to rounding


@dataclass(frozen=True, eq=False)
class Change:
    """words: what is changed, fit for a sentence.

    number, along: where it is one number, its name, and the options for other values by that.
    """

    words: str
    options: Options = field(default_factory=dict[str, Any])
    number: str = ""
    along: Mapping[float, Options] = field(default_factory=dict[float, Options])


STEP = Change("step")
Changes = tuple[Change, ...]
"""Changes made together, in the order of the list."""


@dataclass(frozen=True)
class Field:
    """Every change between two recipes, and where they begin.

    base: options and step before any. steps: from the base's down to the finest, each half of the
    one before; alone: the same where nothing but the step is changed. rest: what else the other
    recipe has, of no use but beside all the others. presets: what sets all of a group at once, as
    recipes for contacts of which neither setting has chosen.
    """

    base: Candidate
    changes: Sequence[Change]
    steps: Sequence[float]
    alone: Sequence[float]
    rest: Sequence[Change] = ()
    presets: Sequence[Change] = ()

    def candidate(self, changes: Iterable[Change]) -> Candidate:
        """With these changes, at the base's step."""
        options = merged(self.base.options, *(change.options for change in changes))
        return Candidate.of(options, self.base.step)

    def ladder(self, changes: Changes) -> list[Candidate]:
        """The changes at the steps that they allow, coarse to fine; one, if the step is kept."""
        candidate = self.candidate(changes)
        if STEP not in changes:
            return [candidate]
        return [candidate.at(step) for step in (self.alone if changes == (STEP,) else self.steps)]

    def along(self, changes: Changes) -> tuple[str, dict[float, Candidate]]:
        """The one number of these, and candidates by its values, in the order of a cure."""
        if STEP in changes:
            return "h", {candidate.step: candidate for candidate in self.ladder(changes)}
        numbers = [change for change in changes if change.along]
        if len(numbers) != 1:
            return "", {}
        (varied,) = numbers
        others = [change for change in changes if change is not varied]
        return varied.number, {
            x: self.candidate([*others, Change("", options)]) for x, options in varied.along.items()
        }


def halved(step: float, least: float) -> list[float]:
    """Steps [s] from the first by halves, until one is at most the least."""
    count = max(0, ceil(log2(step / least) - NEAR))
    return [step / 2**k for k in range(count + 1)]


def knob_changes(knobs: Iterable[Knob], base: Options) -> Iterator[Change]:
    """A change for each knob, as a whole, that the tuned setting has otherwise than the options."""
    for knob in knobs:
        if knob.tuned is None or merged(base, knob.tuned.options) == merged(base):
            continue
        numbers = [dict(_numbers(value.options)) for value in knob.values]
        names = {name for values in numbers for name in values}
        grouped = any(isinstance(value, Mapping) for value in knob.tuned.options.values())
        words = knob.name if grouped else knob.tuned.words  # of a group: many numbers
        if len(names) == 1 and all(len(values) == 1 for values in numbers):
            (name,) = names
            along = {n[name]: v.options for n, v in zip(numbers, knob.values, strict=True)}
            yield Change(words, knob.tuned.options, number=name, along=along)
        else:
            yield Change(words, knob.tuned.options)


def presets(knobs: Iterable[Knob]) -> list[Change]:
    """Every whole recipe among the knobs: which of them is the tuned one hangs on the start."""
    bundles = (knob for knob in knobs if knob.kind == "bundle")
    return [Change(value.words, value.options) for knob in bundles for value in knob.values]


def rest(knobs: Iterable[Knob], recipe: Options) -> list[Change]:
    """A change to what of a recipe is no knob: how exactly to solve, say; none for nothing."""
    named = merged(*(knob.tuned.options for knob in knobs if knob.tuned))
    others = {name: value for name, value in recipe.items() if name not in named}
    words = " + ".join(f"{name} {short_value(value)}" for name, value in others.items())
    return [Change(words, others)] if others else []


def _numbers(options: Options) -> Iterator[tuple[str, float]]:
    """Options that are one number by their names; of those in groups and lists none is one."""
    for name, value in options.items():
        if isinstance(value, int | float) and not isinstance(value, bool):
            yield name, float(value)
