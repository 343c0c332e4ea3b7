"""Lists what a recipe may be made of: an engine's options, a closed list, and steps for a case."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product

from ....engines.knobs import Knob, Options, Value, merged
from ..causes.candidate import Candidate

MOST = 2  # options, all sets of which are tried; then bundles
WHOLE = 1e-9  # of a ratio: whole up to rounding


@dataclass(frozen=True, eq=False)
class Choice:
    """Values of knobs, at most one of each, and how many are options of the engine itself."""

    words: tuple[str, ...]
    options: Options
    protocol: int = 0  # of them: what is done to start and readout

    def at(self, step: float) -> Candidate:
        return Candidate.of(self.options, step)

    def also(self, other: "Choice") -> "Choice":
        words = self.words + other.words
        options = merged(self.options, other.options)
        return Choice(words, options, self.protocol + other.protocol)

    @property
    def size(self) -> int:
        """How many are changed."""
        return len(self.words)

    def milder(self, before: Value, after: Value) -> "Choice":
        """With another value of the same knob."""
        words = tuple(after.words if word == before.words else word for word in self.words)
        return Choice(words, merged(self.options, after.options), self.protocol)


NOTHING = Choice((), {})


@dataclass(frozen=True)
class Menu:
    """knobs: those that matter for a scene. steps: large to small.

    own: the step [s] of who changes nothing; it is one of them, and a smaller one is a change.
    tuned: the tuned setting's options. ours: what is not on it, for it takes our adapter.
    """

    knobs: Sequence[Knob]
    steps: list[float]
    own: float
    tuned: Options
    ours: Sequence[str] = ()

    def choices(self, size: int) -> Iterator[Choice]:
        """Every choice of `size` options."""
        single = [[_choice(knob, v) for v in knob.values] for knob in self._knobs(bundle=False)]
        for among in combinations(single, size):
            for chosen in product(*among):
                found = NOTHING
                for one in chosen:
                    found = found.also(one)
                yield found

    def bundles(self, more: int) -> list[Choice]:
        """Whole recipes, the tuned one too, alone or with so many options more."""
        named = [_choice(knob, v) for knob in self._knobs(bundle=True) for v in knob.values]
        return [
            whole.also(one)
            for whole in (*named, Choice(("the tuned recipe",), self.tuned))
            for one in self.choices(more)
            if not more or merged(whole.options, one.options) != dict(whole.options)
        ]

    @property
    def coarse(self) -> list[float]:
        """Steps that are no change: as large as its own or larger."""
        return [step for step in self.steps if step >= self.own * (1 - WHOLE)]

    @property
    def fine(self) -> list[float]:
        """Steps that are one."""
        return self.steps[len(self.coarse) :]

    def values_in(self, options: Options) -> Iterator[tuple[Knob, Value]]:
        """The knobs of one number with the values that the options are."""
        for knob in self._knobs(bundle=False):
            for value in knob.values:
                whole = any(isinstance(each, Mapping) for each in value.options.values())
                if not whole and merged(options, value.options) == dict(options):
                    yield knob, value

    def _knobs(self, *, bundle: bool) -> list[Knob]:
        return [knob for knob in self.knobs if (knob.kind == "bundle") == bundle and knob.values]


def _choice(knob: Knob, value: Value) -> Choice:
    return Choice((value.words,), value.options, int(knob.kind == "protocol"))


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
