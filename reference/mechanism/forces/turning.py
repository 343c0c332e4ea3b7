"""Torques between the two parts of a joint: torsion springs, their dampers, and motors."""

from collections.abc import Iterator, Sequence
from typing import Any

from ....cases.scene.forces.turning import Motor, Torsion, TorsionDamper, Turning
from ...laws.force import torsion, torsion_damper
from ...system import Array
from ..kinematics.coordinates import Coordinates, Point
from ..kinematics.signal import signal

Numbers = Sequence[Any]


def angles(force: Turning, where: Coordinates) -> list[int | None]:
    """Where the angles of the joint's two parts stand; None of the ground's."""
    joint = where.scene.joints[force.joint]
    return [where.attached[at.body, at.point].phi for at in (joint.a, joint.b)]


def turn(force: Turning, where: Coordinates, q: Numbers) -> Any:
    """φ_b − φ_a [rad] of angles q, or its rate of rates."""
    a, b = angles(force, where)
    return (0.0 if b is None else q[b]) - (0.0 if a is None else q[a])


def couples(force: Turning, where: Coordinates, M: float) -> Iterator[tuple[Any, Point]]:
    """M on the second part and −M on the first, each by a lever of 1 m on the angle alone."""
    for phi, moment in zip(angles(force, where), (-M, M), strict=True):
        yield (0.0, moment), Point((0, 0), (0, 0), (1.0, 0.0), 0, 0, None, phi)


def torsional(
    force: Torsion, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    M = torsion(force.stiffness, force.rest_angle, turn(force, where, q))
    yield from couples(force, where, M)


def twisted(force: Torsion, where: Coordinates, t: Any, q: Numbers) -> Any:
    """(2.45) ½ c (φ − φ₀)²."""
    return 0.5 * force.stiffness * (turn(force, where, q) - force.rest_angle) ** 2


def torsionally_damped(
    force: TorsionDamper, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    yield from couples(force, where, torsion_damper(force.damping, turn(force, where, v)))


def braked(force: TorsionDamper, where: Coordinates, t: Any, q: Numbers, v: Numbers) -> Any:
    """(2.46) ½ d φ̇²."""
    return 0.5 * force.damping * turn(force, where, v) ** 2


def motor(
    force: Motor, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    yield from couples(force, where, signal(force.signal, t)[0])


def driven(force: Motor, where: Coordinates, t: Any, q: Numbers, v: Numbers, Q: Array) -> None:
    """(2.50) M·∂φ/∂qᵃ of both parts."""
    for phi, way in zip(angles(force, where), (-1.0, 1.0), strict=True):
        if phi is not None:
            Q[phi] += way * signal(force.signal, t)[0]
