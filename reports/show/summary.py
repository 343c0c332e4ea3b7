"""The short table: one row a case, one column an engine's setting."""

from collections.abc import Iterator, Sequence
from typing import TypeVar

from ..row import CHANGED, FAILS, Comparison, Rungs

Row = TypeVar("Row", Comparison, Rungs)


def summary(comparisons: Sequence[Comparison], rungs: Sequence[Rungs]) -> list[list[str]]:
    """Lines of cells, the head first: does it agree, how far off at worst, the usable step.

    The usable step is the largest from which on *all* quantities stay within their tolerance.
    """
    columns = sorted({_column(row) for row in comparisons}, key=_by_engine)
    lines = [["case", *columns]]
    rows = _by_cell([row for row in comparisons if row.quantity != "audit"])
    ladders = _by_cell(rungs)
    for case in sorted({row.case for row in comparisons}):
        cells = [(case, column) for column in columns]
        told = ("; ".join(_cell(rows.get(c, []), ladders.get(c, []))) for c in cells)
        lines.append([case, *told])
    return lines


def _by_cell(rows: Sequence[Row]) -> dict[tuple[str, str], list[Row]]:
    """By case and column."""
    found: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        found.setdefault((row.case, _column(row)), []).append(row)
    return found


def _column(row: Comparison | Rungs) -> str:
    return f"{row.engine}.{row.setting}" + (
        "" if row.realised == "native" else f" ({row.realised})"
    )


def _by_engine(column: str) -> tuple[str, int, str]:
    """Engines by name; of each the shipped setting, the user's own, then the tuned one."""
    engine, _, setting = column.partition(".")
    place = {"shipped": 0, "tuned": 2}.get(setting.partition(" ")[0], 1)
    return engine, place, setting


def _cell(rows: Sequence[Comparison], ladder: Sequence[Rungs]) -> Iterator[str]:
    judged = [row for row in rows if not row.verdict.startswith("refused")]
    if not rows:
        return
    if not judged:
        yield "refused"
        return
    fails = sum(row.verdict == FAILS for row in judged)
    beyond = [row for row in judged if row.ratio is not None and not row.ratio <= 1.0]
    changed = sum(row.verdict.startswith(CHANGED) for row in judged)
    if fails:
        yield f"{fails} of {len(judged)} FAIL"
    if changed:
        yield f"{changed} of {len(judged)} changed"
    if beyond:
        worst = max(beyond, key=lambda row: row.ratio or 0.0)
        yield f"{len(beyond)} of {len(judged)} beyond"
        yield f"{worst.quantity} ×{worst.ratio:.2g}"
    elif all(row.ratio is None for row in judged) and not fails:
        yield judged[0].verdict
    elif not (fails or changed):
        yield "agrees"
    steps = [row.usable_step for row in ladder]
    known = [step for step in steps if step is not None]
    if known and len(known) == len(steps):
        yield f"h ≤ {min(known):.1g}"
    if len(judged) < len(rows):
        yield f"{len(rows) - len(judged)} not read"


def markdown(lines: Sequence[Sequence[str]]) -> str:
    """The table as the README shows it."""
    head, *body = lines
    rule = ["---"] * len(head)
    return "".join(f"| {' | '.join(line)} |\n" for line in (head, rule, *body))


def fitting(lines: Sequence[Sequence[str]], width: int) -> str:
    """The table as the terminal shows it; too wide for that, a case's engines one below another."""
    table = _aligned(lines)
    return table if all(len(line) <= width for line in table.splitlines()) else _stacked(lines)


def _aligned(lines: Sequence[Sequence[str]]) -> str:
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    return "\n".join(
        "  ".join(f"{cell:{width}}" for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )


def _stacked(lines: Sequence[Sequence[str]]) -> str:
    (_, *columns), *body = lines
    width = max(map(len, columns))
    out: list[str] = []
    for case, *cells in body:
        out.append(case)
        told = zip(columns, cells, strict=True)
        out += [f"  {column:{width}}  {cell}" for column, cell in told if cell]
    return "\n".join(out)
