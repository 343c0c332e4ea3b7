"""The tables of reports that are compared: what names a row, and when a row has changed."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import floor, isfinite, isinf, isnan, log10

from ..row import FAILS, LADDER, OF_A_LADDER, rank

WORSE, BETTER, CHANGED = "regression", "better", "changed"
LOST, NEW = "lost", "new"
KINDS = (WORSE, BETTER, CHANGED, LOST, NEW)

Row = Mapping[str, str]


@dataclass(frozen=True)
class Rule:
    """Decides when a number has moved, and when that is a regression.

    moved: of the larger of two numbers, what they must differ by. floor: of what is allowed, the
    same. worse: the factor by which an error must grow to be a regression; matters: of what is
    allowed, where a grown error begins to be one.

    The thresholds were measured. Runs of the same code on another processor, or with other kernels
    of linear algebra, differ by 1e-10 of `allow` at most, and three written digits by 1 %: such
    runs raise no alarm.
    """

    moved: float = 0.011
    floor: float = 1e-6
    worse: float = 1.5
    matters: float = 1e-3

    def differ(self, was: float | None, now: float | None, allowed: float | None) -> bool:
        """Whether it is another number; one that is not there differs from every one that is."""
        if was is None or now is None:
            return was is not now
        if isnan(was) or isnan(now):
            return isnan(was) != isnan(now)
        if isinf(was) or isinf(now):
            return was != now
        off = abs(now - was)
        return off > self.floor * (allowed or 0.0) and off > self.moved * max(abs(was), abs(now))

    def grown(self, was: float | None, now: float | None, allowed: float | None) -> bool:
        """Whether an error that differs is a regression."""
        if was is None or now is None:
            return False  # then its verdict says more
        matters = allowed is None or not now <= self.matters * allowed
        return matters and not now <= self.worse * was


Judge = Callable[[Row, Row, Rule, float | None], str | None]
"""Returns the kind of the change from the old row to the new one, or None.

