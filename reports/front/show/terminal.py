"""Shows on the terminal, at the end of a run: rows, a table, and what fails."""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path
from textwrap import wrap

from ....engines import SETTINGS as OFFERED
from ...runs.selection import BOOK
from ...runs.suite import Report
from ...tables.promised import unkept
from ...tables.row import AGREES, FAILS, Certificate, Comparison, Rungs
from ...tables.short_numbers import milliseconds
from ...tables.spoken import SETTINGS, spoken
from .console import say
from .model import FEW, model_lines, overview
from .summary import Cures, approximations, summary
from .table import WIDTH, narrow


def show(
    report: Report, *, detailed: bool, written: Path | None, cures: Cures | None = None
) -> None:
    """Prints summary, warnings, what fails, rows of named cases, and where they were written."""
    models = {model.case.name for model in report.models}
    scenes = [row for row in report.comparisons if row.case not in models]
    certified = [row for row in report.certificates if row.case not in models]
    for model in report.models if detailed and len(models) <= FEW else ():
        for text in model_lines(model):
            say(text)
    if len(models) > 1:
        say(f"\n{overview(report.lines)}")
    _summary(scenes, report.rungs, cures or {})
    for case, warning in report.warnings():
        for text in _wrapped(f"{case}: warning: {warning}", ""):
            say(text)
    for check in report.certificates:
        if check.verdict == FAILS:
            numbers = f"{check.difference:.2e} is above {check.bound:.1e}"
            whose = "MuJoCo's" if check.case in models else "the reference's"
            say(f"FAILS: {check.case}: {whose} {check.check}: {numbers}")
    _fails([row for row in report.comparisons if row.verdict == FAILS])
    for case in report.cases:
        for note in unkept(case, report.comparisons):
            say(note)
    for note in without_effect(scenes):
        say(note)
    if detailed:
        for text in (*certificate_lines(certified), *rows(scenes)):
            say(text)
        say()
    counts = Counter(row.verdict for row in report.comparisons)
    say(", ".join(f"{count} {spoken(word)}" for word, count in counts.most_common()))
    if written is not None:
        say(f"written to {written}")


def _summary(comparisons: Sequence[Comparison], rungs: Sequence[Rungs], cures: Cures) -> None:
    for lines in (summary(comparisons, rungs, cures), approximations(comparisons, rungs)):
        if lines:
            say(f"\n{narrow(lines)}")
    say()


def _fails(rows: Sequence[Comparison]) -> None:
    """One line for each reason: a broken reference fails many rows for one."""
    for (case, because), group in groupby(rows, key=lambda row: (row.case, row.because)):
        first, *others = group
        more = f" and {len(others)} more" if others else ""
        what = f"{first.engine}.{first.setting} {first.quantity}"
        say(f"FAILS: {case}: {what}{more}: {because}")


def line(row: Comparison) -> str:
    """A row in one line: how far off, at which step, what is allowed, and the verdict."""
    reason = f" ({row.because})" if row.because and row.verdict != AGREES else ""
    if row.error is None:
        return f"{row.quantity:20} {row.verdict}{reason}"
    step = "" if row.step is None else f"at h = {row.step:g} s"
    allowed = "" if row.allowed is None else f"allowed {row.allowed:.1e}"
    number = f"{row.error:9.2e} {row.unit:6} {step:18}"
    return f"{row.quantity:20} {number} {allowed:16} {row.verdict}{reason}"


# Notes on own settings, which a user should know and sees in no single row.


Numbers = dict[str, tuple[float | None, ...]]


def without_effect(rows: Sequence[Comparison]) -> Iterator[str]:
    """A line for each own setting whose numbers are the shipped ones, all of them, in a case."""
    by_case: defaultdict[tuple[str, str], dict[str, Numbers]] = defaultdict(dict)
    for row in rows:
        if row.engine != BOOK and row.setting != "tuned":
            numbers = by_case[row.case, row.engine].setdefault(row.setting, {})
            numbers[row.quantity] = (row.step, row.error, row.rms, row.final)
    for (case, engine), settings in by_case.items():
        shipped = settings.get("shipped")
        for setting in settings:
            if setting not in OFFERED and settings[setting] == shipped:
                yield f"{case}: {engine}.{setting} changes nothing: every number is shipped's"


# The rows of a run for the terminal: below each engine's setting its quantities and reasons.


REASON = " " * 6


def rows(comparisons: Sequence[Comparison]) -> Iterator[str]:
    """Lines: of each quantity how far off it is, of what is allowed, the verdict, and why."""
    for _, of_way in groupby(comparisons, key=lambda r: (r.case, r.engine, r.setting, r.realised)):
        group = [*of_way]
        yield ""
        yield head(group)
        protocols = (row.protocol for row in reversed(group) if row.protocol)  # the audit's is less
        yield from _wrapped(next(protocols, ""), "  ")
        names = max(len(spoken(row.quantity)) for row in group)
        units = max(len(row.unit) for row in group)
        for (_, silent, because), same in groupby(group, key=_reason):
            alike = [*same]
            if silent:
                yield from _wrapped(", ".join(spoken(row.quantity) for row in alike), "  ")
                yield from _wrapped(f"{spoken(alike[0].verdict)}: {because}".strip(": "), REASON)
                continue
            for row in alike:
                allowed = "" if row.allowed is None else f"of {row.allowed:.1e}"
                number = f"{row.error:8.2e} {row.unit:{units}}"
                quantity = f"{spoken(row.quantity):{names}}"
                yield f"  {quantity}  {number}  {allowed:11}  {spoken(row.verdict)}"
            yield from _wrapped(because, REASON)


def head(group: Sequence[Comparison]) -> str:
    """Which engine it is in which setting, and the step of all of its rows."""
    first = group[0]
    meaning = SETTINGS.get(first.setting)
    said = [*([meaning] if meaning else []), *filter(None, [spoken(first.realised)])]
    how = f" ({', '.join(said)})" if said else ""
    steps = {row.step for row in group if row.step is not None}
    step = f", h = {milliseconds(steps.pop())}" if len(steps) == 1 else ""
    return f"{first.case} in {first.engine} {first.version} {first.setting}{how}{step}"


def certificate_lines(certificates: Sequence[Certificate]) -> Iterator[str]:
    """Lines: what each reference is known to, of all that its case bounds; of one that holds."""
    for case, rows in groupby(certificates, key=lambda row: row.case):
        checks = [*rows]
        if any(row.verdict == FAILS for row in checks):
            continue  # what it would be known to is no comfort, and is not said
        certified = [
            f"{row.check.removeprefix('error of ')} to {row.certified:.0e} {row.unit}"
            for row in checks
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
