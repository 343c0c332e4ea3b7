"""What an engine's adapter costs over the plainest loop that a user would write.

The plain loop is what `show` prints, run as it is: `mj_step(model, data, n)` on MuJoCo's file, and
pymunk's script. It keeps nothing; a run of the adapter reads states and forces. Both build their
scene within the time.
"""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import mujoco
import numpy as np

from textmech.cases.case import Case
from textmech.cases.scene import Scene
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Engine, Plan, Refusal, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.callbacks.signal import installed, listening
from textmech.engines.mujoco.model.drive import controls
from textmech.engines.mujoco.model.force import BY_ITSELF
from textmech.engines.mujoco.model.rods import with_rods
from textmech.engines.mujoco.read.poses import poses
from textmech.engines.mujoco.read.record import Record
from textmech.engines.probe import guarded
from textmech.engines.pymunk import Pymunk
from textmech.engines.pymunk.adapter.plans import numbers_by_name
from textmech.engines.pymunk.adapter.script import before_each, building
from textmech.engines.pymunk.stepping.run import COLD
from textmech.engines.pymunk.stepping.scene import build
from textmech.engines.signal import factor
from textmech.reports.compare.trial.answers import plans
from textmech.reports.compare.trial.ladder import wanted_reactions
from textmech.reports.compare.trial.start import assembled
from textmech.reports.compare.trial.states import moving
from textmech.reports.compare.trial.table_text import why
from textmech.reports.runs.selection import choose_cases

from .row import Row, Work, in_turn, ratio

AIMS = {"samples": 1.05, "every step": 1.3}
"""The ratios that are aimed at, of runs that read at samples and of those that read every step."""
ROUNDED = 1e-9  # of the motion's size: the same sums in another order, over all steps
SAMPLES = 100  # of a run

Loop = Callable[[int], Start]
"""Takes n steps; returns where all bodies then are."""


def one_of_each_file() -> list[Case]:
    """Returns the first variant of every shipped file in the plane: the others step its scene."""
    cases = [case for case in choose_cases([]) if case.states is None]
    files = {case.source.file: case for case in reversed(cases)}
    return list(files.values())[::-1]


def rows(case: Case, engines: list[Engine], steps: int, rounds: int) -> Iterator[Row]:
    """Yields two rows for each engine that realises the case natively and has a plain loop."""
    start = assembled(moving(case))
    for engine in engines:
        if engine.name not in LOOPS:
            continue
        head = Row("adapter", f"{case.name} in {engine.name}.{engine.setting}")
        ways, error = guarded(partial(plans, engine, case.scene, start))
        if ways is None:
            yield replace(head, note=why(error) if error else "")
        for way in ways or ():
            if isinstance(way, Refusal):
                yield replace(head, note=f"refused: {way.because}")
            elif way.realised == "native":
                pair = Pair(case, start, engine, way, steps)
                measured, error = guarded(partial(_measured, head, pair, rounds))
                yield from measured or [replace(head, note=why(error) if error else "")]


def _measured(head: Row, pair: "Pair", rounds: int) -> list[Row]:
    apart = pair.apart()
    if apart > ROUNDED:
        words = f"the plain loop makes another motion, {apart:.0e} apart"
        return [replace(head, note=words, wrong=True)]
    works = [pair.loop, partial(pair.run, record=False), partial(pair.run, record=True)]
    plain, *runs = in_turn(works, rounds)
    return [
        replace(
            head, over=f"plain loop, {kind}", seconds=float(np.median(run)), aim=aim,
            **dict(zip(("ratio", "spread"), ratio(run, plain), strict=True)),
        )
        for (kind, aim), run in zip(AIMS.items(), runs, strict=True)
    ]  # fmt: skip


