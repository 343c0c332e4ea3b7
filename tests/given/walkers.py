"""Walkers from one strike to the next."""

import numpy as np

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, System

SLOPE = 0.009  # rad
LONGEST = 4.6  # s: of a step, in units in which one takes 3.9


def returned(
    walker: System, entries: tuple[int, ...], *, until: float = LONGEST
) -> tuple[Array, float]:
    """Entries of (q, v) after the next strike, and its time [s]. Raises IndexError without one."""
    strike = follow(walker, np.array([0.0, until])).events[0]
    return strike.after[list(entries)], strike.time
