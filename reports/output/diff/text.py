"""The difference on a terminal: regressions first, by case and engine."""

from collections.abc import Iterator, Sequence
from textwrap import wrap

from .change import KINDS, Change
from .compare import Difference
from .words import TITLES, by_place, head, looked_at, summary

WIDTH = 80
MOST = 30  # of a kind; who has more has one cause, and reads no further


def text(found: Difference, *, width: int = WIDTH, most: int | None = MOST) -> str:
    """most: how many changes of a kind are shown; None: all."""
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
    for case, column, file, told in by_place(changes):
        yield f"  {' '.join(filter(None, (case, column)))}  [{file}]"
        yield from (f"    {names}: {said}" for names, said in told)


def fitted(line: str, width: int) -> list[str]:
    """The line in as many lines as it needs, further ones indented."""
    indent = len(line) - len(line.lstrip())
    further = " " * (indent + 4)
    return wrap(line, max(width, 40), subsequent_indent=further, break_on_hyphens=False) or [""]
