"""Constraint rows of edges in MuJoCo, in the order in which `userdata` has their forces."""

from collections.abc import Iterator
from xml.etree import ElementTree as ET

from ....cases.scene import Edge, Scene


def fields(scene: Scene) -> list[str]:
    """The reactions of the scene's edges, as quantities."""
    return [f"{edge.name}.{field}" for edge, field in edge_forces(scene)]


def write_room(root: ET.Element, scene: Scene) -> None:
    """A number of `userdata` for each."""
    if scene.constraints:
        ET.SubElement(root, "size", nuserdata=str(len(fields(scene))))


def edge_forces(scene: Scene) -> Iterator[tuple[Edge, str]]:
    """Each edge's forces: across it, and its drive or its height's where there are these."""
    for edge in scene.constraints.values():
        for field, (_, kind) in edge.quantities()[edge.name].items():
            if kind == "force":
                yield edge, field
