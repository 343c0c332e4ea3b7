"""Any scene in space as a System: nothing switches there, so it has one mode and no guards."""

from ....cases.scene import Scene
from ...system import MOVING, Array, System
from ..constraints.leeway import Leeway
from .spatial_mode import SpatialMultibody


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
        return self.base.driven_point(name, t)

    def powers(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """The power [W] at any rates of each force that follows a law in time, by its name."""
        forces = self.base.forces(t, q, v)
        return {force.name: float(forces[force.name] @ v) for force in self.base.scene.signals()}
