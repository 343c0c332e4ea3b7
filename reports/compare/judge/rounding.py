"""Bounds what rounding alone does to a number: digits below it are another machine's, not written.

Two machines with the same versions differ by the last bit of a sine or of a sum of products. Over
a run it grows: by one unit a step in what is integrated, and in a force that a step makes of
places by m/h².
"""

import numpy as np

from ..trial.trial import Trial

EPSILON = 2.2e-16
MARGIN = 10  # × the estimate; measured: below 0.2 × it, but 90 × in a linkage near its dead point


def floor(trial: Trial, name: str, step: float) -> float:
    """The difference in the quantity `name` that rounding can make in a run with steps [s]."""
    steps = trial.case.duration / step
    if trial.quantity(name).kind == "event":
        return MARGIN * EPSILON * trial.case.duration * steps
    made = _size(trial, name) * steps
    if trial.quantity(name).kind == "force":
        mass = sum(body.mass for body in trial.case.scene.bodies.values())
        made += mass * _largest(trial, "m") / step**2
    return MARGIN * EPSILON * made


def _size(trial: Trial, name: str) -> float:
    """The size of what the quantity is made of: all places, if it is one; both kinds of energy."""
    quantity = trial.quantity(name)
    if quantity.part == "energy":
        parts = ("energy.kinetic", "energy.potential")
        return max(float(np.max(np.abs(trial.wanted(part)))) for part in parts)
    known = max(trial.size(name), _largest(trial, quantity.unit))
    if quantity.unit == "rad" and known < MARGIN * EPSILON:
        return 1.0  # an angle that stays 0 is made of points, as its cosine is
    return known


def _largest(trial: Trial, unit: str) -> float:
    """The largest place or rate of the reference's motion with the unit; 0 for any other unit."""
    columns = trial.case.scene.frame.alike(unit)
    states = trial.reference.states.values()
    return max((float(np.max(np.abs(s[:, columns]), initial=0.0)) for s in states), default=0.0)