@dataclass(frozen=True)
class Pair:
    """An adapter's run of a plan over the case's duration, and the plain loop of the same.

    steps: of a sample.
    """

    case: Case
    start: Start
    engine: Engine
    plan: Plan
    steps: int

    @property
    def count(self) -> int:
        """Steps of a run."""
        return self.steps * SAMPLES

    @property
    def h(self) -> float:
        """The step [s]."""
        return self.case.duration / self.count

    def _begin(self) -> Callable[[], Loop]:
        return LOOPS[self.engine.name](self.engine, self.case.scene, self.start, self.h, self.plan)

    def apart(self) -> float:
        """Returns how far the two end from each other.

        Of the largest coordinate or speed of any body, and at least of 1 m, 1 rad.
        """
        states = self._begin()()(self.count)
        times = np.array([0.0, self.count * self.h])
        run = self._run(self.case.scene, times, record=False)
        plain = np.array([states[name] for name in run.states])
        ours = np.array([rows[-1] for rows in run.states.values()])
        return float(np.max(np.abs(plain - ours)) / max(1.0, np.max(np.abs(ours))))

    def loop(self, k: int) -> Work:
        """Returns the plain loop, built and stepped."""
        begin = self._begin()
        return lambda: begin()(self.count)

    def run(self, k: int, *, record: bool) -> Work:
        """Returns the adapter's run, read at samples or at every step."""
        times: Array = np.arange(SAMPLES + 1.0) * (self.steps * self.h)
        scene = self.unseen(k)
        return lambda: self._run(scene, times, record=record)

    def unseen(self, k: int) -> Scene:
        """Returns the scene with gravity changed by a rounding: no cache can hide its building."""
        scene = self.case.scene
        x, y = scene.gravity
        return replace(scene, gravity=(x, y * (1 + (k + 1) * 2.0**-52) if y else (k + 1) * 1e-300))

    def _run(self, scene: Scene, times: Array, *, record: bool) -> Trajectory:
        wanted = wanted_reactions(scene, self.case.allow)
        return self.engine.run(
            scene, self.start, times, self.h, self.plan, reactions=wanted, record=record
        )


def mujoco_loop(
    engine: MuJoCo, scene: Scene, start: Start, step: float, plan: Plan
) -> Callable[[], Loop]:
    """`mj_step(model, data, n)` on the file that `show` prints; signals in time are a callback."""
    _, text = engine._script(scene, start, step, plan)  # without what is only seen
    scene, start = with_rods(scene, start)
    signals = [(i, factor(s)) for i, s in enumerate(controls(scene)) if s.law not in BY_ITSELF]

    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        for i, size in signals:
            data.ctrl[i] = size(data.time)

    def begin() -> Loop:
        with listening():
            model = mujoco.MjModel.from_xml_string(text)
            data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, 0)
        begun = data.qpos.copy()  # from whose angles turns are counted

        def take(n: int) -> Start:
            with listening(), installed(control if signals else None):
                mujoco.mj_step(model, data, n)
            no_activation = np.empty((2, 0))
            record = Record(np.array([begun, data.qpos]), np.array([data.qvel] * 2), no_activation)
            rows = poses(scene, model, data, record, start)
            return {name: tuple(row[1].tolist()) for name, row in rows.items()}  # type: ignore[misc]

        return take

    return begin


def pymunk_loop(
    engine: Pymunk, scene: Scene, start: Start, step: float, plan: Plan
) -> Callable[[], Loop]:
    """`space.step(h)` in a Python loop, after the lines of the script that `show` prints."""
    numbers = numbers_by_name(plan.choices(step))
    world = build(scene, start, numbers, plan.realised)
    lines = [
        "import math",
        "import pymunk",
        *building(world, start, numbers),
        "def take(first, last):",
        "    for n in range(first, last):",
        *(f"    {line}" for line in before_each(world, numbers)),
        "        space.step(h)",
    ]
    script = compile("\n".join(lines), "<plain>", "exec")

    def begin() -> Loop:
        names: dict[str, Any] = {"h": step}
        exec(script, names)

        def take(n: int) -> Start:
            space, usual = names["space"], names["space"].iterations
            space.iterations = numbers.get("start.iterations", usual)
            names["take"](0, min(n, COLD))  # the script asks before each step, which costs more
            space.iterations = usual
            names["take"](min(n, COLD), n)
            ahead = step / 2 if numbers.get("time.midpoint") else 0.0
            states = {}
            for name in scene.bodies:
                body = names["bodies"][name]
                (x, y), (vx, vy), omega = body.position, body.velocity, body.angular_velocity
                angle = body.angle + ahead * omega
                states[name] = (x + ahead * vx, y + ahead * vy, angle, vx, vy, omega)
            return states

        return take

    return begin


LOOPS: dict[str, Callable[[Any, Scene, Start, float, Plan], Callable[[], Loop]]] = {
    "mujoco": mujoco_loop,
    "pymunk": pymunk_loop,
}
"""The plain loop of each engine that has one: what builds it, which is what is timed."""
