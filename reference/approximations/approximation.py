"""The book's approximations of Examples 2.3 and 2.4 as motions, like those of an engine."""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np

from ...cases.trajectory import VX, Trajectory, X
from ..coverage import equation
from ..laws.friction import Dry, boxcar
from ..motion.bodies import Answer
from ..motion.follow import follow
from ..system import Array, Guard, Mode, Only, System
from ..systems.friction.dynamometer import Dynamometer
from ..systems.friction.growing_force import GrowingForce
from ..systems.friction.smooth_friction import SmoothDynamometer, SmoothGrowingForce
from ..systems.friction.stick_slip import Pull, guards, modes

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


# The book's approximations of dry friction as producers of motions, to be compared with the law.
#
# The smooth law (2.95) makes a system of its own, `systems/smooth_friction`.


@dataclass(frozen=True)
class Karnopp(System):
    """A block m [kg] at rest at x = 0, with the band |v| ≤ Δ [m/s] in place of v = 0.

    Taken literally it keeps in the band the v with which it sticks; by Karnopp's own rule v := 0.
    """

    m: float
    pull: Pull
    dry: Dry
    Delta: float
    literal: bool

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", modes(self.m, self.pull, self.dry))

    def start(self) -> tuple[str, Array, Array]:
        """At rest at x = 0, where it must stick."""
        return "stuck", np.zeros(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.91) `slips` and `stops`."""
        return guards(self.pull, self.dry, mode, Delta=self.Delta, keeps_v=self.literal)


@equation
def boxcars(
    m: float,
    F_a: Callable[[float, float], float],
    dry: Dry,
    *,
    Delta: float,
    h: float,
    steps: int,
) -> Array:
    """(2.94) with (2.93) in steps of h [s] from rest: x and v at every step, (steps + 1, 2).

    But for the edges it is (2.91) taken literally, and for h → 0 so is its motion.
    """
    return stepped(
        m, F_a, lambda v, f: boxcar(dry, Delta, v, f), h=h, steps=steps, rests=lambda *_: False
    )


# The second answer for motions that switch: the law of friction itself, in small equal steps.
#
# No modes and no guards: at every step the friction is what the law says at that v and F_a.


@equation
def stepped(
    m: float,
    F_a: Callable[[float, float], float],
    F_fr: Callable[[float, float], float],
    *,
    start: tuple[float, float] = (0.0, 0.0),
    h: float,
    steps: int,
    rests: Callable[[float, float, float], bool] = lambda v, after, F_a: v * after < 0.0,
) -> Array:
    """(2.88) ẋ = v, m v̇ = F_a(t, x) + F_fr(v, F_a): x and v at every step, (steps + 1, 2).

    A float jumps over v = 0, where (2.89) sticks: `rests(v, v after the step, F_a)` says when the
    step ends at v = 0. By itself, where v changes sign.
    """
    x, v = start
    rows = [(x, v)]
    for k in range(steps):
        force = F_a(k * h, x)
        after = v + h * (force + F_fr(v, force)) / m
        if rests(v, after, force):
            after = 0.0
        x, v = x + h * (v + after) / 2, after
        rows.append((x, v))
    return np.array(rows)


def arrest(series: Array, h: float) -> list[tuple[str, float]]:
    """`slips` and `stops` with their times [s]: where v leaves zero and where it comes back.

    v = 0 at one single step is a turning point.
    """
    moving = series[:, 1] != 0.0
    moving[1:-1] |= moving[:-2] & moving[2:]
    turns = np.flatnonzero(moving[1:] != moving[:-1])
    return [("stops" if moving[k] else "slips", math.fsum((k, moving[k])) * h) for k in turns]
