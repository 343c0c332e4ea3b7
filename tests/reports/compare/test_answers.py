"""What an engine is asked for, and its answers: looked at before they are believed."""

import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from given import scenes
from given.adapters.engine_space import LOPSIDED, G, hinge, rigid, simulated, spatial, state
from given.scenes.claims import PLANE as PLANE_CLAIM
from given.scenes.claims import claimed as claim_of

from textmech import engines
from textmech.cases.case import Case, Deviation
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Scene, Signal, shape
from textmech.cases.scene.frame import PLANE
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.scene.states import MASS_MATRIX
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Diverged, Engine, Shape, Start
from textmech.engines.knobs import Knob
from textmech.engines.pymunk import Pymunk
from textmech.reports.compare.trial import run as turns
from textmech.reports.compare.trial import work
from textmech.reports.compare.trial.answers import BadAnswer, claimed, moved, tunable
from textmech.reports.compare.trial.ladder import wanted_reactions
from textmech.reports.compare.trial.states import SILENT, ways_of
from textmech.reports.front.show.script import script
from textmech.reports.runs import motion_files as keep
from textmech.reports.runs import suite
from textmech.reports.runs.request import Request
from textmech.reports.tables.row import AGREES, BEYOND, DEVIATES, FAILS, Comparison

# What an engine answers is looked at before it is believed: words on states, records, tuning.

DISK = shape.disk(name="ball", mass=2.0, radius=0.1, points={})
SCENE = Scene((0.0, 0.0), {}, {"ball": DISK}, {}, {}, {})
N = 5
SOUND = {"ball.alpha": np.ones(N), MASS_MATRIX: np.ones(9 * N)}


@pytest.mark.mutant("a quantity of which an engine says nothing has no row")
@pytest.mark.parametrize(
    ("answer", "what"),
    [
        ({}, "answer tells nothing of ball.alpha, and not why"),
        ({MASS_MATRIX: np.ones(9 * N)}, "answer tells nothing of ball.alpha, and not why"),
        ({**SOUND, "ball.alpha": "engine: no"}, "withholds ball.alpha of all states"),
        ({**SOUND, "ball.alpha": np.ones(1)}, r"should have the shape \(5,\), has \(1,\)"),
        ({**SOUND, MASS_MATRIX: np.ones(N)}, r"should have the shape \(45,\), has \(5,\)"),
        ({**SOUND, "ball.alpha": np.ones(N) > 0}, "an array of numbers, is an array of bool"),
        ({**SOUND, "ball.alpha": 1j * np.ones(N)}, "an array of numbers, is an array of complex"),
        ({**SOUND, "ball.alpha": [1.0] * N}, "should be an array of numbers, is a list"),
        ({**SOUND, "ball.alpha": np.ma.ones(N)}, "an array of numbers, is a MaskedArray"),
        (None, "answer should tell each quantity by its name, tells None"),
    ],
)
def test_an_answer_about_states_is_whole(answer: Any, what: str) -> None:
    with pytest.raises(BadAnswer, match=what):
        claimed(answer, tuple(SOUND), SCENE, N)


def test_nobody_is_judged_by_what_was_not_asked() -> None:
    found = claimed({**SOUND, "ball.ax": None}, tuple(SOUND), SCENE, N)
    assert found.keys() == SOUND.keys()


TIMES = np.linspace(0.0, 1.0, N)
STEPS = np.linspace(0.0, 1.0, 4 * N - 3)


def run(**changes: Any) -> Trajectory:
    record = replace(Trajectory(STEPS, {"ball": np.zeros((len(STEPS), 6))}, {}), **changes)
    return Trajectory(TIMES, {"ball": np.zeros((N, 6))}, {}, record=record)


def cut(rows: slice) -> dict[str, Any]:
    return {"times": STEPS[rows], "states": {"ball": np.zeros((len(STEPS[rows]), 6))}}


