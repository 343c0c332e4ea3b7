"""Friction that ends any motion in a finite time: a claim about states may have it."""

from collections.abc import Iterator

from ...drag import Drag
from ...force import of
from ...scene import Scene
from ..parse import Finding, Parsed


def slowing(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """What would stop a motion's points wherever they go; the rest the motion itself tells."""
    if parsed.file.states is not None:
        return
    for force in of(Drag, scene.forces.values()):
        path = ("scene", "forces", force.name, "exponent")
        if force.exponent == 0.0:
            yield path, "must be above 0 in a motion: with 0 it would be dry friction"
        elif force.ends and force.along is not None:
            what = (
                "must be at least 1 of an edge in a motion: with less it would stop in a finite "
                "time, along the edge or across it"
            )
            yield path, what
