"""From a switching system's motion to the states of its bodies: at the samples, and as a record."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from ...cases.trajectory import Trajectory
from ..integrators.explicit import dormand_prince
from ..integrators.implicit import radau
from ..mode import Switching
from ..system import Array
from .follow import TOGETHER, TOLERANCE, Followed, slope

BETWEEN = (
    4  # rows a sample interval: an engine's event is read from rows, the reference's at phases
)
Row = tuple[float, str, Array]  # t, mode, y (2n,)


@dataclass(frozen=True)
class Motion:
    """A switching system and how it moved."""

    system: Switching
    followed: Followed

    def trajectory(self, times: Array, y: Array | None = None) -> Trajectory:
        """The samples; of another motion y (N, 2n) through the same modes, if given."""
        y = self.followed.y if y is None else y
        return _bodies(self.system, zip(times.tolist(), self.followed.modes, y, strict=True))

    def record(self, times: Array) -> Trajectory:
        """Every event twice, as the end of a phase and as the start of the next, and between.

        `follow` keeps samples and events only; what lies between is integrated once more, without
        the search for events. A stiff motion without any has nothing between to show.
        """
        if self.system.implicit and not self.followed.changes:
            return replace(self.trajectory(times), phase=np.zeros(len(times), dtype=np.int64))
        rows = [row for phase in self._phases(times) for row in phase]
        numbers = [k for k, phase in enumerate(self._phases(times)) for _ in phase]
        return replace(_bodies(self.system, rows), phase=np.array(numbers, dtype=np.int64))

    def _phases(self, times: Array) -> list[list[Row]]:
        events = self.followed.changes
        t, mode, y = float(times[0]), *self._start()
        found = []
        for event in events:
            rows = self._phase(t, mode, y, event.time, times)
            found.append([*rows[:-1], (event.time, event.mode_before, event.before)])
            t, mode, y = event.time, event.mode_after, event.after
        return [*found, self._phase(t, mode, y, float(times[-1]), times)]

    def _start(self) -> tuple[str, Array]:
        mode, q, v = self.system.start()
        return mode, np.concatenate([q, v])

    def _phase(self, t: float, mode: str, y: Array, end: float, times: Array) -> list[Row]:
        """From one event to the next; two rows at least, though it may last no time."""
        if end - t <= TOGETHER:
            return [(t, mode, y), (end, mode, y)]
        stops = np.array([t, *times[(times > t + TOGETHER) & (times < end - TOGETHER)], end])
        pairs = pairwise(stops)
        grid = np.append([np.linspace(a, b, BETWEEN, endpoint=False) for a, b in pairs], end)
        method = radau if self.system.implicit else dormand_prince
        path = method(slope(self.system.modes[mode]), grid, y, tolerance=TOLERANCE).y
        return [(at, mode, row) for at, row in zip(grid.tolist(), path, strict=True)]


def _bodies(system: Switching, rows: Iterable[Row]) -> Trajectory:
    """The bodies' states and the reactions that the modes derive; 0 where a mode knows of none."""
    times: list[float] = []
    states: dict[str, list[Any]] = {}
    reactions: list[Mapping[str, float]] = []
    for t, mode, y in rows:
        q, v = np.split(y, 2)
        times.append(t)
        for name, pose in system.modes[mode].poses(t, q, v).items():
            states.setdefault(name, []).append(pose)
        reactions.append(system.modes[mode].reactions(t, q, v))
    names = dict.fromkeys(name for found in reactions for name in found)
    return Trajectory(
        np.array(times),
        {name: np.array(poses, float) for name, poses in states.items()},
        {name: np.array([found.get(name, 0.0) for found in reactions]) for name in names},
    )


def completed(written: Trajectory, generated: Trajectory) -> Trajectory:
    """The written motion with the reactions that only the generated one knows."""
    if len(generated.times) != len(written.times):
        return written  # another count of events: the certificate says so
    return replace(written, reactions={**generated.reactions, **written.reactions})
