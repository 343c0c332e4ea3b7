"""Lists the changes between two recipes, each as a whole: knobs of the engine, and the step."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import ceil, log2
from typing import Any

from ....engines.knobs import Knob, Options, merged, short_value
from .candidate import Candidate

NEAR = 1e-9  # of a halving: a ratio of two steps that is a power of two up to rounding


@dataclass(frozen=True, eq=False)
class Lever:
    """words: what it is changed to, fit for a sentence. finer: it is the step.

    along: the options for other values of its number, where it is one number, by that.
    """

    words: str
    options: Options = field(default_factory=dict[str, Any])
    finer: bool = False
    number: str = ""
    along: Mapping[float, Options] = field(default_factory=dict[float, Options])


STEP = Lever("step", finer=True)
Turned = tuple[Lever, ...]
"""Levers that are changed together, in the order of the list."""


@dataclass(frozen=True)
class Field:
    """Every lever between two recipes, and where they begin.

    base: options and step before any is changed. steps: from the base's down to the finest, each
    half of the one before; alone: the same where nothing but the step is changed. rest: what else
    the other recipe has, of no use but beside all the others. wholes: what sets all of a group at
    once, as recipes for contacts of which neither setting has chosen.
    """

    base: Candidate
    levers: Sequence[Lever]
    steps: Sequence[float]
    alone: Sequence[float]
    rest: Lever | None = None
    wholes: Sequence[Lever] = ()

    def candidate(self, turned: Iterable[Lever]) -> Candidate:
        """With these changed: the finest step if it is one of them."""
        turned = tuple(turned)
        step = self.ladder(turned)[-1] if STEP in turned else self.base.step
        options = merged(self.base.options, *(lever.options for lever in turned))
        return Candidate.of(options, step)

    def ladder(self, turned: Turned) -> Sequence[float]:
        """The steps for a set with the step."""
        return self.alone if turned == (STEP,) else self.steps

    def along(self, turned: Turned) -> tuple[str, dict[float, Candidate]]:
        """The one number of these, and candidates by its values, in the order of a cure."""
        if STEP in turned:
            candidate = self.candidate(turned)
            return "h", {step: candidate.at(step) for step in self.ladder(turned)}
        numbers = [lever for lever in turned if lever.along]
        if len(numbers) != 1:
            return "", {}
        (lever,) = numbers
        others = [other for other in turned if other is not lever]
        return lever.number, {
            x: self.candidate([*others, Lever("", options)]) for x, options in lever.along.items()
        }


def halved(step: float, least: float) -> list[float]:
    """Steps [s] from the first by halves, until one is at most the least."""
    count = max(0, ceil(log2(step / least) - NEAR))
    return [step / 2**k for k in range(count + 1)]


def levers(knobs: Iterable[Knob], base: Options) -> Iterator[Lever]:
    """A lever for each knob, as a whole, that the tuned setting has otherwise than the options."""
    for knob in knobs:
        if knob.tuned is None or merged(base, knob.tuned.options) == merged(base):
            continue
        numbers = [dict(_numbers(value.options)) for value in knob.values]
        varied = {name for found in numbers for name in found}
        grouped = any(isinstance(value, Mapping) for value in knob.tuned.options.values())
        words = knob.name if grouped else knob.tuned.words  # of a group: many numbers
        if len(varied) == 1 and all(len(found) == 1 for found in numbers):
            (name,) = varied
            along = {n[name]: v.options for n, v in zip(numbers, knob.values, strict=True)}
            yield Lever(words, knob.tuned.options, number=name, along=along)
        else:
            yield Lever(words, knob.tuned.options)


def wholes(knobs: Iterable[Knob]) -> list[Lever]:
    """Every whole recipe among the knobs: which of them is the tuned one hangs on the start."""
    bundles = (knob for knob in knobs if knob.kind == "bundle")
    return [Lever(value.words, value.options) for knob in bundles for value in knob.values]


def remainder(knobs: Iterable[Knob], recipe: Options) -> Lever | None:
    """A lever for what of a recipe is no knob: how exactly to solve, say; None for nothing."""
    turned = merged(*(knob.tuned.options for knob in knobs if knob.tuned))
    rest = {name: value for name, value in recipe.items() if name not in turned}
    words = " + ".join(f"{name} {short_value(value)}" for name, value in rest.items())
    return Lever(words, rest) if rest else None


def _numbers(options: Options) -> Iterator[tuple[str, float]]:
    """Options that are one number by their names; of those in groups and lists none is one."""
    for name, value in options.items():
        if isinstance(value, int | float) and not isinstance(value, bool):
            yield name, float(value)
