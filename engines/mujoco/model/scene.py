"""A scene as an MJCF file: the xy plane, gravity −y, hinges about +z, so no axes are mapped.

Every body's frame sits in its centre of mass. Trees are native joints, loops close by `connect`,
springs and dampers are tendons, pushes and torques are actuators at sites.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from xml.etree import ElementTree as ET

from ....cases.scene import GROUND, Anchor, DryFriction, Scene
from ...engine import Choice, Start
from ...foot_contact import strode
from .contact import lies, place
from .drive import controls
from .drive import write as write_drives
from .edge import write_room
from .force import BY_ITSELF, begun_with, write
from .loops import add_loops, add_rods
from .number_text import attributes, soft, written
from .pairs import add_geoms, add_pair_sensors, add_pairs
from .planes import Soft, add_contacts, add_geom, add_planes, add_sensors, touching
from .rope import finish_ropes
from .stops import finish_stops
from .tree import (
    Branch,
    Tree,
    built_as,
    called,
    coordinate,
    coordinates,
    driven,
    freedoms,
    spanning_tree,
    turned,
)

HEAVY = 1e15  # kg of a driven point: 1 N changes its velocity by 1e-15 m/s in a second
LEAST = 1e-15  # kg m² (mjMINVAL) of a particle: MuJoCo takes no less of a body with a joint
FLOOR = f"{GROUND}.floor"  # no contact can be called that


def mjcf(
    scene: Scene,
    start: Start,
    choices: Iterable[Choice],
    begun: tuple[Sequence[float], Sequence[float]] = ((), ()),
) -> str:
    """The scene and its start as text that MuJoCo compiles; choices become attributes.

    A choice's name says where it stands: `option.integrator`, `connect.solref`, `pair.solimp`.
    begun: positions and rates in MuJoCo's order, where they are not the start's.
    """
    numbers = {choice.name: choice.value for choice in choices}
    tree = spanning_tree(scene)
    root = ET.Element("mujoco", model="textmech")
    gravity = written(*scene.gravity, 0)
    option = ET.SubElement(root, "option", attributes(numbers, "option"), gravity=gravity)
    # A reset must not look like a motion.
    flags = {"autoreset": "disable", **attributes(numbers, "flag")}
    ET.SubElement(option, "flag", flags)
    world = ET.SubElement(root, "worldbody")
    _world(world, scene)
    _bodies(world, scene, tree, numbers)
    if touching(scene) or scene.pairs:
        _touching(root, scene, partial(soft, numbers, "pair"))
    if tree.loops:
        pins, rods = attributes(numbers, "connect"), attributes(numbers, "rod")
        add_loops(root, tree.loops, pins, rods)
    add_pins(root, scene, start, attributes(numbers, "connect"))
    write(root, scene)
    add_rods(root, tree.loops)
    write_drives(root, scene)
    write_room(root, scene)
    finish_ropes(root, scene, attributes(numbers, "rope"))
    finish_stops(root, scene, partial(soft, numbers, "stop"))
    _start(root, scene, tree, start, begun, out=_leaves_plane(scene, numbers))
    ET.indent(root)
    return ET.tostring(root, encoding="unicode") + "\n"


def _world(world: ET.Element, scene: Scene) -> None:
    add_planes(world, scene)
    ET.SubElement(world, "site", name=GROUND, pos="0 0 0")
    for name, point in scene.points.items():
        if not point.driven:
            ET.SubElement(world, "site", name=f"{GROUND}.{name}", pos=written(*point.at, 0))
            continue
        # A point that nothing can hold back moves at its constant velocity in every RK4 stage;
        # a mocap body would stand still during a step, which costs three orders.
        body = ET.SubElement(world, "body", name=f"{GROUND}.{name}", gravcomp="1")
        _inertial(body, HEAVY, LEAST)
        for axis in ("x", "y"):
            _joint(body, f"{GROUND}.{name}.{axis}", "slide", axis=_AXES[axis])
        ET.SubElement(body, "site", name=f"{GROUND}.{name}", pos="0 0 0")


_AXES = {"x": "1 0 0", "y": "0 1 0", "angle": "0 0 1"}


def _joint(body: ET.Element, name: str, kind: str, **attributes: str) -> None:
    ET.SubElement(body, "joint", attributes, name=name, type=kind)


def _inertial(body: ET.Element, mass: float, inertia: float) -> None:
    # Only the moment about z plays in the plane; three equal ones are always a possible body.
    ET.SubElement(
        body, "inertial", pos="0 0 0", mass=written(mass), diaginertia=written(*[inertia] * 3)
    )


def _bodies(world: ET.Element, scene: Scene, tree: Tree, numbers: dict[str, object]) -> None:
    out = _leaves_plane(scene, numbers)
    elements = {GROUND: world}
    for element in world.iter("body"):
        elements[element.attrib["name"]] = element
    for branch in tree.branches:
        body = scene.bodies[branch.body]
        element = ET.SubElement(elements[branch.parent], "body", name=called(body.name))
        elements[body.name] = element
        _hang(element, scene, branch, attributes(numbers, "slide"))
        if branch.joint is None and out:
            _joint(element, f"{body.name}.z", "slide", axis="0 0 1")
        # A particle that is held rigidly must add nothing to the inertia of what carries it.
        least = LEAST if element.find("joint") is not None else 0.0
        _inertial(element, body.mass, body.moment if body.turns else least)
        for name, at in body.points.items():
            ET.SubElement(element, "site", name=f"{body.name}.{name}", pos=written(*at, 0))
        for contact in touching(scene).values():
            if contact.body == body.name:
                add_geom(element, scene, contact)
        add_geoms(element, scene, body.name)


def _touching(root: ET.Element, scene: Scene, soft: Soft) -> None:
    """The contacts, each with a sensor: MuJoCo records its force at every step."""
    contacts, sensors = ET.SubElement(root, "contact"), ET.SubElement(root, "sensor")
    add_contacts(contacts, scene, soft)
    add_pairs(contacts, scene, soft)
    add_sensors(sensors, scene)
    add_pair_sensors(sensors, scene)


def _leaves_plane(scene: Scene, numbers: dict[str, object]) -> bool:
    """Whether free bodies may move along z: nothing pushes them there, but without that freedom
    MuJoCo's noslip solver silently does nothing."""
    return bool(touching(scene) or scene.pairs) and numbers.get("option.noslip_iterations", 0) != 0


