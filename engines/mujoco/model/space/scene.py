"""A scene in space as an MJCF file: z up, every body's frame in its centre of mass.

Trees are native joints, loops close by `connect`, springs and dampers are tendons, pushes and
torques are actuators at sites, prescribed rates are heavy armatures.
"""

from collections.abc import Iterable, Sequence
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from .....cases.scene import GROUND, Anchor, Scene, Signal
from .....cases.scene.body import Body
from .....cases.scene.chain import across
from .....cases.scene.contact import Contact
from .....cases.scene.joint import Joint
from .....cases.scene.rotation import Quaternion, Vector3
from .....cases.trajectory import Array
from ....engine import Choice, Start
from ..force import BY_ITSELF, write
from ..force import signals as laws
from ..number_text import attributes, soft, written
from ..scene import FLOOR, HEAVY, LEAST
from ..spatial_tree import held_points, natives, spanning_tree
from ..tree import Branch, called
from .drive import signals as drives
from .drive import write as write_drives
from .edge import write_room
from .start import started

THIN = 1e-6  # m, half the thickness of a disk: an ellipsoid, which touches in one point


def mjcf(
    scene: Scene,
    start: Start,
    choices: Iterable[Choice],
    begun: tuple[Sequence[float], Sequence[float]] = ((), ()),
) -> str:
    """The scene and its start as text that MuJoCo compiles; choices become attributes.

    begun: positions and velocities in MuJoCo's order, where they are not the start's.
    """
    numbers = {choice.name: choice.value for choice in choices}
    root = ET.Element("mujoco", model="textmech")
    option = ET.SubElement(
        root, "option", attributes(numbers, "option"), gravity=written(*scene.gravity)
    )
    # A reset must not look like a motion.
    flags = {"autoreset": "disable", **attributes(numbers, "flag")}
    ET.SubElement(option, "flag", flags)
    world = ET.SubElement(root, "worldbody")
    _world(world, scene)
    _bodies(world, scene)
    if scene.contacts:
        _contacts(root, scene, numbers)
    if spanning_tree(scene).loops:
        _loops(root, scene, attributes(numbers, "connect"))
    write(root, scene)
    write_drives(root, scene)
    write_room(root, scene)
    _start(root, scene, start, begun)
    ET.indent(root)
    return ET.tostring(root, encoding="unicode") + "\n"


def signals(scene: Scene) -> list[Signal]:
    """The laws of the actuators' controls, in MuJoCo's order."""
    return [*laws(scene), *drives(scene)]


def _world(world: ET.Element, scene: Scene) -> None:
    if scene.contacts:
        ET.SubElement(
            world, "geom", name=FLOOR, type="plane", size="0 0 1", contype="0", conaffinity="0"
        )
    _site(world, GROUND, (0.0, 0.0, 0.0))
    for name, point in scene.points.items():
        if not point.driven:
            _site(world, f"{GROUND}.{name}", point.at)
            continue
        # What nothing can hold back moves at its constant velocity in every RK4 stage.
        body = ET.SubElement(world, "body", name=f"{GROUND}.{name}", gravcomp="1")
        ET.SubElement(body, "inertial", pos="0 0 0", mass=written(HEAVY), diaginertia=_LEAST)
        for axis, along in zip("xyz", ("1 0 0", "0 1 0", "0 0 1"), strict=True):
            ET.SubElement(body, "joint", name=f"{GROUND}.{name}.{axis}", type="slide", axis=along)
        _site(body, f"{GROUND}.{name}", (0.0, 0.0, 0.0))


_LEAST = written(*[LEAST] * 3)


def _site(element: ET.Element, name: str, at: Iterable[float]) -> None:
    ET.SubElement(element, "site", name=name, pos=written(*at))


def _bodies(world: ET.Element, scene: Scene) -> None:
    elements = {GROUND: world} | {element.attrib["name"]: element for element in world.iter("body")}
    for branch in spanning_tree(scene).branches:
        body = scene.bodies[branch.body]
        element = ET.SubElement(elements[branch.parent], "body", name=called(body.name))
        elements[body.name] = element
        _hang(element, scene, branch)
        _inertial(element, body)
        for name, at in body.points.items():
            _site(element, f"{body.name}.{name}", at)
        for contact in scene.contacts.values():
            if contact.body == body.name:
                _touching(element, body, contact)


def _hang(element: ET.Element, scene: Scene, branch: Branch[Joint]) -> None:
    """Place a body's frame on its parent, with the joint between: at zero, axes are parallel."""
    at: Sequence[float] = (0.0, 0.0, 0.0)
    if branch.joint is not None:
        outer, inner = branch.ends()
        at = local(scene, inner)
        pairs = zip(local(scene, outer), at, strict=True)
        element.set("pos", written(*(there - own for there, own in pairs)))
    for native in natives(scene, branch):
        given = {"name": native.name, "type": native.type}
        if native.type in ("hinge", "slide"):
            given["axis"] = written(*native.axis)
        if native.type in ("hinge", "ball"):
            given["pos"] = written(*at)
        if native.type == "free":
            ET.SubElement(element, "freejoint", name=native.name)
        else:
            ET.SubElement(element, "joint", given)


