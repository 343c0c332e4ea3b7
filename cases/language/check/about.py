"""What acts about or along a joint: one that lets two parts turn, or one that lets them shift."""

from collections.abc import Iterator

from ...mistake import Path, nearest
from ...scene import Force, Scene
from ..parse import Finding, Parsed


def about(parsed: Parsed, scene: Scene, path: Path, force: Force, name: str) -> Iterator[Finding]:
    """What is wrong with the joint's name, or with the joint."""
    if name not in scene.joints:
        if not parsed.hides(name):
            yield (
                path,
                f"unknown joint {name!r}{nearest(name, parsed.names('joints', scene.joints))}",
            )
        return
    joint = scene.joints[name]
    if force.freedom == "shift":
        if not joint.shifts:
            yield path, f"{name!r} is a {joint.kind}, and lets nothing shift"
        return
    if not joint.turns:
        yield path, f"{name!r} is a {joint.kind}, and lets nothing turn"
        return
    for at in joint.refers():
        if at.body in scene.bodies and not scene.bodies[at.body].turns:
            yield path, f"{name!r} joins {at.body!r}, which is a particle and cannot turn"
