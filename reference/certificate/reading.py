"""How large a motion is: what the reading of its bodies' states is small against."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...cases.scene.frame import Frame
from ...cases.trajectory import Array, Trajectory
from .agreement import worst


@dataclass(frozen=True)
class Size:
    """The largest place [m], 1 rad, velocity [m/s] and rate [rad/s] of a motion, by unit.

    As two motions are compared: what is at rest is not asked for less than what would carry it
    through its own size, or through 1 rad, in the duration.
    """

    m: float
    rad: float
    speed: float
    rate: float

    def of(self, unit: str) -> float:
        """By a quantity's unit."""
        return {"m": self.m, "rad": self.rad, "m/s": self.speed, "rad/s": self.rate}[unit]

    def difference(self, unit: str, read: Array | float, wanted: Array | float) -> float:
        """The largest difference, relative to the motion's size or to what is wanted, if larger."""
        own = max(self.of(unit), worst(np.abs(np.ravel(wanted))))
        return worst(np.abs(np.ravel(np.asarray(read) - wanted))) / (own or 1.0)


def size(frame: Frame, motion: Trajectory, lengths: float, duration: float) -> Size:
    """The size of a motion, over all bodies.

    lengths [m]: on the bodies. A point of a body is as fast as its arm makes it.
    """
    states = np.concatenate(list(motion.states.values()))
    largest: Any = lambda columns: worst(np.abs(states[:, columns]).ravel())  # noqa: E731
    m, rate = max(largest(frame.place), lengths), max(largest(frame.spin), 1.0 / duration)
    rad = max(1.0, largest(frame.attitude))
    return Size(m, rad, max(largest(frame.velocity), m * rate), rate)
