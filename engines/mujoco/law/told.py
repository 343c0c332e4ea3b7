"""Forces that MuJoCo has no element for: by their laws, at every stage, in MuJoCo's callback.

It is asked when places and velocities of the stage are known, and puts forces on bodies, which
MuJoCo then counts as it counts any other.
"""

import math
from collections.abc import Callable

import mujoco
import numpy as np

from ....cases.scene import GROUND, Anchor, Scene
from ...told import Place, law_of
from ..force import lacking
from .signal import Control, bound

_SITE = int(mujoco.mjtObj.mjOBJ_SITE)

Read = Callable[[], Place]
Push = Callable[[tuple[float, float], Place], None]


def told(scene: Scene, model: mujoco.MjModel) -> list[Control]:
    """One callback for all of them, or none."""
    forces = [force for force, _ in lacking(scene)]
    if not forces:
        return []

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        pushed = data.xfrc_applied
        laws = [
            (law_of(scene, f), [_point(scene, model, data, at) for at in scene.ends(f)])
            for f in forces
        ]

        def apply() -> None:
            pushed[:] = 0.0
            t = data.time
            for law, points in laws:
                places = [read() for read, _ in points]
                for (_, push), force, place in zip(points, law(t, places), places, strict=True):
                    push(force, place)

        return apply

    return [bound(bind)]


def _point(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, anchor: Anchor
) -> tuple[Read, Push]:
    """How a point is read, and how a force on it is told: about the centre of mass of its body."""
    site = int(model.site(str(anchor)).id)
    body = int(model.site_bodyid[site])
    turns = anchor.body != GROUND and scene.bodies[anchor.body].turns
    at, axes = data.site_xpos[site], data.xmat[body]
    centre, wrench, moving = data.xipos[body], data.xfrc_applied[body], np.zeros(6)

    def read() -> Place:
        mujoco.mj_objectVelocity(model, data, _SITE, site, moving, 0)
        _, _, _, vx, vy, _ = moving.tolist()
        angle = math.atan2(axes.item(3), axes.item(0)) if turns else 0.0
        return Place(at.item(0), at.item(1), vx, vy, angle)

    def push(force: tuple[float, float], place: Place) -> None:
        fx, fy = force
        wrench[0] += fx
        wrench[1] += fy
        if turns:
            wrench[5] += (place.x - centre.item(0)) * fy - (place.y - centre.item(1)) * fx

    return (read, push) if body else (read, _nobody)


def _nobody(force: tuple[float, float], place: Place) -> None:
    """The ground bears anything."""
