"""What of a scene pymunk has no element for."""

from ...cases.scene import Force, Scene
from .force import ELEMENTS


def lacking(scene: Scene) -> list[tuple[Force, str]]:
    """The forces that pymunk has no element for, and why: our laws tell it them."""
    found = ((force, ELEMENTS[type(force)].lacks) for force in scene.forces.values())
    return [(force, why) for force, why in found if why]
