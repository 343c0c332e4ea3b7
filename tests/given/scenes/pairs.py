"""Two bodies that touch, typed for several tests: a disk on a tray that turns, and others."""

from math import cos, sin

G = 9.80665
M, W, H = 3.0, 1.2, 0.1  # of the tray
m, R, S0, PHI0 = 0.8, 0.12, 0.15, 0.2  # of the disk, and the start
J, I, A = M * (W**2 + H**2) / 12, m * R**2 / 2, H / 2 + R
TRAY = f"""\
scene:
  points: {{O: [0, 0]}}
  bodies:
    tray: {{block: {{mass: {M}, width: {W}, height: {H}}}}}
    disk: {{disk: {{mass: {m}, radius: {R}}}}}
  joints: {{axle: {{pin: [ground.O, tray.center]}}}}
  contacts: {{touch: {{between: [disk, tray.top], friction: 1.5}}}}
initial:
  tray: {{angle: {PHI0}, omega: -1.0}}
  disk:
    x: {S0 * cos(PHI0) - A * sin(PHI0)!r}
    y: {S0 * sin(PHI0) + A * cos(PHI0)!r}
    angle: {PHI0}
    vx: {(A * cos(PHI0) + S0 * sin(PHI0))!r}
    vy: {(A * sin(PHI0) - S0 * cos(PHI0))!r}
    omega: -1.0
allow: {{disk.x: 1.0e-2, tray.angle: 1.0e-2, touch.normal: 1.0e-1, touch.tangent: 1.0e-1}}
"""
"""A block that turns about its middle, and a disk that rolls on it with it at first."""
BOB = """\
scene:
  points: {O: [0, 0]}
  bodies: {drum: {disk: {mass: 2, radius: 0.5}}, bob: {particle: {mass: 1}}}
  joints: {axle: {pin: [ground.O, drum.center]}}
  contacts: {touch: {between: [bob, drum], friction: MU}}
initial: {drum: {angle: 0}, bob: {from: ground.O, length: 0.5, direction: 70 deg}}
allow: {bob.x: 1.0e-2, touch.normal: 1.0e-1}
"""
"""A particle on a drum that turns."""
