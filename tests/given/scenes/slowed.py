"""A rod on a pin with a cart that slides on it, and a bob beside: all that goes with a velocity.

And which law sees a parameter that is 5 % off in the hand-written systems of that kind.
"""

from .. import laws
from ..laws import Law

SLOWED = """\
scene:
  points: {O: [0, 0]}
  bodies:
    rod: {bar: {mass: 1.2, length: 0.8}}
    cart: {block: {mass: 0.7, width: 0.2, height: 0.1}, points: {P: [0.1, 0.05]}}
    bob: {particle: {mass: 0.5}}
  joints:
    hinge: {pin: [ground.O, rod.start]}
    rail: {slide: [rod.center, cart.P], along: [1, 0.3], angle: 20 deg}
  forces:
    air: {drag: rod.end, coefficient: 0.4, exponent: 2}
    wind: {drag: bob.center, coefficient: 0.3, exponent: 1.5}
    oil: {viscous: rail, coefficient: {forward: 0.8, backward: 1.7}, exponent: 1.5}
    field: {magnetic: bob, charge: 0.7, along_z: 3.0}
    glow: {magnetic: rod, charge: -0.4, along_z: 2.0}
initial:
  rod: {angle: -50 deg, omega: 2.0}
  cart: {x: 0.5, vx: 1.0}
  bob: {x: 1.0, y: 0.2, vx: 1.5, vy: -0.4}
allow: {rod.angle: 1.0e-2, cart.x: 1.0e-2, bob.x: 1.0e-2, air.force: 1.0, oil.force: 1.0}
"""

SEEN_BY: dict[str, dict[str, Law]] = {
    "charge_in_field": {
        "m": laws.equations, "e": laws.equations, "B": laws.free_cut, "F": laws.power,
    },
    "falling_drag": {"m": laws.equations, "d": laws.power},
    "turning_sled": {
        "m": laws.equations, "l": laws.equations, "d": laws.power, "d_across": laws.free_cut,
    },
    "viscous_drift": {
        "m": laws.equations, "A": laws.power, "w": laws.equations, "d_minus": laws.free_cut,
        "d_plus": laws.closed_form,
    },
    "viscous_growing_force": {
        "m": laws.equations, "b": laws.power, "d_minus": laws.closed_form, "d_plus": laws.free_cut,
    },
}  # fmt: skip