def _hang(element: ET.Element, scene: Scene, branch: Branch, soft: dict[str, str]) -> None:
    """Place a body's frame on its parent, with the joint between them."""
    body, joint = scene.bodies[branch.body], branch.joint
    if joint is None:
        for name in ("x", "y", *(["angle"] if body.turns else [])):
            kind = "hinge" if name == "angle" else "slide"
            _joint(element, f"{body.name}.{name}", kind, axis=_AXES[name])
        return
    outer, inner = branch.ends()
    left = built_as(scene, joint)
    held = 0.0 if left.turns or not body.turns else joint.angle
    held = held if branch.forward else -held
    at, own = local(scene, outer), turned(local(scene, inner), held)
    element.set("pos", written(at[0] - own[0], at[1] - own[1], 0))
    if held:
        element.set("quat", written(math.cos(held / 2), 0, 0, math.sin(held / 2)))
    friction = {} if joint.dry_friction is None else _friction(joint.dry_friction, soft)
    for freedom in freedoms(scene, branch):
        if freedom == "turn":
            pos, axis = written(*local(scene, inner), 0), _AXES["angle"]
            name, rubs = coordinate(joint, "turn"), {} if joint.shifts else friction
            _joint(element, name, "hinge", axis=axis, pos=pos, **rubs)
        else:
            # MuJoCo's axis stands in the child; `along` stands in the joint's first part.
            along = turned(joint.along, -held) if branch.forward else turned(joint.along, math.pi)
            name = coordinate(joint, "shift")
            _joint(element, name, "slide", axis=written(*along, 0), **friction)


def _friction(dry: DryFriction, soft: dict[str, str]) -> dict[str, str]:
    """A joint has one number for both directions, moving and at rest."""
    mean = (dry.kinetic.forward + dry.kinetic.backward) / 2
    return {"frictionloss": written(mean), **soft}


def local(scene: Scene, anchor: Anchor) -> tuple[float, float]:
    if anchor.body == GROUND:
        point = scene.points[anchor.point]
        return (0.0, 0.0) if point.driven else point.at
    return scene.bodies[anchor.body].points[anchor.point]


def _start(
    root: ET.Element,
    scene: Scene,
    tree: Tree,
    start: Start,
    begun: tuple[Sequence[float], Sequence[float]],
    *,
    out: bool,
) -> None:
    """The start as a keyframe, in the order in which MuJoCo numbers joints: depth first."""
    pairs: dict[str, list[tuple[float, float]]] = {}
    for name in driven(scene):
        x, y, vx, vy = scene.points[name.partition(".")[2]].state(0.0)
        pairs[name] = [(x, vx), (y, vy)]
    for branch in tree.branches:
        pairs[called(branch.body)] = coordinates(scene, tree, branch, start)
        if branch.joint is None and out:
            pairs[called(branch.body)].append((0.0, 0.0))
    flat = [
        pair
        for element in root.iter("body")  # document order is depth first
        for pair in pairs[element.attrib["name"]]
    ]
    key = ET.SubElement(ET.SubElement(root, "keyframe"), "key", name="start")
    key.set("qpos", written(*(begun[0] or [position for position, _ in flat])))
    key.set("qvel", written(*(begun[1] or [rate for _, rate in flat])))
    if activations := begun_with(scene):
        key.set("act", written(*activations))
    if laws := controls(scene):
        key.set("ctrl", written(*(int(law.law in BY_ITSELF) for law in laws)))


# Feet that stand one after the other, as MJCF: pins to the floor, of which the driver moves the
# sites and says which are active.


def add_pins(root: ET.Element, scene: Scene, start: Start, attributes: Mapping[str, str]) -> None:
    """A `connect` for each foot, with the contact's name; those that lie on the floor stand."""
    world = root.find("worldbody")
    feet = strode(scene)
    if world is None or not feet:
        return
    equality = root.find("equality")
    equality = ET.SubElement(root, "equality") if equality is None else equality
    for name, foot in feet.items():
        stands = lies(scene, foot, start)
        at = place(scene, foot.at, start) if stands else (0.0, 0.0)
        ET.SubElement(world, "site", name=name, pos=written(*at, 0))
        ET.SubElement(
            equality, "connect", dict(attributes),
            name=name, site1=name, site2=str(foot.at), active="true" if stands else "false",
        )  # fmt: skip
