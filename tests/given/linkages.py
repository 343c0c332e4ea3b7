"""Linkages typed without their start, for tests of what follows from one."""

FOUR_BAR = """\
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
allow: {crank.angle: 1.0e-2}
"""
SLIDER_CRANK = """\
scene:
  points: {O: [0, 0]}
  bodies:
    crank: {bar: {mass: 1, length: 0.2}}
    rod: {bar: {mass: 1, length: 0.6}}
    piston: {block: {mass: 1.1, width: 0.1, height: 0.06}}
  joints:
    main: {pin: [ground.O, crank.start]}
    big_end: {pin: [crank.end, rod.start]}
    small_end: {pin: [rod.end, piston.center]}
    bore: {slide: [ground.O, piston.center], along: [3, 0]}
allow: {crank.angle: 1.0e-2}
"""
BAR = """\
scene:
  points: {O: [0, 0], hook: {at: [0, 0], velocity: [1.0, 0.5]}}
  bodies: {bar: {bar: {mass: 1, length: 5}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
allow: {bar.angle: 1.0e-2}
"""
PAIR = """\
scene:
  points: {O: [0, 0]}
  bodies: {one: {bar: {mass: 1, length: 0.8}}, two: {bar: {mass: 1, length: 0.8}}}
  joints: {top: {pin: [ground.O, one.start]}, knee: {JOINT}}
allow: {one.angle: 1.0e-2}
"""

LINKAGE = """\
scene:
  space: 3
  points: {O: [0, 0, 0], Q: [0.6, 0.1, 0]}
  bodies:
    crank:
      rigid: {mass: 0.5, inertia: [1.0e-3, 2.0e-3, 2.2e-3, 0, 0, 0]}
      points: {foot: [-0.07, 0, 0], pin: [0.07, 0, 0]}
    coupler:
      rigid: {mass: 0.5, inertia: [1.5e-3, 3.0e-2, 2.9e-2, 0, 0, 0]}
      points: {a: [-0.3, 0, 0], b: [0.3, 0, 0]}
    rocker:
      rigid: {mass: 0.8, inertia: [1.2e-2, 1.0e-2, 1.5e-2, 0, 0, 0]}
      points: {foot: [-0.1, -0.2, 0], pin: [0.1, 0.2, 0]}
  joints:
    motor: {hinge: [ground.O, crank.foot], axis: [0, 0, 1]}
    near:
      freedoms: {yaw: {hinge: [0, 0, 1]}, pitch: {hinge: [0, 1, 0]}, roll: {hinge: [1, 0, 0]}}
      of: [crank.pin, coupler.a]
    far: {ball: [coupler.b, rocker.pin]}
    bearing: {hinge: [ground.Q, rocker.foot], axis: [0.6, 0, 0.8]}
initial: {motor: {angle: 30 deg}, near: {roll: 0}}
"""
"""A crank, a coupler and a rocker about a skew axis: it closes in two ways."""
