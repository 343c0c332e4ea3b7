"""Scenes with ropes, as case files have them."""

PAIR = """\
scene:
  gravity: none
  bodies: {one: {particle: {mass: 1.0}}, two: {particle: {mass: 2.0}}}
  forces: {rope: {rope: [one.center, two.center], length: 1.0}}
initial: {one: {x: 0, y: 0, vx: -1.0, vy: 0.5}, two: {x: 0.5, y: 0, vx: 1.0, vy: 0}}
allow: {one.x: 1.0e-2, two.y: 1.0e-2, rope.force: 1.0}
"""
HELD = """\
scene:
  points: {O: [0, 0], Q: [0, 0.5]}
  bodies: {bar: {bar: {mass: 1.0, length: 0.8}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
  forces: {rope: {rope: [ground.Q, bar.end], length: 1.1}}
initial: {bar: {angle: 10 deg}}
allow: {bar.angle: 1.0e-2, hinge.force: 1.0, rope.force: 1.0}
"""
TOWED = """\
scene:
  gravity: none
  points: {hook: {at: [0, 0], velocity: [0.5, 0]}}
  bodies: {sled: {bar: {mass: 1.0, length: 0.8}}}
  forces: {rope: {rope: [ground.hook, sled.start], length: 0.3}}
initial: {sled: {x: 0, y: -0.2, angle: -90 deg, vx: 0, vy: 0, omega: 0}}
allow: {sled.x: 1.0e-2, sled.angle: 1.0e-2, rope.force: 1.0}
"""
TWO = """\
scene:
  points: {A: [-0.6, 0], B: [0.6, 0]}
  bodies: {rod: {bar: {mass: 1.0, length: 0.8}}}
  forces:
    left: {rope: [ground.A, rod.start], length: 0.5}
    right: {rope: [ground.B, rod.end], length: 0.7}
initial: {rod: {x: 0, y: -0.1, angle: 5 deg, vx: 0.1, vy: 0, omega: 0}}
allow: {rod.x: 1.0e-2, rod.angle: 1.0e-2, left.force: 1.0, right.force: 1.0}
"""
EVERY = {"pair": PAIR, "held": HELD, "towed": TOWED, "two": TWO}