def test_a_sound_record_is_believed() -> None:
    assert moved(run(), SCENE, TIMES).record is not None


@pytest.mark.mutant("a record that is another motion's")
@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"times": STEPS + 100.0}, "should last from the first sample to the last"),
        ({"times": STEPS[::-1].copy()}, "should rise from step to step"),
        ({"times": STEPS * np.nan}, "should rise from step to step"),
        ({"times": STEPS.tolist()}, "times of the record should be an array"),
        ({"times": np.ma.array(STEPS)}, "times of the record should be an array"),
        (cut(slice(0, 9)), "should last from the first sample to the last"),
        (cut(slice(0, 1)), "should rise from step to step"),
        ({"states": {"ball": np.ma.zeros((len(STEPS), 6))}}, "is a MaskedArray"),
    ],
)
def test_a_record_is_of_the_whole_run(changes: dict[str, Any], what: str) -> None:
    with pytest.raises(BadAnswer, match=what):
        moved(run(**changes), SCENE, TIMES)


@pytest.mark.mutant("a record that is not finite is one in which nothing happens")
def test_a_record_that_is_not_finite_has_diverged() -> None:
    states = np.zeros((len(STEPS), 6))
    states[7:] = np.nan
    with pytest.raises(Diverged, match=r"not finite in the record from t = 0\.4375 s on"):
        moved(run(states={"ball": states}), SCENE, TIMES)


@dataclass
class Tuned:
    """An engine's words on tuning."""

    recipe_: Any = field(default_factory=dict)
    knobs_: Any = ()
    cost_: Any = 1.0
    snippet_: Any = "x"
    steps: tuple[float, ...] = (1e-2, 1e-3)

    def recipe(self, *_: Any) -> Any:
        return self.recipe_

    def knobs(self, *_: Any) -> Any:
        return self.knobs_

    def cost(self, *_: Any) -> Any:
        return self.cost_ if self.cost_ is None else lambda *_: self.cost_

    def snippet(self, *_: Any) -> Any:
        return self.snippet_


def test_sound_words_on_tuning_are_believed() -> None:
    engine: Any = Tuned({"iterations": 5}, [Knob("sweeps", ())])
    assert tunable(engine, SCENE, {}) == {"iterations": 5}


@pytest.mark.mutant("a recipe that is no options")
@pytest.mark.parametrize(
    ("wrong", "what"),
    [
        ({"recipe_": 5}, "recipe should be options"),
        ({"recipe_": {"a": object()}}, "recipe should be options"),
        ({"knobs_": None}, "knobs should be a list of knobs, is None"),
        ({"knobs_": ["sweeps"]}, "knobs should be a list of knobs"),
        ({"cost_": None}, "cost should be a function of options and a step, is None"),
        ({"cost_": "1"}, "cost should be a number above 0"),
        ({"cost_": float("nan")}, "cost should be a number above 0, is nan"),
        ({"cost_": -1.0}, "cost should be a number above 0"),
        ({"snippet_": None}, "snippet should be text, is None"),
    ],
)
def test_words_on_tuning_are_looked_at(wrong: dict[str, Any], what: str) -> None:
    engine: Any = Tuned(**wrong)
    with pytest.raises(BadAnswer, match=what):
        tunable(engine, SCENE, {})


@dataclass
class Shaped(Tuned):
    """One that tells the shapes of a user's too."""

    shapes_: Any = ()
    words_: Any = ""

    def shapes(self, *_: Any) -> Any:
        return self.shapes_

    def own_contacts(self, *_: Any) -> Any:
        return self.words_


