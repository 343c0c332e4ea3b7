"""Recipes for contacts, pasted into models of a user's own, which start where a user starts them.

Each keeps there what the case allows, from starts that are moved too: what comes down does so in
another part of a step, what brakes stops in another.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.adapters.plain_models import BOX, CUBE, MODELS, Box

from textmech.cases.case import Case
from textmech.cases.language.document import read
from textmech.cases.load import load
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first
from textmech.reports.front.show.advice import advice_lines, shipped_lines
from textmech.reports.runs.cache.store import usable
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_engines
from textmech.reports.search.advice import candidates
from textmech.reports.search.advice.advice_rows import Advised, Requirement, settings
from textmech.reports.search.advice.advise import advised
from textmech.reports.search.causes.candidate import Candidate

ASKED = [
    ("creeping_block", "mujoco"), ("creeping_block", "pymunk"), ("sinking_ball", "mujoco"),
    ("sinking_ball", "pymunk"), ("landing", "mujoco"),
    ("landing", "pymunk"),
    ("bouncing_ball", "pymunk"), ("rolling_down", "mujoco"), ("rolling_down", "pymunk"),
    ("sliding_block.braking", "pymunk"), ("rolling_wheel.downhill", "mujoco"),
]  # fmt: skip
FALLS = {"landing": 4.4, "bouncing_ball": 3.1}  # m/s, with which it comes down
MOVED = (0.0, 0.3, 0.6, 0.85)  # parts of a step's way


def advice(name: str, engine: str) -> Advised:
    """What is advised on a shipped case."""
    asked, chosen = Requirement(None, 2.0), choose_engines([engine], ["shipped"])
    cases = [scenes.EVERY[name]]
    with advised(Request(cases, chosen, jobs=1, store=usable()), asked) as (one,):
        return one


def lines(one: Advised, candidate: Candidate) -> str:
    """What is to be pasted."""
    engine: Any = one.pair.engine
    start = first(one.pair.reference())
    options = candidate.on(one.pair.shapes).options
    return engine.snippet(one.pair.case.scene, start, options, candidate.step)


def moved(name: str, folder: Path, part: float, step: float) -> Case:
    """The case with its start moved: further along, and what falls by a part of a step's way."""
    case = scenes.EVERY[name]
    data: Any = json.loads(json.dumps(read(Path(case.source.file)).data, default=str))
    data.pop("system", None)  # which has a start of its own
    (start,) = data["initial"].values()
    start["x"] += 0.25 * part
    if name in FALLS:
        start["y"] += part * FALLS[name] * step
    for variant in data.get("variants", {}).values():
        if "v0" in (given := variant.get("parameters", {})):
            given["v0"] *= 1 + 0.02 * part
    file = folder / Path(case.source.file).name
    file.write_text(json.dumps(data), encoding="utf-8")
    return next(other for other in load(file) if other.name == name)


def worst(case: Case, engine: str, pasted: str, step: float, box: Box = BOX) -> float:
    """The largest error of the body's place over what is allowed, in a model of a user's own.

    Not within two steps of a blow: there the engine is before it yet, or still deep in the floor.
    """
    reference = solve(case).trajectory
    (body,) = case.scene.bodies
    rows = MODELS[engine](case, first(reference), pasted, reference.times, box)
    away = np.abs(reference.times[:, None] - reference.blows[None, :]) > 2 * step
    away = np.all(away, axis=1)
    off = np.max(np.abs(rows - reference.states[body][:, :3])[away], axis=0)
    names = {f"{body}.{axis}": error for axis, error in zip(("x", "y", "angle"), off, strict=True)}
    names["touch.gap"] = off[1]
    return max(names[name] / case.allow[name] for name in names.keys() & case.allow.keys())


@pytest.mark.slow
@pytest.mark.parametrize(("name", "engine"), ASKED)
def test_what_is_pasted_keeps_the_tolerance_in_a_users_own_model(
    name: str, engine: str, tmp_path: Path
) -> None:
    one = advice(name, engine)
    assert one.recipes is not None
    assert one.shapes
    for candidate in one.pasted:
        assert "shapes: plain" in settings(one.pair, candidate)
        for part in MOVED:
            case = moved(name, tmp_path, part, candidate.step)
            case = replace(case, duration=one.pair.case.duration, samples=one.pair.case.samples)
            for box in (BOX, CUBE):
                off = worst(case, engine, lines(one, candidate), candidate.step, box)
                assert off <= 1.0, (candidate, part, box)


@pytest.mark.slow
@pytest.mark.mutant("advice on a contact measured on the points of our own model")
def test_advice_of_our_own_model_would_not_hold(tmp_path: Path) -> None:
    """What public users were told of a box on a slope: it creeps as soon as it is one."""
    one = advice("creeping_block", "mujoco")
    ours = Candidate.of({"impratio": 1e4}, 1e-2)  # ×0.008 for a point of 1e-12 m
    case = moved("creeping_block", tmp_path, 0.0, ours.step)
    assert worst(case, "mujoco", lines(one, ours), ours.step) > 1.0


@pytest.mark.slow
def test_the_nearest_is_printed_where_none_keeps_the_tolerance(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of one option at a time: whole recipes with one more are as far off, and take 40 s."""
    monkeypatch.setattr(candidates, "MOST", 1)
    monkeypatch.setattr(candidates.Candidates, "whole_groups", lambda self: iter(()))
    one = advice("bouncing_disk.elastic", "mujoco")
    assert one.recipes is None
    told = [*shipped_lines(one), *advice_lines(one)]
    place = told.index("  the nearest")
    assert "wheel is a sphere geom" in told[2]
    assert any("stays ×" in line for line in told[:place])
    assert any("<pair solref=" in line for line in told[place:])
    assert any("where wheel is a cylinder geom" in line for line in told[place:])


@pytest.mark.slow
def test_what_is_measured_in_our_model_alone_says_so() -> None:
    told = list(shipped_lines(advice("heavy_on_light", "mujoco")))
    assert "measured in our model alone" in told[2]
    assert "1e-12 m" in told[2]
