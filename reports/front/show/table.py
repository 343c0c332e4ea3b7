"""Tables of cells: for a page, and for a terminal of 80 columns."""

from collections.abc import Iterator, Sequence
from itertools import groupby, zip_longest
from textwrap import wrap

from .summary import Line

WIDTH = 80  # columns, of a terminal or of a file that its output goes to
GAP = 2
HEAD = ("", "worst, × allowed", "agrees with", "cured by")
PAGE = ("case", "setting", "worst, × allowed", "agrees with", "cured by")
LEAST = 12  # columns for words that are broken into lines


def markdown(lines: Sequence[Sequence[str]]) -> str:
    """A table as a page shows it, its head first."""
    head, *body = lines
    rule = ["---"] * len(head)
    return "".join(f"| {' | '.join(line)} |\n" for line in (head, rule, *body))


def page(lines: Sequence[Line]) -> list[list[str]]:
    """The summary's lines as cells, its head first; a case is named once, no column is empty."""
    rows: list[list[str]] = [list(PAGE)]
    for case, group in groupby(lines, key=lambda line: line.case):
        named = [f"`{case}`"]
        for line in group:
            rows.append([*named, line.setting, line.worst, line.agrees, line.cured])
            named = [""]
    used = [i for i in range(len(PAGE)) if any(row[i] for row in rows[1:])]
    return [[row[i] for i in used] for row in rows]


def narrow(lines: Sequence[Line]) -> str:
    """The summary for the terminal: below each case its settings, what is too long in lines."""
    cells = [(f"  {line.setting}", line.worst, line.agrees, line.cured) for line in lines]
    used = [i for i in range(len(HEAD)) if any(row[i] for row in cells)]
    rows = [[row[i] for i in used] for row in cells]
    head = [HEAD[i] for i in used]
    widths = _widths([head, *rows])
    out = list(_broken(head, widths))
    cases = iter(rows)
    for case, group in groupby(lines, key=lambda line: line.case):
        out.append(case)
        for _ in group:
            out += _broken(next(cases), widths)
    return "\n".join(out)


def _widths(rows: Sequence[Sequence[str]]) -> list[int]:
    """Returns the width of each column: what its cells need, as far as there is room.

    Where there is not, the widest columns are broken, but for the first: a name is not.
    """
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    room = WIDTH - GAP * (len(widths) - 1)
    while sum(widths) > room and max(widths[1:]) > LEAST:
        widest = max(range(1, len(widths)), key=lambda i: widths[i])
        widths[widest] -= 1
    return widths


def _broken(row: Sequence[str], widths: Sequence[int]) -> Iterator[str]:
    """A row in as many lines as its longest cell needs."""
    first, *cells = row
    parts = [wrap(cell, width) for cell, width in zip(cells, widths[1:], strict=True)]
    for line in zip_longest([first], *parts, fillvalue=""):
        pairs = zip(line, widths, strict=True)
        yield (" " * GAP).join(f"{cell:{width}}" for cell, width in pairs).rstrip()
