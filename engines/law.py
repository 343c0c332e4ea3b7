"""Force laws in words, for every engine that has to be told a force from outside.

A law is written three times on purpose, because a mistake here would cancel nowhere else: with
the book's letters in `reference/`, here, and as a table of typed values in tests/engines.
"""

import math
from collections.abc import Callable
from dataclasses import astuple
from typing import Any

from ..cases.force import Damper, Line, Spring
from ..cases.friction import DryFriction, Smooth
from ..cases.scene import Scene
from ..cases.signal import Signal


def value(signal: Signal, t: float) -> tuple[float, ...]:
    """The law in time at t [s]: N for a push, N m for a torque."""
    if signal.law == "sine":
        factor = math.sin(signal.angular_frequency * t + signal.phase)
    else:
        factor = t if signal.law == "ramp" else 1.0
    return tuple(amplitude * factor for amplitude in signal.amplitude)


def tension(force: Line, length: float, rate: float) -> float:
    """With what force [N] a spring, a damper, … pulls its two ends together."""
    return TENSIONS[type(force)](force, length, rate)


def _spring(force: Spring, length: float, rate: float) -> float:
    """(2.82) c (λ − λ₀)."""
    return force.stiffness * (length - force.rest_length)


def _damper(force: Damper, length: float, rate: float) -> float:
    """(2.47) d λ̇."""
    return force.damping * rate


def one_number(scene: Scene) -> str:
    """What an engine that knows one number of friction leaves out, in words; or nothing."""
    told = [
        f"{contact.name} by its kinetic {contact.kinetic:g} (static {contact.static:g})"
        for contact in scene.contacts.values()
        if contact.switches and contact.static != contact.kinetic
    ]
    told += [
        f"{joint.name}, where there are several"
        for joint in scene.joints.values()
        if (dry := joint.dry_friction) is not None
        if len({*astuple(dry.static), *astuple(dry.kinetic)}) > 1 or dry.smooth is not None
    ]
    return f"one number for friction: {', '.join(told)}" if told else ""


TENSIONS: dict[type[Line], Callable[[Any, float, float], float]] = {
    Spring: _spring,
    Damper: _damper,
}


def dry_friction(friction: DryFriction, speed: float, applied: float) -> float:
    """(2.89) On the second part, positive forward [N]; `applied` is all else along the slide.

    At rest it holds up to the static bound, the bound included; beyond, it brakes as it will once
    the part moves.
    """
    kinetic, static = friction.kinetic, friction.static
    if speed > 0:
        return -kinetic.forward
    if speed < 0:
        return kinetic.backward
    if applied > static.forward:
        return -kinetic.forward
    if applied < -static.backward:
        return kinetic.backward
    return -applied


def smooth_friction(
    friction: DryFriction, speed: float, applied: float, *, smooth: Smooth
) -> float:
    """(2.95) The same with every switch blown up to tanh [N]; inside the band nothing rests."""
    a = smooth.sharpness
    kinetic, static = friction.kinetic, friction.static

    def inside(low: float, high: float, x: float) -> float:
        return (math.tanh(a * (x - low)) + math.tanh(a * (high - x))) / 2

    def above(low: float, x: float) -> float:
        return (1 + math.tanh(a * (x - low))) / 2

    band = inside(-smooth.band, smooth.band, speed)
    holding = band * inside(-static.backward, static.forward, applied)
    forward = above(smooth.band, speed) + band * above(static.forward, applied)
    backward = above(smooth.band, -speed) + band * above(static.backward, -applied)
    return kinetic.backward * backward - kinetic.forward * forward - applied * holding
