"""A joint that exists only here: a bearing in which a body may both turn and slide along its axis.

All that has to be said of it stands in the first paragraph, under the file to which it would
belong. Prints the largest differences of a motion from what it has to be.
"""

# ruff: noqa: E402 - each part has its imports beside it, and the last must come after the others

import sys
from pathlib import Path

import numpy as np
from pydantic import Field

# cases/language/grammar/joint.py
from textmech.cases.fields.part import Pair
from textmech.cases.fields.vector import Direction
from textmech.cases.language.grammar.joint import KINDS, SpatialJointed
from textmech.cases.scene.joint import Freedom


class Bearing(SpatialJointed):
    """Lets the second part slide along an axis, and turn about it."""

    kind = "bearing"
    bearing: Pair
    axis: Direction = Field(description="in the axes of the first part")

    def left(self) -> tuple[Freedom, ...]:
        return Freedom.shift(self.axis, "shift"), Freedom.turn(self.axis, "angle")


KINDS[3]["bearing"] = Bearing

# The rest is used as it is.

from given.adapters.outside import answered, solved

from textmech.cases.scene.observe import observe
from textmech.engines.mujoco import MuJoCo

OMEGA = 3.0  # rad/s
CASE = f"""\
title: A bar slides down a bearing, and turns in it
source: {{equations: ["2.60"]}}
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{bar: {{rigid: {{mass: 2.0, inertia: [0.2, 0.3, 0.1, 0, 0, 0]}}}}}}
  joints: {{post: {{bearing: [ground.O, bar.center], axis: [0, 0, 1]}}}}
initial: {{post: {{shift: 0.5, angle: 20 deg, omega: {OMEGA}}}}}
allow: {{post.shift: 1.0e-2, post.angle: 1.0e-2, post.mx: 1.0e-2}}
duration: 0.5
samples: 26
step: {{mujoco: 1.0e-3}}
"""


def main(folder: Path) -> None:
    case, reference = solved(folder, CASE)
    t = case.times
    turned = observe(case.scene, reference, "post.angle") - np.radians(20) - OMEGA * t
    fallen = observe(case.scene, reference, "post.shift") - 0.5 + 9.80665 * t**2 / 2
    print("turned", np.abs(turned).max())
    print("fallen", np.abs(fallen).max())
    found = answered(MuJoCo("tuned"), case, reference)
    print("mujoco", np.abs(found.states["bar"] - reference.states["bar"]).max())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
