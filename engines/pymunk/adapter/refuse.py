"""Scenes on which pymunk would abort the process, or for which it has no joint or no shape."""

import math

from ....cases.scene import GROUND, Scene
from ....cases.scene.frame import PLANE
from ...engine import Start
from ...foot_contact import NO_STRIDE, strides
from ..callbacks.force import ELEMENTS, lacking, throws_back
from ..model.drive import NO_LINE
from ..model.edge import NO_EDGE
from ..model.pair import MOST


def why_not_native(scene: Scene, start: Start) -> list[str]:
    """Why pymunk has nothing of its own for the scene; our laws and our driver have."""
    edges = [NO_EDGE] if scene.constraints else []
    strode = [NO_STRIDE] if strides(scene) else []
    return [*edges, *strode, *(why for _, why in lacking(scene, start))][:1]


def why_unbuildable(scene: Scene) -> str | None:
    """The first body or joint that has no counterpart; in space everything."""
    if scene.frame is not PLANE:
        return "engine: pymunk moves bodies in a plane, and this scene is in space"
    for body in scene.bodies.values():
        inertia = body.moment if body.turns else 1.0
        if not (0 < body.mass < math.inf and 0 < inertia < math.inf):
            return f"engine: pymunk takes only positive finite masses, {body.name} has none"
    for part in (*scene.joints.values(), *scene.springs(), *scene.dampers()):
        if part.a.body == part.b.body:
            where = "the ground" if part.a.body == GROUND else part.a.body
            return f"engine: {part.name} joins {where} to itself, on which pymunk aborts"
    for force in scene.forces.values():
        if type(force) not in ELEMENTS:
            return f"adapter: {force.name} is a {force.word}, which it does not build"
    if what := throws_back(scene):
        return what
    for quantity in scene.drives:
        if quantity.endswith(".speed"):
            return f"{NO_LINE}, as {quantity} is driven"
    for joint in scene.joints.values():
        point = scene.points.get(joint.a.point) if joint.a.body == GROUND else None
        if joint.dry_friction and point and point.moves:
            return f"adapter: {joint.name} has dry friction on a point that moves by a law"
    if len({c.plane for c in scene.contacts.values()}) + len(scene.pairs) > MOST:
        return f"engine: pymunk tells apart what touches what by {MOST} bits, and here are more"
    touching = [*scene.contacts.values(), *scene.pairs.values()]
    beside = [*touching, *(j for j in scene.joints.values() if j.dry_friction)]
    for edge in scene.constraints.values():
        if beside:
            return f"adapter: {edge.name} beside the dry friction of {beside[0].name}"
    for joint in scene.joints.values():
        first = joint.a.body
        only_turns = joint.turns and not joint.shifts
        if not only_turns and first != GROUND and not scene.bodies[first].turns:
            return f"adapter: {joint.name} starts at a particle, which has no axes"
    return None