@pytest.mark.mutant("shapes that are none believed")
@pytest.mark.parametrize(
    ("wrong", "what"),
    [
        ({"shapes_": None}, "shapes should be a list of shapes, is None"),
        ({"shapes_": ["box"]}, "shapes should be a list of shapes"),
        ({"shapes_": [Shape("a box", object())]}, "shapes should have options as a file has them"),  # type: ignore[arg-type]
        ({"words_": None}, "own_contacts should be text, is None"),
    ],
)
def test_words_on_shapes_are_looked_at(wrong: dict[str, Any], what: str) -> None:
    sound: Any = Shaped(shapes_=[Shape("a box", {"shapes": "box"})], words_="ours are points")
    assert tunable(sound, SCENE, {}) == {}
    engine: Any = Shaped(**wrong)
    with pytest.raises(BadAnswer, match=what):
        tunable(engine, SCENE, {})


@dataclass
class Paced:
    """A stranger's engine that is asked how fast it is."""

    act: Callable[[], Any]
    name: str = "strange"
    setting: str = "shipped"
    version: str = "1"

    def pace(self, scene: Scene) -> float:
        return self.act()


def leaves() -> float:
    raise SystemExit(0)


@pytest.mark.slow
@pytest.mark.mutant("an engine that is asked for its pace ends the run")
def test_who_is_asked_for_his_pace_costs_nobody_anything(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work, "foreign", lambda name: True)
    monkeypatch.setattr(work, "PATIENCE", 0.5)
    asked: Any = ("strange", "shipped", "1")
    told = [
        work._own_pace(work._Asked((*asked, str(i)), Paced(act), SCENE))
        for i, act in enumerate([lambda: 2e-3, leaves, lambda: os._exit(0), lambda: time.sleep(60)])
    ]
    assert told == [2e-3, None, None, None]


# What an engine is asked for, so that every force of a row can be told.

DRIVEN = spatial(
    [rigid("rod", 1.3, LOPSIDED, {"end": (0.2, 0.1, 0.0)})],
    [hinge("q1", "ground.O", "rod.end", (0.0, 0.0, 1.0))],
    drives={"q1.omega": Signal("constant", (2.0,))},
)


def test_in_the_plane_each_force_is_asked_for_by_itself() -> None:
    for one in (case for case in scenes.SHIPPED.values() if case.scene.frame is PLANE):
        forces = [
            q.name
            for q in table(one.scene).values()
            if q.kind in ("force", "acceleration") and q.part not in one.scene.forces
        ]
        rods = {f"{joint.name}.force" for joint in one.scene.joints.values() if joint.swings}
        told = tuple(name for name in forces if name not in rods)
        inner = one.scene.inner()
        limits = [force for limit in one.scene.limits() for force in limit.reactions()]
        assert wanted_reactions(one.scene, forces) == (*told, *inner)
        assert wanted_reactions(one.scene, table(one.scene)) == (*told, *limits, *inner)


def test_work_is_told_by_what_drives_and_stops_by_both() -> None:
    knee = scenes.SHIPPED["driven_knee.spring"].scene
    assert wanted_reactions(knee, ["knee.work", "coil.work"]) == ("knee.torque",)
    stopped = scenes.SHIPPED["stopped_pendulum.rests"].scene
    assert wanted_reactions(stopped, ["stop.torque", "stop.angle"]) == ("stop.low", "stop.high")
    assert wanted_reactions(DRIVEN, ["q1.work"]) == ("q1.torque",)


def test_in_space_sizes_are_told_by_components_and_each_is_asked_for_once() -> None:
    names = ("q1.angle", "q1.force", "q1.fx", "q1.moment", "q1.torque", "energy.total", "e.time")
    components = ("q1.fx", "q1.fy", "q1.fz", "q1.mx", "q1.my", "q1.mz", "q1.torque")
    assert wanted_reactions(DRIVEN, names) == components


def test_a_rim_tells_along_and_side_by_its_force() -> None:
    disk = scenes.SHIPPED["tilting_disk.circle"].scene
    names = ("touch.side", "touch.along", "touch.normal", "touch.slip")
    assert wanted_reactions(disk, names) == ("touch.fx", "touch.fy", "touch.normal")