The last argument is the error that is allowed of the row's quantity; None where there is none.
"""


@dataclass(frozen=True)
class Columns:
    """The columns of one file, and what is said of its rows.

    keys: what names a row. numbers, words: what must be there too; the first number, and the first
    word that is not empty, are what a row says. judge: how two rows of one name are compared; None:
    cell by cell of `words`.

    what, column: what a row is about, and in which engine, with names of columns in braces; by
    themselves its further keys, and its engine with its setting. unit, label: of its number.
    verdicts: all that may stand in the column of that name.
    """

    name: str
    keys: tuple[str, ...]
    numbers: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    judge: Judge | None = None
    what: str = ""
    column: str = ""
    unit: str = ""
    label: str = ""
    verdicts: tuple[str, ...] = ()

    @property
    def needed(self) -> tuple[str, ...]:
        """The columns that the file must have."""
        return (*self.keys, *self.numbers, *self.words)

    def key(self, row: Row) -> tuple[str, ...]:
        """Returns the cells that name a row."""
        return tuple(row[name] for name in self.keys)


def number(row: Row, column: str) -> float | None:
    """Returns the number in a cell, or None if the cell is empty."""
    return float(row[column]) if row[column] else None


def _both(old: Row, new: Row, column: str) -> tuple[float | None, float | None]:
    return number(old, column), number(new, column)


def _of_an_error(old: Row, new: Row, rule: Rule, allowed: float | None) -> str | None:
    """Judges by the verdict, else by the error in one unit, else by a new unit or tolerance."""
    if old["verdict"] != new["verdict"]:
        return WORSE if rank(new["verdict"]) > rank(old["verdict"]) else BETTER
    was, now = _both(old, new, "error")
    if old["unit"] == new["unit"] and rule.differ(was, now, allowed):
        if rule.grown(was, now, allowed):
            return WORSE
        return BETTER if rule.grown(now, was, allowed) else CHANGED
    asked = any(old[name] != new[name] for name in ("unit", "allowed"))
    return CHANGED if asked else None


def _of_a_ladder(old: Row, new: Row, rule: Rule, allowed: float | None) -> str | None:
    """Judges by the usable step, else by the verdict where that does not depend on rounding."""
    was, now = _both(old, new, "usable_step")
    if rule.differ(was, now, None):
        return WORSE if (now or 0.0) < (was or 0.0) else BETTER
    unsure = max(number(row, "uncertainty") or 0.0 for row in (old, new))
    words = old["verdict"] != new["verdict"] and unsure > rule.floor * (allowed or 0.0)
    return CHANGED if words else None


def _of_a_step(old: Row, new: Row, rule: Rule, allowed: float | None) -> str | None:
    """Judges nothing: the judged step is in tolerance.csv, all together in convergence.csv."""
    return None


LEAST = 1e-9  # s: below it a time is rounding's
DIGITS = 9  # of a time as it is written


def _of_an_event(old: Row, new: Row, rule: Rule, allowed: float | None) -> str | None:
    """Judges by the time, as far as it is written; which one is right, tolerance.csv says."""
    was, now = _both(old, new, "time")
    if was == now or was is None or now is None:
        return None if was == now else CHANGED
    digit = 10.0 ** (floor(log10(abs(was))) + 1 - DIGITS) if was and isfinite(was) else 0.0
    return None if abs(now - was) <= max(LEAST, 1.5 * digit) else CHANGED


DECADES = 11.0  # what is certified is a power of ten: the next one may be rounding's


def _of_a_check(old: Row, new: Row, rule: Rule, allowed: float | None) -> str | None:
    """Judges by whether the check holds, else by decades of what is certified."""
    if old["verdict"] != new["verdict"]:
        return WORSE if new["verdict"] == FAILS else BETTER
    was, now = _both(old, new, "certified")
    if was is None or now is None:
        return None if was is now else CHANGED
    return None if max(was, now) <= DECADES * min(was, now) else CHANGED


def _of_an_item(old: Row, new: Row, rule: Rule, allowed: float | None) -> str | None:
    """Judges by whether anything covers it; which of many cases does is of no matter."""
    covered = [row["cases"] or row["otherwise"] for row in (old, new)]
    return WORSE if covered[0] and not covered[1] else None


ENGINE = ("case", "engine", "setting", "realised")

# fmt: off
ERRORS = Columns(
    "tolerance.csv", keys=(*ENGINE, "quantity"), numbers=("error", "step", "allowed"),
    words=("verdict", "version", "unit"), judge=_of_an_error, unit="{unit}", verdicts=LADDER,
)
LADDERS = Columns(
    "convergence.csv", keys=(*ENGINE, "ladder", "quantity"), numbers=("usable_step", "uncertainty"),
    words=("verdict",), judge=_of_a_ladder, what="{quantity} ({ladder})", unit="s",
    label="usable step", verdicts=tuple(OF_A_LADDER),
)
STEPS = Columns(
    "steps.csv", keys=(*ENGINE, "ladder", "quantity", "step"), numbers=("error",),
    judge=_of_a_step, what="{quantity} ({ladder}, h = {step} s)",
)
INSTANTS = Columns(
    "events.csv", keys=(*ENGINE, "event", "k"), numbers=("time",), judge=_of_an_event,
    what="{event} {k}", unit="s",
)
CERTIFICATES = Columns(
    "reference.csv", keys=("case", "system", "check"), numbers=("certified",),
    words=("verdict", "unit"), judge=_of_a_check, what="{check}", column="reference ({system})",
    unit="{unit}", label="certified to", verdicts=("holds", FAILS),
)
COVERED = Columns(
    "coverage.csv", keys=("kind", "number"), words=("cases", "otherwise"), judge=_of_an_item,
    what="{kind} {number}", column="coverage",
)
CAUSES = Columns(
    "causes.csv", keys=("case", "engine", "setting", "quantity", "cure"),
    words=("error", "allowed", "options", "step", "error_after", "cost", "law"),
)
ADVICE = Columns(
    "advice.csv", keys=("case", "engine", "tolerance", "margin", "want"),
    words=("recipe", "settings", "step", "cost", "shipped_cost", "ratio", "quantity", "remains"),
)
RELEASES = Columns(
    "versions.csv", keys=("case", "engine", "version", "setting", "realised", "quantity"),
    words=("verdict", "error", "allowed", "because"), what="{quantity} of {version}",
)
# fmt: on
_ALL = (ERRORS, LADDERS, STEPS, INSTANTS, CERTIFICATES, COVERED, CAUSES, ADVICE, RELEASES)
KNOWN = {columns.name: columns for columns in _ALL}
OF_A_RUN = KNOWN.keys() - {ADVICE.name, RELEASES.name}
"""The files that one run writes together; the others are runs of their own."""
