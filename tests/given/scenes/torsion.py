"""What acts about joints: of two bars on pins, one named backward, and of bodies in space."""

_EACH = """\
  forces:
    wire: {torsion: hinge, stiffness: 9.0, rest_angle: -30 deg}
    knee: {torsion: elbow, stiffness: 3.0, rest_angle: 20 deg}
    oil: {torsion_damper: elbow, damping: 0.12}
    drive: {motor: elbow, sine: {amplitude: 1.3, angular_frequency: 4.0}}
    pull: {motor: hinge, ramp: 0.8}
"""

ARM = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 1.2, length: 0.8}}, arm: {bar: {mass: 0.7, length: 0.5}}}
  joints: {hinge: {pin: [ground.O, rod.start]}, elbow: {pin: [arm.start, rod.end]}}
FORCES
initial: {rod: {angle: 20 deg, omega: 1.0}, arm: {angle: -50 deg, omega: 0}}
allow: {rod.angle: 1.0e-2, arm.angle: 1.0e-2, wire.torque: 1.0, knee.angle: 1.0e-2, oil.torque: 1.0}
""".replace("FORCES\n", _EACH)

LOOP = """\
scene:
  points: {O: [0, 0], Q: [0.9, 0]}
  bodies:
    crank: {bar: {mass: 1, length: 0.3}}
    coupler: {bar: {mass: 1, length: 0.8}}
    rocker: {bar: {mass: 1, length: 0.6}}
  joints:
    A: {pin: [ground.O, crank.start]}
    B: {pin: [crank.end, coupler.start]}
    C: {pin: [coupler.end, rocker.end]}
    D: {pin: [ground.Q, rocker.start]}
  forces: {wire: {torsion: D, stiffness: 9.0, rest_angle: 60 deg}}
initial: {crank: {angle: 70 deg}}
near: {rocker: {angle: 96 deg}}
allow: {rocker.angle: 1.0e-2, crank.angle: 1.0e-2}
"""
"""A four-bar linkage with a spring about its last pin, so that another has to close the loop."""

FLAT = """\
scene:
  space: 3
  gravity: [0, -9.80665, 0]
  points: {O: [0, 0, 0]}
  bodies: {rod: {bar: {mass: 1.2, length: 0.8}}, arm: {bar: {mass: 0.7, length: 0.5}}}
  joints:
    hinge: {hinge: [ground.O, rod.start], axis: [0, 0, 1]}
    elbow: {hinge: [arm.start, rod.end], axis: [0, 0, 1]}
FORCES
initial: {hinge: {angle: 20 deg, omega: 1.0}, elbow: {angle: 70 deg, omega: 1.0}}
allow: {hinge.angle: 1.0e-2, wire.torque: 1.0, knee.angle: 1.0e-2, oil.torque: 1.0}
""".replace("FORCES\n", _EACH)
"""The bars of ARM in the plane z = 0 of space."""

SPATIAL = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
    rod: {bar: {mass: 1.2, length: 0.8}}
    arm:
      rigid: {mass: 0.7, inertia: [0.02, 0.035, 0.04, 0.003, -0.001, 0.002]}
      points: {P: [-0.2, 0.05, 0.1]}
    tip:
      rigid: {mass: 0.4, inertia: [0.01, 0.015, 0.02, 0.001, -0.001, 0.002]}
      points: {P: [-0.2, 0.05, 0.1]}
  joints:
    hinge: {hinge: [ground.O, rod.start], axis: [0, 1, 0.3]}
    elbow: {hinge: [arm.P, rod.end], axis: [0.2, 0, 1]}
    wrist:
      freedoms: {theta: {hinge: [0, 1, 0]}, phi: {hinge: [3, 1, 4]}}
      of: [arm.center, tip.P]
FORCES
    one: {torsion: wrist.theta, stiffness: 2.0, rest_angle: 10 deg}
    two: {torsion: wrist.phi, stiffness: 1.0, rest_angle: -20 deg}
    soft: {torsion_damper: wrist.theta, damping: 0.05}
    hard: {torsion_damper: wrist.phi, damping: 0.03}
    weave: {motor: wrist.theta, sine: {amplitude: 0.3, angular_frequency: 5.0}}
    push: {motor: wrist.phi, constant: 0.2}
initial:
  hinge: {angle: 20 deg, omega: 1.0}
  elbow: {angle: -50 deg, omega: 0.3}
  wrist: {theta: 0.3, phi: -0.4, theta_dot: 0.5, phi_dot: -1.0}
allow: {
  hinge.angle: 1.0e-2, elbow.angle: 1.0e-2, wrist.theta: 1.0e-2, wrist.phi: 1.0e-2,
  hinge.mx: 1.0, elbow.mx: 1.0, wrist.my: 1.0, wire.torque: 1.0, oil.torque: 1.0, two.angle: 1.0,
}
""".replace("FORCES\n", _EACH)
"""Hinges in any direction, the second named backward, and a joint with two skew turns."""
