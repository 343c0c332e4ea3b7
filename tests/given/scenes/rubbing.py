"""Parts on pins with dry friction: a bar that swings to rest, and two rotors on one axle."""

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from textmech.cases.trajectory import Array

BAR = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 1.2, length: 0.8}}}
  joints: {hinge: {pin: [ENDS], dry_friction: {static: STATIC, kinetic: KINETIC}}}
initial: {rod: {angle: 0, omega: 0}}
allow: {rod.angle: 1.0e-2, hinge.friction: 1.0e-2}
"""
ARM = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 1.2, length: 0.8}}, arm: {bar: {mass: 0.7, length: 0.5}}}
  joints:
    hinge: {pin: [ground.O, rod.start]}
    elbow: {pin: [PARTS], dry_friction: {static: 0.9, kinetic: 0.6, stribeck: {speed: 2.0}}}
initial: {rod: {angle: -20 deg, omega: 1.0}, arm: {angle: -50 deg, omega: 0}}
allow: {rod.angle: 1.0e-2, arm.angle: 1.0e-2, elbow.friction: 1.0e-2}
"""
SMOOTH = BAR.replace("KINETIC}", "KINETIC, smooth: {band: 0.01, sharpness: 1.0e3}}")
STATIC, NUDGE = 1.5, 1e-6  # N m, s
HUNG, HELD = "ground.O, rod.start", "rod.start, ground.O"
CLUTCH = """\
scene:
  points: {O: [0, 0]}
  bodies: {a: {disk: {mass: 2.0, radius: 0.3}}, b: {disk: {mass: 1.5, radius: 0.2}}}
  joints:
    axle: {pin: [ground.O, a.center]}
    clutch: {pin: [PARTS], dry_friction: {static: 0.5, kinetic: 0.4}}
initial: {a: {angle: 0, omega: 6.0}, b: {angle: 0, omega: 0}}
allow: {a.angle: 1.0e-2, b.angle: 1.0e-2, clutch.friction: 1.0e-2}
"""


def swinging(ends: str, forward: float, backward: float, text: str = BAR) -> str:
    """A bar let go level; friction [N m] while it turns counter-clockwise and clockwise.

    It is held at rest by 1.5 N m; which of the two parts is named first makes no difference to it.
    """
    ways = (forward, backward) if ends == HUNG else (backward, forward)
    kinetic = f"{{forward: {ways[0]}, backward: {ways[1]}}}"
    return text.replace("ENDS", ends).replace("STATIC", str(STATIC)).replace("KINETIC", kinetic)


def swung(times: Array, forward: float, backward: float) -> Array:
    """(N,) its angle: J_O φ̈ = −m g (l/2) cos φ ∓ M_k, swing by swing, until 1.5 N m holds."""
    weight, J = 1.2 * 9.80665 * 0.4, 1.2 * 0.8**2 / 3
    t, phi, sign, found = 0.0, 0.0, -1.0, np.zeros(len(times))

    def turns(t: float, s: Array) -> float:
        return s[1]

    turns.terminal = True  # type: ignore[attr-defined]
    while t < times[-1]:
        brakes = -forward if sign > 0 else backward

        def rates(t: float, s: Array, brakes: float = brakes) -> list[float]:
            return [s[1], (-weight * math.cos(s[0]) + brakes) / J]

        _, first = rates(t, np.array([phi, 0.0]))
        if abs(weight * math.cos(phi)) <= STATIC:
            found[times >= t] = phi
            break
        # off the turning point, where the event would be seen again
        begun = [phi + first * NUDGE**2 / 2, first * NUDGE]
        half = solve_ivp(
            rates, (t + NUDGE, times[-1] + NUDGE), begun, "DOP853", dense_output=True,
            events=turns, rtol=1e-12, atol=1e-13,
        )  # fmt: skip
        dense: Any = half.sol
        inside = (times > t) & (times <= half.t[-1])
        found[inside] = dense(times[inside])[0]
        t, phi, sign = float(half.t[-1]), float(half.y[0, -1]), -sign
    return found


def coupled(times: Array) -> tuple[Array, Array]:
    """(N,) angles of a and b: 0.4 N m brakes one and drives the other until they turn alike."""
    J_a, J_b = 2.0 * 0.3**2 / 2, 1.5 * 0.2**2 / 2
    alike = 6.0 / (0.4 * (1 / J_a + 1 / J_b))
    tau, beyond = np.minimum(times, alike), np.maximum(times - alike, 0.0)
    common = 6.0 * J_a / (J_a + J_b) * beyond
    return 6.0 * tau - 0.2 / J_a * tau**2 + common, 0.2 / J_b * tau**2 + common
