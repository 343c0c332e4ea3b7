"""Scenes that land, as a person types them."""

HINGED = """\
scene:
  points: {O: [0, 0.3]}
  bodies: {rod: {bar: {mass: 2, length: 0.8}}}
  joints: {hinge: {pin: [ground.O, rod.start]}}
  contacts: {tip: {between: [rod.end, ground.floor], friction: 0}}
events: {lands: {tip.gap: falls to zero}}
initial: {rod: {angle: 20 deg}}
allow: {rod.angle: 1.0e-3}
"""
"""A bar on a pin, whose tip comes down."""
