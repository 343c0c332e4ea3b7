"""Colours that colour-blind people tell apart (Okabe and Ito), each with a shape and a dash.

The page's style and script have the same: `heat.css`, `plot.js`.
"""

from collections.abc import Iterable
from html import escape
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from ...tables.ownership import OURS
from ...tables.replace import replace
from .column import Column

INK = "#010203"  # replaced by the colour of the page's text
DPI = 130  # of a picture in dots: a quarter more than a screen's
UNDATED = {"Date": None, "Creator": None}
ENGINES = {"mujoco": "#0072B2", "pymunk": "#D55E00", "book": "#009E73"}
THEIRS = [(code.lower(), f"var(--{name})") for name, code in ENGINES.items()]
"""As the page's style has them, lighter in the dark."""
OTHERS = ("#CC79A7", "#E69F00", "#56B4E9")
MARKERS = {"mujoco": "o", "pymunk": "^", "book": "D"}
DASHES = {"shipped": (0, (4, 2)), "recommended": (0, (7, 2, 1, 2)), "tuned": "-"}
OWN = tuple(zip(OTHERS, ("P", "X", "*"), ((0, (2, 1)), (0, (1, 2)), (0, (8, 2))), strict=True))
"""Of a person's own settings, in their order: colour, marker, dash."""
WAYS = {"law": (0, (1, 1.5)), "driver": (0, (5, 1.5, 1, 1.5))}


def colour(engine: str) -> str:
    """Returns the colour of an engine; of an unknown one, one of the rest by its name."""
    return ENGINES.get(engine) or OTHERS[sum(map(ord, engine)) % len(OTHERS)]


def style(column: Column, among: Iterable[Column]) -> dict[str, Any]:
    """Returns how a column's line is drawn beside all others: by engine, setting and way.

    As shipped its markers are hollow, as recommended half filled, tuned they are full.
    """
    own = sorted({(other.engine, other.setting) for other in among if other.own})
    way = WAYS.get(column.realised)
    if column.own:
        code, marker, dash = OWN[own.index((column.engine, column.setting)) % len(OWN)]
        return {"color": code, "marker": marker, "linestyle": way or dash, "markerfacecolor": code}
    code = colour(column.engine)
    return {
        "color": code,
        "marker": MARKERS.get(column.engine, "s"),
        "linestyle": way or DASHES.get(column.setting, "-"),
        "fillstyle": {"shipped": "none", "recommended": "left"}.get(column.setting, "full"),
    }


def svg(figure: Figure, name: str) -> str:
    """Returns a figure as SVG for a page: in its text's ink, named, the same bytes every time."""
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": name}):
        out = StringIO()
        figure.savefig(out, format="svg", transparent=True, metadata=UNDATED)
    drawing = out.getvalue()
    drawing = drawing[drawing.index("<svg") :].replace(
        "<svg", f'<svg role="img" aria-label="{escape(name)}"', 1
    )
    for code, name in ((INK, "currentColor"), ("#000000", "currentColor"), *THEIRS):
        drawing = drawing.replace(code, name)
    return drawing


def save(figure: Figure, file: Path) -> None:
    """Saves a figure as a file, on white, that says whose it is (`ours` reads it).

    Raises OSError: then what stood there stands there.
    """
    vector = file.suffix.lower() == ".svg"
    dated = UNDATED | {"Creator": OURS} if vector else {"Software": OURS}
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": file.stem}):
        drawn = BytesIO()
        figure.savefig(drawn, format=file.suffix[1:].lower(), dpi=DPI, metadata=dated)
    replace(file.parent, {file.name: drawn.getvalue()})
