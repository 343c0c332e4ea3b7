"""A mechanism on paper: engines where they end, space seen from above, links between places."""

from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise
from matplotlib.figure import Figure

from textmech.cases.trajectory import Array
from textmech.reports.page import picture
from textmech.reports.page.column import Column
from textmech.reports.page.poses import Poses

T = np.linspace(0.0, 1.0, 7)
UP = np.stack([0 * T, 2 * T, 0 * T], axis=1)  # x, y, angle: it rises by 2 m
RIGHT = np.stack([3 * T, 0 * T, 0 * T], axis=1)


TUNED = Column("mujoco", "tuned", "native")


def moved(**parts: Array) -> dict[str, Any]:
    """What is drawn of parts that go evenly from the first of their rows to the last."""
    moves = {name: (rows, np.gradient(rows, T, axis=0)) for name, rows in parts.items()}
    return Poses(T, moves).packed()


MOTION: dict[str, Any] = {
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


def drawn(module: Any = picture) -> list[tuple[str, list[list[float]]]]:
    """Each line by its label, as places."""
    axes = Figure().subplots()
    module.strobe(axes, MOTION, [TUNED])
    return [
        (str(line.get_label()), np.round(np.asarray(line.get_xydata()), 3).tolist())
        for line in axes.get_lines()
    ]


@pytest.mark.mutant("engines are drawn where they begin")
def test_an_engine_is_drawn_where_it_ends() -> None:
    assert ("mujoco tuned", [[3.0, 0.0]]) in drawn()
    began = otherwise(picture, "{part: pose[-1] for part", "{part: pose[0] for part")
    assert ("mujoco tuned", [[0.0, 0.0]]) in drawn(began)


def test_the_reference_is_drawn_at_its_instants_and_its_links_at_the_last() -> None:
    places = [place for label, place in drawn() if label != "mujoco tuned"]
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
