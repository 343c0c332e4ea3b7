"""Any scene in space as a System: nothing switches there, so it has one mode and no guards."""

import numpy as np

from .....cases.scene import GROUND, Anchor, Scene
from ....system import MOVING, Array, System
from ...constraints.leeway import Leeway
from .mode import SpatialMultibody


class SpatialMechanism(System):
    """The scene as its one mode, which is its `base` too."""

    def __init__(self, scene: Scene, start: tuple[Array, Array]) -> None:
        self.base = SpatialMultibody(scene, start)
        self.modes = {MOVING: self.base}
        self.corners = [corner for law in scene.laws() for corner in law.corners]

    def start(self) -> tuple[str, Array, Array]:
        """The assembled start."""
        return MOVING, *self.base.start()

    def leeway(self, mode: str, t: float, q: Array, v: Array) -> Leeway | None:
        """The forces that the laws allow in a mode here; None where there is one of each."""
        return self.base.leeway(t, q, v)

    def driven_point(self, name: str, t: float) -> tuple[float, ...]:
        """x, y, z, vx, vy, vz of a point of the ground that moves."""
        layout = self.base.layout
        still = np.zeros(layout.where.size)
        bodies = layout.bodies(self.base.start()[0], still)
        point = layout.attached([Anchor(GROUND, name)]).at(t, bodies)
        return *point.r[0].tolist(), *point.r_dot[0].tolist()

    def powers(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """The power [W] at any rates of each force that follows a law in time, by its name."""
        each = dict(zip(self.base.scene.forces, self.base.forces(t, q, v), strict=True))
        return {force.name: float(each[force.name] @ v) for force in self.base.scene.signals()}
