"""The book's approximations of Examples 2.3 and 2.4 as motions, like those of an engine."""

from collections.abc import Callable
from dataclasses import asdict, replace

import numpy as np

from ...cases.trajectory import VX, Trajectory, X
from ..motion.bodies import Answer
from ..motion.follow import follow
from ..system import Array, Mode, Only, System
from ..systems.friction.dynamometer import Dynamometer
from ..systems.friction.growing_force import GrowingForce
from ..systems.friction.smooth_friction import SmoothDynamometer, SmoothGrowingForce
from .karnopp import Karnopp, boxcars

KINDS = ("karnopp", "boxcar", "smooth")
DELTA = 5e-4  # m/s, the book's band in both examples
A = 1e5  # s/m, and its sharpness

Example = GrowingForce | Dynamometer
_SMOOTH: dict[type, Callable[..., Mode]] = {
    GrowingForce: SmoothGrowingForce,
    Dynamometer: SmoothDynamometer,
}


def approximated(kind: str, system: Example, times: Array, step: float) -> Trajectory:
    """The motion by (2.91), (2.94) or (2.95) at the times, with the record its events need.

    Only the boxcar is stepped, by `step` [s]; the others are followed as exactly as the law is.
    """
    if kind == "boxcar":
        return _stepped(system, times, step)
    if kind == "karnopp":
        other: System = Karnopp(system.m, system.pull, system.dry, DELTA, literal=True)
    else:
        other = Only(_SMOOTH[type(system)](**asdict(system), Delta=DELTA, A=A))
    motion = Answer(other, follow(other, times, every=True))
    return replace(motion.trajectory(times), record=motion.record(forces=False))


def _stepped(system: Example, times: Array, step: float) -> Trajectory:
    every = round((times[1] - times[0]) / step)
    steps = every * (len(times) - 1)
    xv = boxcars(system.m, system.pull.F_a, system.dry, Delta=DELTA, h=step, steps=steps)
    states = np.zeros((steps + 1, 6))
    states[:, [X, VX]] = xv
    record = Trajectory(np.arange(steps + 1) * step, {"block": states}, {})
    record = replace(record, phase=np.zeros(steps + 1, dtype=np.int64))
    return Trajectory(times, {"block": states[::every]}, {}, record)
