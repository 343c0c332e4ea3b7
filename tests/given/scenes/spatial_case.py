"""A sound case file in space with one of every word; each mistake is planted in it."""

SOUND = """\
title: A bit of everything in space
source: {exercise: "2.1", equations: ["2.60"]}
parameters: {m: 1.2, l: 0.8 m, phi0: 30 deg, w: 2 rad/s, J: 0.05}
scene:
  space: 3
  incline: phi0
  points: {O: [0, 0, 0], hook: {at: [0, 0, 1], velocity: [0, 0.1, 0]}}
  bodies:
    bar: {bar: {mass: m, length: l}, points: {P: [0.1, 0, 0]}}
    wheel: {disk: {mass: 2.0, radius: 0.25, axle: [0, 1, 0]}}
    globe: {sphere: {mass: 2.0, radius: 0.25}}
    box: {block: {mass: 2.0, size: [0.1, 0.2, 0.3]}}
    top: {rigid: {mass: 2.0, inertia: [J, J, 0.04, 0, 0, 0.01]}, points: {P: [0, 0, -0.2]}}
    bob: {particle: {mass: 0.5}}
  joints:
    q1: {hinge: [ground.O, bar.start], axis: [0, 0, 2]}
    neck: {ball: [ground.hook, top.P]}
    cross: {universal: [bar.end, box.center], axes: [[0, 1, 0], [0, 0, 1]]}
    rail: {slide: [ground.O, bob.center], along: [0, 3, 4]}
    upright:
      freedoms: {x: {slide: [1, 0, 0]}, y: {slide: [0, 1, 0]}, theta: {hinge: [0, 0, 1]}}
      of: [ground.O, wheel.center]
  contacts:
    touch: {between: [globe, ground.floor], friction: 0.5, ideal: rolling}
  forces:
    coil: {spring: [bar.end, wheel.center], stiffness: 40.0, rest_length: 0.2}
    hand: {push: wheel.center, constant: [1.0, 0, 0]}
    motor: {torque: top, sine: {amplitude: [0, 0, 1.0], angular_frequency: 20 rpm}}
  drive:
    upright.theta_dot: w
    q1.omega: {sine: {amplitude: 2.0, angular_frequency: w, phase: phi0}}
initial:
  q1: {angle: phi0, omega: 1.0}
  top: {attitude: [{axis: [0, 0, 1], angle: 0.1}, {axis: [1, 0, 0], angle: phi0}], P: [0, 0, 1]}
  neck: {omega: [0, 0, 20]}
  globe: {x: 1.0, y: 0, z: 0.25, vx: 0.1, attitude: {axis: [1, 0, 0], angle: 0}, omega: [0, 0, 1]}
near: {bob: {y: 0.1}, upright: {x: 0.2}}
duration: 1.0
samples: 26
step: {mujoco: 1.0e-3, pymunk: 1.0e-4}
allow: {bar.attitude: 1.0e-2, q1.angle: 1.0e-2, touch.slip: unknown, q1.torque: 1.0}
events: {top_of: {bob.vz: falls to zero}}
"""