@pytest.mark.parametrize("name", ["q1.force", "q1.moment", "q1.fz", "q1.torque"])
def test_what_is_asked_for_is_enough(name: str) -> None:
    """An engine that is asked so gives what `observe` needs. Turning evenly about z, it carries."""
    start = {"rod": state((-0.2, -0.1, 0.0), (1, 0, 0, 0), (0.2, -0.4, 0.0), (0, 0, 2.0))}
    times = np.linspace(0.0, 0.1, 3)
    motion = simulated(DRIVEN, start, times, 1e-3, wanted_reactions(DRIVEN, [name]))
    found = observe(DRIVEN, motion, name)
    assert found.shape == times.shape
    if name == "q1.fz":
        assert np.allclose(found, 1.3 * G, atol=1e-9)  # N, of 13: the engine's rounding


# Rows of claims about states: native, without a step or an order, and refused in words.

MUJOCO, PYMUNK = (engines.make(name, "tuned") for name in ("mujoco", "pymunk"))


def rows(case: Case, engine: Any) -> dict[str, Comparison]:
    report = suite.measure(Request([case], [engine], book=False))
    assert report.rungs == []
    assert report.instants == []
    return {row.quantity: row for row in report.comparisons}


@pytest.mark.slow
def test_rows(tmp_path: Path) -> None:
    case = claim_of(tmp_path, PLANE_CLAIM)
    found = rows(case, MUJOCO)
    assert set(found) == {"audit", *case.allow}
    for row in found.values():
        assert (row.realised, row.verdict, row.step, row.when) == ("native", AGREES, None, None)
        assert row.protocol == ""
    assert found["wheel.inertia"].unit == "kg m²"


@pytest.mark.slow
def test_what_is_not_told_is_refused(tmp_path: Path) -> None:
    case = claim_of(tmp_path, PLANE_CLAIM, allow={"wheel.P.ax": 1e-11, "wheel.P.x": 1e-12})
    found = rows(case, PYMUNK)
    assert found["wheel.P.ax"].because.startswith("engine: pymunk has velocities")
    assert found["wheel.P.x"].verdict == AGREES


@pytest.mark.slow
def test_twice_the_energy_is_beyond_fails_or_is_declared(tmp_path: Path) -> None:
    case = claim_of(tmp_path, PLANE_CLAIM, allow={"energy.kinetic": 1e-11})
    shipped = engines.make("pymunk", "shipped")
    row = rows(case, shipped)["energy.kinetic"]
    assert row.verdict == BEYOND
    assert row.because.startswith("largest in state ")
    assert rows(case, PYMUNK)["energy.kinetic"].verdict == BEYOND
    promised = replace(case, reach={"pymunk": {"energy.kinetic": 1e-12}})
    assert rows(promised, PYMUNK)["energy.kinetic"].verdict == FAILS
    assert row.error is not None
    near = Deviation("it is m v² + J ω²", by=(0.9 * row.error, 1.1 * row.error))
    declared = replace(case, deviates={"pymunk.shipped": {"energy.kinetic": near}})
    assert rows(declared, shipped)["energy.kinetic"].verdict == DEVIATES
    gone = Deviation("it is m v² + J ω²", by=(1.1 * row.error, 1.2 * row.error))
    declared = replace(case, deviates={"pymunk.shipped": {"energy.kinetic": gone}})
    assert rows(declared, shipped)["energy.kinetic"].verdict == FAILS


class Silent:
    """An engine without the verb."""

    name, setting, version, own_step = "silent", "shipped", "1", None


def test_an_engine_without_answers_is_refused(tmp_path: Path) -> None:
    engine: Any = Silent()
    (way,) = ways_of(engine, claim_of(tmp_path, PLANE_CLAIM), {})
    assert way.because == SILENT  # type: ignore[union-attr]


class Broken(Pymunk):
    """One that answers with what is no number."""

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> dict[str, Array | str]:
        n = len(next(iter(states.values())))
        return {name: np.full(n, np.nan) for name in wanted}


