"""Pictures on paper: curves, tube and ladder of one quantity, and a mechanism at its instants."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given.command.report_folders import RUNGS, STEPS
from given.otherwise import otherwise
from matplotlib.figure import Figure

from textmech.cases.trajectory import Array
from textmech.reports.front.page import paint, picture
from textmech.reports.front.page.column import Column
from textmech.reports.front.page.poses import Poses

# The picture of one quantity on paper: its curves, its tube, and its ladder.

ALLOWED = 1e-2


KINDS = [Column("mujoco", name, "native") for name in ("shipped", "recommended", "tuned", "a", "b")]


def looks(module: Any = paint) -> set[tuple[Any, ...]]:
    """Colour, dash, marker and how full it is, of an engine's settings and of two own ones."""
    found = [module.style(one, KINDS) for one in KINDS]
    names = ("color", "linestyle", "marker", "fillstyle")
    return {tuple(str(one.get(name)) for name in names) for one in found}


@pytest.mark.mutant("own settings look as tuned")
def test_no_setting_looks_as_another() -> None:
    assert len(looks()) == len(KINDS)
    mine = [paint.style(one, KINDS) for one in KINDS[2:]]
    for name in ("color", "linestyle", "marker"):
        assert len({str(one[name]) for one in mine}) == 3, name
    assert len(looks(otherwise(paint, "if column.own:", "if False:"))) == 3


@pytest.mark.mutant("a curve that leaves the tube's picture is not told")
def test_what_leaves_the_tube_is_told_with_its_size() -> None:
    def told(module: Any = picture) -> str:
        axes, times = Figure().subplots(), np.array([0.0, 1.0])
        curves = {
            "reference": [1.0, 2.0],
            "off": {KINDS[0].key: {"curve": [0.0, 50.0]}},
        }
        module._tube(axes, times, curves, KINDS[:1], 0.25, "x [m]")
        assert axes.get_ylim()[1] < 5.0
        return axes.texts[0].get_text()

    assert told() == "mujoco shipped leaves the picture: off by up to 50"
    assert told(otherwise(picture, "or np.max(y) > top", "")) == ""


def drawn(module: Any = picture) -> tuple[list[float], list[float]]:
    """The first line of the ladder: steps, and what is drawn over them."""
    axes = Figure().subplots()
    steps = [STEPS[0], replace(STEPS[1], error=5e-2)]
    others = [replace(one, engine="pymunk", error=7.0) for one in steps]
    module._ladder(axes, [RUNGS], others + steps, ALLOWED)
    line = axes.get_lines()[0]
    return np.asarray(line.get_xdata()).tolist(), np.asarray(line.get_ydata()).tolist()


@pytest.mark.mutant("a ladder of errors that are not over what is allowed")
def test_a_ladder_is_of_errors_over_what_is_allowed() -> None:
    steps, errors = drawn()
    assert steps == [1.0, 2.0]  # ms
    assert errors == pytest.approx([0.1, 5.0])  # beyond from 1 on, as the line says
    bare = otherwise(picture, "step.error / allowed", "step.error")
    assert drawn(bare)[1] == pytest.approx([1e-3, 5e-2])


def tube(module: Any = picture) -> tuple[list[float], list[float]]:
    """The engine's curve, and the lowest and the highest of what is allowed."""
    axes, times = Figure().subplots(), np.array([0.0, 1.0])
    curves = {
        "reference": [1.0, 2.0],
        "off": {"mujoco.tuned.native": {"curve": [0.0, 0.5]}},
    }
    module._tube(axes, times, curves, [Column("mujoco", "tuned", "native")], 0.25, "x [m]")
    (area,) = axes.collections
    heights = np.asarray(area.get_paths()[0].vertices)[:, 1]
    curve = np.asarray(axes.get_lines()[1].get_ydata()).tolist()
    return curve, [float(np.min(heights)), float(np.max(heights))]


@pytest.mark.mutant("the picture's {named}")
@pytest.mark.parametrize(
    ("named", "was", "now"),
    [
        (
            "engines off the other way",
            "reference + off",
            "reference - off",
        ),
        ("tube twice as wide", "reference + allowed, color", "reference + 2 * allowed, color"),
    ],
)
def test_a_curve_is_as_far_off_as_the_engine_is(named: str, was: str, now: str) -> None:
    curve, allowed = tube()
    assert curve == pytest.approx([1.0, 2.5], rel=0.005)
    assert allowed == pytest.approx([0.75, 2.25], rel=1e-3)
    assert tube(otherwise(picture, was, now)) != (curve, allowed)


