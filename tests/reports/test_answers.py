"""What an engine answers is looked at before it is believed: words on states, records, tuning."""

import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest

from textmech.cases.scene import Scene, shape
from textmech.cases.scene.states import MASS_MATRIX
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Diverged, Shape
from textmech.engines.knobs import Knob
from textmech.reports.compare.trial import work
from textmech.reports.compare.trial.answers import BadAnswer, claimed, moved, tunable

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
        work._told(work._Asked((*asked, str(i)), Paced(act), SCENE))
        for i, act in enumerate([lambda: 2e-3, leaves, lambda: os._exit(0), lambda: time.sleep(60)])
    ]
    assert told == [2e-3, None, None, None]
