"""How an engine's turns in space are counted: attitudes tell none, and samples may be far apart.

Where the reference turns by more than a radian between two samples, the engine is asked in between
too; its own rates then say how far it went, up to three times as fast as the reference does.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, cast

import numpy as np

from ...cases.case import Case
from ...cases.scene.observe import motion_of
from ...cases.trajectory import Array, Trajectory

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
