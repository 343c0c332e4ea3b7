"""All rows, a case that needs no file, and an engine whose errors are known in advance."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.scene import Scene
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Choice, Diverged, Plan, Realised, Refusal, Start
from textmech.reports.compare.trial.start import first
from textmech.reports.compare.trial.trial import Trial, ways
from textmech.reports.front.pytest_plugin import CaseItem, measured
from textmech.reports.runs import suite
from textmech.reports.runs.cache.store import usable
from textmech.reports.runs.chosen_models import choose_models
from textmech.reports.runs.processes import pool
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_cases, choose_engines
from textmech.reports.runs.suite import Report

TEXT = """\
title: A free body that moves at constant velocity
source: {equations: ["2.23"]}
scene:
  gravity: none
  bodies: {ball: {particle: {mass: 2.0}}}
initial: {ball: {x: 0, y: 0, vx: 1, vy: 0}}
duration: 1.0
samples: 26
step: {mujoco: 1.0e-3, pymunk: 1.0e-3}
allow: {ball.x: 1.0e-2}
"""
STOPS = (0.3, 0.7)  # s: the reference of a case with events slows down to rest twice
STARTS = 0.5


def speed(t: Array, *stops: float) -> Array:
    """Two brakings, the second from STARTS on; more stops than two are another motion."""
    v = np.clip(1 - t / stops[0], 0, None)
    for i, stop in enumerate(stops[1:]):
        starts = STARTS + 0.3 * i
        v += np.where(t > starts, np.clip(1 - (t - starts) / (stop - starts), 0, None), 0)
    return v


def stiffness(step: float) -> list[Choice]:
    """A number that is tied to the step."""
    return [Choice("soft", step, "as large as the step")]


def nothing() -> None:
    """What an engine does before it plans or runs: named, so that it crosses into a process."""


@dataclass(frozen=True)
class Fake:
    """x(t) = t + model t + rate h^order t; diverges above `stable`."""

    setting: str = "tuned"
    name: str = "mujoco"
    version: str = "4.0.0"
    own_step: float | None = None
    model: float = 0.0
    rate: float = 1.0
    order: int = 1
    stable: float = 1.0
    lost: tuple[float, ...] = ()  # steps at which it diverges too
    follows: bool = False
    stops: tuple[float, ...] = ()  # of the record of every step
    delay: float = 0.0  # of each stop, in steps
    ways: tuple[Realised, ...] = ("native",)
    numbers: dict[str, float] = field(default_factory=dict)
    refusal: str | None = None
    simplified: str = ""
    planning: Callable[[], None] = nothing
    before: Callable[[], None] = nothing

    def plans(self, scene: Scene, start: Start) -> list[Plan | Refusal]:
        self.planning()
        if self.refusal is not None:
            return [Refusal("native", self.refusal)]
        orders = (self.order, self.order + 1)
        following = orders if self.follows else None
        blind = {"ball.vy": "engine: it is blind"}
        bare = Plan("native", orders, following, stiffness, withheld=blind)
        return [replace(bare, realised=way, simplified=self.simplified) for way in self.ways]

    def script(
        self,
        scene: Scene,
        start: Start,
        step: float,
        plan: Plan,
        *,
        title: str = "",
        duration: float = 1.0,
    ) -> str:
        return "pass\n"

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        return {"ball.mass": 2.0} | self.numbers

    def run(
        self,
        scene: Scene,
        start: Start,
        times: Array,
        step: float,
        plan: Plan,
        *,
        reactions: tuple[str, ...],
        record: bool = False,
    ) -> Trajectory:
        self.before()
        if step > self.stable or step in self.lost:
            raise Diverged("too large a step")
        (soft,) = plan.choices(step)
        model = self.model * (soft.value / 1e-3 if self.follows else 1.0)
        ball = np.zeros((len(times), 6))
        ball[:, 0] = times * (1 + model + self.rate * step**self.order)
        ball[:, 3] = 1.0
        kept = self._record(times, step) if record and self.stops else None
        return Trajectory(times, {"ball": ball}, {}, record=kept)

    def _record(self, times: Array, step: float) -> Trajectory:
        every = np.arange(round(times[-1] / step) + 1) * step
        ball = np.zeros((len(every), 6))
        ball[:, 3] = speed(every, *(stop + self.delay * step for stop in self.stops))
        return Trajectory(every, {"ball": ball}, {})


@pytest.fixture(autouse=True)
def nothing_remembered(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """What a test of the plug-in plants must be computed, and be remembered by nobody."""
    if "pytester" in request.fixturenames:
        monkeypatch.setenv("TEXTMECH_CACHE", "/dev/null")


@pytest.fixture(scope="session")
def moving(tmp_path_factory: pytest.TempPathFactory) -> Case:
    """The free body's case."""
    return written(tmp_path_factory.mktemp("case"), TEXT)


def written(folder: Path, text: str, name: str = "moving.yaml") -> Case:
    file = folder / name
    file.write_text(text, encoding="utf-8")
    (case,) = load(file)
    return case


@pytest.fixture(scope="session")
def stopping(tmp_path_factory: pytest.TempPathFactory) -> Case:
    """The same with an event that happens twice."""
    text = TEXT.replace("allow: {", "events: {stops: {ball.vx: stays zero}}\nallow: {")
    text = text.replace("ball.x: 1.0e-2", "ball.x: 1.0e-2, stops.time: 2.5e-3")
    return written(tmp_path_factory.mktemp("case"), text)


def phased() -> Trajectory:
    """The reference's record: braking, rest, braking, rest."""
    edges = (0.0, STOPS[0], STARTS, STOPS[1], 1.0)
    times = [np.linspace(a, b, 5) for a, b in itertools.pairwise(edges)]
    ball = np.zeros((20, 6))
    ball[:5, 3] = ball[10:15, 3] = np.linspace(1, 0, 5)
    return Trajectory(np.concatenate(times), {"ball": ball}, {}, phase=np.repeat(np.arange(4), 5))


@pytest.fixture
def trial(moving: Case) -> Callable[..., Trial]:
    """A trial of a fake engine with the given properties, or of another case."""

    def made(case: Case = moving, **properties: Any) -> Trial:
        times = case.times
        ball = np.zeros((len(times), 6))
        ball[:, 0], ball[:, 3] = times, 1.0
        kept = phased() if case.events else None
        switches = np.array([STOPS[0], STARTS, STOPS[1]] if case.events else [])
        reference = Trajectory(times, {"ball": ball}, {}, record=kept, switches=switches)
        realised = properties.pop("realised", "native")
        engine = Fake(**{k: v for k, v in properties.items() if k != "planning"})
        found = ways(engine, case.scene, first(reference))
        way = next(way for way in found if way.realised == realised)
        return Trial(case, reference, Fake(**properties), way)

    return made


@pytest.fixture(scope="session")
def report(request: pytest.FixtureRequest) -> Report:
    """All rows; those of this session where it compares everything anyway."""
    cases, engines = choose_cases([]), choose_engines([], [])
    names = [item.name for item in request.session.items if isinstance(item, CaseItem)]
    pairs = {"-".join(name.split("-")[:2]) for name in names}
    if all(f"{c.name}-{e.name}.{e.setting}" in pairs for c in cases for e in engines):
        return measured(request.session)
    jobs, store = pool.workers(), usable()
    models = choose_models([]).cases
    return suite.measure(Request(cases, engines, jobs=jobs, store=store, models=models))
