"""An answer in Python as a notebook shows it: frames as HTML, motions as a figure."""

from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from io import BytesIO

import pandas as pd
from matplotlib.figure import Figure

from .column import Column, ordered
from .motion_frames import RIGHT
from .paint import style

WIDTH, HEIGHT = 8.0, 2.2  # inches: of a plot, one below the other
TABLE = {"index": False, "border": 0, "na_rep": "", "justify": "left"}


class Drawing(Figure):
    """A figure that a notebook shows by itself, whatever backend is chosen."""

    def _repr_png_(self) -> bytes:
        out = BytesIO()
        self.savefig(out, format="png", dpi=100)
        return out.getvalue()

    @property
    def html(self) -> str:
        """The picture as an element that needs no file."""
        return f'<img alt="" src="data:image/png;base64,{b64encode(self._repr_png_()).decode()}">'


def drawn(
    title: str,
    motions: Mapping[tuple[str, str, str], pd.DataFrame],
    units: Mapping[str, str],
    quantities: Sequence[str],
    allowed: Mapping[str, float],
) -> Drawing:
    """Draws each quantity over time: the reference with its tolerance, and the engines over it.

    motions: by engine, setting and way a frame by time; of a model its limit in the reference's
    place.
    """
    way = next(way for way in RIGHT if way in motions)
    reference, (against, *_) = motions[way], way
    figure = Drawing(figsize=(WIDTH, HEIGHT * len(quantities) + 0.6), layout="constrained")
    every = figure.subplots(len(quantities), squeeze=False, sharex=True)[:, 0]
    shown = ordered(Column(*way) for way in motions if way not in RIGHT)
    for axes, quantity in zip(every, quantities, strict=True):
        right = reference[quantity]
        axes.plot(right.index, right, color="black", lw=2, label=against)
        if quantity in allowed:
            band = right - allowed[quantity], right + allowed[quantity]
            axes.fill_between(right.index, *band, color="black", alpha=0.12, lw=0)
        low, high = axes.get_ylim()
        for column in shown:
            series = motions[column.engine, column.setting, column.realised][quantity]
            every_fifth = max(1, len(series) // 5)
            look = {"ms": 4, "markevery": every_fifth, **style(column, shown)}
            axes.plot(series.index, series, lw=1.3, label=column.title, **look)
        room = high - low  # an engine that is lost leaves the picture
        bottom, top = axes.get_ylim()
        axes.set_ylim(max(bottom, low - room), min(top, high + room))
        axes.set_ylabel(f"{quantity} [{units[quantity]}]")
        if until := reference.attrs.get("until"):
            axes.axvspan(until, right.index[-1], hatch="//", fc="none", ec="black", alpha=0.25)
            axes.set_title(f"later than {until:.3g} s nothing is judged", loc="right", fontsize=9)
    every[-1].set_xlabel("state" if reference.index.name == "state" else "t [s]")
    every[0].set_title(title, loc="left")
    if shown:
        figure.legend(*every[0].get_legend_handles_labels(), loc="outside lower left", ncols=3)
    return figure


def table(frame: pd.DataFrame) -> str:
    """A frame as HTML, with no cell cut short."""
    with pd.option_context("display.max_colwidth", None, "display.precision", 3):
        return frame.to_html(**TABLE)  # type: ignore[arg-type]


def paragraphs(parts: Iterable[str]) -> str:
    """Sentences as HTML; all that was markup in them is escaped."""
    return "".join(f"<p>{escape(part)}</p>" for part in parts)
