"""The rows of a run for the terminal: below each engine's setting its quantities and reasons."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from textwrap import wrap

from ..data.row import AGREES, FAILS, Certificate, Comparison
from ..data.short_numbers import milliseconds
from .table import WIDTH

REASON = " " * 6


def rows(comparisons: Sequence[Comparison]) -> Iterator[str]:
    """Lines: of each quantity how far off it is, of what is allowed, the verdict, and why."""
    for _, found in groupby(comparisons, key=lambda r: (r.case, r.engine, r.setting, r.realised)):
        group = [*found]
        yield ""
        yield head(group)
        yield from _wrapped(group[0].protocol, "  ")
        names = max(len(row.quantity) for row in group)
        units = max(len(row.unit) for row in group)
        for (_, silent, because), same in groupby(group, key=_reason):
            told = [*same]
            if silent:
                yield from _wrapped(", ".join(row.quantity for row in told), "  ")
                yield from _wrapped(f"{told[0].verdict}: {because}".strip(": "), REASON)
                continue
            for row in told:
                allowed = "" if row.allowed is None else f"of {row.allowed:.1e}"
                number = f"{row.error:8.2e} {row.unit:{units}}"
                yield f"  {row.quantity:{names}}  {number}  {allowed:11}  {row.verdict}"
            yield from _wrapped(because, REASON)


def head(group: Sequence[Comparison]) -> str:
    """Which engine it is in which setting, and the step of all of its rows."""
    first = group[0]
    how = "" if first.realised == "native" else f" ({first.realised})"
    steps = {row.step for row in group if row.step is not None}
    step = f", h = {milliseconds(steps.pop())}" if len(steps) == 1 else ""
    return f"{first.case} in {first.engine} {first.version} {first.setting}{how}{step}"


def certificate_lines(certificates: Sequence[Certificate]) -> Iterator[str]:
    """Lines: what each reference is known to, of all that its case bounds; of one that holds."""
    for case, rows in groupby(certificates, key=lambda row: row.case):
        found = [*rows]
        if any(row.verdict == FAILS for row in found):
            continue  # what it would be known to is no comfort, and is not said
        certified = [
            f"{row.check.removeprefix('error of ')} to {row.certified:.0e} {row.unit}"
            for row in found
            if row.certified is not None
        ]
        if certified:
            yield ""
            yield from _wrapped(f"{case}: the reference is certified: {', '.join(certified)}", "")


def _reason(row: Comparison) -> tuple[str, bool, str]:
    """Returns the key of neighbouring rows that share one reason; a row that agrees has none."""
    because = "" if row.verdict == AGREES else row.because
    return (row.verdict if because or row.error is None else ""), row.error is None, because


def _wrapped(text: str, indent: str) -> list[str]:
    return wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent or "  ")
