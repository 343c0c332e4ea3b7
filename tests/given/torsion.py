"""Two bars on pins with all that can act about a joint; the second pin is named backward."""

ARM = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 1.2, length: 0.8}}, arm: {bar: {mass: 0.7, length: 0.5}}}
  joints: {hinge: {pin: [ground.O, rod.start]}, elbow: {pin: [arm.start, rod.end]}}
  forces:
    wire: {torsion: hinge, stiffness: 9.0, rest_angle: -30 deg}
    knee: {torsion: elbow, stiffness: 3.0, rest_angle: 20 deg}
    oil: {torsion_damper: elbow, damping: 0.12}
    drive: {motor: elbow, sine: {amplitude: 1.3, angular_frequency: 4.0}}
    pull: {motor: hinge, ramp: 0.8}
initial: {rod: {angle: 20 deg, omega: 1.0}, arm: {angle: -50 deg, omega: 0}}
allow: {rod.angle: 1.0e-2, arm.angle: 1.0e-2, wire.torque: 1.0, knee.angle: 1.0e-2, oil.torque: 1.0}
"""
