"""Any scene in space as a System: nothing switches there, so it has one mode and no guards."""

from ....cases.space.scene import SpatialScene
from ...system import MOVING, Array, System
from .mode import SpatialMultibody


class SpatialMechanism(System):
    """The scene as its one mode, which is its `base` too."""

    def __init__(self, scene: SpatialScene, start: tuple[Array, Array]) -> None:
        self.base = SpatialMultibody(scene, start)
        self.modes = {MOVING: self.base}
        self.corners = [corner for law in scene.laws() for corner in law.corners]

    def start(self) -> tuple[str, Array, Array]:
        """The assembled start."""
        return MOVING, *self.base.start()
