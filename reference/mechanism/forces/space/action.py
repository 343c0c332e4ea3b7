"""Force elements in space as the reference knows them, in maximal coordinates: one table.

A kind says what it exerts on which points, and beside that, derived by itself, its U (2.45), its
D (2.46) or its Q₄ (2.50), as in the plane.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .....cases.scene.forces.force import (
    Damper,
    Force,
    Motor,
    Push,
    Spring,
    Torque,
    Torsion,
    TorsionDamper,
)
from ....laws.force import damper, spring
from ...kinematics.space.kinematics import Bodies, Layout, Points
from ..action import SHORT, NoDirection, signal
from .turning import Turn, braked, driven, motor, torsional, torsionally_damped, twisted

Wrench = tuple[int, Any, Any]
"""Number of a body, a force on it and a moment about its centre of mass, (3,) in ground axes."""


@dataclass(frozen=True)
class Action:
    """A kind of force element; called with the element, t, the bodies and its points, or its turn.

    wrenches: what it does to each body. U [J], D [W]. Q4: the wrenches of what has no U and no D.
    line: whether that element has no direction where its two ends meet.
    """

    wrenches: Callable[..., Iterator[Wrench]]
    U: Callable[..., Any] = lambda force, points: 0.0
    D: Callable[..., Any] = lambda force, points: 0.0
    Q4: Callable[..., Iterator[Wrench]] = lambda force, t, numbers, points: iter(())
    line: Callable[[Any], bool] = lambda force: False


class Actions:
    """The forces of a scene on its coordinates."""

    def __init__(self, layout: Layout) -> None:
        forces = list(layout.scene.forces.values())
        unknown = [f.name for f in forces if type(f) not in ACTIONS]
        if unknown:
            raise NotImplementedError(f"{unknown[0]} is not known in space")
        self._each = [
            (force, ACTIONS[type(force)], _where(layout, force),
             [layout.numbers[at.body] for at in layout.scene.ends(force)])
            for force in forces
        ]  # fmt: skip
        at = list(layout.where.columns.values())
        self._columns = [(c.r_dot, c.omega) for c in at] + [(None, None)]

    def alone(self, t: Any, bodies: Bodies, n: int) -> Iterator[Any]:
        """(2.50) Q_a (n,) of each force by itself. Raises NoDirection."""
        for each in self._each:
            Q = np.zeros(n)
            self._one(each, t, bodies, Q)
            yield Q

    def enter(self, t: Any, bodies: Bodies, Q: Any) -> None:
        """(2.50) Adds Q_a of all forces to Q (n,). Raises NoDirection."""
        for each in self._each:
            self._one(each, t, bodies, Q)

    def _one(self, each: tuple[Any, ...], t: Any, bodies: Bodies, Q: Any) -> None:
        force, action, attached, numbers = each
        self._enter(action.wrenches(force, t, numbers, attached.at(t, bodies)), bodies, Q)

    def other(self, t: Any, bodies: Bodies, n: int, kind: Any) -> Any:
        """(2.50) Q₄ (n,)."""
        Q = np.zeros(n, kind)
        for force, action, attached, numbers in self._each:
            self._enter(action.Q4(force, t, numbers, attached.at(t, bodies)), bodies, Q)
        return Q

    def potential(self, t: Any, bodies: Bodies) -> Any:
        """(2.45) U [J]."""
        return sum(action.U(f, attached.at(t, bodies)) for f, action, attached, _ in self._each)

    def dissipation(self, t: Any, bodies: Bodies) -> Any:
        """(2.46) D [W]."""
        return sum(action.D(f, attached.at(t, bodies)) for f, action, attached, _ in self._each)

    def moments(self, t: Any, bodies: Bodies) -> Iterator[tuple[str, Any]]:
        """Yields a joint and the moment (3,) about it on its second part, in ground axes."""
        for force, action, attached, numbers in self._each:
            if force.about is not None:
                _, (_, _, M) = action.wrenches(force, t, numbers, attached.at(t, bodies))
                yield force.about, M

    def meets(self, t: float, bodies: Bodies, within: float) -> str | None:
        """The first line that is shorter than that [m], and so without direction."""
        for force, action, attached, _ in self._each:
            if action.line(force) and abs(_length(attached.at(t, bodies))) < within:
                return force.name
        return None

    def _enter(self, wrenches: Iterator[Wrench], bodies: Bodies, Q: Any) -> None:
        for number, F, M in wrenches:
            r_dot, omega = self._columns[number]
            if r_dot is not None:
                Q[r_dot : r_dot + 3] += F
            if omega is not None:
                Q[omega : omega + 3] += M @ bodies.R[number]


def _where(layout: Layout, force: Any) -> Any:
    """The points on which a force acts, or the turn about which it does."""
    return Turn(layout, force) if force.about else layout.attached(force.refers())


def _cross(a: Any, b: Any) -> Any:
    return np.array(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


def _length(points: Points) -> Any:
    """λ [m]."""
    d = points.r[1] - points.r[0]
    return np.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])


def _pulled(F: Any, numbers: Sequence[int], points: Points) -> Iterator[Wrench]:
    """F (3,) on the first end, its opposite on the second."""
    yield numbers[0], F, _cross(points.d[0], F)
    yield numbers[1], -F, -_cross(points.d[1], F)


def _spring(force: Spring, t: Any, numbers: Sequence[int], points: Points) -> Iterator[Wrench]:
    d = points.r[1] - points.r[0]
    if d @ d < (SHORT * force.rest_length) ** 2:
        raise NoDirection(force.name)
    yield from _pulled(spring(force.stiffness, force.rest_length, d), numbers, points)


def _stretched(force: Spring, points: Points) -> Any:
    """(2.45) ½ c (λ − λ₀)²; ½ c λ² has a derivative at λ = 0 too."""
    if force.rest_length == 0.0:
        d = points.r[1] - points.r[0]
        return 0.5 * force.stiffness * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
    return 0.5 * force.stiffness * (_length(points) - force.rest_length) ** 2


def _damper(force: Damper, t: Any, numbers: Sequence[int], points: Points) -> Iterator[Wrench]:
    d, d_dot = points.r[1] - points.r[0], points.r_dot[1] - points.r_dot[0]
    yield from _pulled(damper(force.damping, d, d_dot), numbers, points)


def _damped(force: Damper, points: Points) -> Any:
    """(2.46) ½ d λ̇², λ̇ = Δ·Δ̇/λ."""
    d, d_dot = points.r[1] - points.r[0], points.r_dot[1] - points.r_dot[0]
    along = d[0] * d_dot[0] + d[1] * d_dot[1] + d[2] * d_dot[2]
    return 0.5 * force.damping * along * along / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2])


def _push(force: Push, t: Any, numbers: Sequence[int], points: Points) -> Iterator[Wrench]:
    F = np.array(signal(force.signal, t))
    yield numbers[0], F, _cross(points.d[0], F)


def _torque(force: Torque, t: Any, numbers: Sequence[int], points: Points) -> Iterator[Wrench]:
    yield numbers[0], np.zeros(3), np.array(signal(force.signal, t))


ACTIONS: dict[type[Force], Action] = {
    Spring: Action(_spring, U=_stretched, line=lambda spring: spring.rest_length > 0.0),
    Damper: Action(_damper, D=_damped, line=lambda damper: True),
    Push: Action(_push, Q4=_push),
    Torque: Action(_torque, Q4=_torque),
    Torsion: Action(torsional, U=twisted),
    TorsionDamper: Action(torsionally_damped, D=braked),
    Motor: Action(motor, Q4=driven),
}
