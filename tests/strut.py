"""An element that holds on one side and exists only here: a strut, never shorter than it is.

All that has to be said of it stands below, each under the file to which it would belong. Prints
when its three answers let go, and the largest differences of a motion between them.
"""

# ruff: noqa: E402 - each part has its imports beside it, and the last must come after the others

import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar
from xml.etree import ElementTree as ET

import numpy as np
from pymunk.constraints import SlideJoint

from textmech.cases.fields.field import In

# cases/scene/forces/force.py
from textmech.cases.scene.forces.element import Limit
from textmech.cases.scene.forces.force import FORCES
from textmech.cases.scene.motion import Motion
from textmech.cases.scene.point import Anchor
from textmech.cases.trajectory import Array, X, Y


@dataclass(frozen=True)
class Strut(Limit):
    """(2.14) on one side, λ ≥ L: it pushes where its ends are as near as they can be."""

    word = "strut"
    measured = "length"
    given: ClassVar[Mapping[str, tuple[str, ...]]] = {"force": ("force",)}
    a: Anchor  # one end
    b: Anchor  # the other
    length: Annotated[float, In("m", above=0)]  # L

    @property
    def sides(self) -> dict[str, tuple[float, float]]:
        """It pushes where it is as short as it can be."""
        return {"force": (1.0, self.length)}

    def refers(self) -> tuple[Anchor, ...]:
        return (self.a, self.b)

    def quantities(self) -> dict[str, Any]:
        return {self.name: {"length": ("m", "coordinate"), "force": ("N", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) length [m]; KeyError of its force, which only a producer knows."""
        return {"length": motion.line(self.a, self.b)[0]}[field]

    def numbers(self) -> dict[str, float]:
        return {"length": self.length}


FORCES["strut"] = Strut

# reference/mechanism/modes/unilateral.py

from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.constraints.constraint_terms import FIRST, SECOND, Apart
from textmech.reference.mechanism.modes.unilateral import LIMITS, Roped


def propped(scene: Any, strut: Strut, side: str, where: Any) -> Roped:
    """(2.14) λ = L; its multiplier pushes both ends apart."""
    row, at = (Apart(FIRST, SECOND),), strut.sides[side][1]
    short = Constraint(strut.name, (strut.a, strut.b), (row,), ((side,),), (at,), where)
    return Roped(name=strut.name, quantity=f"{strut.name}.{side}", normal=short)


LIMITS[Strut] = propped

# engines/mujoco/model/force.py

from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.model import force as mujoco
from textmech.engines.mujoco.model.limit import finish_rope, tension
from textmech.engines.mujoco.model.number_text import written


def write(sections: mujoco.Sections, strut: Strut) -> None:
    limits = {"limited": "true", "range": written(strut.length, mujoco.NEVER)}
    given = {"name": strut.name, **limits}
    spatial = ET.SubElement(sections["tendon"], "spatial", given)
    for end in (strut.a, strut.b):
        ET.SubElement(spatial, "site", site=str(end))


mujoco.ELEMENTS[Strut] = mujoco.Element(
    write,
    lambda model, strut: {"length": model.tendon_range[model.tendon(strut.name).id, 0]},
    limit=mujoco.Limited("rope", finish_rope, tension),
)

# engines/pymunk/callbacks/force.py

from textmech.engines.pymunk import Pymunk
from textmech.engines.pymunk.callbacks import force as pymunk
from textmech.engines.pymunk.model.limit import pulled


def joint(world: Any, strut: Strut) -> Any:
    ends = world.local(strut.a), world.local(strut.b)
    return SlideJoint(world.body(strut.a), world.body(strut.b), *ends, strut.length, math.inf)


pymunk.ELEMENTS[Strut] = pymunk.Element(
    limit=pymunk.Limited("slide joint", joint, lambda joint, strut: {"length": joint.min}, pulled)
)

# The rest is used as it is.

from given.adapters.outside import answered, solved

from textmech.reports.compare.events.times import reference_events

CASE = """\
title: A ball slides off a post
source: {equations: ["2.14"]}
scene:
  points: {O: [0, 0]}
  bodies: {ball: {particle: {mass: 2.0}}}
  forces: {post: {strut: [ground.O, ball.center], length: 0.5}}
initial: {ball: {from: ground.O, length: 0.5, direction: 60 deg, vx: 0, vy: 0}}
events: {leaves: {post.force: falls to zero}}
allow: {ball.x: 1.0e-2, ball.y: 1.0e-2, leaves.time: 1.0e-2, post.force: 1.0}
duration: 0.5
samples: 26
step: {mujoco: 1.0e-4, pymunk: 1.0e-4}
"""


def main(folder: Path) -> None:
    case, reference = solved(folder, CASE)
    assert reference.record is not None
    (left,) = reference_events(case.scene, reference.record, case.events["leaves"])
    print("leaves", left)
    for engine in (MuJoCo("tuned"), Pymunk("tuned")):
        found = answered(engine, case, reference, ("post.force",))
        off = found.states["ball"][:, [X, Y]] - reference.states["ball"][:, [X, Y]]
        print(engine.name, np.abs(off).max())
        force = found.reactions["post.force"] - reference.reactions["post.force"]
        print(f"{engine.name}.force", np.abs(force[1:4]).max())  # later soft limits let go, or hop


if __name__ == "__main__":
    main(Path(sys.argv[1]))
