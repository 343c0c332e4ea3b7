"""Edges in every engine: moved and held as the reference has it, or refused with the reason."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.adapters.engine_scenes import ROLLS, WHEEL, machine
from given.adapters.planning import SHIPPED, TUNED, moved, refused, ways
from given.scenes import edges

from textmech.cases.scene import Anchor, Edge
from textmech.engines.engine import Start
from textmech.engines.signal import rate, value
from textmech.reference.solve import solve

# By the tuned settings at these steps over 0.4 s: MuJoCo by RK4, pymunk of second order.
STEP = {"mujoco": 2e-3, "pymunk": 2e-4}
PLACES, FORCES = {"mujoco": 1e-9, "pymunk": 3e-7}, {"mujoco": 1e-8, "pymunk": 1e-4}
END = scenes.tail(0.4, 6)


@pytest.mark.slow
@pytest.mark.parametrize("engine", TUNED)
@pytest.mark.parametrize("name", ["free", "constant", "ramp", "sine", "train"])
def test_edges_move_and_hold_as_the_reference(engine: str, name: str, tmp_path: Path) -> None:
    text = {"free": edges.FREE, "train": edges.TRAIN, **edges.DRIVEN}[name]
    case = scenes.typed(tmp_path, text, tail=END)
    known = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in known.states.items()}  # type: ignore[misc]
    wanted = tuple(name for name in known.reactions if name.split(".")[0] in case.scene.constraints)
    if engine == "mujoco" and name == "train":
        wanted += ("hitch.fx", "hitch.fy")
    found = moved(
        TUNED[engine], case.scene, start, case.times, STEP[engine],
        realised="law", reactions=wanted,
    )  # fmt: skip
    for body, rows in known.states.items():
        assert np.max(np.abs(found.states[body] - rows)) < PLACES[engine]
    assert set(found.reactions) == (set() if (engine, name) == ("pymunk", "train") else set(wanted))
    for quantity, forces in found.reactions.items():
        assert np.max(np.abs(forces - known.reactions[quantity])) < FORCES[engine], quantity


@pytest.mark.parametrize("engine", TUNED)
def test_natively_there_is_no_edge(engine: str, tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, edges.FREE)
    start: Start = dict.fromkeys(case.scene.bodies, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert ways(TUNED[engine], case.scene, start) == ("native", "law")
    for setting in (TUNED, SHIPPED):
        said = refused(setting[engine], case.scene)
        assert said is not None
        assert said.startswith("engine: ")
    assert ways(SHIPPED[engine], case.scene, start) == ("native",)


@pytest.mark.parametrize("engine", TUNED)
def test_an_edge_beside_what_gives_way_is_refused(engine: str) -> None:
    scene = machine([WHEEL], contacts=[ROLLS])
    edge = Edge("blade", Anchor("wheel", "center"), (1.0, 0.0))
    object.__setattr__(scene, "constraints", {"blade": edge})
    said = refused(TUNED[engine], scene)
    assert said is not None
    assert said.startswith("adapter: blade beside")


@pytest.mark.parametrize("name", edges.LAWS)
def test_the_rate_of_a_law_is_its_derivative(name: str, tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, edges.DRIVEN[name])
    law = case.scene.constraints["blade"].speed
    assert law is not None
    slope = (value(law, 0.7 + 1e-5)[0] - value(law, 0.7 - 1e-5)[0]) / 2e-5
    assert rate(law, 0.7)[0] == pytest.approx(slope, abs=1e-9)
