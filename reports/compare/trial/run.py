"""One run of a trial: a rung of a ladder, which needs nothing but itself."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, cast

import numpy as np

from ....cases.case import Case
from ....cases.scene.observe import motion_of, observe
from ....cases.scene.quantity import at_event, needed_by_events
from ....cases.trajectory import Array, Trajectory
from ....engines.engine import Claims, Diverged, Engine, Plan, Start
from ..events.states import engine_states
from ..events.times import Known, engine_events
from .answers import claimed, moved
from .ladder import wanted_reactions
from .limit import limit
from .table_text import spelled
from .work import pace

Samples = Mapping[str, Array]
"""By quantity, (N,); of a run that is looked at also by body, its states (N, 6) or (N, 13)."""
Climbed = Samples | str
"""Of one rung, or why it has none."""


@dataclass(frozen=True)
class Rung:
    """One run: the engine with a plan at a step [s]. It is pickled, and needs no reference.

    bounds: what is read, and how large it may become and still be a motion. poses: whether the
    bodies' states are kept beside it. fastest: how fast joints turn in the reference
    [rad/s], in space, where turns are counted. events: what is known of each from the reference.
    """

    case: Case
    engine: Engine
    start: Start
    plan: Plan
    step: float
    bounds: Mapping[str, float]
    poses: bool = False
    fastest: float = 0.0
    events: Mapping[str, Known] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The name that progress shows."""
        return f"{self.case.name} in {self.engine.name}.{self.engine.setting}"

    @property
    def steps(self) -> float:
        """The number of steps that the engine takes."""
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
    case, late, scene = rung.case, rung.case.late, rung.case.scene
    # An engine starts at 0, whenever that is.
    acting = scene.later(late) if late else scene
    case = replace(case, late=0.0) if late else case
    wanted = dict.fromkeys((*rung.bounds, *needed_by_events(case.events, case.allow)))
    run = partial(
        rung.engine.run,
        reactions=wanted_reactions(scene, wanted),
        record=bool(case.events),
    )
    trajectory = counted(
        case,
        # A copy: an engine that changes what it is given must not change what it is asked for.
        lambda times: moved(
            run(acting, rung.start, times.copy(), rung.step, rung.plan), scene, times
        ),
        rung.step,
        rung.fastest,
    )
    trajectory = _later(trajectory, late)
    samples = {name: observe(scene, trajectory, name) for name in rung.bounds}
    for name, most in rung.bounds.items():
        if not np.all(np.abs(samples[name]) < most):
            raise Diverged(f"{name} reaches {np.max(np.abs(samples[name])):.1g}")
    states = trajectory.states if rung.poses else {}
    return {**samples, **states, **_events(rung, trajectory)}


def _later(trajectory: Trajectory, late: float) -> Trajectory:
    """The trajectory, each time [s] so much later."""
    if not late:
        return trajectory
    record = trajectory.record and _later(trajectory.record, late)
    return replace(trajectory, times=trajectory.times + late, record=record)


def _answers(rung: Rung) -> Samples:
    """Samples of a claim about states: all of them at once, in the engine's own numbers."""
    case, engine = rung.case, rung.engine
    assert case.states is not None
    assert isinstance(engine, Claims)
    drawn = case.states.drawn(case.scene)
    wanted = tuple(rung.bounds)
    answer = engine.answer(case.scene, rung.start, drawn, wanted)
    samples = claimed(answer, wanted, case.scene, case.samples)
    for name, rows in samples.items():
        if not np.all(np.isfinite(rows)):
            raise Diverged(f"{name} is not finite")
    return samples


def _events(rung: Rung, trajectory: Trajectory) -> Samples:
    """Times (K,) of every event, as `event.time`, and states (K,) at it, from the engine's record.

    The states are those that the case bounds; what cannot be read from the record is left out.
    """
    samples: dict[str, Array] = {}
    case, record = rung.case, trajectory.record
    if record is None:
        return samples
    for name, event in case.events.items():
        with suppress(KeyError):  # a reaction that is not recorded at every step
            known = rung.events.get(name)
            samples[f"{name}.time"] = engine_events(case.scene, record, event, known)
    for name in case.allow:
        at = at_event(name, case.events)
        if at is not None and f"{at.event}.time" in samples:
            times = samples[f"{at.event}.time"]
            with suppress(KeyError):
                samples[name] = engine_states(case, record, at, times)
    return samples


# How an engine's turns in space are counted: attitudes tell none, and samples may be far apart.
#
# Where the reference turns by more than a radian between two samples, the engine is asked in
# between too; its own rates then say how far it went, up to three times as fast as the reference
# does.


FAR = 1.0  # rad from one row to the next: a third of the half turn that can be told

Run = Callable[[Array], Trajectory]
"""The motion at the times."""


def counted(case: Case, run: Run, step: float, fastest: float) -> Trajectory:
    """The motion at the case's times, with the turns that it makes between them.

    fastest: how fast the reference turns [rad/s]; step [s] of the engine.
    """
    each = between(case.interval, step, fastest)
    if each == 1:
        return run(case.times)
    rows = (case.samples - 1) * each + 1
    finer = run(np.arange(rows, dtype=np.float64) * (case.interval / each))
    motion, joints = motion_of(case.scene, finer), cast(Any, case.scene.joints)
    return replace(
        finer,
        times=case.times,
        states={name: states[::each] for name, states in finer.states.items()},
        reactions={name: values[::each] for name, values in finer.reactions.items()},
        near={
            name: joint.turned(motion).angles[::each]
            for name, joint in joints.items()
            if joint.counts
        },
    )


def between(interval: float, step: float, fastest: float) -> int:
    """Into how many equal parts of whole steps a sample interval is cut, at the least."""
    steps = max(1, round(interval / step))
    parts = (n for n in range(1, steps + 1) if steps % n == 0)
    return next((n for n in parts if fastest * interval <= FAR * n), steps)
