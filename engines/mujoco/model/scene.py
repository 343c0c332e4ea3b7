"""A scene as an MJCF file, of the plane or of space: `tree` says how it lies in MuJoCo's axes.

Every body's frame sits in its centre of mass. Trees are native joints, loops close by `connect`,
springs and dampers are tendons, pushes and torques are actuators at sites, prescribed rates are
heavy armatures.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ....cases.scene import GROUND, DryFriction, Scene
from ....cases.scene.frame import PLANE
from ....cases.scene.rotation import Quaternion
from ....cases.trajectory import Array
from ...engine import Choice, Start
from ...foot_contact import strode
from .contact import lies, place
from .drive import controls
from .drive import write as write_drives
from .edge import write_room
from .force import BY_ITSELF, begun_with, finish, write
from .loops import add_loops, add_rods
from .number_text import attributes, lifted, section, soft, written
from .pairs import add_geoms, add_pair_sensors, add_pairs
from .planes import Soft, add_contacts, add_geom, add_planes, add_sensors, met, touching
from .start import started
from .tree import AXES, Branch, Tree, called, held_angle, local, natives, spanning_tree, turned

HEAVY = 1e15  # kg of a driven point: 1 N changes its velocity by 1e-15 m/s in a second
LEAST = 1e-15  # kg m² (mjMINVAL) of a particle: MuJoCo takes no less of a body with a joint


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
    gravity = written(*lifted(scene.gravity))
    option = ET.SubElement(root, "option", attributes(numbers, "option"), gravity=gravity)
    # A reset must not look like a motion.
    flags = {"autoreset": "disable", **attributes(numbers, "flag")}
    ET.SubElement(option, "flag", flags)
    world = ET.SubElement(root, "worldbody")
    _world(world, scene)
    _bodies(world, scene, tree, numbers)
    if met(scene):
        _touching(root, scene, partial(soft, numbers, "pair"))
    if tree.loops:
        pins, rods = attributes(numbers, "connect"), attributes(numbers, "rod")
        add_loops(root, scene, tree.loops, pins, rods)
    add_pins(root, scene, start, attributes(numbers, "connect"))
    write(root, scene)
    add_rods(root, tree.loops)
    write_drives(root, scene)
    write_room(root, scene)
    finish(root, scene, numbers)
    _start(root, scene, start, begun, out=_leaves_plane(scene, numbers))
    ET.indent(root)
    return ET.tostring(root, encoding="unicode") + "\n"


def _world(world: ET.Element, scene: Scene) -> None:
    add_planes(world, scene)
    ET.SubElement(world, "site", name=GROUND, pos="0 0 0")
    for name, point in scene.points.items():
        site = f"{GROUND}.{name}"
        if not point.driven:
            ET.SubElement(world, "site", name=site, pos=written(*lifted(point.at)))
            continue
        # A point that nothing can hold back moves at its constant velocity in every RK4 stage;
        # a mocap body would stand still during a step, which costs three orders.
        body = ET.SubElement(world, "body", name=site, gravcomp="1")
        _inertial(body, HEAVY, (LEAST, LEAST, LEAST))
        for axis, along in zip(scene.frame.axes, AXES, strict=False):
            _joint(body, f"{site}.{axis}", "slide", axis=written(*along))
        ET.SubElement(body, "site", name=site, pos="0 0 0")


def _joint(body: ET.Element, name: str, kind: str, **attributes: str) -> None:
    ET.SubElement(body, "joint", attributes, name=name, type=kind)


def _inertial(
    body: ET.Element, mass: float, moments: Sequence[float], axes: Quaternion | None = None
) -> None:
    given = {} if axes is None else {"quat": written(*axes)}
    ET.SubElement(
        body, "inertial", given, pos="0 0 0", mass=written(mass), diaginertia=written(*moments)
    )


def _bodies(world: ET.Element, scene: Scene, tree: Tree, numbers: dict[str, object]) -> None:
    elements = {GROUND: world} | {element.attrib["name"]: element for element in world.iter("body")}
    for branch in tree.branches:
        body = scene.bodies[branch.body]
        element = ET.SubElement(elements[branch.parent], "body", name=called(body.name))
        elements[body.name] = element
        _hang(element, scene, branch, attributes(numbers, "slide"))
        if branch.joint is None and _leaves_plane(scene, numbers):
            _joint(element, f"{body.name}.z", "slide", axis=written(*AXES[2]))
        _inertial(element, body.mass, *_moments(element, scene, body))
        for name, at in body.points.items():
            ET.SubElement(element, "site", name=f"{body.name}.{name}", pos=written(*lifted(at)))
        for contact in touching(scene).values():
            if contact.body == body.name:
                add_geom(element, scene, contact)
        add_geoms(element, scene, body.name)


def _moments(
    element: ET.Element, scene: Scene, body: Any
) -> tuple[tuple[float, float, float], Quaternion | None]:
    """Principal moments [kg m²] of a body, and the attitude of their axes; None: the body's."""
    if not body.turns:
        # A particle that is held rigidly must add nothing to the inertia of what carries it.
        least = LEAST if element.find("joint") is not None else 0.0
        return (least, least, least), None
    if scene.frame is PLANE:
        # Only the moment about z plays in the plane; three equal ones are always a possible body.
        return (body.moment, body.moment, body.moment), None
    return principal(body.tensor)


