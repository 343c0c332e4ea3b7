"""With which of an engine's settings, and up to which step, a case comes out as in the textbook."""

from collections.abc import Mapping, Sequence

from ... import engines
from ..data.row import FAILS, REFUSED, Comparison, Rungs
from ..data.short_numbers import milliseconds

Way = tuple[str, str]
"""A setting, and how it is realised."""
NATIVE = "native"


def place(way: Way) -> tuple[float, str, str]:
    """Where a way stands among others: the fewer changes, the earlier."""
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
    failing = sorted({way[0] for way, found in rows.items() if _fails(found)})
    fails = [f"{' and '.join(failing)} FAILS"] if failing else []
    able = [way for way, found in rows.items() if within(found) or _step(found, ladders.get(way))]
    if not able:
        return "; ".join([*fails, "none"] if any(way[0] == "tuned" for way in rows) else fails)
    steps = {way: _step(rows[way], ladders.get(way)) or 0.0 for way in able}
    best = min(able, key=lambda way: (way[1] != NATIVE, -steps[way], place(way)))
    name = best[0] if best[1] == NATIVE else best[1]
    step = f" {milliseconds(steps[best])}" if steps[best] else ""  # states have none
    return "; ".join([*fails, f"{name}{step}"])


def within(rows: Sequence[Comparison]) -> bool:
    """Whether all that can be read is within its tolerance, at the judged step."""
    return bool(judged(rows)) and all(_within(row) for row in judged(rows))


def _within(row: Comparison) -> bool:
    return row.ratio is not None and row.ratio <= 1.0


def _step(rows: Sequence[Comparison], ladder: Sequence[Rungs] | None) -> float | None:
    """The largest from which on all is within: by the ladder, or the judged one; None: none is.

    What is on no ladder (a count, say) has to be within where it was judged.
    """
    usable = [rung.usable_step for rung in ladder or ()]
    known = [step for step in usable if step is not None]
    climbed = {rung.quantity for rung in ladder or ()}
    rest = [row for row in judged(rows) if row.quantity not in climbed]
    if known and len(known) == len(usable) and all(map(_within, rest)):
        return min(known)
    steps = [row.step for row in rows if row.step is not None]
    return min(steps, default=None) if within(rows) else None


def _fails(rows: Sequence[Comparison]) -> bool:
    return any(row.verdict == FAILS for row in rows)
