"""The short table: how far off each case is in each engine, what agrees, and what cures it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import TypeVar

from ..batch.selection import BOOK
from ..data.row import CHANGED, REFUSED, Comparison, Rungs
from ..data.short_numbers import factor
from .best_setting import NATIVE, Way, agreement, judged, place

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
            _cured(rows[way], cures or {}),
        )
        for case, engine, rows, ladders in _engines(comparisons, rungs)
        if engine != BOOK
        for way in _shown(rows)
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
    found: dict[tuple[str, str], dict[Way, list[Row]]] = {}
    for row in rows:
        ways = found.setdefault((row.case, row.engine), {})
        ways.setdefault((row.setting, row.realised), []).append(row)
    return found


def _shown(rows: Iterable[Way]) -> list[Way]:
    ways = sorted(rows, key=place)
    native = [way for way in ways if way[1] == NATIVE] or ways[:1]
    return [way for way in native if way[0] != "tuned"] or native


def _worst(rows: Sequence[Comparison]) -> str:
    answered = judged(rows)
    if not answered:
        return REFUSED
    told = [row for row in answered if row.ratio is not None]
    if not told:
        return answered[0].verdict
    words = []
    if any(row.verdict == CHANGED for row in answered):
        words.append("changed")
    worst = max(told, key=_size)
    words.append("agrees" if _size(worst) <= 1 else f"{worst.quantity} {factor(_size(worst))}")
    if len(answered) < len(rows):
        words.append(f"{len(rows) - len(answered)} not read")
    return ", ".join(words)


def _size(row: Comparison) -> float:
    return inf if row.ratio is None or not row.ratio <= inf else row.ratio  # NaN is the worst


def _cured(rows: Sequence[Comparison], cures: Cures) -> str:
    told = [row for row in judged(rows) if row.ratio is not None]
    worst = max(told, key=_size, default=None)
    if worst is None or _size(worst) <= 1:
        return ""
    return cures.get((worst.case, worst.engine, worst.setting, worst.quantity), "")
