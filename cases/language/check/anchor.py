"""Whether the point that something refers to is there: of the ground, or of a body."""

from collections.abc import Iterator

from ...mistake import Path, nearest
from ...scene import FLOOR, GROUND, Anchor, Scene
from ..parse import Finding, Parsed


def no_point(parsed: Parsed, scene: Scene, path: Path, at: Anchor) -> Iterator[Finding]:
    """Yields what is wrong with a reference to a point."""
    if at.body == GROUND:
        planes = getattr(parsed.file.scene, "planes", {})
        if at.point == FLOOR or at.point in planes.keys() - scene.points.keys():
            yield path, f"ground.{at.point} is not a point; only a contact touches it"
        elif at.point not in scene.points and not parsed.hides(at.point, ("points",)):
            known = parsed.names("points", scene.points)
            yield path, f"the ground has no point {at.point!r}{nearest(at.point, known)}"
        return
    yield from _no_body(parsed, scene, path, at.body)
    if at.body in scene.bodies and at.point not in scene.bodies[at.body].points:
        hint = nearest(at.point, scene.bodies[at.body].points)
        yield path, f"body {at.body!r} has no point {at.point!r}{hint}"


def _no_body(parsed: Parsed, scene: Scene, path: Path, name: str) -> Iterator[Finding]:
    if name not in scene.bodies and not parsed.hides(name):
        yield path, f"unknown body {name!r}{nearest(name, parsed.names('bodies', scene.bodies))}"