# A mechanism on paper: engines where they end, space seen from above, links between places.

T = np.linspace(0.0, 1.0, 7)
UP = np.stack([0 * T, 2 * T, 0 * T], axis=1)  # x, y, angle: it rises by 2 m
RIGHT = np.stack([3 * T, 0 * T, 0 * T], axis=1)


TUNED = Column("mujoco", "tuned", "native")


def moved(**parts: Array) -> dict[str, Any]:
    """What is drawn of parts that go evenly from the first of their rows to the last."""
    moves = {name: (rows, np.gradient(rows, T, axis=0)) for name, rows in parts.items()}
    return Poses(T, moves).rounded()


MOTION: dict[str, Any] = {
    "against": "reference",
    "axes": 2,
    "trail": None,
    **moved(**{"dot": UP, "ground.hook": RIGHT[:, :2]}),
    "ghosts": {"mujoco.tuned.native": moved(dot=RIGHT)},
    "sketch": {
        "bodies": {"dot": {"lines": [], "dot": True}},
        "links": [{"kind": "spring", "ends": [["dot", [0.5, 0.0]], ["ground.hook", [0.0, 0.0]]]}],
        "ground": [],
    },
}


def strobed(module: Any = picture) -> list[tuple[str, list[list[float]]]]:
    """Each line by its label, as places."""
    axes = Figure().subplots()
    module.strobe(axes, MOTION, [TUNED])
    return [
        (str(line.get_label()), np.round(np.asarray(line.get_xydata()), 3).tolist())
        for line in axes.get_lines()
    ]


@pytest.mark.mutant("engines are drawn where they begin")
def test_an_engine_is_drawn_where_it_ends() -> None:
    assert ("mujoco tuned", [[3.0, 0.0]]) in strobed()
    began = otherwise(picture, "{part: pose[-1] for part", "{part: pose[0] for part")
    assert ("mujoco tuned", [[0.0, 0.0]]) in strobed(began)


def test_the_reference_is_drawn_at_its_instants_and_its_links_at_the_last() -> None:
    places = [place for label, place in strobed() if label != "mujoco tuned"]
    dots = np.array([place[0] for place in places if len(place) == 1])
    assert dots == pytest.approx(UP[:, :2], abs=1e-3)
    assert [place for place in places if len(place) == 2] == [[[0.5, 2.0], [3.0, 0.0]]]


@pytest.mark.mutant("the scale is that of an engine that fell away")
def test_the_scale_is_the_mechanisms() -> None:
    fell = {"mujoco.tuned.native": moved(dot=-50 * UP)}

    def lowest(module: Any = picture) -> float:
        axes = Figure().subplots()
        module.strobe(axes, {**MOTION, "ghosts": fell}, [TUNED])
        axes.apply_aspect()
        return axes.get_ylim()[0]

    assert -3.0 < lowest() < 0.0
    assert lowest(otherwise(picture, "axes.dataLim.set(limits)", "pass")) < -90.0


def test_the_last_instant_is_in_full_ink() -> None:
    axes = Figure().subplots()
    still = {**MOTION["sketch"], "links": []}
    picture.strobe(axes, {**MOTION, "ghosts": {}, "sketch": still}, [])
    assert [line.get_alpha() for line in axes.get_lines()][-1] == 1.0


@pytest.mark.mutant("space seen from below")
def test_space_is_seen_from_the_side_and_above() -> None:
    """What is higher is drawn higher, and so is what is further away."""
    near = np.array([[np.cos(picture.AZIMUTH), np.sin(picture.AZIMUTH), 0.0]])
    up, right = np.array([[0.0, 0.0, 1.0]]), np.array([[-near[0, 1], near[0, 0], 0.0]])
    assert picture._seen(up)[0] == pytest.approx([0.0, np.cos(picture.ELEVATION)])
    assert picture._seen(right)[0] == pytest.approx([1.0, 0.0])
    assert picture._seen(near)[0] == pytest.approx([0.0, -np.sin(picture.ELEVATION)])
    was = "z * np.cos(ELEVATION) - towards"
    below = otherwise(picture, was, was.replace("-", "+"))
    assert below._seen(near)[0, 1] > 0.0
