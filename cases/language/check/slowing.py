"""Friction that ends any motion in a finite time: a claim about states may have it."""

from collections.abc import Iterator

from ...scene import Scene
from ..parse import Finding, Parsed


def slowing(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every exponent below 1 of a motion's points."""
    if parsed.file.states is not None:
        return
    for name, force in scene.forces.items():
        if force.ends:
            what = "must be at least 1 in a motion: with less it would stop in a finite time"
            yield ("scene", "forces", name, "exponent"), what
