"""The rows of the reports: what is said about one quantity of one case in one engine."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

AGREES, BEYOND, DEVIATES, FAILS = "agrees", "beyond", "deviates", "FAILS"
REFUSED, DIVERGED, CRASHED, CHANGED = "refused", "diverged", "crashed", "changed"
LADDER = (AGREES, DEVIATES, BEYOND, CHANGED, REFUSED, DIVERGED, CRASHED, FAILS)
"""Verdicts from good to bad, each one word: its reason is another column's."""
EXACT, TEXTBOOK, WITHIN, ANOTHER = "exact", "converges", "within", BEYOND
FALLS, STAYS, UNSETTLED, INSTANTS = "falls", "stays", "unsettled", "instants"
OF_A_LADDER = {
    EXACT: "exact but for rounding at the smallest step",
    TEXTBOOK: "converges to the textbook",
    WITHIN: "converges to another value, within the tolerance",
    ANOTHER: "converges to another value, beyond the tolerance",
    FALLS: "no limit settles; the error falls with the step",
    STAYS: "no limit settles; the error stays on every step",
    UNSETTLED: "not settled",
    INSTANTS: "instants of events: no order, no limit",
}
"""Of convergence.csv: each verdict, one word, and what it says to a person."""
UNSEARCHED = "not searched"
"""Of causes.csv: nobody has looked for a cure."""
MUTANTS, MUTATION, SPEED = OF_NO_RUN = "mutants.csv", "mutation.csv", "speed.csv"
"""What the project's own tests plant, what was planted by chance, how long what is typed takes:
beside the committed reports alone, and of no run."""


NUMBERS = ".3g"  # three digits: more would be noise from one machine to the next


def as_written(number: float | None) -> float | None:
    """The number as a report writes it, to three significant digits; None stays None."""
    return None if number is None else float(format(number, NUMBERS))


def rank(verdict: str) -> int:
    """Returns how bad a verdict is, from 0; what is no verdict is worse than all of them."""
    return LADDER.index(verdict) if verdict in LADDER else len(LADDER)


@dataclass(frozen=True)
class Comparison:
    """A row of tolerance.csv. A quantity's row, or the engine's `audit`."""

    case: str
    theme: str  # what the case is about; of several themes all, with blanks between
    source: str
    engine: str
    version: str
    setting: str
    realised: str
    protocol: str
    quantity: str
    unit: str
    step: float | None
    error: float | None  # the largest
    when: float | None  # s: where the error is largest
    rms: float | None
    final: float | None
    allowed: float | None
    ratio: float | None
    verdict: str
    because: str


@dataclass(frozen=True)
class Rungs:
    """A row of convergence.csv: what one quantity's ladder of steps says."""

    case: str
    engine: str
    version: str
    setting: str
    realised: str
    ladder: str
    quantity: str
    unit: str
    order: float | None
    order_low: float | None
    order_high: float | None
    limit: float | None
    uncertainty: float | None
    usable_step: float | None
    verdict: str


@dataclass(frozen=True)
class StepError:
    """A row of steps.csv: the largest error of one quantity at one step of a ladder.

    A row for each, for nothing bounds how many a ladder has: they double up to 8 ms from whatever
    step a case names.
    """

    case: str
    engine: str
    setting: str
    realised: str
    ladder: str
    quantity: str
    unit: str
    step: float
    error: float  # inf where an event happens more or less often than in the reference


@dataclass(frozen=True)
class Instant:
    """A row of events.csv: the k-th time of an event, in the reference or in an engine."""

    case: str
    engine: str  # `reference` for the reference, with neither version nor setting
    version: str
    setting: str
    realised: str
    event: str
    k: int  # from 1
    time: float  # s
    difference: float | None  # to the reference's k-th; None where it has no k-th


@dataclass(frozen=True)
class Certificate:
    """A row of reference.csv: one check of one reference.

    certified: what the reference is known to, of an observed quantity; None of anything else.
    """

    case: str
    source: str
    system: str
    check: str
    difference: float
    bound: float
    certified: float | None
    unit: str
    verdict: str


@dataclass(frozen=True)
class Cause:
    """A row of causes.csv: what brings a quantity within its tolerance; of several a row each.

    cure: in words; or that none was found, or looked for. searched_with: the engine's version and a
    word of the case, the setting, our adapter and the search; nothing where no search is behind it.
    """

    case: str
    engine: str
    setting: str
    quantity: str
    error: float | None  # of the row that is explained
    allowed: float | None
    cure: str
    options: str  # YAML, as in a file of settings
    step: float | None
    error_after: float | None
    cost: float | None  # over the row's own, of a simulated second
    law: str  # how the error follows the cure's one number
    searched_with: str = ""


@dataclass(frozen=True)
class Known:
    """The findings of an earlier run: causes, by the row that they explain, and all verdicts.

    causes: by case, engine, setting and quantity; verdicts: by these with the realisation before
    the quantity.
    """

    causes: Mapping[tuple[str, str, str, str], Sequence[Cause]] = field(
        default_factory=dict[Any, Any]
    )
    verdicts: Mapping[tuple[str, ...], str] = field(default_factory=dict[Any, Any])


@dataclass(frozen=True)
class Advice:
    """A row of advice.csv: a recipe for a case in an engine, natively; or what remains.

    The recipe in words, `none` where nothing keeps the bar. ratio: of the worst quantity, its error
    over its tolerance.
    """

    case: str
    theme: str
    engine: str
    tolerance: float | None  # of each quantity's size; None: as the case allows
    margin: float
    want: str  # `fewest changes`, `cheapest`, or `both`: which of the two recipes it is
    recipe: str
    settings: str  # YAML: a file of settings, whole
    step: float | None
    cost: float | None  # of a simulated second, as the engine counts it
    shipped_cost: float | None
    ratio: float | None
    quantity: str
    remains: str
