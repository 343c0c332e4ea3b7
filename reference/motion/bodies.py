"""From a system's motion to the states of its bodies and to the forces between them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ...cases.scene import Scene
from ...cases.trajectory import Trajectory
from ..formalisms.derivative import along
from ..system import Array, Mode, Pose, System
from .follow import Followed, Kept
from .stuck import Stuck
from .turns import Counted, counted

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
        return self.turns.told(self._bodies(rows, forces=True))

    @cached_property
    def turns(self) -> Counted:
        """The turns of joints in space, counted along the march."""
        return counted(self.scene, self.system, self.followed) if self.scene else Counted()

    def march(self, *, forces: bool) -> Trajectory:
        """The start and the ends of all steps, with reactions or without: closer than samples.

        Raises Stuck as `trajectory` does.
        """
        return self._phased(self.followed.march, forces=forces)

    def record(self, *, forces: bool) -> Trajectory:
        """The rows that were kept on the way, with reactions or without."""
        return self._phased(self.followed.rows, forces=forces)

    def _phased(self, rows: Sequence[Kept], *, forces: bool) -> Trajectory:
        phase = np.array([row[1] for row in rows], dtype=np.int64)
        return self.turns.told(replace(self._bodies(rows, forces=forces), phase=phase))

    def _bodies(self, rows: Iterable[Kept], *, forces: bool) -> Trajectory:
        times: list[float] = []
        states: dict[str, list[Any]] = {}
        reactions: list[Mapping[str, float]] = []
        for t, phase, y in rows:
            mode = self.system.modes[self.followed.phases[phase]]
            q, v = mode.parted(y)
            poses = mode.poses(t, q, v)
            times.append(t)
            inner = {name: pose[0] for name, pose in poses.items() if len(pose) == 1}
            for name, pose in poses.items():
                if name not in inner:
                    states.setdefault(name, []).append(pose)
            if forces or inner:
                try:
                    found = {**self.beside(phase, t, poses), **mode.reactions(t, q, v)}
                except ArithmeticError as error:
                    raise Stuck(str(error), mode, t, y) from error
                if self.accelerates:
                    found |= accelerations(mode, t, q, v)
                reactions.append(found | inner)
        names = dict.fromkeys(name for found in reactions for name in found)
        return Trajectory(
            np.array(times),
            {name: np.array(poses, float) for name, poses in states.items()},
            {name: np.array([found.get(name, 0.0) for found in reactions]) for name in names},
        )


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
