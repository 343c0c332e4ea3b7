"""Every step of a run, from which event times are read.

It must cost little beside the step itself: pymunk copies all bodies in one call, one copy after
the other, and what the copies mean is worked out when the run is over.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from pymunk.batch import BodyFields, Buffer, get_space_bodies

from ....cases.scene.observe import observe
from ....cases.trajectory import Array, Trajectory
from ..model.chipmunk_state import copier
from ..model.world import World
from .impulse import impulses

_STATE = BodyFields.POSITION | BodyFields.ANGLE | BodyFields.VELOCITY | BodyFields.ANGULAR_VELOCITY
SETTLED = 4  # steps after which two impulses are sound
ROUNDING = 1e-12  # m: what rests on the floor stands that near to it, on either side
_BUFFER = Buffer()  # one for all runs: pymunk never frees a buffer's memory


@dataclass(frozen=True)
class Record:
    """Steps that are recorded: `keep` keeps the present states, `trajectory` is what they were.

    forces: the quantities of contacts of which the impulses are kept too. cut: whether a step is
    where a foot comes down.
    """

    world: World
    step: float
    midpoint: bool
    forces: tuple[str, ...] = ()
    cut: bool = False
    keep: Callable[[], None] = field(init=False)
    _felt: list[list[float]] = field(init=False, default_factory=list)

    def __post_init__(self) -> None:
        _BUFFER.clear()
        copy, read = copier(self.world.space, _STATE, _BUFFER), impulses(self.world, self.forces)

        def both() -> None:
            copy()
            self._felt.append(read())

        object.__setattr__(self, "keep", both if self.forces else copy)
        self.keep()

    def trajectory(self) -> Trajectory:
        """A row for the start and for each step, and one in the middle of a step that bounces.

        One phase, as an engine knows of none.
        """
        order = Buffer()
        get_space_bodies(self.world.space, BodyFields.BODY_ID, order)
        numbers = np.frombuffer(order.int_buf(), np.uintp).tolist()
        rows = np.frombuffer(_BUFFER.float_buf()).reshape(-1, len(numbers), 6).copy()
        rows = rows[:, [numbers.index(body.id) for body in self.world.bodies.values()]]
        times = np.arange(len(rows), dtype=np.float64) * self.step
        forces = self._forces(len(rows))
        if self.midpoint:
            rows, times, after = self._ahead(rows, times)
            forces = np.insert(forces, after, forces[after], axis=0)
        reactions = {name: forces[:, i] for i, name in enumerate(self.forces)}
        return replace(self._named(rows, times), reactions=reactions)

    def _forces(self, count: int) -> Array:
        """(count, forces) [N] at the times of the velocities.

        An impulse acts over the middle of its step: at midpoint between two steps their mean is
        meant, else what a user sees after the step. The first two steps settle, as for samples.
        """
        if not self.forces:
            return np.zeros((count, 0))
        felt = np.array(self._felt) / self.step
        felt[0] = felt[min(1, len(felt) - 1)]  # before the first step nothing is felt
        if self.midpoint and len(felt) > SETTLED:
            slope = felt[SETTLED] - felt[SETTLED - 1]
            begins = felt[SETTLED - 1] - np.arange(2.5, -0.5, -1.0)[:, None] * slope
            felt[SETTLED - 1 : -1] = (felt[SETTLED - 1 : -1] + felt[SETTLED:]) / 2
            felt[: SETTLED - 1] = begins
        return felt

    def _ahead(self, rows: Array, times: Array) -> tuple[Array, Array, NDArray[np.intp]]:
        """Positions at the times of the velocities, half a step ahead.

        Where a body bounces, it is in the floor only in the middle of the step: both rows around
        it stand above. There the middle is kept too, with the velocities before the impact. Third
        are the rows before which the middles stand. A step that is cut where a foot strikes has
        no such middle: half a step back along its velocities behind the impact no body ever was.
        """
        middle = rows[1:].copy()
        middle[:, :, 3:] = rows[:-1, :, 3:]
        rows[:, :, :3] += self.step / 2 * rows[:, :, 3:]
        lost = np.zeros(len(middle), bool)
        scene = self.world.scene
        for contact in () if self.cut else (*scene.contacts, *scene.pairs):
            gap = observe(scene, self._named(rows, times), f"{contact}.gap")
            dip = observe(scene, self._named(middle, times[1:]), f"{contact}.gap")
            lost |= (dip <= 0) & (gap[:-1] > ROUNDING) & (gap[1:] > ROUNDING)
        after = np.flatnonzero(lost) + 1
        rows = np.insert(rows, after, middle[lost], axis=0)
        return rows, np.insert(times, after, times[after] - self.step / 2), after

    def _named(self, rows: Array, times: Array) -> Trajectory:
        states = {name: rows[:, i] for i, name in enumerate(self.world.bodies)}
        return Trajectory(times, states, {}, phase=np.zeros(len(rows), np.int64))
