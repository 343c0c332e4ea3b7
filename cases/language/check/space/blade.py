"""Blades in space: what can carry one."""

from collections.abc import Iterator

from ....space.scene import SpatialScene
from ...parse import Finding, Parsed


def blades(parsed: Parsed, scene: SpatialScene) -> Iterator[Finding]:
    """Every mistake in the sound constraints that is not one of a name."""
    for name, edge in scene.constraints.items():
        if what := edge.unfit(scene.bodies.get(edge.at.body)):
            yield ("scene", "constraints", name, edge.word), what
