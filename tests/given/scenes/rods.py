"""Massless rods: a bar and a particle that hang on them in a chain, and a bar hung up by two."""

CHAIN = """\
scene:
  points: {O: [0, 0], hook: {at: [0, 1], velocity: [0.1, 0]}}
  bodies: {bar: {bar: {mass: 1.2, length: 0.8}}, bob: {particle: {mass: 0.4}}}
  joints:
    left: {distance: [bar.start, ground.O], length: 0.5}
    chain: {distance: [bar.end, bob.center]}
  forces: {coil: {spring: [bob.center, ground.hook], stiffness: 9.0, rest_length: 0.4}}
initial:
  bar: {start: [-0.3, -0.4], angle: 10 deg}
  bob: {x: 0.7, y: -0.5}
allow: {bar.x: 1.0, bar.angle: 1.0, left.force: 1.0, chain.force: 1.0, left.gap: 1.0e-3}
"""
SWING = """\
scene:
  points: {O: [0, 0], Q: [0.7, 0.1]}
  bodies: {bar: {bar: {mass: 1.2, length: 0.8}}}
  joints:
    left: {distance: [ground.O, bar.start], length: 0.5}
    right: {distance: [bar.end, ground.Q], length: 0.6}
initial: {bar: {start: [-0.3, -0.4]}}
near: {bar: {end: [0.4, -0.4]}}
allow: {bar.x: 1.0, bar.angle: 1.0, left.force: 1.0, right.force: 1.0, right.gap: 1.0e-3}
"""
LINKED = """\
scene:
  points: {O: [0, 0], Q: [0.7, 0]}
  bodies: {crank: {bar: {mass: 1.2, length: 0.4}}, rocker: {bar: {mass: 0.7, length: 0.6}}}
  joints:
    A: {pin: [ground.O, crank.start]}
    D: {pin: [ground.Q, rocker.start]}
    right: {distance: [crank.end, rocker.end]}
initial: {crank: {angle: 60 deg}, rocker: {angle: 80 deg}}
allow: {crank.angle: 1.0, rocker.angle: 1.0, right.force: 1.0, right.gap: 1.0e-3}
"""
"""A four-bar linkage whose coupler has no mass, and the length at which it starts."""

BOTH = """\
scene:
  points: {O: [0, 0], Q: [0.9, 0]}
  bodies:
    crank: {bar: {mass: 1.0, length: 0.3}}
    coupler: {bar: {mass: 1.0, length: 0.8}}
    rocker: {bar: {mass: 1.0, length: 0.6}}
    pendulum: {bar: {mass: 0.5, length: 0.5}}
  joints:
    A: {pin: [ground.O, crank.start]}
    right: {distance: [crank.end, pendulum.end]}
    B: {pin: [crank.end, coupler.start]}
    C: {pin: [coupler.end, rocker.end]}
    D: {pin: [ground.Q, rocker.start]}
    E: {pin: [ground.O, pendulum.start]}
initial: {crank: {angle: 70 deg}, pendulum: {angle: 20 deg}}
near: {rocker: {angle: 96 deg}}
allow: {crank.angle: 1.0, rocker.angle: 1.0, C.force: 1.0, right.force: 1.0, right.gap: 1.0e-3}
"""
"""A loop that a pin closes, and one that a rod does; it holds crank and pendulum together."""
