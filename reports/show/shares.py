"""The first table of the README: how many cases each engine gets right, and how far off it is."""

from collections.abc import Iterable, Sequence
from statistics import mean, median

from ...engines import place
from ..data.row import Comparison
from ..data.short_numbers import factor
from .picture import worst

FAR = 100.0


def shares(rows: Sequence[Comparison]) -> list[list[str]]:
    """Lines of cells, the head first: a line for each engine's setting."""
    lines = [["setting", "every quantity within", "one off ×100 or more", "the worst, in median"]]
    for (engine, setting), ratios in sorted(worst(rows).items(), key=_place):
        within = f"{_share(ratio <= 1 for ratio in ratios)} of {len(ratios)} cases"
        far = _share(ratio >= FAR for ratio in ratios)
        lines.append([f"{engine} {setting}", within, far, _times(median(ratios))])
    return lines


def _share(those: Iterable[bool]) -> str:
    return f"{mean(those):.0%}".replace("%", " %")


def _place(found: tuple[tuple[str, str], list[float]]) -> tuple[str, float]:
    (engine, setting), _ = found
    return engine, place(setting)


def _times(ratio: float) -> str:
    """Below 1 only its size matters."""
    return f"{factor(ratio) if ratio > 1 else f'×{ratio:.1g}'} its tolerance"
