"""A force element that exists only here: a cable that pulls with a constant tension.

All that has to be said of it stands below, each under the file to which it would belong; the rest
of the suite is as it is. Prints the largest differences of a motion between its three answers.
"""

# ruff: noqa: E402 - each part has its imports beside it, and the last must come after the others

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any
from xml.etree import ElementTree as ET

import numpy as np

from textmech.cases.fields.field import In
from textmech.cases.fields.signal import Signal

# cases/scene/forces/force.py
from textmech.cases.scene.forces.force import FORCES, Line
from textmech.cases.scene.motion import Motion
from textmech.cases.trajectory import ANGLE, Array


@dataclass(frozen=True)
class Cable(Line):
    """F = T along the line between two points, which it pulls together."""

    word = "cable"
    pull: Annotated[float, In("N", above=0)]

    def tension(self, length: Array, rate: Array) -> Array:
        return np.full_like(length, self.pull)

    def potential(self, motion: Motion) -> Array:
        """U = T λ."""
        return self.pull * motion.line(self.a, self.b)[0]


FORCES["cable"] = Cable

# reference/mechanism/forces/action.py

from textmech.reference.mechanism.forces.action import ACTIONS, Lined, Load, pulled
from textmech.reference.mechanism.kinematics.kinematics import Kinematics


@dataclass(frozen=True)
class Pulled(Lined):
    """T along the line."""

    force: Cable

    def loads(self, k: Kinematics) -> list[Load]:
        """T along Δ on the first end."""
        return pulled(k, *self.ends(k), self.gap(k) * (self.force.pull / self.length(k)))

    def U(self, k: Kinematics) -> Any:
        """U = T λ."""
        return self.force.pull * self.length(k)


ACTIONS[Cable] = Pulled

# engines/law.py

from textmech.engines.law import TENSIONS

TENSIONS[Cable] = lambda force, length, rate: force.pull

# engines/mujoco/model/force.py

from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.model import force as mujoco
from textmech.engines.mujoco.model.number_text import written


def write(sections: mujoco.Sections, force: Cable) -> None:
    mujoco.tendon(sections, force)
    gear = written(-force.pull)
    ET.SubElement(sections["actuator"], "general", name=force.name, tendon=force.name, gear=gear)


mujoco.ELEMENTS[Cable] = mujoco.Element(write, signal=lambda force: Signal("constant", (1.0,)))

# engines/pymunk/callbacks/force.py

from textmech.engines.pymunk import Pymunk
from textmech.engines.pymunk.callbacks import force as pymunk
from textmech.engines.pymunk.callbacks.line_forces import midpoint_force, pull

pymunk.ELEMENTS[Cable] = pymunk.Element(
    load=pull, tell=lambda world, force, step, drift: midpoint_force(world, force, step)
)

# The rest is used as it is.

from given.adapters.outside import answered, solved

from textmech.cases.scene.observe import observe

CASE = """\
title: A bar on a pin, pulled by a cable
source: {equations: ["2.50"]}
scene:
  points: {O: [0, 0], W: [0.9, 0.7]}
  bodies: {rod: {bar: {mass: 1.2, length: 0.8}}}
  joints: {hinge: {pin: [ground.O, rod.start]}}
  forces: {rope: {cable: [rod.end, ground.W], pull: 9 N}}
initial: {rod: {angle: -20 deg}}
allow: {rod.angle: 1.0e-2, rope.length: 1.0e-2, rope.force: 1.0e-2, hinge.fx: 1.0}
duration: 1.0
samples: 11
step: {mujoco: 1.0e-3, pymunk: 1.0e-3}
"""


def main(folder: Path) -> None:
    case, reference = solved(folder, CASE)
    assert set(observe(case.scene, reference, "rope.force")) == {9.0}
    print("energy", np.ptp(observe(case.scene, reference, "energy.total")))
    for engine, forces in ((MuJoCo("tuned"), ("hinge.fx",)), (Pymunk("tuned"), ())):
        found = answered(engine, case, reference, forces)
        angle = found.states["rod"][:, ANGLE] - reference.states["rod"][:, ANGLE]
        print(engine.name, np.abs(angle).max())
        for name in forces:
            print(name, np.abs(found.reactions[name] - reference.reactions[name]).max())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
