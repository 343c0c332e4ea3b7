"""The themes of a case, read from its scene: by them a person looks for an answer."""

from .case import Case
from .scene import Scene
from .scene.point import GROUND

THEMES = {
    "pins": "joints of open chains",
    "loops": "closed chains of joints",
    "springs": "springs, dampers, muscles",
    "rolling": "rolling and blades: constraints on velocities",
    "friction": "dry friction: sliding, sticking, breaking loose",
    "impacts": "landing, bouncing, walking",
    "drag": "viscous drag and fields",
    "driven": "forces and motions given in time",
    "space": "attitudes and joints in space",
    "states": "claims about states, without a motion",
}
"""Each with what it means; a case may be about several."""
ELASTIC = {"spring", "damper", "torsion", "torsion_damper", "muscle", "linear_muscle"}
VISCOUS = {"drag", "viscous", "magnetic"}
GIVEN = {"push", "torque", "motor"}
OPENING = {"normal", "gap"}  # what is zero while nothing touches, or while something does


def themes(case: Case) -> tuple[str, ...]:
    """The themes of a case, in the order of THEMES; `pins` if no other applies."""
    scene = case.scene
    words = {force.word for force in scene.forces.values()}
    contacts = scene.contacts.values()
    applies = {
        "loops": _loops(scene),
        "springs": bool(words & ELASTIC),
        "rolling": bool(scene.constraints) or any(c.ideal == "rolling" for c in contacts),
        "friction": _dry(scene) or any(c.switches and c.static > 0.0 for c in contacts),
        "impacts": _strikes(case),
        "drag": bool(words & VISCOUS),
        "driven": bool(words & GIVEN) or bool(scene.drives) or _has_moved_point(scene),
        "space": scene.frame.dimension == 3,
        "states": case.states is not None,
    }
    chosen = tuple(name for name in THEMES if applies.get(name))
    return (
        chosen
        if set(chosen) - {"driven", "space"}
        else tuple(name for name in THEMES if name == "pins" or name in chosen)
    )


def _loops(scene: Scene) -> bool:
    """Whether the joints close a chain: one of them joins parts that already hang together."""
    part = {name: name for name in (GROUND, *scene.bodies)}

    def root(name: str) -> str:
        while part[name] != name:
            name = part[name]
        return name

    for joint in scene.joints.values():
        a, b = (root(end.body) for end in joint.refers()[:2])
        if a == b:
            return True
        part[a] = b
    return False


def _dry(scene: Scene) -> bool:
    return any(getattr(joint, "dry_friction", None) for joint in scene.joints.values())


def _has_moved_point(scene: Scene) -> bool:
    return any(point.driven for point in scene.points.values())


def _strikes(case: Case) -> bool:
    """Whether something lands, bounces or walks: told by its contacts and by its events."""
    contacts = case.scene.contacts.values()
    walks = any(getattr(contact, "tips", ()) or contact.ahead_of for contact in contacts)
    one_sided = any(case.scene.one_sided())
    quantities = {event.quantity.rpartition(".")[2] for event in case.events.values()}
    return walks or one_sided or bool(quantities & OPENING)
