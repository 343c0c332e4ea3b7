"""Which rows may fail: those of what somebody has promised, not those of what is only asked.

The shipped cases' bars are ours, and a `reach`, a declared deviation and a reference are promised
by whoever wrote the case. That a recipe of ours keeps the tolerance of a user's own case nobody
has promised: where it does not, that is the answer to his question.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from ...cases.case import Case
from ...cases.find import is_shipped
from .row import AGREES, BEYOND, DEVIATES, DIVERGED, FAILS, REFUSED, Comparison

OURS = "tuned"


def ships(case: Case) -> bool:
    """Whether it is a case that comes with the suite, and no file of somebody else's."""
    return is_shipped(case.source.file)


def answered(case: Case, rows: Iterable[Comparison]) -> list[Comparison]:
    """Returns the case's rows; only those fail of which something was promised."""
    return [*rows] if ships(case) else [_answered(case, row) for row in rows]


def _answered(case: Case, row: Comparison) -> Comparison:
    if row.verdict != FAILS or row.setting != OURS or _promised(case, row):
        return row
    broken, _, why = row.because.partition("; ")
    if case.states is None and row.because.startswith(f"{DIVERGED}: "):  # of states none diverges
        return replace(row, verdict=DIVERGED, because=row.because.removeprefix(f"{DIVERGED}: "))
    if row.error is None or row.ratio is None or row.ratio <= 1 or " is above allow " not in broken:
        return row
    return replace(row, verdict=BEYOND, because=why)


def _promised(case: Case, row: Comparison) -> bool:
    native = row.realised == "native"
    key = row.engine if native else f"{row.engine}.{row.realised}"
    bars = [case.reach.get(key, {}), case.reach.get(f"{row.engine}.limit", {}) if native else {}]
    declared = case.deviates.get(f"{row.engine}.{row.setting}", {})
    return row.quantity in declared or any(row.quantity in bar for bar in bars)


def unkept(case: Case, rows: Iterable[Comparison]) -> Iterator[str]:
    """A line for each engine in which no setting that was run keeps all of a user's own case.

    And for each `reach` that no row is held to. Only where our recipe was run: else nobody has
    tried.
    """
    if ships(case):
        return
    engines: dict[str, dict[tuple[str, str], list[Comparison]]] = {}
    for row in rows:
        if row.case == case.name and row.quantity != "audit":
            ways = engines.setdefault(row.engine, {})
            ways.setdefault((row.setting, row.realised), []).append(row)
    yield from _of_no_row(case, engines)
    for engine, ways in engines.items():
        if not any(setting == OURS for setting, _ in ways):
            continue
        worsts = {way: worst for way, group in ways.items() if (worst := _worst(group)) is not None}
        if worsts and not any(_keeps(group) for group in ways.values()):
            (setting, how), row = min(worsts.items(), key=lambda item: item[1].ratio or 0.0)
            name = f"{engine}.{setting}" if how == "native" else f"{engine}.{setting} ({how})"
            step = "" if row.step is None else f" at {row.step:g} s"
            nearest = f"{name}, {row.quantity} ×{row.ratio:.2g}{step}"
            nothing = "no setting keeps it at the judged step"
            yield f"{case.name} in {engine}: {nothing}; nearest: {nearest}"


def _of_no_row(
    case: Case, engines: Mapping[str, Mapping[tuple[str, str], Iterable[Comparison]]]
) -> Iterator[str]:
    for key in case.reach:
        engine, _, way = key.partition(".")
        ran = {how for (setting, how), rows in engines.get(engine, {}).items()
               if setting == OURS and _judged(rows)}  # fmt: skip
        if ran and (way if way in ("law", "driver") else "native") not in ran:
            yield f"{case.name}: reach.{key} is held by no row: {engine} does not run the scene so"


def _judged(rows: Iterable[Comparison]) -> list[Comparison]:
    return [row for row in rows if row.verdict != REFUSED]


def _keeps(rows: Iterable[Comparison]) -> bool:
    judged = _judged(rows)
    return bool(judged) and all(map(_is_within, judged))


def _is_within(row: Comparison) -> bool:
    """Whether the tolerance is kept, be it that something else that was declared is not."""
    return row.verdict in (AGREES, DEVIATES) or (row.ratio is not None and row.ratio <= 1)


def _worst(rows: Iterable[Comparison]) -> Comparison | None:
    """Returns the row farthest off; None where one has no number, as when it diverged."""
    judged = _judged(rows)
    if not judged or any(row.ratio is None or row.ratio != row.ratio for row in judged):
        return None
    return max(judged, key=lambda row: row.ratio or 0.0)
