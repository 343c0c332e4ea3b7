"""One run of a trial: a rung of a ladder, which needs nothing but itself."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

import numpy as np

from ...cases.case import Case
from ...cases.scene.frame import frame_of
from ...cases.scene.observe import observe
from ...cases.scene.quantity import at_event, told_by
from ...cases.trajectory import Array, Trajectory
from ...engines.engine import Claims, Diverged, Engine, Plan, Start
from ..events.states import engine_states
from ..events.times import engine_events
from ..limit import limit
from ..spelled import spelled
from .answers import moved
from .ladder import wanted_reactions
from .turns import counted
from .work import pace

Samples = Mapping[str, Array]
"""By quantity, (N,); of a run that is looked at also by body, the places and attitudes (N, …)."""
Climbed = Samples | str
"""Of one rung, or why it has none."""


@dataclass(frozen=True)
class Rung:
    """One run: the engine with a plan at a step [s]. It is pickled, and needs no reference.

    bounds: what is read, and how large it may become and still be a motion. poses: whether the
    bodies' places and attitudes are kept beside it. fastest: how fast joints turn in the reference
    [rad/s], in space, where turns are counted.
    """

    case: Case
    engine: Engine
    start: Start
    plan: Plan
    step: float
    bounds: Mapping[str, float]
    poses: bool = False
    fastest: float = 0.0

    @property
    def name(self) -> str:
        """For whoever waits for it."""
        return f"{self.case.name} in {self.engine.name}.{self.engine.setting}"

    @property
    def steps(self) -> float:
        """How many the engine takes."""
        return self.case.duration / self.step

    @property
    def limit(self) -> float:
        """How long the engine may take [s]."""
        return limit(self.steps * pace(self.case, self.engine))


def climbed(rung: Rung) -> Climbed:
    """The run's samples, or in words why it has none."""
    try:
        return _run(rung) if rung.case.states is None else _answers(rung)
    except Diverged as gone:
        return spelled(gone)


def _run(rung: Rung) -> Samples:
    case, scene = rung.case, rung.case.scene
    wanted = dict.fromkeys((*rung.bounds, *told_by(case.events, case.allow)))
    run = partial(
        rung.engine.run,
        reactions=wanted_reactions(scene, wanted),
        record=bool(case.events),
    )
    trajectory = counted(
        case,
        lambda times: moved(run(scene, rung.start, times, rung.step, rung.plan), scene, times),
        rung.step,
        rung.fastest,
    )
    samples = {name: observe(scene, trajectory, name) for name in rung.bounds}
    for name, most in rung.bounds.items():
        if not np.all(np.abs(samples[name]) < most):
            raise Diverged(f"{name} reaches {np.max(np.abs(samples[name])):.1g}")
    poses = seen(trajectory) if rung.poses else {}
    return {**samples, **poses, **_events(case, trajectory)}


def seen(trajectory: Trajectory) -> Samples:
    """By body, the columns (N, 3), in space (N, 7), that tell where it is and how it is turned."""
    return {
        body: states[:, : frame_of(states.shape[1]).attitude.stop]
        for body, states in trajectory.states.items()
    }


def _answers(rung: Rung) -> Samples:
    """Of a claim about states: all of them at once, in the engine's own numbers."""
    case, engine = rung.case, rung.engine
    assert case.states is not None
    assert isinstance(engine, Claims)
    drawn = case.states.drawn(case.scene)
    found = engine.answer(case.scene, rung.start, drawn, tuple(rung.bounds))
    samples = {name: rows for name, rows in found.items() if not isinstance(rows, str)}
    for name, rows in samples.items():
        if not np.all(np.isfinite(rows)):
            raise Diverged(f"{name} is not finite")
    return samples


def _events(case: Case, trajectory: Trajectory) -> Samples:
    """What can be read from the engine's record of every event: its times (K,), as `event.time`,

    and what the case bounds of its states (K,).
    """
    found: dict[str, Array] = {}
    if trajectory.record is None:
        return found
    for name, event in case.events.items():
        with suppress(KeyError):  # a reaction that is not recorded at every step
            found[f"{name}.time"] = engine_events(case.scene, trajectory.record, event)
    for name in case.allow:
        at = at_event(name, case.events)
        if at is not None and f"{at.event}.time" in found:
            times = found[f"{at.event}.time"]
            with suppress(KeyError):
                found[name] = engine_states(case, trajectory.record, at, times)
    return found