def _inertial(element: ET.Element, body: Body) -> None:
    inertial = ET.SubElement(element, "inertial", pos="0 0 0", mass=written(body.mass))
    if not body.turns:
        # A particle that is held rigidly must add nothing to the inertia of what carries it.
        inertial.set("diaginertia", _LEAST if element.find("joint") is not None else "0 0 0")
        return
    moments, axes = principal(body.tensor)
    inertial.set("diaginertia", written(*moments))
    if axes is not None:
        inertial.set("quat", written(*axes))


def _touching(element: ET.Element, body: Body, contact: Contact) -> None:
    """A disk as thin as an ideal one, or a sphere; of a pivot one as small as a point."""
    geom = ET.SubElement(
        element, "geom", name=contact.name, pos=written(*body.points[contact.at.point]),
        contype="0", conaffinity="0",
    )  # fmt: skip
    if contact.ideal == "pivot":
        geom.set("type", "sphere")
        geom.set("size", written(THIN))
        return
    assert body.radius is not None
    if contact.rim:
        assert body.axle is not None
        geom.set("type", "ellipsoid")
        geom.set("size", written(body.radius, body.radius, THIN))
        geom.set("zaxis", written(*body.axle))
    else:
        geom.set("type", "sphere")
        geom.set("size", written(body.radius))


def local(scene: Scene, anchor: Anchor) -> Vector3:
    """A point in the axes of its body, or of the ground; a driven point is its own body."""
    if anchor.body != GROUND:
        return scene.bodies[anchor.body].points[anchor.point]
    point = scene.points[anchor.point]
    return (0.0, 0.0, 0.0) if point.driven else point.at  # type: ignore[return-value]


def _contacts(root: ET.Element, scene: Scene, numbers: dict[str, object]) -> None:
    """Pairs, each with a sensor: the floor's force along the ground's axes."""
    contacts, sensors = ET.SubElement(root, "contact"), ET.SubElement(root, "sensor")
    for contact in scene.contacts.values():
        ET.SubElement(
            contacts, "pair", soft(numbers, "pair", contact.name), name=contact.name,
            geom1=FLOOR, geom2=contact.name,
            condim="3", friction=written(contact.friction, contact.friction, 0, 0, 0),
        )  # fmt: skip
        ET.SubElement(
            sensors, "contact", geom1=FLOOR, geom2=contact.name, data="force", num="1",
            reduce="netforce",
        )  # fmt: skip


def connect_points(scene: Scene, joint: Joint) -> list[Vector3]:
    """The points, from each of the joint's own in the axes of both parts, that `connect` holds.

    A hinge's lie on its axis. As far apart as the parts are large, for softness is one of length.
    """
    count = held_points(scene, joint)
    assert count is not None
    turns = [turn.axis for turn in joint.turns] if count == 2 else []
    ways = [*turns, *(u.tolist() for u in across(turns))]
    reach = max(_reach(scene, joint.a), _reach(scene, joint.b)) or 1.0
    offsets = [(0.0, 0.0, 0.0)]
    for x, y, z in ways[: count - 1]:
        offsets.append((reach * x, reach * y, reach * z))
    return offsets


def _reach(scene: Scene, anchor: Anchor) -> float:
    """How far [m] the body's points are from its centre."""
    points = scene.bodies[anchor.body].points.values() if anchor.body != GROUND else ()
    return max((float(np.linalg.norm(at)) for at in points), default=0.0)


def _loops(root: ET.Element, scene: Scene, given: dict[str, str]) -> None:
    equality = ET.SubElement(root, "equality")
    elements = {e.attrib["name"]: e for e in root.iter("body")}
    (world,) = root.iter("worldbody")
    for joint in spanning_tree(scene).loops:
        for number, offset in enumerate(connect_points(scene, joint)):
            name = f"{joint.name}.{number}"
            for side, anchor in (("a", joint.a), ("b", joint.b)):
                home = str(anchor) if str(anchor) in elements else called(anchor.body)
                at = [x + dx for x, dx in zip(local(scene, anchor), offset, strict=True)]
                _site(elements.get(home, world), f"{name}.{side}", at)
            ET.SubElement(
                equality, "connect", given, name=name, site1=f"{name}.a", site2=f"{name}.b"
            )


def _start(
    root: ET.Element,
    scene: Scene,
    start: Start,
    begun: tuple[Sequence[float], Sequence[float]],
) -> None:
    """The start as a keyframe, in the order in which MuJoCo numbers joints: depth first."""
    found = started(scene, start)
    each = [found[element.attrib["name"]] for element in root.iter("body")]
    key = ET.SubElement(ET.SubElement(root, "keyframe"), "key", name="start")
    key.set("qpos", written(*(begun[0] or [x for places, _ in each for x in places])))
    key.set("qvel", written(*(begun[1] or [x for _, rates in each for x in rates])))
    if laws := signals(scene):
        key.set("ctrl", written(*(int(law.law in BY_ITSELF) for law in laws)))


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
    found = np.maximum(moments, LEAST)
    largest = int(np.argmax(found))
    rest = float(sum(np.delete(found, largest)))
    if 0 < found[largest] - rest <= ROUNDING * rest:
        found[largest] = rest
    return float(found[0]), float(found[1]), float(found[2])


def _quaternion(axes: Array) -> Quaternion:
    """The unit quaternion (w, x, y, z) of a rotation matrix."""
    found = np.empty(4)
    mujoco.mju_mat2Quat(found, axes.ravel())
    w, x, y, z = found.tolist()
    return w, x, y, z
