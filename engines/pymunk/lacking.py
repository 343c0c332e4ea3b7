"""What of a scene pymunk has no element for."""

from ...cases.scene import Force, Scene
from .force import ELEMENTS
from .law.one_side import NO_SIDE


def lacking(scene: Scene) -> list[tuple[Force, str]]:
    """The forces that pymunk has no element for, and why: our laws tell it them."""
    found = ((force, ELEMENTS[type(force)].lacks) for force in scene.forces.values())
    one_sided = ((spring, NO_SIDE) for spring in scene.one_sided())
    return [*((force, why) for force, why in found if why), *one_sided]
