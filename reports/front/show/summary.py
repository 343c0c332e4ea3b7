"""The short table: how far off each case is in each engine, what agrees, and what cures it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import TypeVar

from .... import engines
from ...runs.selection import BOOK
from ...tables.row import CHANGED, FAILS, REFUSED, Comparison, Rungs
from ...tables.short_numbers import factor, milliseconds

# With which of an engine's settings, and up to which step, a case comes out as in the textbook.


Way = tuple[str, str]
"""A setting, and how it is realised."""
NATIVE = "native"


def place(way: Way) -> tuple[float, str, str]:
    """Returns the sort key of a way: the fewer changes, the earlier."""
    setting, realised = way
    return engines.place(setting), setting, realised


def judged(rows: Sequence[Comparison]) -> list[Comparison]:
    """Returns the rows that the engine answers and does not refuse."""
    return [row for row in rows if row.verdict != REFUSED]


def agreement(
    rows: Mapping[Way, Sequence[Comparison]], ladders: Mapping[Way, Sequence[Rungs]]
) -> str:
    """Names what agrees at the largest step, the engine's own elements before our law or driver.

    What fails is named too. Where nothing agrees and the best recipe was not asked for,
    nothing is said.
    """
    failing = sorted({way[0] for way, group in rows.items() if _fails(group)})
    fails = [f"{' and '.join(failing)} FAILS"] if failing else []
    able = [way for way, group in rows.items() if within(group) or _step(group, ladders.get(way))]
    if not able:
        return "; ".join([*fails, "none"] if any(way[0] == "tuned" for way in rows) else fails)
    steps = {way: _step(rows[way], ladders.get(way)) or 0.0 for way in able}
    best = min(able, key=lambda way: (way[1] != NATIVE, -steps[way], place(way)))
    name = best[0] if best[1] == NATIVE else best[1]
    step = f" {milliseconds(steps[best])}" if steps[best] else ""  # states have none
    return "; ".join([*fails, f"{name}{step}"])


def within(rows: Sequence[Comparison]) -> bool:
    """Whether all that can be read is within its tolerance, at the judged step."""
    return bool(judged(rows)) and all(_is_within(row) for row in judged(rows))


def _is_within(row: Comparison) -> bool:
    return row.ratio is not None and row.ratio <= 1.0


def _step(rows: Sequence[Comparison], ladder: Sequence[Rungs] | None) -> float | None:
    """Returns the largest step from which on all is within, by the ladder or as judged; or None.

    What is on no ladder (a count, say) has to be within where it was judged.
    """
    usable = [rung.usable_step for rung in ladder or ()]
    known = [step for step in usable if step is not None]
    climbed = {rung.quantity for rung in ladder or ()}
    rest = [row for row in judged(rows) if row.quantity not in climbed]
    if known and len(known) == len(usable) and all(map(_is_within, rest)):
        return min(known)
    steps = [row.step for row in rows if row.step is not None]
    return min(steps, default=None) if within(rows) else None


def _fails(rows: Sequence[Comparison]) -> bool:
    return any(row.verdict == FAILS for row in rows)


Row = TypeVar("Row", Comparison, Rungs)
Cures = Mapping[tuple[str, str, str, str], str]
"""By case, engine, setting and quantity: what brings it within its tolerance, in words."""


@dataclass(frozen=True)
class Line:
    """The result of a case in a setting: its worst quantity over what is allowed, or a verdict.

    agrees: with which of the engine's settings, and up to which step, everything is within its
    tolerance. cured: what brings the worst quantity within, as far as that is known.
    """

    case: str
    setting: str
    worst: str
    agrees: str
    cured: str


def summary(
    comparisons: Sequence[Comparison], rungs: Sequence[Rungs], cures: Cures | None = None
) -> list[Line]:
    """Returns for each case and engine a line as shipped, and one for each own setting of the user.

    The tuned setting has a line of its own only where nothing else was run.
    """
    return [
        Line(
            case,
            f"{engine}.{way[0]}",
            _worst(rows[way]),
            agreement(rows, ladders),
            _cure_of(rows[way], cures or {}),
        )
        for case, engine, rows, ladders in _engines(comparisons, rungs)
        if engine != BOOK
        for way in _shown_ways(rows)
    ]


def approximations(comparisons: Sequence[Comparison], rungs: Sequence[Rungs]) -> list[Line]:
    """Returns a line for each of the book's own approximations of dry friction."""
    return [
        Line(
            case,
            f"{BOOK}.{way[0]}",
            _worst(rows[way]),
            agreement({way: rows[way]}, ladders).removeprefix(f"{way[0]} "),
            "",
        )
        for case, engine, rows, ladders in _engines(comparisons, rungs)
        if engine == BOOK
        for way in sorted(rows)
    ]


def _engines(
    comparisons: Sequence[Comparison], rungs: Sequence[Rungs]
) -> Iterator[tuple[str, str, dict[Way, list[Comparison]], dict[Way, list[Rungs]]]]:
    rows = _grouped(row for row in comparisons if row.quantity != "audit")
    ladders = _grouped(rungs)
    for (case, engine), ways in sorted(rows.items()):
        yield case, engine, ways, ladders.get((case, engine), {})


def _grouped(rows: Iterable[Row]) -> dict[tuple[str, str], dict[Way, list[Row]]]:
    groups: dict[tuple[str, str], dict[Way, list[Row]]] = {}
    for row in rows:
        ways = groups.setdefault((row.case, row.engine), {})
        ways.setdefault((row.setting, row.realised), []).append(row)
    return groups


def _shown_ways(rows: Iterable[Way]) -> list[Way]:
    ways = sorted(rows, key=place)
    native = [way for way in ways if way[1] == NATIVE] or ways[:1]
    return [way for way in native if way[0] != "tuned"] or native


def _worst(rows: Sequence[Comparison]) -> str:
    answered = judged(rows)
    if not answered:
        return REFUSED
    rated = [row for row in answered if row.ratio is not None]
    if not rated:
        return answered[0].verdict
    words = []
    if any(row.verdict == CHANGED for row in answered):
        words.append("changed")
    worst = max(rated, key=_size)
    words.append("agrees" if _size(worst) <= 1 else f"{worst.quantity} {factor(_size(worst))}")
    if len(answered) < len(rows):
        words.append(f"{len(rows) - len(answered)} not read")
    return ", ".join(words)


def _size(row: Comparison) -> float:
    return inf if row.ratio is None or not row.ratio <= inf else row.ratio  # NaN is the worst


def _cure_of(rows: Sequence[Comparison], cures: Cures) -> str:
    rated = [row for row in judged(rows) if row.ratio is not None]
    worst = max(rated, key=_size, default=None)
    if worst is None or _size(worst) <= 1:
        return ""
    return cures.get((worst.case, worst.engine, worst.setting, worst.quantity), "")
