"""From a system's motion to the states of its bodies and to the forces between them."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from ...cases.scene import Scene
from ...cases.scene.chain import Turns
from ...cases.scene.counting import THREE, ambiguous_turns
from ...cases.scene.frame import SPACE
from ...cases.scene.observe import motion_of
from ...cases.trajectory import Trajectory
from ..coverage import equation
from ..formalisms.derivative import along
from ..system import Array, Mode, Pose, System
from .follow import Change, Followed, Kept, rows_at
from .stuck import Stuck, slope

JUMPS = 1e-6  # of the fastest rate: what stops is set to rest by less, an impact jumps by more

# The turns of joints in space, counted along the steps of the march: attitudes tell none.
#
# Between two steps the states are those of the cubic through both and their slopes, wherever a
# joint goes too far from one to the next to be counted: good to 1e-4 of what changes, and enough.


ROUNDS = 24  # halvings of what is too far: gimbal lock is met then, or passed by
# rad: three turns that go so near to gimbal lock jump there by half turns, or do not, by what the
# cubic between two steps is off, but where they go straight through: then the others hardly turn.
NEAR, STRAIGHT = 1e-4, 1e-6
MISSED = 1e-9  # of a cosine: far above its rounding, and a turn's width of 4e-5 rad


@dataclass(frozen=True)
class Counted:
    """The turns [rad] of each joint (M, K) at times (M,), which are close enough to be counted.

    rates: theirs [rad/s]. lost: whether it cannot be told which way three turns go. missed: a joint
    whose three turns cannot make its attitude, and when [s].
    """

    times: Array = field(default_factory=lambda: np.zeros(1))
    angles: dict[str, Array] = field(default_factory=dict)
    rates: dict[str, Array] = field(default_factory=dict)
    lost: bool = False
    missed: tuple[str, float] | None = None

    def with_turns(self, motion: Trajectory) -> Trajectory:
        """The motion, with the counted turns at its own times."""
        near = {name: self._at(motion.times, angles) for name, angles in self.angles.items()}
        return replace(motion, near=near, fastest=self.fastest)

    def _at(self, times: Array, columns: Array) -> Array:
        return np.stack([np.interp(times, self.times, column) for column in columns.T], axis=1)

    @property
    def fastest(self) -> float:
        """Largest rate of any turn [rad/s]."""
        return max((float(np.max(np.abs(rates))) for rates in self.rates.values()), default=0.0)

    def unrolled(self) -> float:
        """How far [rad] any turn is from the integral of its rate, from the start on.

        Infinite where it cannot be told which way three turns go.
        """
        if self.lost:
            return math.inf
        dt = np.diff(self.times)[:, None]
        off = [0.0]
        for name, rates in self.rates.items():
            summed = np.cumsum(0.5 * (rates[1:] + rates[:-1]) * dt, axis=0)
            off.append(float(np.max(np.abs(self.angles[name][1:] - self.angles[name][0] - summed))))
        return max(off)


def counted(scene: Scene, system: System, followed: Followed) -> Counted:
    """Counts the turns of joints along a motion in space; in the plane a state has them."""
    space = scene.frame is SPACE
    every: Any = scene.joints.values() if space else ()
    joints = [joint for joint in every if joint.counts]
    if not joints:
        return Counted()
    rows = [_Row(i, *kept) for i, kept in enumerate(followed.march)]
    bare = [_poses(system, followed, row) for row in rows]
    times, by_joint = _count_turns(scene, joints, rows, bare)
    for _ in range(ROUNDS):
        wide = np.any([ambiguous_turns(turns, times) for turns in by_joint.values()], axis=0)
        if not wide.any():
            break
        rows, bare = _refine(system, followed, rows, bare, wide.tolist())
        times, by_joint = _count_turns(scene, joints, rows, bare)
    return Counted(
        times,
        {name: turns.angles for name, turns in by_joint.items()},
        {name: turns.rates for name, turns in by_joint.items()},
        any(_lost(turns) for turns in by_joint.values()),
        _first_miss(times, by_joint),
    )


def _lost(turns: Turns) -> bool:
    near = turns.free < NEAR
    if turns.angles.shape[1] < THREE or not near.any():
        return False
    return bool(np.any(turns.aside[near] > STRAIGHT * np.abs(turns.rates[near, 1])))


def _first_miss(times: Array, by_joint: Mapping[str, Turns]) -> tuple[str, float] | None:
    for name, turns in by_joint.items():
        beyond = np.broadcast_to(turns.missed > MISSED, times.shape)
        if beyond.any():
            return name, float(times[np.argmax(beyond)])
    return None


@dataclass(frozen=True)
class _Row:
    """A state on the way: step: the number of the last step of the march that is not behind it."""

    step: int
    t: float
    phase: int
    y: Array


def _poses(system: System, followed: Followed, row: _Row) -> Any:
    mode = system.modes[followed.phases[row.phase]]
    return mode.poses(row.t, *mode.parted(row.y))


def _count_turns(
    scene: Scene, joints: list[Any], rows: list[_Row], bare: list[Any]
) -> tuple[Array, dict[str, Turns]]:
    """The times, and the turns of each joint as they are counted from row to row."""
    times = np.array([row.t for row in rows])
    states = {name: np.array([poses[name] for poses in bare], float) for name in scene.bodies}
    motion = motion_of(scene, Trajectory(times, states, {}))
    return times, {joint.name: joint.turned(motion) for joint in joints}


def _refine(
    system: System, followed: Followed, rows: list[_Row], bare: list[Any], wide: list[bool]
) -> tuple[list[_Row], list[Any]]:
    """The rows with one more in the middle of each interval that is too wide."""
    kept, poses = rows[:1], bare[:1]
    for row, after, pose, is_wide in zip(rows[:-1], rows[1:], bare[1:], wide, strict=True):
        middle = (row.t + after.t) / 2
        if is_wide and row.t < middle < after.t and row.phase == after.phase:
            kept.append(_inside(system, followed, row.step, middle))
            poses.append(_poses(system, followed, kept[-1]))
        kept.append(after)
        poses.append(pose)
    return kept, poses


def _inside(system: System, followed: Followed, step: int, t: float) -> _Row:
    (t0, phase, y0), (t1, _, y1) = followed.march[step : step + 2]
    f, h = slope(system.modes[followed.phases[phase]]), t1 - t0
    k0, k1, s = h * f(t0, y0), h * f(t1, y1), (t - t0) / h
    y = y0 + s * ((y1 - y0) * s * (3 - 2 * s) + (1 - s) * (k0 * (1 - s) - k1 * s))
    return _Row(step, t, phase, y)


Beside = Callable[[int, float, Mapping[str, Pose]], Mapping[str, float]]
"""(number of the phase, t, poses) → reactions that somebody else derives for the same motion."""


@dataclass(frozen=True)
class Answer:
    """A system, how it moved, and who derives the reactions that it does not know itself.

    accelerates: whether its bodies' accelerations are asked for too. scene: of which the turns of
    joints are counted; None: of nothing.
    """

    system: System
    followed: Followed
    beside: Beside = lambda phase, t, poses: {}
    accelerates: bool = False
    scene: Scene | None = None

    def trajectory(self, times: Array, y: Array | None = None) -> Trajectory:
        """The samples; of another motion y (N, ·) through the same phases, if given.

        Raises Stuck at a sample where reactions are not determined.
        """
        y = self.followed.y if y is None else y
        phases = self.followed.phase.tolist()
        rows = zip(times.tolist(), phases, y, strict=True)
        return self.turns.with_turns(self._bodies(rows, forces=True))

    def at(self, times: Array, *, forces: bool) -> Trajectory:
        """The motion at any times [s] up to the last sample, with reactions or without."""
        return self.along(rows_at(self.system, self.followed, times), forces=forces)

    def blows(self) -> list[Change]:
        """Returns the changes of mode at which rates jump, as those of an impact do."""
        parted = lambda mode, y: self.system.modes[mode].parted(y)[1]  # noqa: E731
        jumps = [
            float(np.max(np.abs(parted(c.mode_after, c.after) - parted(c.mode_before, c.before))))
            for c in self.followed.changes
        ]
        rates = [np.abs(parted(self.followed.phases[k], y)) for _, k, y in self.followed.march]
        least = JUMPS * max(float(np.max(each, initial=0.0)) for each in rates)
        return [c for c, jump in zip(self.followed.changes, jumps, strict=True) if jump > least]

    @cached_property
    def turns(self) -> Counted:
        """The turns of joints in space, counted along the march."""
        return counted(self.scene, self.system, self.followed) if self.scene else Counted()

    def march(self, *, forces: bool) -> Trajectory:
        """The start and the ends of all steps, with reactions or without: closer than samples.

        Raises Stuck as `trajectory` does.
        """
        return self.along(self.followed.march, forces=forces)

    def record(self, *, forces: bool) -> Trajectory:
        """The rows that were kept on the way, with reactions or without."""
        return self.along(self.followed.rows, forces=forces)

    def along(self, rows: Sequence[Kept], *, forces: bool = True) -> Trajectory:
        """The motion at any rows of it."""
        phase = np.array([row[1] for row in rows], dtype=np.int64)
        return self.turns.with_turns(replace(self._bodies(rows, forces=forces), phase=phase))

    def _bodies(self, rows: Iterable[Kept], *, forces: bool) -> Trajectory:
        times: list[float] = []
        states: dict[str, list[Any]] = {}
        reactions: list[Mapping[str, float]] = []
        for t, phase, y in rows:
            mode = self.system.modes[self.followed.phases[phase]]
            q, v = mode.parted(y)
            poses = mode.poses(t, q, v)
            times.append(t)
            t = self.followed.still(t, phase)
            inner = {name: pose[0] for name, pose in poses.items() if len(pose) == 1}
            for name, pose in poses.items():
                if name not in inner:
                    states.setdefault(name, []).append(pose)
            if forces or inner:
                try:
                    values = {**self.beside(phase, t, poses), **mode.reactions(t, q, v)}
                except ArithmeticError as error:
                    raise Stuck(str(error), mode, t, y) from error
                if self.accelerates:
                    values |= accelerations(mode, t, q, v)
                reactions.append(values | inner)
        names = dict.fromkeys(name for values in reactions for name in values)
        return Trajectory(
            np.array(times),
            {name: np.array(poses, float) for name, poses in states.items()},
            {name: np.array([values.get(name, 0.0) for values in reactions]) for name in names},
        )


@equation
def accelerations(mode: Mode, t: float, q: Array, v: Array) -> dict[str, float]:
    """(2.22) ẍ, ÿ and φ̈ of each body, by quantity: the change of the velocities in its pose."""

    def velocities(t: Any, q: Any, v: Any) -> Any:
        return np.array([pose[3:] for pose in mode.poses(t, q, v).values() if len(pose) > 1])

    names = [name for name, pose in mode.poses(t, q, v).items() if len(pose) > 1]
    rates = (1.0, mode.rates(t, q, v), mode.accelerations(t, q, v))
    changes = along(velocities, (t, q, v), rates).tolist()
    fields = ("ax", "ay", "alpha")
    return {
        f"{name}.{field}": a
        for name, row in zip(names, changes, strict=True)
        for field, a in zip(fields, row, strict=True)
    }
