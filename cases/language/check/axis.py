"""Bodies and the axes about which they turn: a particle has none, and a slender bar lacks one."""

from collections.abc import Iterator

import numpy as np

from ...scene import Scene
from ...scene.body import Body
from ...scene.joint import Joint
from ...scene.point import Anchor
from ...scene.solid import without_inertia
from ...trajectory import Array
from ..parse import Finding, Parsed

_NONE = "and it has no inertia about that"
NEAR = 1e-9  # sine of an angle, and of a length its part: numbers are typed with up to ten digits


def turns_freely(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Particles that a joint would turn, and bodies that turn freely without inertia."""
    for name, joint in scene.joints.items():
        turning = [f for f in joint.turns if f.kind == "turn"]
        for at in joint.refers():
            body = scene.bodies.get(at.body)
            if turning and body is not None and not body.turns:
                path = ("scene", "joints", name, joint.word)
                yield path, f"{at.body!r} is a particle and cannot turn; join it by a `ball`"
    for name, body in scene.bodies.items():
        if not body.turns or parsed.shaken:
            continue
        axis = without_inertia(body.inertia)
        if axis is not None and not _held(parsed, scene, name, axis):
            yield ("scene", "bodies", name), _freely(body, axis)


def _freely(body: Body, axis: Array) -> str:
    if body.shape == "bar":
        own = "nothing keeps it from turning about its own axis"
        return f"{body.name!r} is a slender bar: {own}, {_NONE}; give it as a `rigid` with a tensor"
    about = ", ".join(f"{x:.3g}" for x in axis * np.sign(axis[np.argmax(abs(axis))]) + 0.0)
    return f"nothing keeps {body.name!r} from turning about [{about}], {_NONE}"


def _held(parsed: Parsed, scene: Scene, body: str, axis: Array) -> bool:
    """Whether some joint keeps the body from turning about an axis through its centre."""
    if any(path[:2] == ("scene", "joints") for path in parsed.broken):
        return True  # perhaps that one
    return any(
        at.body == body and not _lets(scene, joint, at, axis)
        for joint in scene.joints.values()
        for at in joint.refers()
    )


def _lets(scene: Scene, joint: Joint, at: Anchor, axis: Array) -> bool:
    """Whether the joint lets the body turn about this axis wherever the joint stands."""
    point = scene.bodies[at.body].points.get(at.point)
    if point is None:
        return False
    d = np.asarray(point)
    on_it = np.linalg.norm(np.cross(axis, d)) <= NEAR * np.linalg.norm(d)
    if not on_it and len(joint.shifts) < 3:
        return False
    if not joint.holds_attitude:
        return True
    # The first axis stands in the first part and the last in the second.
    own = joint.turns[:1] if at == joint.a else joint.turns[-1:]
    return any(np.linalg.norm(np.cross(axis, f.axis)) <= NEAR for f in own)
