"""Force laws in words, for every engine that has to be told a force from outside.

A law is written three times on purpose, because a mistake here would cancel nowhere else: with
the book's letters in `reference/`, here, and as a table of typed values in tests/engines.
Laws in time stand in signal.py.
"""

import math
from collections.abc import Callable
from dataclasses import astuple
from typing import Any

from ..cases.fields.friction import DryFriction, Smooth
from ..cases.scene import Scene
from ..cases.scene.forces.force import Damper, Line, Spring
from ..cases.scene.forces.turning import Torsion, TorsionDamper, Turning


def tension(force: Line, length: float, rate: float) -> float:
    """With what force [N] a spring, a damper, … pulls its two ends together."""
    return TENSIONS[type(force)](force, length, rate)


def _spring(force: Spring, length: float, rate: float) -> float:
    """(2.82) c (λ − λ₀), nothing on the side on which a one-sided spring does not act."""
    stretch = length - force.rest_length
    idle = stretch > 0 if force.only == "compression" else stretch < 0
    return 0.0 if force.only and idle else force.stiffness * stretch


def _damper(force: Damper, length: float, rate: float) -> float:
    """(2.47) d λ̇."""
    return force.damping * rate


def turning(force: Turning, angle: float, rate: float) -> float:
    """With what torque [N m] a torsion spring or damper turns the second part of its joint."""
    return TORQUES[type(force)](force, angle, rate)


def _torsion(force: Torsion, angle: float, rate: float) -> float:
    """(2.45) −c (φ − φ₀)."""
    return -force.stiffness * (angle - force.rest_angle)


def _torsion_damper(force: TorsionDamper, angle: float, rate: float) -> float:
    """(2.47) −d φ̇."""
    return -force.damping * rate


def one_number(scene: Scene) -> str:
    """The friction that an engine with one number leaves out, in words; an empty text if none."""
    parts = [
        f"{contact.name} by its kinetic {contact.kinetic:g} (static {contact.static:g})"
        for contact in (*scene.contacts.values(), *scene.pairs.values())
        if contact.switches and contact.static != contact.kinetic
    ]
    parts += [
        f"{joint.name}, where there are several"
        for joint in scene.joints.values()
        if (dry := joint.dry_friction) is not None
        if len({*astuple(dry.static), *astuple(dry.kinetic)}) > 1 or dry.smooth is not None
    ]
    return f"one number for friction: {', '.join(parts)}" if parts else ""


TENSIONS: dict[type[Line], Callable[[Any, float, float], float]] = {
    Spring: _spring,
    Damper: _damper,
}

TORQUES: dict[type[Turning], Callable[[Any, float, float], float]] = {
    Torsion: _torsion,
    TorsionDamper: _torsion_damper,
}


def dry_friction(friction: DryFriction, speed: float, applied: float) -> float:
    """(2.89) On the second part, positive forward [N]; `applied` is all else along the slide.

    At rest it holds up to the static bound, the bound included; beyond, it brakes as it will once
    the part moves.
    """
    static = friction.static
    if speed > 0:
        return -braking(friction, 1, speed)
    if speed < 0:
        return braking(friction, -1, speed)
    if applied > static.forward:
        return -braking(friction, 1, 0.0)
    if applied < -static.backward:
        return braking(friction, -1, 0.0)
    return -applied


def braking(friction: DryFriction, sense: int, speed: float) -> float:
    """(2.90) The size of the friction [N] that slides this way (1 or −1), so fast."""
    kinetic = friction.kinetic.forward if sense > 0 else friction.kinetic.backward
    if (falls := friction.stribeck) is None:
        return kinetic
    static = friction.static.forward if sense > 0 else friction.static.backward
    return kinetic + (static - kinetic) * math.exp(-abs(speed) / falls.speed)


def smooth_friction(
    friction: DryFriction, speed: float, applied: float, *, smooth: Smooth
) -> float:
    """(2.95) The same with every switch blown up to tanh [N]; inside the band nothing rests."""
    return smooth_under(friction, smooth, applied)(speed)


def smooth_under(friction: DryFriction, smooth: Smooth, applied: float) -> Callable[[float], float]:
    """(2.95) By the speed [m/s] alone, under one applied force [N].

    tanh is odd: two of them say on which side of both bounds of a band a number lies. They are
    what the law costs, at every stage of every step.
    """
    a, band = smooth.sharpness, smooth.band
    kinetic, static = friction.kinetic, friction.static
    above = math.tanh(a * (applied + static.backward))
    below = math.tanh(a * (static.forward - applied))
    held, forward, backward = (above + below) / 2, (1 - below) / 2, (1 - above) / 2

    def force(speed: float) -> float:
        above, below = math.tanh(a * (speed + band)), math.tanh(a * (band - speed))
        creeps = (above + below) / 2
        brakes = kinetic.backward * ((1 - above) / 2 + creeps * backward)
        return (
            brakes
            - kinetic.forward * ((1 - below) / 2 + creeps * forward)
            - applied * (creeps * held)
        )

    return force
