"""Constraint rows of edges in space, in the order in which `userdata` has their forces."""

from collections.abc import Iterator
from xml.etree import ElementTree as ET

from .....cases.scene import Scene
from .....cases.scene.constraint import Edge


def fields(scene: Scene) -> list[str]:
    """The reactions of the scene's edges, as quantities."""
    return [f"{edge.name}.{field}" for edge, field in edge_forces(scene)]


def write_room(root: ET.Element, scene: Scene) -> None:
    """A number of `userdata` for each."""
    if scene.constraints:
        ET.SubElement(root, "size", nuserdata=str(len(fields(scene))))


def edge_forces(scene: Scene) -> Iterator[tuple[Edge, str]]:
    """Each edge's force to its side, and the one on its height where that is kept."""
    for edge in scene.constraints.values():
        yield edge, "force"
        if edge.kept:
            yield edge, "normal"
