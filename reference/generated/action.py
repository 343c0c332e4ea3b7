"""The applied forces of a scene in maximal coordinates: what springs, dampers and pushes exert."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ...cases.scene import Damper, Force, Push, Signal, Spring, Torque
from ..laws.force import damper, spring
from ..system import Array
from .coordinates import Coordinates, Point

Numbers = Sequence[Any]
SHORT = 1e-9  # of the rest length: a motion that comes so close would not miss zero but by rounding


class NoDirection(ArithmeticError):
    """A spring whose ends are at the same place."""


def act(force: Force, where: Coordinates, t: float, q: Numbers, v: Numbers, Q: Array) -> None:
    """Adds one force to the generalized forces: Q_a += F·∂r/∂qᵃ as in (2.50), (n,)."""
    if isinstance(force, Torque):
        Q[where.columns[force.body][1]] += signal(force.signal, t)[0]
        return
    for F, p in pulls(force, where, t, q, v):
        if p.xy is not None:
            Q[p.xy] += F[0]
            Q[p.xy + 1] += F[1]
        if p.phi is not None:
            Q[p.phi] += p.d[0] * F[1] - p.d[1] * F[0]


def pulls(
    force: Force, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    """The force [N] on each of the points at which it acts.

    Raises NoDirection for a spring that passes through zero length: its force would jump.
    """
    match force:
        case Spring() | Damper():
            a, b = where.point(force.a, t, q, v), where.point(force.b, t, q, v)
            d = (b.r[0] - a.r[0], b.r[1] - a.r[1])
            if isinstance(force, Spring):
                if d[0] * d[0] + d[1] * d[1] < (SHORT * force.rest_length) ** 2:
                    raise NoDirection(force.name)
                F = spring(force.stiffness, force.rest_length, d).tolist()
            else:
                d_dot = (b.r_dot[0] - a.r_dot[0], b.r_dot[1] - a.r_dot[1])
                F = damper(force.damping, d, d_dot).tolist()
            yield F, a
            yield (-F[0], -F[1]), b
        case Push():
            yield signal(force.signal, t), where.point(force.at, t, q, v)


def signal(law: Signal, t: Any) -> tuple[Any, ...]:
    """A push's components [N] or a torque [N m] at time t: A, A t or A sin(w t + phase)."""
    if law.law == "constant":
        return law.amplitude
    size = t if law.law == "ramp" else np.sin(law.angular_frequency * t + law.phase)
    return tuple(entry * size for entry in law.amplitude)
