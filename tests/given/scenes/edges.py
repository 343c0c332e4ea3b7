"""Scenes with edges, as a person types them."""

SLEIGH = """\
scene:
  gravity: none
  bodies: {sleigh: {rigid: {mass: 1.7, inertia: 0.09}, points: {P: [-0.35, 0.1]}}}
  constraints: {blade: {edge: sleigh.P, along: [0.8, 0.6]%s}}
initial: {sleigh: {P: [0.2, -0.1], angle: 40 deg, omega: 1.1}%s}
allow: {sleigh.x: 1.0e-2, sleigh.angle: 1.0e-2, blade.force: 1.0, blade.slip: 1.0e-6}
"""
FREE = SLEIGH % ("", ", blade: {speed: 0.7}")
"""A blade beside the centre of mass, and oblique."""
LAWS = {
    "constant": "0.7",
    "ramp": "{ramp: 0.4}",
    "sine": "{sine: {amplitude: 0.9, angular_frequency: 3.0, phase: 40 deg}}",
}
DRIVEN = {law: SLEIGH % (f", speed: {text}", "") for law, text in LAWS.items()}

TRAIN = """\
scene:
  seen: from above
  incline: 10 deg
  bodies:
    sleigh: {rigid: {mass: 1.7, inertia: 0.09}, points: {P: [-0.35, 0], H: [-0.5, 0]}}
    trailer: {bar: {mass: 0.8, length: 0.6}}
  joints: {hitch: {pin: [sleigh.H, trailer.end]}}
  constraints:
    blade: {edge: sleigh.P, along: [1, 0], speed: {sine: {amplitude: 0.8, angular_frequency: 2.0}}}
    skid: {edge: trailer.start, along: [1, 0]}
initial: {sleigh: {P: [0, 0], angle: 20 deg, omega: 1.2}, trailer: {angle: -10 deg}}
allow: {sleigh.x: 1.0e-2, trailer.angle: 1.0e-2, blade.force: 1.0, skid.force: 1.0, hitch.fx: 1.0}
"""
"""A driven sleigh on a slope that draws a trailer on a skid."""
