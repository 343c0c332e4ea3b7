"""The heat map: for every case and column the worst of its errors, in parts of what is allowed."""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass

from ...tables.row import (
    AGREES,
    BEYOND,
    CHANGED,
    CRASHED,
    DEVIATES,
    DIVERGED,
    FAILS,
    REFUSED,
    Comparison,
    Rungs,
)
from ...tables.short_numbers import milliseconds
from ...tables.spoken import spoken
from .column import Column, column

SHADES = (1e-3, 1e-2, 1e-1, 1.0, 10.0, 100.0, 1000.0)
"""Up to where each shade goes, of error over allowed: the fourth is the last within."""
ABSENT = "absent"
WORD = {DEVIATES: "declared"}


@dataclass(frozen=True)
class Cell:
    """The result of a case in a column. kind: a word that colours and filters it."""

    kind: str
    text: str
    worst: str = ""  # the quantity
    ratio: float | None = None
    beyond: int = 0
    judged: int = 0
    step: float | None = None  # s: the largest from which on all quantities agree
    why: str = ""

    @property
    def within(self) -> int:
        """How many of the judged rows are; where the run was lost, none."""
        return 0 if self.kind in (DIVERGED, CRASHED) else self.judged - self.beyond

    @property
    def shade(self) -> int:
        """The cell's shade: 0 for no visible error, 3 just within, 4 just beyond, 7 far off."""
        if self.ratio is None:
            return len(SHADES) if self.kind in (DIVERGED, CRASHED) else 0
        return bisect_left(SHADES, self.ratio)

    @property
    def words(self) -> str:
        """The cell in words, for people who cannot see colours."""
        if self.why:
            return self.why
        most = f"{self.beyond} of {self.judged} too far off" if self.beyond else "all within"
        parts = [most]
        if self.worst and self.ratio is not None:
            parts.append(f"worst {self.worst} at {short(self.ratio)} of what is allowed")
        if self.kind == "declared":
            parts.append("as declared in the case")
        if self.step is not None:
            parts.append(f"all within from h = {milliseconds(self.step)} on")
        return "; ".join(parts)


def cells(rows: Sequence[Comparison], rungs: Sequence[Rungs]) -> dict[tuple[str, Column], Cell]:
    """Returns the cells by case and column."""
    compared: dict[tuple[str, Column], list[Comparison]] = {}
    climbed: dict[tuple[str, Column], list[Rungs]] = {}
    for row in rows:
        if row.quantity != "audit":
            compared.setdefault((row.case, column(row)), []).append(row)
    for rung in rungs:
        climbed.setdefault((rung.case, column(rung)), []).append(rung)
    return {at: _cell(group, climbed.get(at, [])) for at, group in compared.items()}


def _cell(rows: Sequence[Comparison], ladders: Sequence[Rungs]) -> Cell:
    judged = [row for row in rows if row.verdict != REFUSED]
    if not judged:
        return Cell(REFUSED, "–", why=f"{spoken(REFUSED)}: {rows[0].because}")
    sizes = [(row.ratio, row) for row in judged if row.ratio is not None]
    beyond = sum(not ratio <= 1.0 for ratio, _ in sizes)
    kind = _kind(judged, beyond)
    if not sizes:
        return Cell(kind, kind, judged=len(judged), why=judged[0].because)
    ratio, worst = max(sizes, key=lambda pair: pair[0])
    steps = [ladder.usable_step for ladder in ladders]
    known = [step for step in steps if step is not None]
    return Cell(
        kind,
        short(ratio),
        worst.quantity,
        ratio,
        beyond,
        len(judged),
        min(known) if known and len(known) == len(steps) else None,
    )


def _kind(rows: Sequence[Comparison], beyond: int) -> str:
    """The gravest of the verdicts; what is declared counts where nothing else is beyond."""
    verdicts = [row.verdict for row in rows]
    for word in (FAILS, CRASHED, DIVERGED, CHANGED, BEYOND, DEVIATES):
        if word in verdicts:
            return WORD.get(word, word.lower())
    return BEYOND if beyond else AGREES


def short(ratio: float) -> str:
    """`470`, `2.3`, `0.02`, `3e5`: a ratio in few letters."""
    if ratio == 0.0:
        return "0"
    if ratio >= 1e4 or ratio < 1e-3:
        return f"{ratio:.0e}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")
    return f"{ratio:.2g}" if ratio < 99.5 else f"{ratio:.0f}"
