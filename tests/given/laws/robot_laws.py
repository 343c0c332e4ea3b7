"""The laws that the five-axis robots obey, each as the largest relative violation."""

import numpy as np

from textmech.reference.formalisms import energy, lagrange
from textmech.reference.system import Mode

from ..machines.robots import states
from . import cut_bodies, difference

EDGE = {"blade.normal", "blade.force"}
MULTIPLIERS = ("blade.normal", "blade.force", *(f"q{k}.torque" for k in range(1, 6)))


def equations(mode: Mode) -> float:
    """Explicit accelerations and multipliers against (2.44) and (2.60) over T and U."""
    worst = 0.0
    for t, q, v in states(mode):
        a, lam = lagrange.multipliers(mode, t, q, v)
        worst = max(worst, difference(mode.accelerations(t, q, v), a))
        held = mode.reactions(t, q, v)
        own = [held[name] for name in MULTIPLIERS if name in held]
        assert len(own) == len(lam)
        worst = max(worst, difference(own, lam) if own else 0.0)
    return worst


def cut_free(mode: Mode) -> float:
    """(2.23), (2.27) of all bodies cut free: they balance, and give the reactions it states."""
    worst = 0.0
    for t, q, v in states(mode):
        left, found = cut_bodies.solved(mode, t, q, v, mode.accelerations(t, q, v))
        held, own, theirs = mode.reactions(t, q, v), [], []
        for joint, cut in zip(mode.coordinates, mode.cuts(t, q), strict=False):
            own += [held[f"{joint}.{field}"] for field in ["fx", "fy", "fz", "mx", "my", "mz"]]
            one, other = (np.array(axis) for axis in cut.moments)
            moment = found[f"{joint}.across1"] * one + found[f"{joint}.across2"] * other
            moment = moment + found.get(f"{joint}.torque", 0.0) * np.cross(one, other)
            theirs += [*cut_bodies.force(found, joint, "fx fy fz"), *moment]
        for name in EDGE & held.keys():
            own, theirs = [*own, held[name]], [*theirs, found[name]]
        worst = max(worst, left, difference(own, theirs))
    return worst


def moves(mode: Mode) -> float:
    """`poses` moves as it says, and has the energy T."""
    return cut_bodies.moves(mode, states(mode))


def power(mode: Mode) -> float:
    """(2.51) over the largest power of an inertial force."""
    worst = 0.0
    for t, q, v in states(mode):
        terms = lagrange.momentum(mode, t, q, v) * mode.accelerations(t, q, v)
        worst = max(worst, abs(energy.power_balance(mode, t, q, v)) / abs(terms).max())
    return worst


LAWS = (equations, cut_free, moves, power)