def test_what_is_no_number_fails(tmp_path: Path) -> None:
    engine: Engine = Broken("tuned")
    found = rows(claim_of(tmp_path, PLANE_CLAIM), engine)
    assert found["wheel.P.x"].verdict == FAILS
    assert found["wheel.P.x"].because == "diverged: wheel.P.x is not finite"


class Wrong(Pymunk):
    """One that cannot be asked."""

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> dict[str, Array | str]:
        raise ZeroDivisionError("no answer")


def test_what_raises_is_no_refusal_that_passes(tmp_path: Path) -> None:
    engine: Any = Wrong("tuned")
    (way,) = ways_of(engine, claim_of(tmp_path, PLANE_CLAIM), {})
    assert way.because == "ZeroDivisionError: no answer"  # type: ignore[union-attr]
    found = rows(claim_of(tmp_path, PLANE_CLAIM), engine)
    assert {row.verdict for row in found.values()} == {FAILS}


def test_nothing_of_it_can_be_shown(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="is a claim about states: nothing is run"):
        script(claim_of(tmp_path, PLANE_CLAIM), MUJOCO)


@pytest.mark.slow
def test_what_is_kept_has_a_row_for_each_state(tmp_path: Path) -> None:
    case = claim_of(tmp_path, PLANE_CLAIM)
    report = suite.measure(Request([case], [MUJOCO], book=False))
    keep.keep(report, tmp_path / "kept")
    table = pd.read_csv(tmp_path / "kept" / "claimed.csv")
    assert table["state"].tolist() == [0, 1, 2, 3]
    one, other = (table[f"wheel.P.x [m] {who}"] for who in ("reference", "mujoco.tuned.native"))
    assert np.max(np.abs(one - other)) < 1e-12


# An engine's turns in space are counted between the samples, where these are far apart.

TURNING = """\
title: A body that turns evenly
scene:
  space: 3
  gravity: none
  points: {O: [0, 0, 0]}
  bodies: {b: {rigid: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}}
  joints: {q: {hinge: [ground.O, b.center], axis: [0, 0, 1]}}
initial: {q: {angle: 400 deg, omega: 20}}
duration: 3
samples: 4
step: 1.0e-2
allow: {q.angle: 1.0}
"""
RATE = 20.0  # rad/s


def turning(times: Array) -> Trajectory:
    """It speeds up and slows down, so that its rate at whole seconds says nothing."""
    angle = math.radians(400) + RATE * (times - np.sin(math.tau * times) / math.tau)
    rate, still = RATE * (1 - np.cos(math.tau * times)), np.zeros((len(times), 3))
    zero = np.zeros(len(times))
    attitude = np.column_stack([np.cos(angle / 2), zero, zero, np.sin(angle / 2)])
    states = np.hstack([still, attitude, still, zero[:, None], zero[:, None], rate[:, None]])
    return Trajectory(times, {"b": states}, {"q.fx": times})


@pytest.mark.mutant("turns of an engine guessed from its samples")
def test_an_engine_is_asked_between_its_samples(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(TURNING)
    (case,) = scenes.load(path)
    found = turns.counted(case, turning, 0.01, 2 * RATE)
    expected = math.radians(400) + RATE * case.times
    np.testing.assert_allclose(observe(case.scene, found, "q.angle"), expected, atol=1e-9)
    np.testing.assert_array_equal(found.times, case.times)
    np.testing.assert_allclose(found.reactions["q.fx"], case.times, atol=1e-12)
    guessed = observe(case.scene, turning(case.times), "q.angle")
    assert np.max(np.abs(guessed - expected)) > 6.0


def test_samples_are_cut_into_whole_steps() -> None:
    assert turns.between(0.1, 0.01, 0.0) == 1
    assert turns.between(0.1, 0.01, 10.0) == 1
    assert turns.between(0.1, 0.01, 15.0) == 2
    assert turns.between(0.1, 0.01, 30.0) == 5
    assert turns.between(0.1, 0.01, 1e6) == 10