def _leaves_plane(scene: Scene, numbers: dict[str, object]) -> bool:
    """Whether free bodies of the plane may move along z: nothing pushes them there, but without
    that freedom MuJoCo's noslip solver silently does nothing."""
    noslip = numbers.get("option.noslip_iterations", 0) != 0
    return scene.frame is PLANE and bool(met(scene)) and noslip


def _hang(element: ET.Element, scene: Scene, branch: Branch, soft: dict[str, str]) -> None:
    """Place a body's frame on its parent, with the joints between: at zero, axes are parallel,
    or as a joint of the plane holds them."""
    joint = branch.joint
    pos: dict[str, str] = {}
    friction: dict[str, str] = {}
    if joint is not None:
        outer, inner = branch.ends()
        x, y, z = local(scene, inner)
        pos["pos"] = written(x, y, z)
        held = held_angle(scene, branch)
        ends = zip(local(scene, outer), (*turned((x, y), held), z), strict=True)
        element.set("pos", written(*(there - own for there, own in ends)))
        if held:
            element.set("quat", written(math.cos(held / 2), 0, 0, math.sin(held / 2)))
        if joint.dry_friction is not None:
            friction = _friction(joint.dry_friction, soft)
    for native in natives(scene, branch):
        if native.type == "free":
            ET.SubElement(element, "freejoint", name=native.name)
            continue
        given = {"axis": written(*native.axis)} if native.type != "ball" else {}
        given |= pos if native.type != "slide" else {}
        rubs = friction if native.of == 0 else {}
        _joint(element, native.name, native.type, **given, **rubs)


def _touching(root: ET.Element, scene: Scene, soft: Soft) -> None:
    """The contacts, each with a sensor: MuJoCo records its force at every step."""
    contacts, sensors = ET.SubElement(root, "contact"), ET.SubElement(root, "sensor")
    add_contacts(contacts, scene, soft)
    add_pairs(contacts, scene, soft)
    add_sensors(sensors, scene)
    add_pair_sensors(sensors, scene)


def _friction(dry: DryFriction, soft: dict[str, str]) -> dict[str, str]:
    """A joint has one number for both directions, moving and at rest."""
    mean = (dry.kinetic.forward + dry.kinetic.backward) / 2
    return {"frictionloss": written(mean), **soft}


def _start(
    root: ET.Element,
    scene: Scene,
    start: Start,
    begun: tuple[Sequence[float], Sequence[float]],
    *,
    out: bool,
) -> None:
    """The start as a keyframe, in the order in which MuJoCo numbers joints: depth first."""
    coordinates = started(scene, start)
    for branch in spanning_tree(scene).branches if out else ():
        if branch.joint is None:
            for columns in coordinates[called(branch.body)]:
                columns.append(0.0)
    # Document order is depth first.
    each = [coordinates[element.attrib["name"]] for element in root.iter("body")]
    key = ET.SubElement(ET.SubElement(root, "keyframe"), "key", name="start")
    key.set("qpos", written(*(begun[0] or [x for places, _ in each for x in places])))
    key.set("qvel", written(*(begun[1] or [x for _, rates in each for x in rates])))
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
    equality = section(root, "equality")
    for name, foot in feet.items():
        stands = lies(scene, foot, start)
        at = place(scene, foot.at, start) if stands else (0.0, 0.0)
        ET.SubElement(world, "site", name=name, pos=written(*at, 0))
        ET.SubElement(
            equality, "connect", dict(attributes),
            name=name, site1=name, site2=str(foot.at), active="true" if stands else "false",
        )  # fmt: skip


# An inertia tensor as MuJoCo takes it: principal moments, and the attitude of their axes.
#
# MuJoCo's own `fullinertia` refuses a third of all thin disks that are turned: rounding makes their
# largest moment exceed the sum of the others. Here it is cut to the sum.


ROUNDING = 1e-13  # of the largest moment: what is beyond is no rounding, and MuJoCo's to refuse


def principal(tensor: Array) -> tuple[tuple[float, float, float], Quaternion | None]:
    """Moments [kg m²], none below MuJoCo's least, and the attitude of their axes; None: the body's.

    A slender bar's moment about its own axis becomes 1e-15.
    """
    if np.array_equal(tensor, np.diag(np.diag(tensor))):
        return _possible(np.diag(tensor)), None
    moments, axes = np.linalg.eigh(tensor)
    if np.linalg.det(axes) < 0:
        axes[:, 0] = -axes[:, 0]
    return _possible(moments), _quaternion(axes)


def _possible(moments: Array) -> tuple[float, float, float]:
    """No moment exceeds the sum of the others, by rounding."""
    principal = np.maximum(moments, LEAST)
    largest = int(np.argmax(principal))
    rest = float(sum(np.delete(principal, largest)))
    if 0 < principal[largest] - rest <= ROUNDING * rest:
        principal[largest] = rest
    return float(principal[0]), float(principal[1]), float(principal[2])


def _quaternion(axes: Array) -> Quaternion:
    """The unit quaternion (w, x, y, z) of a rotation matrix."""
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, axes.ravel())
    w, x, y, z = quaternion.tolist()
    return w, x, y, z
