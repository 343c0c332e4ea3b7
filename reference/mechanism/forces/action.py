"""Force elements as the reference knows them, in maximal coordinates: one table, ACTIONS.

A kind of element says what it exerts on which points, and beside that, derived by itself, its
potential U (2.45), its generalized potential V (2.48), its dissipation D (2.46) or its generalized
force Q₄ (2.50).
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....cases.scene.forces.force import (
    Couple,
    Damper,
    Drag,
    Force,
    Line,
    LinearMuscle,
    Magnetic,
    Motor,
    Muscle,
    Push,
    Rope,
    Spring,
    Stops,
    Torque,
    Torsion,
    TorsionDamper,
    Viscous,
)
from ...laws.force import damper, spring
from ...system import Array
from ..kinematics.coordinates import Coordinates, Point
from ..kinematics.signal import signal
from .couple import coupled, turned_apart
from .drag import drag_loss, dragged, slowed, viscous_loss
from .magnetic import deflected, magnetic_potential
from .muscle import contracted, pulled, stretched
from .turning import braked, driven, motor, torsional, torsionally_damped, twisted

Numbers = Sequence[Any]
SHORT = 1e-9  # of the rest length: a motion that comes so close would not miss zero but by rounding


class NoDirection(ArithmeticError):
    """A spring with a length of its own whose ends are at the same place."""


@dataclass(frozen=True)
class Action:
    """A kind of force element; called with the element, the coordinates, t, q and, but for U, v.

    pulls: each force [N] with the point at which it acts. U and V [J], D [W]. Q4: adds its own to
    a vector (n,). rate: of its inner state. line: whether that element has no direction where its
    two ends meet.
    """

    pulls: Callable[..., Iterator[tuple[Any, Point]]]
    U: Callable[..., Any] = lambda force, where, t, q: 0.0
    rate: Callable[..., Any] = lambda force, where, t, q: 0.0
    V: Callable[..., Any] = lambda force, where, t, q, v: 0.0
    D: Callable[..., Any] = lambda force, where, t, q, v: 0.0
    Q4: Callable[..., None] = lambda force, where, t, q, v, Q: None
    line: Callable[[Any], bool] = lambda force: False


def act(force: Force, where: Coordinates, t: float, q: Numbers, v: Numbers, Q: Array) -> None:
    """Adds one force to the generalized forces: Q_a += F·∂r/∂qᵃ as in (2.50), (n,)."""
    for F, p in ACTIONS[type(force)].pulls(force, where, t, q, v):
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
    return ACTIONS[type(force)].pulls(force, where, t, q, v)


def potential(force: Force, where: Coordinates, t: Any, q: Numbers) -> Any:
    """(2.45) its share of U [J]."""
    return ACTIONS[type(force)].U(force, where, t, q)


def generalized_potential(force: Force, where: Coordinates, t: Any, q: Any, v: Any) -> Any:
    """Its share of V (2.48) [J], of the rates v (n,) or (n, K)."""
    return ACTIONS[type(force)].V(force, where, t, q, v)


def inner_rate(force: Force, where: Coordinates, t: Any, q: Numbers) -> Any:
    """The rate of its inner state."""
    return ACTIONS[type(force)].rate(force, where, t, q)


def dissipation(force: Force, where: Coordinates, t: Any, q: Numbers, v: Numbers) -> Any:
    """(2.46) its share of D [W]."""
    return ACTIONS[type(force)].D(force, where, t, q, v)


def other(force: Force, where: Coordinates, t: Any, q: Numbers, v: Numbers, Q: Array) -> None:
    """(2.50) adds its share of Q₄, of what has no U and no D, (n,)."""
    ACTIONS[type(force)].Q4(force, where, t, q, v, Q)


def ends_meet(force: Force, where: Coordinates, t: float, q: Numbers, within: float) -> bool:
    """Whether it is shorter than that [m], and so without direction."""
    return ACTIONS[type(force)].line(force) and length(force, where, t, q) < within  # type: ignore[arg-type]


def ends(force: Line, where: Coordinates, t: Any, q: Numbers, v: Numbers) -> tuple[Point, Point]:
    """The points at its two ends."""
    return where.point(force.a, t, q, v), where.point(force.b, t, q, v)


def length(force: Line, where: Coordinates, t: Any, q: Numbers) -> Any:
    """λ [m]."""
    a, b = ends(force, where, t, q, q)
    x, y = b.r[0] - a.r[0], b.r[1] - a.r[1]
    return np.sqrt(x * x + y * y)


def _spring(
    force: Spring, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    a, b = ends(force, where, t, q, v)
    d = (b.r[0] - a.r[0], b.r[1] - a.r[1])
    if d[0] * d[0] + d[1] * d[1] < (SHORT * force.rest_length) ** 2:
        raise NoDirection(force.name)
    F = spring(force.stiffness, force.rest_length, d).tolist()
    yield F, a
    yield (-F[0], -F[1]), b


def _stretched(force: Spring, where: Coordinates, t: Any, q: Numbers) -> Any:
    """(2.45) ½ c (λ − λ₀)²; ½ c λ² has a derivative at λ = 0 too."""
    if force.rest_length == 0.0:
        a, b = ends(force, where, t, q, q)
        x, y = b.r[0] - a.r[0], b.r[1] - a.r[1]
        return 0.5 * force.stiffness * (x * x + y * y)
    return 0.5 * force.stiffness * (length(force, where, t, q) - force.rest_length) ** 2


def _damper(
    force: Damper, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    a, b = ends(force, where, t, q, v)
    d = (b.r[0] - a.r[0], b.r[1] - a.r[1])
    d_dot = (b.r_dot[0] - a.r_dot[0], b.r_dot[1] - a.r_dot[1])
    F = damper(force.damping, d, d_dot).tolist()
    yield F, a
    yield (-F[0], -F[1]), b


def _damped(force: Damper, where: Coordinates, t: Any, q: Numbers, v: Numbers) -> Any:
    """(2.46) ½ d λ̇², λ̇ = Δ·Δ̇/λ."""
    a, b = ends(force, where, t, q, v)
    x, y = b.r[0] - a.r[0], b.r[1] - a.r[1]
    along = x * (b.r_dot[0] - a.r_dot[0]) + y * (b.r_dot[1] - a.r_dot[1])
    return 0.5 * force.damping * along * along / (x * x + y * y)


def _push(
    force: Push, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    yield signal(force.signal, t), where.point(force.at, t, q, v)


def _pushed(force: Push, where: Coordinates, t: Any, q: Numbers, v: Numbers, Q: Array) -> None:
    """(2.50) F·∂r/∂qᵃ."""
    F, p = signal(force.signal, t), where.point(force.at, t, q, v)
    assert p.xy is not None  # a push acts on a body
    Q[p.xy] += F[0]
    Q[p.xy + 1] += F[1]
    if p.phi is not None:
        Q[p.phi] += p.d[0] * F[1] - p.d[1] * F[0]


def _torque(
    force: Torque, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    """A couple: what a force across a lever of 1 m does to the angle alone."""
    phi = where.columns[force.body][1]
    yield (0.0, signal(force.signal, t)[0]), Point((0, 0), (0, 0), (1.0, 0.0), 0, 0, None, phi)


def _turned(force: Torque, where: Coordinates, t: Any, q: Numbers, v: Numbers, Q: Array) -> None:
    """(2.50) M·∂φ/∂qᵃ."""
    Q[where.columns[force.body][1]] += signal(force.signal, t)[0]


ACTIONS: dict[type[Force], Action] = {
    Spring: Action(_spring, U=_stretched, line=lambda spring: spring.rest_length > 0.0),
    Damper: Action(_damper, D=_damped, line=lambda damper: True),
    Push: Action(_push, Q4=_pushed),
    Torque: Action(_torque, Q4=_turned),
    Couple: Action(coupled, Q4=turned_apart),
    Torsion: Action(torsional, U=twisted),
    TorsionDamper: Action(torsionally_damped, D=braked),
    Motor: Action(motor, Q4=driven),
    Drag: Action(dragged, D=drag_loss),
    Viscous: Action(slowed, D=viscous_loss),
    Magnetic: Action(deflected, V=magnetic_potential),
    Muscle: Action(pulled, U=stretched, rate=contracted),
    LinearMuscle: Action(pulled, U=stretched, rate=contracted),
    Rope: Action(lambda *_: iter(())),  # taut it is a constraint
    Stops: Action(lambda *_: iter(())),  # as what rests on one
}
