"""Causes in a row's last column: its instant, what is declared of it, and what cures it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from .row import DEVIATES, DIVERGED, UNSEARCHED, Cause, Comparison
from .search.told import NONE, NOTHING
from .search.why import Key, key_of

Moments = Mapping[Key, str]
"""In words, of rows whose error is largest at an instant."""
MOST = 3  # cures in a sentence: causes.csv has them all


def with_causes(
    rows: Sequence[Comparison], causes: Sequence[Cause], moments: Moments
) -> list[Comparison]:
    """The rows, of which each that has causes says them."""
    found: dict[Key, list[Cause]] = {}
    for cause in causes:
        found.setdefault(key_of(cause), []).append(cause)
    return [
        _with(row, found[key_of(row)], moments.get(key_of(row), ""))
        if row.realised == "native" and key_of(row) in found
        else row
        for row in rows
    ]


def _with(row: Comparison, causes: Sequence[Cause], moment: str) -> Comparison:
    """What the ladder told stays where there is nothing better to tell."""
    first = causes[0].cure
    if first == UNSEARCHED:
        return row
    declared = row.because if row.verdict in (DEVIATES, DIVERGED) else moment
    if first == NONE:
        told = [declared or row.because, "none of its options tried cures it"]
    elif first == NOTHING:
        told = [declared or row.because, NOTHING]
    else:
        told = [declared, f"cured by {_cures(causes)}"]
    return replace(row, because="; ".join(part for part in told if part))


def _cures(causes: Sequence[Cause]) -> str:
    told = [_cure(cause) for cause in causes[:MOST]]
    more = len(causes) - len(told)
    return " or ".join([*told, f"{more} more"] if more else told)


def _cure(cause: Cause) -> str:
    """`RK4 (×4)`: beside it what it costs."""
    cost = "" if cause.cost is None else f" (×{cause.cost:.2g} the cost)"
    at = f" {cause.step:.3g} s" if cause.cure.endswith("step") else ""
    return f"{cause.cure}{at}{cost}"
