"""Claims about states typed in tests: a chain in space, and free bodies of the plane."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from textmech.cases.case import Case
from textmech.cases.load import load

CHAIN = """\
title: A bar and a cuboid in series
source: {equations: ["2.44"]}
parameters: {m: 1.2, l: 0.8 m}
scene:
  space: 3
  points: {O: [0, 0, 0.1]}
  bodies:
    rod: {bar: {mass: m, length: l}}
    box: {block: {mass: 2.0, size: [0.1, 0.2, 0.3]}, points: {in: [0.05, 0.1, 0], P: [0, 0.1, 0.2]}}
  joints:
    q1: {hinge: [ground.O, rod.start], axis: [0, 3, 4]}
    rail:
      freedoms: {s: {slide: [1, 0, 0]}, a: {hinge: [0, 0, 1]}}
      of: [rod.end, box.in]
states: {random: 5, seed: 7, q: [-1, 1], q_dot: [-2, 2], q_ddot: [-3, 3]}
allow: {box.P.ax: 1.0e-9, q1.torque: 1.0e-9, rail.s_force: 1.0e-9, energy.total: 1.0e-9}
"""

PLANE = """\
title: A disk and a particle in the plane
source: {equations: ["2.54"]}
scene:
  points: {O: [0, 0]}
  bodies:
    wheel: {disk: {mass: 1.3, radius: 0.2}, points: {P: [0.1, 0.05]}}
    bob: {particle: {mass: 0.4}}
states: {random: 4, seed: 0, q: [-1, 1], q_dot: [-2, 2]}
allow: {wheel.P.x: 1.0e-12, wheel.P.vy: 1.0e-12, wheel.inertia: 1.0e-12, momentum.x: 1.0e-12}
"""


def claimed(folder: Path, text: str, **given: Any) -> Case:
    """The case of a file with this text, with some of its fields replaced."""
    path = folder / "claimed.yaml"
    path.write_text(text, encoding="utf-8")
    return replace(load(path)[0], **given)
