"""Lists what a recipe may be made of: an engine's options, a closed list, and steps for a case."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, reduce
from itertools import combinations, product

from ....engines.knobs import Knob, Options, Value, merged
from ..causes.candidate import Candidate
from ..causes.search import Ladder

MOST = 2  # options, all sets of which are tried; then bundles
WHOLE = 1e-9  # of a ratio: whole up to rounding


@dataclass(frozen=True, eq=False)
class Choice:
    """Options of some knobs, how many knobs, and how many of these act on start and readout."""

    options: Options
    size: int = 0
    protocol: int = 0

    def at(self, step: float) -> Candidate:
        return Candidate(self._text, step)

    def also(self, other: "Choice") -> "Choice":
        options = merged(self.options, other.options)
        return Choice(options, self.size + other.size, self.protocol + other.protocol)

    @cached_property
    def _text(self) -> str:
        return Candidate.of(self.options, 0.0).text


NOTHING = Choice({})


@dataclass(frozen=True)
class Candidates:
    """knobs: those that matter for a scene. steps: large to small.

    own: the step [s] of who changes nothing; it is one of them, and a smaller one is a change.
    tuned: the tuned setting's options. ours: what is left out, for it takes our adapter.
    """

    knobs: Sequence[Knob]
    steps: list[float]
    own: float
    tuned: Options
    ours: Sequence[str] = ()
    _sets: dict[int, list[Choice]] = field(default_factory=dict[int, list[Choice]])

    def choices(self, size: int) -> list[Choice]:
        """Every choice of `size` options."""
        if size not in self._sets:
            single = [[_choice(k, v) for v in k.values] for k in self._knobs(bundle=False)]
            self._sets[size] = [
                reduce(Choice.also, chosen, NOTHING)
                for among in combinations(single, size)
                for chosen in product(*among)
            ]
        return self._sets[size]

    def bundles(self, more: int) -> list[Choice]:
        """Whole recipes, the tuned one too, alone or with so many options more."""
        named = [_choice(knob, v) for knob in self._knobs(bundle=True) for v in knob.values]
        return [
            whole.also(one)
            for whole in (*named, Choice(self.tuned, 1))
            for one in self.choices(more)
            if not more or merged(whole.options, one.options) != dict(whole.options)
        ]

    def groups(self) -> Iterator[list[Ladder[Choice]]]:
        """Yields none, one, two options at all steps; a step below its own counts as one."""
        smaller: list[Choice] = []
        for size in range(MOST + 1):
            choices = self.choices(size)
            yield [*_ladders(choices, self.coarse), *_ladders(smaller, self.fine)]
            smaller = choices

    def whole_groups(self) -> Iterator[list[Ladder[Choice]]]:
        """Yields whole recipes, and each with an option more, at its own step or larger first."""
        for steps in (self.coarse, self.fine):
            for more in (0, 1):
                yield _ladders(self.bundles(more), steps)

    @property
    def coarse(self) -> list[float]:
        """Steps that are no change: as large as its own or larger."""
        return [step for step in self.steps if step >= self.own * (1 - WHOLE)]

    @property
    def fine(self) -> list[float]:
        """Steps that are one."""
        return self.steps[len(self.coarse) :]

    def values_in(self, options: Options) -> list[tuple[Knob, Value]]:
        """The knobs of one number with the values that the options are."""
        return [
            (knob, value)
            for knob in self._knobs(bundle=False)
            for value in knob.values
            if not any(isinstance(each, Mapping) for each in value.options.values())
            and merged(options, value.options) == dict(options)
        ]

    def _knobs(self, *, bundle: bool) -> list[Knob]:
        return [knob for knob in self.knobs if (knob.kind == "bundle") == bundle and knob.values]


def _choice(knob: Knob, value: Value) -> Choice:
    return Choice(value.options, 1, int(knob.kind == "protocol"))


def _ladders(choices: Iterable[Choice], steps: Sequence[float]) -> list[Ladder[Choice]]:
    """The choices at each of the steps, and at half the last."""
    rungs = [*steps, *(step / 2 for step in steps[-1:])]
    return [Ladder(choice, [choice.at(step) for step in rungs]) for choice in choices if rungs]


def parts(options: Options) -> Iterator[tuple[str, ...]]:
    """The names of what a recipe sets, of groups within them."""
    for name, value in options.items():
        if isinstance(value, Mapping):
            yield from ((name, *rest) for rest in parts(value))
        else:
            yield (name,)


def fitting(steps: Sequence[float], own: float, interval: float) -> list[float]:
    """The own step and those of a list that meet every sample, unchanged, the largest first."""
    met = [step for step in steps if abs(interval / step - round(interval / step)) <= WHOLE]
    others = [step for step in met if abs(step - own) > WHOLE * own and step <= interval]
    return sorted([own, *others], reverse=True)
