"""A part with one number of dry friction, (2.88) stepped with (2.89): what engines know of it."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from textmech.cases.trajectory import Array

STEPS = 400  # a sample interval: first order, so some 1e-4 of the motion


@dataclass(frozen=True)
class OneNumber:
    """What acts beside friction [N or N m], the mass [kg or kg m²], and the bound, by the time.

    of: place, speed and friction as the case calls them.
    """

    applied: Callable[[float, float], float]
    m: float
    bound: Callable[[float], float]
    v0: float = 0.0
    damping: float = 0.0
    of: tuple[str, str, str] = ("block.x", "block.vx", "guide.friction")


@dataclass(frozen=True)
class Moved:
    """x, v and friction (N,) at the times, and when [s] it slips and stops."""

    x: Array
    v: Array
    friction: Array
    slips: list[float]
    stops: list[float]


def one_number(part: OneNumber, times: Array) -> Moved:
    """A step changes v by the applied force, then friction takes its impulse from what is left."""
    h, m = float(times[1] - times[0]) / STEPS, part.m
    x, v, rows = 0.0, part.v0, []
    slips: list[float] = []
    stops: list[float] = []
    for i in range(STEPS * (len(times) - 1) + 1):
        moved = v
        free = v + h * (part.applied(i * h, x) - part.damping * v) / m
        v = math.copysign(max(0.0, abs(free) - h * part.bound(i * h) / m), free)
        if i % STEPS == 0:
            rows.append((x, moved, (v - free) * m / h))
        x += h * v
        if (v == 0.0) != (moved == 0.0):
            (stops if v == 0.0 else slips).append((i + 1) * h)
    places, speeds, forces = np.array(rows).T
    return Moved(places, speeds, forces, slips, stops)
