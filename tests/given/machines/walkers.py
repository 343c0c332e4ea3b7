"""Walkers from one strike to the next."""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, System
from textmech.reference.systems.walkers.compass_walker import CompassWalker

SLOPE = 0.009  # rad, of the simplest walker
DOWN = 0.02  # rad, of the compass walker
LONGEST = 4.6  # s: of a step, in units in which one takes 3.9


def returned(
    walker: System, entries: tuple[int, ...], *, until: float = LONGEST
) -> tuple[Array, float]:
    """Entries of (q, v) after the next strike, and its time [s]. Raises IndexError without one."""
    strike = follow(walker, np.array([0.0, until])).events[0]
    return strike.after[list(entries)], strike.time


ENTRIES = (1, 5, 4)  # after a strike on the right leg: its partner's lean, and the rates of both
UP = math.pi / 2
# Near the limit cycle on a slope of 0.02.
WALKER = CompassWalker(10.0, 5.0, 1.0, DOWN, 1.0, UP + 0.2135, UP - 0.2135, 0.8617, 0.6753)


@dataclass(frozen=True)
class Legs(CompassWalker):
    """Legs that are no bars."""

    center: float
    inertia: float

    @property
    def c(self) -> float:
        return self.center

    @property
    def J(self) -> float:
        return self.inertia


UNEVEN = Legs(7.0, 1.3, 0.9, 0.05, 1.0, UP + 0.3, UP - 0.3, 1.1, 0.2, 0.35, 0.06)


def begun(walker: CompassWalker, x: Array) -> Any:
    """With both feet on the floor, the left leg leaning back by x₀, and both rates."""
    a0, w0, u0 = map(float, x)
    return replace(walker, left0=UP + a0, right0=UP - a0, w0=w0, u0=u0)
