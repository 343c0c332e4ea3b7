"""Measures an engine's adapter against the plainest loop, which must make the same motion."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from textmech.cases.case import Case
from textmech.cases.scene import Scene
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Diverged, Engine, Plan, Realised, Refusal, Start
from textmech.engines.probe import guarded
from textmech.reports.batch.selection import choose_cases
from textmech.reports.compare.trial.answers import plans
from textmech.reports.compare.trial.ladder import wanted_reactions
from textmech.reports.compare.trial.start import assembled
from textmech.reports.compare.trial.states import moving
from textmech.reports.system.table_text import why

from . import mujoco_loop, pymunk_loop
from .plain import Begin
from .turns import Ratio, Work, ratio, turns

RUNGS = 5  # of the ladder that is built: as many as a shipped setting's
COARSER = 4  # times the step at which a loop of first order must be at least
FALLS = 2  # times further from the adapter: nearly 4, but events lie between its steps
ROUNDED = 1e-9  # of the motion's size: the same sums in another order, over all steps


LOOPS: dict[str, Callable[[Any, Scene, Start, float, Plan], Begin | None]] = {
    "mujoco": mujoco_loop.plain,
    "pymunk": pymunk_loop.plain,
}
"""The plain loop of each engine that has one, for a plan; numbers that follow the step are those of
the step [s] that is given."""


@dataclass(frozen=True)
class Amount:
    """How much is measured: steps a sample, samples of a run, rounds."""

    steps: int = 100
    samples: int = 100
    rounds: int = 5


@dataclass(frozen=True)
class Row:
    """One plan of one case; without ratios where there is a reason against them.

    step: of the plain loop [s of CPU]. samples, recorded: a run with its building and reading over
    the plain loop with its building, read at samples or at every step. building: of all rungs of a
    ladder. apart: how far the two motions end from each other, of the motion's size.
    """

    case: str
    engine: str
    setting: str
    realised: Realised
    step: float = np.nan
    samples: Ratio | None = None
    recorded: Ratio | None = None
    building: Ratio | None = None
    apart: float = np.nan
    because: str = ""

    @property
    def differs(self) -> bool:
        """Whether the plain loop makes another motion: then there is nothing to compare."""
        return self.samples is None and not np.isnan(self.apart)


def one_of_each_file() -> list[Case]:
    """The first variant of every shipped file: the others step the same scene."""
    cases = [case for case in choose_cases([]) if case.states is None]
    files = {case.source.file: case for case in reversed(cases)}
    return list(files.values())[::-1]


def rows(case: Case, engines: list[Engine], amount: Amount) -> Iterator[Row]:
    """Each way of the engines that have a plain loop."""
    start = assembled(moving(case))
    for engine in engines:
        if engine.name in LOOPS:
            ways, error = guarded(partial(plans, engine, case.scene, start))
            if error is not None:
                yield Row(case.name, engine.name, engine.setting, "native", because=why(error))
            for way in ways or ():
                head = Row(case.name, engine.name, engine.setting, way.realised)
                if isinstance(way, Refusal):
                    yield replace(head, because=f"refused: {way.because}")
                    continue
                found, error = guarded(partial(_row, head, Pair(case, start, engine, way, amount)))
                yield found or replace(head, because=_lost(error))


def _lost(error: BaseException | None) -> str:
    return str(error) if error is None or isinstance(error, Diverged) else why(error)


def _row(head: Row, pair: "Pair") -> Row:
    if pair.plain() is None:
        return replace(head, because="nobody has written a plain loop for it")
    apart = pair.apart(1)
    same = apart <= ROUNDED
    jumps = any(law.corners for law in pair.case.scene.laws())  # the plain loop steps over them
    if not same and (jumps or head.realised != "native"):
        same = FALLS * apart <= pair.apart(COARSER)
    if not same:
        return replace(head, apart=apart, because="the plain loop makes another motion")
    plain, samples, recorded = turns([pair.loop, pair.run, pair.record], pair.amount.rounds)
    built, building = turns([pair.build_plainly, pair.build], pair.amount.rounds)
    return replace(
        head,
        step=float(np.median(plain)) / pair.count,
        samples=ratio(samples, plain),
        recorded=ratio(recorded, plain),
        building=ratio(building, built),
        apart=apart,
    )


@dataclass(frozen=True)
class Pair:
    """An adapter's run of a plan over the case's duration, and the plain loop of the same."""

    case: Case
    start: Start
    engine: Engine
    plan: Plan
    amount: Amount

    @property
    def count(self) -> int:
        """Steps of a run."""
        return self.amount.steps * self.amount.samples

    @property
    def h(self) -> float:
        """s."""
        return self.case.duration / self.count

    def plain(self) -> Begin | None:
        """Returns a function that builds the plain loop for a step [s]; None: nobody wrote it.

        Nothing is built before the function is called.
        """
        loop = LOOPS[self.engine.name]
        return loop(self.engine, self.case.scene, self.start, self.h, self.plan)

    def apart(self, coarser: int) -> float:
        """How far the two end from each other at so many times the step, numbers tied to it held.

        Of the largest coordinate or speed of any body, and at least of 1 m, 1 rad.
        """
        h, count = coarser * self.h, self.count // coarser
        begin = self.plain()
        assert begin
        loop = begin(h)
        loop.take(count)
        times = np.array([0.0, count * h])
        found = self._run(self.case.scene, times, h, self.plan.held_at(self.h), record=False)
        plain = np.array([loop.states()[name] for name in found.states])
        ours = np.array([rows[-1] for rows in found.states.values()])
        return float(np.max(np.abs(plain - ours)) / max(1.0, np.max(np.abs(ours))))

    def loop(self, k: int) -> Work:
        """The plain loop, built and stepped; nothing is kept of it."""
        begin = self.plain()
        assert begin
        return lambda: begin(self.h).take(self.count)

    def run(self, k: int) -> Work:
        """The adapter's run, with what the suite reads at samples."""
        return self._work(k, record=False)

    def record(self, k: int) -> Work:
        """The adapter's run, with every step recorded."""
        return self._work(k, record=True)

    def _work(self, k: int, *, record: bool) -> Work:
        times: Array = np.arange(self.amount.samples + 1.0) * (self.amount.steps * self.h)
        scene = self.unseen(k)
        return lambda: self._run(scene, times, self.h, self.plan, record=record)

    def build_plainly(self, k: int) -> Work:
        """The plain loop's building of a ladder."""
        begin = self.plain()
        assert begin
        return lambda: [begin(h) for h in self._ladder()]

    def build(self, k: int) -> Work:
        """The adapter's: runs without a step, of a scene that its caches have not seen."""
        scene, plan = self.unseen(k), self.plan.held_at(self._ladder()[-1])
        return lambda: [
            self._run(scene, np.zeros(1), h, plan, record=False) for h in self._ladder()
        ]

    def _ladder(self) -> list[float]:
        return [self.h * 2**k for k in range(RUNGS)]

    def unseen(self, k: int) -> Scene:
        """Returns the scene with gravity changed by a rounding: no cache can hide its building."""
        scene = self.case.scene
        x, y = scene.gravity
        return replace(scene, gravity=(x, y * (1 + (k + 1) * 2.0**-52) if y else (k + 1) * 1e-300))

    def _run(self, scene: Scene, times: Array, h: float, plan: Plan, *, record: bool) -> Trajectory:
        wanted = wanted_reactions(scene, self.case.allow) if len(times) > 1 else ()
        return self.engine.run(scene, self.start, times, h, plan, reactions=wanted, record=record)
