"""A chain's places, velocities and accelerations against what its joints hold and leave.

The rows of the mechanism in maximal coordinates know nothing of the chain's coordinates, and the
joints read these back from the poses alone.
"""

from collections.abc import Iterator

import numpy as np

from ...cases.scene.motion import Motion
from ...cases.scene.space.scene import SpatialScene
from ...cases.trajectory import Trajectory
from ..certificate.agreement import relative, worst
from ..mechanism.modes.space.mode import SpatialMultibody
from ..stated import Stated
from ..system import Array
from .derived import moving

Row = tuple[Array, Array, Array]
THREE = 3  # turns, of which other angles make the same attitude


def unheld(mode: Stated, scene: SpatialScene, rows: Iterator[Row]) -> float:
    """(2.10), (2.15) The largest of f = 0, f_a v = 0 and f_a v̇ = γ, each of its largest term."""
    base = SpatialMultibody(scene, (np.zeros(0), np.zeros(0)))
    found: list[float] = []
    for q, v, a in rows:
        poses, changes = mode.poses(0.0, q, v), moving(mode, q, v, a)
        at, rates = base.place(poses)
        _, accelerations = base.place({name: tuple(x) for name, x in changes.items()})
        f_a, g, gamma = base.rows(0.0, at, rates)
        found.append(worst(np.abs(base.f(0.0, at))) / max(1.0, worst(np.abs(at))))
        for held, right in ((rates, g), (accelerations, gamma)):
            size = worst(np.abs(f_a * held).ravel()) or 1.0
            found.append(worst(np.abs(f_a @ held - right)) / size)
    return worst(found)


def misread(scene: SpatialScene, found: Trajectory, drawn: dict[str, Array]) -> float:
    """How far coordinates and rates that joints read from the poses are from what was drawn."""
    motion = Motion(scene.bodies, scene.points, found)
    apart: list[float] = []
    for joint in scene.joints.values():
        places, rates = joint.coordinates(motion)
        for k, freedom in enumerate(joint.freedoms):
            place, rate, _ = drawn[f"{joint.name}.{freedom.name}"].T
            if freedom.kind == "turn" and len(joint.turns) == THREE:
                continue
            apart.append(relative(rate, rates[:, k], least=1.0))
            off = place - places[:, k]
            if freedom.kind == "turn":
                off = np.remainder(off + np.pi, 2 * np.pi) - np.pi
            apart.append(worst(np.abs(off)) / max(1.0, worst(np.abs(place))))
    return worst(apart)
