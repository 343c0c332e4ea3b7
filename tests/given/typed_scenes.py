"""Scenes typed for several tests, without an end: what rolls, loses its way or rests."""

import numpy as np

WHEEL = """\
scene:
  points: {hook: [0, 1]}
  incline: BETA
  bodies: {wheel: {disk: {mass: 1, radius: 0.25}}}
  contacts: {touch: {between: [wheel, ground.floor], friction: MU, ideal: rolling}}
  forces: {lift: {push: wheel.center, ramp: [0, UP]}}
initial: {wheel: {x: 0, angle: 0}}
allow: {wheel.x: 1.0e-2}
"""
PARALLELOGRAM = """\
scene:
  points: {O: [0, 0], Q: [0.9, 0]}
  bodies:
    crank: {bar: {mass: 1, length: 0.3}}
    coupler: {bar: {mass: 1, length: 0.9}}
    rocker: {bar: {mass: 1, length: 0.3}}
  joints:
    A: {pin: [ground.O, crank.start]}
    B: {pin: [crank.end, coupler.start]}
    C: {pin: [coupler.end, rocker.end]}
    D: {pin: [ground.Q, rocker.start]}
initial: {crank: {angle: 70 deg}}
near: {rocker: {angle: 70 deg}}
allow: {crank.angle: 1.0e-2}
"""
SPRING = """\
scene:
  points: {O: [0, 0]}
  bodies: {dot: {particle: {mass: 0.7}}}
  forces: {coil: {spring: [ground.O, dot.center], stiffness: 3, rest_length: 0.5}}
initial: {dot: {x: 0, y: START}}
allow: {dot.y: 1.0e-2}
"""
PENDULUM = """\
scene:
  points: {O: [PLACE, 0]}
  bodies: {bar: {bar: {mass: MASS, length: LENGTH}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
initial: {bar: {angle: ANGLE, omega: RATE}}
allow: {bar.angle: SMALL, hinge.fx: FORCE}
"""
CART = """\
scene:
  points: {O: [0, 0]}
  bodies: {cart: {block: {mass: 2, width: 0.3, height: 0.1}}, rod: {bar: {mass: 0.5, length: 0.6}}}
  joints:
    rail: {slide: [ground.O, cart.center], along: [1, 0]}
    hinge: {pin: [cart.center, rod.start]}
initial: {cart: {x: 0}, rod: {angle: -40 deg}}
allow: {cart.x: 1.0e-3, cart.y: 1.0e-3, cart.vy: 1.0e-3}
"""
AT_REST = {
    "hanging bar": """\
scene:
  points: {O: [0, 0]}
  bodies: {bar: {bar: {mass: 1.2, length: 0.8}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
initial: {bar: {angle: -90 deg}}
allow: {bar.angle: 1.0e-2}
""",
    "hanging mass": """\
scene:
  points: {O: [0, 0]}
  bodies: {dot: {particle: {mass: 0.7}}}
  joints: {guide: {slide: [ground.O, dot.center], along: [0, 1]}}
  forces: {coil: {spring: [ground.O, dot.center], stiffness: 30, rest_length: 0.5}}
initial: {dot: {y: -0.7288218333333333}}
allow: {dot.y: 1.0e-2, guide.torque: 1.0e-3}
""",
    "two slides in series": """\
scene:
  points: {O: [0, 0]}
  bodies: {a: {particle: {mass: 1}}, b: {particle: {mass: 1}}}
  joints:
    one: {slide: [ground.O, a.center], along: [1, 0], dry_friction: {static: 6, kinetic: 3}}
    two: {slide: [a.center, b.center], along: [1, 0], dry_friction: {static: 4, kinetic: 2}}
  forces: {pull: {push: b.center, ramp: [1.0, 0]}}
initial: {a: {x: 0}, b: {x: 0}}
allow: {a.x: 1.0e-3, b.x: 1.0e-3}
""",
    "wheel without friction": WHEEL.replace("BETA", "0").replace("MU", "0").replace("UP", "0"),
}


def time_to_flat() -> float:
    """When [s] PARALLELOGRAM lies flat: ½ J α̇² = 2 m g a (sin α₀ − sin α), so that t = ∫ dα/α̇."""
    J, weight = 2 * 0.3**2 / 3 + 0.3**2, 2 * 9.80665 * 0.3  # two cranks, one coupler of 1 kg
    # α = α₀ − s², by Gauss: the integrand is then smooth at the start
    s, weights = np.polynomial.legendre.leggauss(40)
    half = np.sqrt(np.radians(70)) / 2
    s, weights = half * (s + 1), half * weights
    fallen = np.sin(np.radians(70)) - np.sin(np.radians(70) - s**2)
    return float(np.sum(weights * 2 * s / np.sqrt(2 * weight * fallen / J)))


# A particle that slides along x through the ground's O.
RAILED = """\
scene:
  gravity: none
  points: {O: [0, 0], A: [-1, 0]}
  bodies: {b: {particle: {mass: 1.0}}}
  joints: {r: {slide: [ground.O, b.center], along: [1, 0]}}
"""
