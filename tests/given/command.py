"""The command in a process of its own, and a case of a user's for it."""

import subprocess
import sys
from pathlib import Path

NEW = """\
title: A bar that hangs on a cart
scene:
  points: {O: [0, 0]}
  bodies:
    cart: {block: {mass: 2.0, width: 0.3, height: 0.1}}
    rod: {bar: {mass: 0.5, length: 0.6}}
  joints:
    rail: {slide: [ground.O, cart.center], along: [1, 0]}
    hinge: {pin: [cart.center, rod.start]}
initial: {cart: {x: 0}, rod: {angle: -40 deg}}
duration: 0.4
samples: 6
step: {mujoco: 1.0e-3, pymunk: 1.0e-3}
allow: {cart.x: 1.0e-2, rod.angle: 1.0e-2}
"""


def textmech(*words: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "textmech.reports.cli", *map(str, words)],
        capture_output=True,
        text=True,
        cwd=folder,
        timeout=120,
        check=False,
    )
