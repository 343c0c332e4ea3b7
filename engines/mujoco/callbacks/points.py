"""The points at which a force acts: read at a stage, and told its forces there."""

import math
from collections.abc import Callable, Sequence

import mujoco
import numpy as np

from ....cases.scene import GROUND, Anchor, Scene
from ....cases.scene.forces.force import Force
from ...point_forces import Exerted, Place

_SITE = int(mujoco.mjtObj.mjOBJ_SITE)

Read = Callable[[], Place]
Push = Callable[[tuple[float, float], Place], None]


class Points:
    """MuJoCo's arrays, fetched once."""

    def __init__(
        self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, force: Force
    ) -> None:
        self._ends = [_point(scene, model, data, anchor) for anchor in scene.ends(force)]

    def places(self) -> list[Place]:
        """Where they are, and how they move."""
        return [read() for read, _ in self._ends]

    def push(self, forces: Exerted, places: Sequence[Place]) -> None:
        """A force [N] at each, about the centre of mass of its body."""
        for (_, push), force, place in zip(self._ends, forces, places, strict=True):
            push(force, place)


def _point(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, anchor: Anchor
) -> tuple[Read, Push]:
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
