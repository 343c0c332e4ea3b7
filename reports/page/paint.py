"""Colours that colour-blind people tell apart (Okabe and Ito), with a shape and a dash beside each."""

from typing import Any

from .column import Column

INK = "#010203"  # replaced by the colour of the page's text
ENGINES = {"mujoco": "#0072B2", "pymunk": "#D55E00", "book": "#009E73"}
OTHERS = ("#CC79A7", "#E69F00", "#56B4E9")
MARKERS = {"mujoco": "o", "pymunk": "^", "book": "D"}
DASHES = {"shipped": (0, (4, 2)), "tuned": "-"}
WAYS = {"law": (0, (1, 1.5)), "driver": (0, (5, 1.5, 1, 1.5)), "any way": (0, (1, 1.5))}


def colour(engine: str) -> str:
    """Of an engine; of one that nobody knew, one of the rest by its name."""
    return ENGINES.get(engine) or OTHERS[sum(map(ord, engine)) % len(OTHERS)]


def style(column: Column) -> dict[str, Any]:
    """How its line is drawn: the engine's colour and marker; hollow as shipped, dashed by its way."""
    shipped = column.setting == "shipped"
    return {
        "color": colour(column.engine),
        "marker": MARKERS.get(column.engine, "s"),
        "linestyle": WAYS.get(column.realised) or DASHES.get(column.setting, (0, (2, 1))),
        "markerfacecolor": "none" if shipped else colour(column.engine),
    }


def ink(svg: str) -> str:
    """The drawing in the ink of the page, so that it is read in the dark too."""
    drawing = svg[svg.index("<svg") :]
    return drawing.replace(INK, "currentColor").replace("#000000", "currentColor")
