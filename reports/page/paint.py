"""Colours that colour-blind people tell apart (Okabe and Ito), each with a shape and a dash."""

from io import StringIO
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from ..ours import OURS
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
WAYS = {"law": (0, (1, 1.5)), "driver": (0, (5, 1.5, 1, 1.5)), "any way": (0, (1, 1.5))}


def colour(engine: str) -> str:
    """Of an engine; of one that nobody knew, one of the rest by its name."""
    return ENGINES.get(engine) or OTHERS[sum(map(ord, engine)) % len(OTHERS)]


def style(column: Column) -> dict[str, Any]:
    """How its line is drawn: colour and marker by engine, hollow as shipped, dashed by its way."""
    shipped = column.setting == "shipped"
    return {
        "color": colour(column.engine),
        "marker": MARKERS.get(column.engine, "s"),
        "linestyle": WAYS.get(column.realised) or DASHES.get(column.setting, (0, (2, 1))),
        "markerfacecolor": "none" if shipped else colour(column.engine),
    }


def svg(figure: Figure, salt: str) -> str:
    """To stand in a page: in the ink of its text, and with the same bytes every time."""
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": salt}):
        out = StringIO()
        figure.savefig(out, format="svg", transparent=True, metadata=UNDATED)
    drawing = out.getvalue()
    drawing = drawing[drawing.index("<svg") :]
    for code, name in ((INK, "currentColor"), ("#000000", "currentColor"), *THEIRS):
        drawing = drawing.replace(code, name)
    return drawing


def save(figure: Figure, file: Path) -> None:
    """As a file of its own, on white, that says whose it is (`ours` reads it). Raises OSError."""
    vector = file.suffix.lower() == ".svg"
    dated = UNDATED | {"Creator": OURS} if vector else {"Software": OURS}
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": file.stem}):
        figure.savefig(file, dpi=DPI, metadata=dated)
