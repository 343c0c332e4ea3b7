"""Writes the difference between two report folders as text for a terminal.

Regressions come first; within a kind, changes of one case, engine and file stand together.
"""

from collections.abc import Iterator, Sequence
from textwrap import wrap

from .change import KINDS, Change
from .compare import Difference
from .words import TITLES, by_place, head, looked_at, summary

WIDTH = 80
MOST = 30  # changes shown of a kind: more have one cause as a rule, and are not read one by one


def text(found: Difference, *, width: int = WIDTH, most: int | None = MOST) -> str:
    """Returns the difference in lines of at most `width` columns, or of 40 if that is less.

    most: how many changes of a kind are shown; None: all.
    """
    lines = [head("OLD", found.old), head("NEW", found.new), *looked_at(found)]
    for kind in KINDS:
        changes = found.of(kind)
        if changes:
            lines += ["", f"{TITLES[kind]} ({len(changes)})"]
            lines += _listed(changes[:most])
            if len(changes[:most]) < len(changes):
                lines.append(f"  and {len(changes) - len(changes[:most])} more: --all shows them")
    lines += ["", summary(found)]
    return "\n".join(part for line in lines for part in fitted(line, width))


def _listed(changes: Sequence[Change]) -> Iterator[str]:
    """Yields a line for neighbours of one case, column and file, and below it what has changed."""
    for case, column, file, told in by_place(changes):
        yield f"  {' '.join(filter(None, (case, column)))}  [{file}]"
        yield from (f"    {names}: {said}" for names, said in told)


def fitted(line: str, width: int) -> list[str]:
    """Returns the lines of a line broken to this width; those after the first are indented more."""
    indent = len(line) - len(line.lstrip())
    further = " " * (indent + 4)
    return wrap(line, max(width, 40), subsequent_indent=further, break_on_hyphens=False) or [""]
