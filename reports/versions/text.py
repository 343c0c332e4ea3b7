"""Which release moved which number, on a terminal."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from ..diff.change import Change
from ..diff.text import fitted
from ..diff.words import by_place
from .table import Step

MOST = 40  # changes of one release; the CSV has them all


def text(steps: Sequence[Step], width: int) -> str:
    """By engine and release."""
    lines: list[str] = []
    for engine, some in groupby(steps, key=lambda step: step.now.release.engine):
        lines += ["", engine]
        for step in some:
            lines += _told(step)
    return "\n".join(part for line in lines[1:] for part in fitted(line, width))


def _told(step: Step) -> Iterator[str]:
    version, changes = step.now.release.version, step.changes
    if not step.now.folder:
        yield f"  {version}: {step.now.because}"
    elif step.before is None:
        yield f"  {version}: {_counted(step)}"
    elif not changes:
        yield f"  {version}: {_counted(step)}, as in {step.before.version}"
    else:
        yield f"  {version}: {_counted(step)}, {len(changes)} not as in {step.before.version}"
        for case, column, _, told in by_place(sorted(changes[:MOST], key=_place)):
            yield f"    {case} {column}"
            yield from (f"      {names}: {said}" for names, said in told)
        if len(changes) > MOST:
            yield f"    and {len(changes) - MOST} more"


def _counted(step: Step) -> str:
    measured = sum(row["largest"] != "" for row in step.rows)
    without = len(step.rows) - measured
    return f"{measured} numbers" + (f" and {without} rows without one" if without else "")


def _place(change: Change) -> tuple[str, str]:
    return change.place.case, change.place.column
