"""Edges: what can carry one, and with which speed it starts."""

from collections.abc import Iterator

from ...scene import Scene
from ..parse import Finding, Parsed


def edges(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound edges and in the speeds of the start."""
    for name, edge in scene.constraints.items():
        if what := edge.unfit(scene.bodies.get(edge.at.body)):
            yield ("scene", "constraints", name, edge.word), what
    for name, start in parsed.file.initial.items():
        given = sorted(start.keys)
        if name not in scene.constraints:
            if "speed" in given and name not in scene.joints:
                what = "only an edge or a joint that slides starts with a `speed`"
                yield ("initial", name, "speed"), what
            continue
        for key in given:
            if key != "speed":
                yield ("initial", name, key), f"{name!r} is an edge and starts with a `speed`"
            elif scene.constraints[name].speed is not None:
                yield ("initial", name, key), f"the speed of {name!r} is prescribed"
