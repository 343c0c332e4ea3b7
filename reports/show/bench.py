"""What the adapters cost: each figure a ratio of two minima of ten, taken in turn in one run.

Stepping is a run with all its readings, less the building of the scene, over the bare loop. A
case with events records every step.
"""

import time
from collections.abc import Callable, Iterator
from functools import partial
from typing import Protocol

import numpy as np
from scipy.integrate import solve_ivp

from ...cases.case import Case
from ...engines.engine import Engine, Loop, Plan, Start
from ...reference.integrators.explicit import dormand_prince
from ...reference.system import Array, Mode
from ...reference.systems.double_pendulum import DoublePendulum
from ..selection import choose_cases, choose_engines
from ..trial.ladder import wanted_reactions
from ..trial.start import assembled

Work = Callable[[], object]


class Looped(Engine, Loop, Protocol):
    """An engine that offers its bare loop."""


ROUNDS = 10  # the minimum of ten: what the machine can do when nobody disturbs it
STEP = 2e-4  # s, for all: what a step costs hardly depends on its size; no wheel rolls too far
STEPS = 100  # a sample
SAMPLES = 200
TOLERANCES = (1e-8, 1e-9, 1e-10, 1e-11, 1e-12)  # around the error they are compared at
ENOUGH = 1e-10  # the error at which the integrators are compared


def table() -> Iterator[str]:
    """The lines of the table, one measured after the other."""
    head = f"{'run':>9} {'building':>9} {'bare loop':>9}  (run - building) / bare loop"
    yield f"{f'{STEPS * SAMPLES} steps, {SAMPLES} samples':52} {head}"
    for case in _one_of_each_file():
        start = assembled(case)
        for engine, plan in _native(case, start):
            ours, building, bare = _stepping(case, start, engine, plan)
            label = f"{case.name} in {engine.name}.{engine.setting}"
            label += ", every step" if case.events else ""
            numbers = " ".join(f"{s * 1e3:6.1f} ms" for s in (ours, building, bare))
            yield f"{label:52} {numbers}  {(ours - building) / bare:.2f}"
    yield ""
    yield f"{'to an error of 1e-10':52} {'ours':>9} {'scipy':>9}  ratio"
    ours, scipys = _integrators()
    yield f"{'double pendulum':52} {ours * 1e3:6.1f} ms {scipys * 1e3:6.1f} ms  {ours / scipys:.2f}"


def _one_of_each_file() -> Iterator[Case]:
    """The first variant of every shipped file: the others step the same scene."""
    seen = set()
    for case in choose_cases([]):
        if case.source.file not in seen:
            seen.add(case.source.file)
            yield case


def _native(case: Case, start: Start) -> Iterator[tuple[Looped, Plan]]:
    """The engines that offer their bare loop, each with its native plan of the case."""
    for engine in choose_engines([], []):
        if isinstance(engine, Loop):
            for way in engine.plans(case.scene, start):
                if isinstance(way, Plan) and way.realised == "native":
                    yield engine, way


def _stepping(case: Case, start: Start, engine: Looped, plan: Plan) -> list[float]:
    """Seconds of the adapter's run, of building the scene, and of the engine's bare loop."""
    times = np.arange(SAMPLES + 1, dtype=np.float64) * (STEPS * STEP)

    def adapter() -> Work:
        return lambda: engine.run(
            case.scene,
            start,
            times,
            STEP,
            plan,
            reactions=wanted_reactions(case.scene, case.allow),
            record=bool(case.events),
        )

    def building() -> Work:
        return lambda: engine.loop(case.scene, start, STEP, plan)

    def bare() -> Work:
        loop = engine.loop(case.scene, start, STEP, plan)
        return lambda: loop(STEPS * SAMPLES)

    return _fastest(adapter, building, bare)


def _fastest(*setups: Callable[[], Work]) -> list[float]:
    """The least seconds of each work, set up anew and taken in turn."""
    least = [float("inf")] * len(setups)
    for _ in range(ROUNDS):
        for i, setup in enumerate(setups):
            work = setup()
            before = time.perf_counter()
            work()
            least[i] = min(least[i], time.perf_counter() - before)
    return least


def _integrators() -> tuple[float, float]:
    """Seconds to 1e-10 on the double pendulum: our explicit integrator, and scipy's DOP853."""
    (case,) = choose_cases(["double_pendulum"])
    system = DoublePendulum(**case.parameters)
    y0 = np.concatenate(system.start())
    rates = _rates(system)

    def ours(tolerance: float) -> Array:
        return dormand_prince(rates, case.times, y0, tolerance=tolerance).y

    def scipys(tolerance: float) -> Array:
        span = (0.0, case.duration)
        found = solve_ivp(rates, span, y0, "DOP853", case.times, rtol=tolerance, atol=tolerance)
        return found.y.T

    truth = ours(1e-15)
    seconds = [
        _fastest(lambda t=t: partial(ours, t), lambda t=t: partial(scipys, t)) for t in TOLERANCES
    ]
    errors = [
        [float(np.max(np.abs(method(t) - truth))) for method in (ours, scipys)] for t in TOLERANCES
    ]
    found = np.array([errors, seconds])
    return _at(ENOUGH, *found[:, :, 0]), _at(ENOUGH, *found[:, :, 1])


def _rates(system: Mode) -> Callable[[float, Array], Array]:
    n = len(system.start()[0])
    return lambda t, y: np.concatenate([y[n:], system.accelerations(t, y[:n], y[n:])])


def _at(error: float, errors: Array, seconds: Array) -> float:
    """Seconds at which the error is reached, on the line through log error and log seconds."""
    slope, offset = np.polyfit(np.log(errors), np.log(seconds), 1)
    return float(np.exp(slope * np.log(error) + offset))
