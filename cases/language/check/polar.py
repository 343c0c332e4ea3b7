"""Starts that give a place by its distance from a point of the ground, in some direction."""

from collections.abc import Iterator

from ...mistake import nearest
from ...point import GROUND, anchor
from ...scene import Scene
from ..grammar.file import Initial
from ..parse import Finding, Parsed

KEYS = ("from", "length", "direction")


def polar(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound starts."""
    for name, start in parsed.file.initial.items():
        given = [key for key in KEYS if key in start.keys]
        if not given or name not in scene.bodies:
            continue
        for key in (key for key in KEYS if key not in given):
            yield ("initial", name), f"needs `{key}` beside {' and '.join(given)}"
        for key in sorted({"x", "y", *start.places} & start.keys):
            yield ("initial", name, key), "cannot stand beside `from`, which gives the place too"
        yield from _origin(parsed, scene, name, start)


def _origin(parsed: Parsed, scene: Scene, name: str, start: Initial) -> Iterator[Finding]:
    if start.from_ is None:
        return
    at, path = anchor(start.from_), ("initial", name, "from")
    if at.body != GROUND:
        yield path, f"should be a point of the ground, is {start.from_!r}"
    elif at.point not in scene.points and not parsed.hides(at.point, ("points",)):
        known = parsed.names("points", scene.points)
        yield path, f"the ground has no point {at.point!r}{nearest(at.point, known)}"
