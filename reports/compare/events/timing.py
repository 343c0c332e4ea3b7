"""When the events of a reference happen, and what steps of some size can tell of them.

Every rung of every engine asks the same, so that it is computed once for all of them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ....cases.case import Case
from ....cases.trajectory import Array, Trajectory
from ....reference.solve import motion_of
from .times import Known, certain_events, nearest, reading, reference_events


@dataclass(frozen=True)
class Timing:
    """The events of a case in the record of its reference; without a record there are none."""

    case: Case
    record: Trajectory | None

    @cached_property
    def events(self) -> dict[str, Array]:
        """The reference's times (K,) [s] of every event."""
        if self.record is None:
            return {name: np.zeros(0) for name in self.case.events}
        return {
            name: reference_events(self.case.scene, self.record, event)
            for name, event in self.case.events.items()
        }

    def surely(self, event: str, step: float) -> NDArray[np.int64]:
        """Which of the reference's events an engine with this step [s] has to tell."""
        if self.record is None:
            return np.arange(0)
        if (event, step) not in self._sure:
            known = self.known(step)[event]
            self._sure[event, step] = certain_events(
                self.case.scene, self.record, self.case.events[event], known, step
            )
        return self._sure[event, step]

    def miscounted(self, event: str, count: int, step: float) -> float | None:
        """By how many an engine's events are fewer than such steps tell, or more than there are.

        None where they are fewer than there are, and such steps tell no more of them for sure.
        """
        most = len(self.events[event])
        if count >= most:
            return float(count - most)
        missing = len(self.surely(event, step)) - count
        return float(missing) if missing > 0 else None

    def partners(self, event: str, times: Array) -> NDArray[np.int64]:
        """Which of the reference's events an engine's, at these times [s], are compared with.

        Where it has fewer they are the nearest, in order; of more than there are the first.
        """
        wanted = self.events[event]
        return nearest(times, wanted) if len(times) < len(wanted) else np.arange(len(wanted))

    def known(self, step: float) -> dict[str, Known]:
        """How each event is read from such steps [s], and when it happens or might."""
        if self.record is None:
            return {}
        if step not in self._known:
            self._known[step] = {
                name: reading(self.case.scene, self.record, event, self.events[name], step)
                for name, event in self.case.events.items()
            }
        return self._known[step]

    @cached_property
    def motion(self) -> Callable[[Array], Trajectory]:
        """The reference's motion at any times [s] up to its end."""
        return motion_of(self.case)

    @cached_property
    def around(self) -> dict[tuple[float, tuple[float, ...]], Trajectory]:
        """The reference around impacts, by the step and the impacts [s], as far as asked for."""
        return {}

    @cached_property
    def later(self) -> "dict[float, tuple[Case, Trajectory, Timing]]":
        """The case from a time [s] on, its motion and events, as far as that was asked for."""
        return {}

    @cached_property
    def _sure(self) -> dict[tuple[str, float], NDArray[np.int64]]:
        return {}

    @cached_property
    def _known(self) -> dict[float, dict[str, Known]]:
        return {}


def timing(case: Case, reference: Trajectory) -> Timing:
    """The timing of a case's events in its reference."""
    return Timing(case, reference.record)
