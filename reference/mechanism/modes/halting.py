"""Friction of a point by a power below 1 of its speed (2.86), which could end its motion.

d |v|^α is not small beside the speed that is left: alone it takes that in a finite time, and then
nothing tells where the point goes on, if anything pushes it. Under its weight a ball never stops.
"""

from collections.abc import Callable, Iterator

import numpy as np

from ....cases.scene.forces.drag import Drag
from ....cases.scene.forces.force import of
from ...system import Array, Guard
from ..constraints.constraint import Constraint, tracked
from .mode_selection import After, Undetermined
from .modes import Modes

SLOW = 1e-6  # of the speed at the start, or of one that forces give within the scene's size
OTHERS = 2.0  # times what the friction does: then it goes through rest, and does not stay


def halting(modes: Modes, mode: str, size: float) -> Iterator[Guard]:
    """Yields guards where drags stop their points: a message, as no law sets such a point off."""
    for force in of(Drag, modes.scene.forces.values()):
        if force.exponent < 1.0 and force.coefficient:
            slow, point = SLOW * _speed(modes, size), tracked(force.at, modes.base.where)
            yield Guard(
                None, _over(point, slow), _stops(modes, mode, force, point, slow), vain=True
            )


def _speed(modes: Modes, size: float) -> float:
    q, v = modes.start
    fastest = float(np.max(np.abs(v), initial=0.0))
    return fastest or float(np.sqrt(size * modes.base.terms(0.0, q, v)[0])) or 1.0


def _over(point: Constraint, slow: float) -> Callable[[float, Array, Array], float]:
    """How much faster than that the point is [m/s]."""

    def faster(t: float, q: Array, v: Array) -> float:
        f, g, _ = point.alone.rows(t, q, v)
        return float(np.hypot(*(f @ v - g))) - slow

    return faster


def _stops(
    modes: Modes, mode: str, force: Drag, point: Constraint, slow: float
) -> Callable[[float, Array, Array], After]:
    """A function for the guard: the same mode, where others move the point through its rest.

    It raises Undetermined where they do not.
    """

    def then(t: float, q: Array, v: Array) -> After:
        f, _, gamma = point.alone.rows(t, q, v)
        a_P = np.hypot(*(f @ modes[mode].accelerations(t, q, v) - gamma))
        body = modes.scene.bodies[force.at.body]
        if a_P < OTHERS * force.coefficient * slow**force.exponent * body.mobility(force.at.point):
            what = (
                f"stops {force.at} at t = {t:.4g} s, and with an exponent below 1 it does so in a "
                "finite time: shorten the duration, or give an exponent of at least 1; along a "
                "slide a `viscous` may stop"
            )
            raise Undetermined(force.name, what, t)
        return mode, q, v

    return then
