"""Checks the scene of a claim about states: free bodies of the plane, or an open chain in space.

What slows a body of the plane by its velocity may act on it: it is claimed, and moves nothing.
"""

from collections.abc import Iterator

from ...scene import Scene
from ...scene.frame import SPACE
from ...scene.joint import Joint
from ...scene.point import GROUND
from ...scene.quantity import table
from ...scene.states import claimable
from ..grammar.file import File
from ..parse import Finding, Parsed

_NOTHING = "a claim about states is about bodies and joints alone"


def states(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake of a claim about states in its scene and its bounds."""
    spec = parsed.file.scene
    for section in ("constraints", "contacts"):
        yield from ((("scene", section, name), _NOTHING) for name in getattr(spec, section))
    for name, force in scene.forces.items():
        if not force.stated:
            also = "" if scene.frame is SPACE else ", and about `drag`"
            yield ("scene", "forces", name), _NOTHING + also
    for name, point in spec.points.items():
        if point.driven:
            yield ("scene", "points", name), f"is driven: {_NOTHING}"
    if scene.frame is SPACE:
        if scene.drives:
            yield ("scene", "drive"), _NOTHING
        yield from _particles(scene)
        yield from _chain(parsed, scene)
    else:
        what = "has no place here: states of the plane are those of free bodies; write `space: 3`"
        yield from ((("scene", "joints", name), what) for name in spec.joints)
    yield from _limits(parsed.file)
    for name in parsed.file.allow:
        if name in table(scene) and name not in claimable(scene):
            what = f"{name!r} is no claim about states: it is drawn itself, or held by a constraint"
            yield ("allow", name), what


def _particles(scene: Scene) -> Iterator[Finding]:
    for name, body in scene.bodies.items():
        if not body.turns:
            yield ("scene", "bodies", name), "is a particle; a claim about states takes none"


def _chain(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """From the ground on each body hangs on one joint, whose freedoms have names."""
    if any(path[0] == "scene" for path in parsed.broken):
        return  # what is missing may be what joins them
    hung = {GROUND}
    for name, joint in _outward(scene):
        path = ("scene", "joints", name)
        if any(not freedom.name for freedom in joint.freedoms):
            yield path, f"a {joint.kind} has no coordinates to draw; write `freedoms`"
        if joint.a.body not in hung:
            what = "begins at nothing that hangs on the ground; name the part nearer to it first"
            yield (*path, joint.word), what
        elif joint.b.body in hung:
            yield path, "closes a loop: states are drawn of open chains"
        hung |= {joint.a.body, joint.b.body}
    for name in scene.bodies:
        if name not in hung:
            yield ("scene", "bodies", name), "hangs on nothing: join it to the ground by `freedoms`"


def _outward(scene: Scene) -> Iterator[tuple[str, Joint]]:
    """The joints from the ground on; last those that begin at nothing that hangs."""
    left, hung = dict(scene.joints), {GROUND}
    while left:
        ready = (name for name, joint in left.items() if joint.a.body in hung)
        name = next(ready, None) or next(iter(left))
        yield name, left[name]
        hung |= {left[name].a.body, left[name].b.body}
        del left[name]


def _limits(file: File) -> Iterator[Finding]:
    for setting, declared in file.deviates.items():
        for name, deviation in declared.items():
            if deviation.limit is not None:
                what = "no step leads to a state, so that there is no limit; write `by`"
                yield ("deviates", setting, name, "limit"), what
    for way in file.reach:
        if way.rpartition(".")[2] in ("law", "driver", "limit"):
            yield ("reach", way), "states are asked of the engine itself; write its name alone"
