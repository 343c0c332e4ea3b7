"""Machines with a light part between heavy ones, at which pymunk's sweeps converge slowly."""

WHITWORTH = """\
scene:
  points: {O: [0, 0], Q: [0, -0.4]}
  bodies:
    crank: {bar: {mass: 3, length: 0.25}}
    die: {block: {mass: 0.1, width: 0.1, height: 0.06}}
    arm: {bar: {mass: 1, length: 1.0}}
  joints:
    axle: {pin: [ground.O, crank.start]}
    pivot: {pin: [ground.Q, arm.start]}
    guide: {slide: [arm.start, die.center], along: [1, 0]}
    crankpin: {pin: [crank.end, die.center]}
  forces: {motor: {torque: crank, constant: 4.0}}
initial: {crank: {angle: 20 deg, omega: 4}}
near: {arm: {angle: 60 deg}}
allow: {crank.angle: 1.0e-2, arm.angle: 1.0e-2, axle.force: 0.5}
"""
SCISSOR = """\
scene:
  points: {O: [0, 0]}
  bodies:
    left: {bar: {mass: 1, length: 1.0}}
    right: {bar: {mass: 1, length: 1.0}}
    roller: {block: {mass: 0.2, width: 0.1, height: 0.1}}
    load: {particle: {mass: 10}}
  joints:
    A: {pin: [ground.O, left.start]}
    M: {pin: [left.center, right.center]}
    R: {pin: [right.start, roller.center]}
    rail: {slide: [ground.O, roller.center], along: [1, 0]}
    T: {pin: [right.end, load.center]}
  forces: {oil: {damper: [ground.O, roller.center], damping: 200}}
initial: {left: {angle: 60 deg}}
near: {right: {angle: 120 deg}}
allow: {left.angle: 1.0e-2, load.y: 1.0e-2, A.force: 0.5}
"""
CRANE = """\
scene:
  points: {O: [0, 0]}
  bodies:
    trolley: {block: {mass: 5, width: 0.4, height: 0.2}}
    rope: {bar: {mass: 0.1, length: 1.5}}
    load: {block: {mass: 8, width: 0.3, height: 0.3}}
  joints:
    rail: {slide: [ground.O, trolley.center], along: [1, 0]}
    top: {pin: [trolley.center, rope.start]}
    hook: {pin: [rope.end, load.center]}
initial: {trolley: {x: 0}, rope: {angle: -50 deg}, load: {angle: 0}}
allow: {trolley.x: 1.0e-2, rope.angle: 1.0e-2, hook.force: 0.5}
"""
