"""The size of a difference between two motions, where it is largest, and its digits."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....cases.scene.frame import PLANE
from ....cases.trajectory import Array
from ..trial.trial import Trial

AS_LARGE = 0.999  # of the largest: a constant error is largest at its first sample, not at a random


@dataclass(frozen=True)
class Error:
    """A difference over the samples: its largest, its root mean square, and the last one."""

    largest: float
    rms: float
    final: float
    at: int  # the first sample where it is the largest, to three digits


def error(samples: Array, reference: Array) -> Error:
    """The error of samples (N,) against the reference (N,); for attitudes (N, 3) each."""
    d = sizes(samples - reference)
    largest = float(np.max(d))
    first = int(np.argmax(~(d < AS_LARGE * largest)))  # of NaN nothing is smaller
    return Error(largest, float(np.sqrt(np.mean(d * d))), float(d[-1]), first)


def sizes(d: Array) -> Array:
    """Returns the sizes (N,) of differences (N,), or the angles of turns (N, 3)."""
    return np.abs(d) if d.ndim == 1 else np.linalg.norm(d, axis=1)


def largest(d: Array) -> float:
    """Returns the largest size of the differences."""
    return float(np.max(sizes(d)))


def round_to_floor(number: float, floor: float) -> float:
    """The number to the digits above the floor's power of ten; below it 0."""
    if not (math.isfinite(number) and 0 < floor < math.inf):
        return number
    return round(number, _digits(floor)) + 0.0  # a zero has no sign: rounding alone decides it


def round_up_to_floor(number: float, floor: float) -> float:
    """The number to the digits above the floor, but never less than one unit of the last digit."""
    return (
        round_to_floor(max(number, 10.0 ** -_digits(floor)), floor)
        if 0 < floor < math.inf
        else number
    )


def _digits(floor: float) -> int:
    return -math.ceil(math.log10(floor))


# Bounds what rounding alone does to a number: digits below it are another machine's, not written.
#
# Two machines with the same versions differ by the last bit of a sine or of a sum of products.
# Over a run it grows: by one unit a step in what is integrated, and in a force that a step makes
# of places by m/h².


EPSILON = 2.2e-16
MARGIN = 10  # × the estimate; measured: below 0.2 × it, but 90 × in a linkage near its dead point


OF_ALLOW = 0.1  # of `allow`: a bound or an uncertainty above it hides what a verdict is about


def floor(trial: Trial, name: str, step: float) -> float:
    """The difference in the quantity `name` that rounding can make in a run with steps [s].

    As far as it decides nothing: most engines do better than the bound, by orders where no force
    is made of places, and a number that is judged has to show what it is judged by.
    """
    steps = trial.case.duration / step
    if trial.quantity(name).kind == "event":
        return MARGIN * EPSILON * trial.case.duration * steps
    made = _size(trial, name) * steps
    if trial.quantity(name).kind == "force":
        mass = sum(body.mass for body in trial.case.scene.bodies.values())
        made += mass * _largest(trial, "m") / step**2
    allowed = trial.allowed(name)
    return min(MARGIN * EPSILON * made, math.inf if allowed is None else OF_ALLOW * allowed)


def _size(trial: Trial, name: str) -> float:
    """The size of what the quantity is made of: all places, if it is one; both kinds of energy.

    Of a momentum those of all bodies, though their sum may be none.
    """
    quantity = trial.quantity(name)
    if quantity.part == "momentum":
        return _momentum(trial, angular=quantity.field.startswith("angular"))
    if quantity.part == "energy":
        parts = ("energy.kinetic", "energy.potential")
        return max(float(np.max(np.abs(trial.wanted(part)))) for part in parts)
    known = max(trial.size(name), _largest(trial, quantity.unit))
    if quantity.unit == "rad" and known < MARGIN * EPSILON:
        return 1.0  # an angle that stays 0 is made of points, as its cosine is
    return known


def _momentum(trial: Trial, *, angular: bool) -> float:
    """The sum over the bodies of the largest m v, or m r v + J ω, along the reference's motion."""
    frame, made = trial.case.scene.frame, 0.0
    for name, s in trial.reference.states.items():
        body: Any = trial.case.scene.bodies[name]
        parts = (s[:, columns] for columns in (frame.place, frame.velocity, frame.spin))
        r, v, omega = (float(np.max(np.linalg.norm(part, axis=1))) for part in parts)
        moment = body.moment if frame is PLANE else float(np.max(np.abs(body.tensor)))
        made += body.mass * r * v + moment * omega if angular else body.mass * v
    return made


def _largest(trial: Trial, unit: str) -> float:
    """The largest place or rate of the reference's motion with the unit; 0 for any other unit."""
    columns = trial.case.scene.frame.alike(unit)
    states = trial.reference.states.values()
    return max((float(np.max(np.abs(s[:, columns]), initial=0.0)) for s in states), default=0.0)
