"""A bar that swings: the case file of somebody else's project."""

SWING = """\
title: A bar that swings
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 0.5, length: 0.6}}}
  joints: {hinge: {pin: [ground.O, rod.start]}}
initial: {rod: {angle: -40 deg}}
duration: 0.4
samples: 6
step: {mujoco: 1.0e-3, pymunk: 1.0e-3}
allow: {rod.angle: 1.0e-2}
"""


def swing(allow: str) -> str:
    """The same with another tolerance of its angle."""
    return SWING.replace("rod.angle: 1.0e-2", f"rod.angle: {allow}")
