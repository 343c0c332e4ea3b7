"""A scene of one body with the shape that a user has: a geom on a free joint, advice pasted in.

Nothing of our own model is in it: no point of 1e-12 m, no three freedoms, no settled start, and no
pair but those that the pasted lines ask for. Its z is up, and is the scene's y: MuJoCo's own floor
lies exactly level, and a box that is put on it is not in contact yet, as no user's is.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ....cases.scene import GROUND, Body, Scene
from ....cases.scene.frame import PLANE, SPACE
from ....cases.trajectory import ANGLE, OMEGA, VX, VY, Array, Trajectory, X, Y
from ...engine import Plan, Start
from ...plain_shapes import CYLINDER, as_built, unsuited, with_box, without_box
from ..callbacks.signal import listening
from ..model.drive import controls
from ..model.force import BY_ITSELF, begun_with, lacking, write
from ..model.number_text import lifted, written
from ..model.planes import add_sensors, dimensions, grounded, touching
from ..model.tree import called
from ..read.measure import tensor
from ..read.reaction import felt_force
from ..read.record import all_steps, counted, whole
from .run import check

ONE_SUM = "adapter: shapes: what one plane exerts on a geom is read as one force"

OURS = {
    PLANE: "a point that touches is a sphere of 1e-12 m, and no body can leave its plane",
    SPACE: "what touches is a ball, or a disk of 1e-6 m, and each contact a <pair>",
}
"""By the scene's frame, how our own model differs from a user's."""


def refused(scene: Scene, shape: str, options: Mapping[str, object]) -> str | None:
    """Why the scene is not built with such shapes, as a `Refusal` says it; None: it is."""
    if options.get("settled"):
        return "adapter: shapes: a settled start cannot be pasted"
    if any(law.law not in BY_ITSELF for law in scene.laws()) or lacking(scene):
        return "adapter: shapes: a force takes a callback"
    return unsuited(scene, shape)


def words(scene: Scene, start: Start, shape: str) -> str:
    """`block is a box geom of 0.2 × 0.1 × 0.2 m with a free joint`."""
    (body,) = with_box(scene, start, shape)[0].bodies.values()
    geom = _geom(body, shape)
    across, *others = [f"{2 * float(size):g}" for size in geom["size"].split()]
    if body.radius is None:
        sizes = f"{' × '.join([across, *others])} m"
    else:
        sizes = " and ".join([f"{across} m across", *(f"{long} m long" for long in others)])
    return f"{body.name} is a {geom['type']} geom, {sizes}, with a free joint"


def points(scene: Scene, shape: str) -> int:
    """At how many points the geom touches a plane at most."""
    (body,) = scene.bodies.values()
    return 4 if body.radius is None else 2 if shape == CYLINDER else 1


def planned(plan: Plan, scene: Scene, start: Start, shape: str) -> Plan:
    """The plan with what is built, and what is not read."""
    planes = [contact.on for contact in scene.contacts.values()]
    together = {
        f"{contact.name}.{field}": ONE_SUM
        for contact in scene.contacts.values()
        for field in ("normal", "tangent")
        if planes.count(contact.on) > 1
    }
    return as_built(plan, words(scene, start, shape), together)


def plain_mjcf(
    scene: Scene, start: Start, shape: str, pasted: str, alone: Mapping[str, Mapping[str, str]]
) -> str:
    """The model as a user writes it, with the start as a keyframe, behind the pasted lines.

    alone: by contact what it alone has, as the lines say.
    """
    scene, start = with_box(scene, start, shape)
    (body,) = scene.bodies.values()
    root = ET.fromstring(f"<mujoco>{pasted}</mujoco>")
    option = ET.SubElement(root, "option", gravity=written(*raised(scene.gravity)))
    ET.SubElement(option, "flag", autoreset="disable")  # a reset must not look like a motion
    world = ET.SubElement(root, "worldbody")
    contacts = {contact.on: contact for contact in touching(scene).values()}
    for name, contact in contacts.items():
        given = {"name": grounded(name), "type": "plane", "size": "0 0 1"} | _rubs(contact.friction)
        given |= {} if contact.plane.level else {"zaxis": written(*raised(contact.plane.normal))}
        given |= {"pos": written(*raised(contact.plane.at))} if any(contact.plane.at) else {}
        ET.SubElement(world, "geom", given)
    ET.SubElement(world, "site", name=GROUND)
    for name, point in scene.points.items():
        ET.SubElement(world, "site", name=f"{GROUND}.{name}", pos=written(*raised(point.at)))
    element = ET.SubElement(world, "body", name=called(body.name))
    ET.SubElement(element, "freejoint", name=body.name)
    for name, at in body.points.items():
        ET.SubElement(element, "site", name=f"{body.name}.{name}", pos=written(*raised(at)))
    # Of two geoms that touch the larger friction counts: that of the plane.
    least = min(contact.friction for contact in contacts.values())
    geom = _geom(body, shape) | {"name": body.name, "mass": written(body.mass)} | _rubs(least)
    ET.SubElement(element, "geom", geom)
    if body.radius is not None and (shape != CYLINDER or body.shape != "disk"):
        j = written(body.moment, body.moment, body.moment)
        ET.SubElement(element, "inertial", pos="0 0 0", mass=written(body.mass), diaginertia=j)
    # What a geom has not: lines with it ask for pairs.
    if any(alone.values()) or any("solreffriction" in pair.attrib for pair in root.iter("pair")):
        pairs = ET.SubElement(root, "contact")
        for name, contact in contacts.items():
            ET.SubElement(
                pairs, "pair", dict(alone[contact.name]), geom1=grounded(name), geom2=body.name,
                condim=dimensions(contact.friction),
                friction=written(contact.friction, contact.friction),
            )  # fmt: skip
    write(root, scene)
    for force in root.iter("general"):
        gear = [float(number) for number in force.get("gear", "1").split()]
        force.set("gear", written(*raised(gear[:3]), *raised(gear[3:])))
    sensors = ET.SubElement(root, "sensor")
    add_sensors(sensors, scene)
    for sensor in sensors:
        sensor.set("geom2", body.name)
    _keyframe(root, scene, start)
    ET.indent(root)
    return ET.tostring(root, encoding="unicode") + "\n"


def _rubs(friction: float) -> dict[str, str]:
    """As a geom has it; with condim 3 the other two numbers, MuJoCo's defaults, do nothing."""
    return {"friction": written(friction, 0.005, 0.0001), "condim": dimensions(friction)}


def _geom(body: Body, shape: str) -> dict[str, str]:
    if body.radius is not None and shape == CYLINDER:
        size = written(body.radius, body.radius / 2)
        return {"type": "cylinder", "size": size, "zaxis": "0 1 0"}
    if body.radius is not None:
        return {"type": "sphere", "size": written(body.radius)}
    assert body.size is not None  # else it is unsuited
    width, height = body.size
    return {"type": "box", "size": written(width / 2, width / 2, height / 2)}


def raised(vector: Sequence[float]) -> tuple[float, float, float]:
    """A vector of the plane, or of MuJoCo's model of it, where z is up; no zero is negative."""
    x, y, z = lifted(vector)
    return x + 0.0, 0.0 - z, y + 0.0


def _keyframe(root: ET.Element, scene: Scene, start: Start) -> None:
    ((x, y, angle, vx, vy, omega),) = start.values()
    key = ET.SubElement(ET.SubElement(root, "keyframe"), "key", name="start")
    turned = math.cos(angle / 2), *raised((0.0, 0.0, math.sin(angle / 2)))
    key.set("qpos", written(*raised((x, y)), *turned))
    key.set("qvel", written(*raised((vx, vy)), *raised((0.0, 0.0, omega))))
    if activations := begun_with(scene):
        key.set("act", written(*activations))
    if laws := controls(scene):
        key.set("ctrl", written(*(1 for _ in laws)))


def measured(scene: Scene, text: str) -> dict[str, float]:
    """The physics of such a model, as `Engine.measure` tells it."""
    model = mujoco.MjModel.from_xml_string(text)
    (body,) = scene.bodies.values()
    number = model.body(called(body.name)).id
    numbers = {"gravity.x": model.opt.gravity[0], "gravity.y": model.opt.gravity[2]}
    numbers[f"{body.name}.mass"] = model.body_mass[number]
    if body.turns:
        numbers[f"{body.name}.inertia"] = tensor(model, number)[1, 1]
    for contact in scene.contacts.values():
        met = {model.geom(name).id for name in (grounded(contact.on), body.name)}
        pairs = [i for i in range(model.npair) if {*_geoms(model, i)} == met]
        rubbing = [model.pair_friction[i, 0] for i in pairs]
        rubbing = rubbing or [max(model.geom_friction[i, 0] for i in met)]
        numbers[f"{contact.name}.friction"] = rubbing[0] if contact.friction else 0.0
    return {name: float(x) for name, x in numbers.items()}


def _geoms(model: mujoco.MjModel, pair: int) -> tuple[int, int]:
    return int(model.pair_geom1[pair]), int(model.pair_geom2[pair])


def run(
    scene: Scene,
    start: Start,
    times: Array,
    shape: str,
    text: str,
    reactions: tuple[str, ...],
    *,
    record: bool,
) -> Trajectory:
    """The motion of such a model at the times; record: every step too. Raises Diverged."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    step = float(model.opt.timestep)
    counts, grid = counted(times, step), all_steps(times, step)
    with listening() as warnings:
        every = whole(model, data, len(grid))
        check(warnings, grid, every)
    assert every.felt is not None  # `whole` keeps it
    forces = every.felt.reshape(len(grid), -1, 3)[:, :, [0, 2, 1]].reshape(len(grid), -1)
    felt = {name: felt_force(scene, model, name, forces) for name in reactions}
    states = dict(_states(with_box(scene, start, shape)[1], every.qpos, every.qvel))
    phase = np.zeros(len(grid), dtype=np.int64)  # an engine does not say when one ends
    motion = Trajectory(
        times,
        {name: rows[counts] for name, rows in states.items()},
        {name: rows[counts] for name, rows in felt.items()},
        record=Trajectory(grid, states, felt, phase=phase) if record else None,
    )
    return without_box(scene, motion, shape)


def _states(start: Start, qpos: Array, qvel: Array) -> Iterator[tuple[str, Array]]:
    """(N, 6) of the body: its angle counts whole turns, of less than a half from step to step."""
    ((name, state),) = start.items()
    rows = np.zeros((len(qpos), 6))
    rows[:, [X, Y]], rows[:, [VX, VY]] = qpos[:, [0, 2]], qvel[:, [0, 2]]
    turned = np.unwrap(2 * np.arctan2(-qpos[:, 5], qpos[:, 3]))
    rows[:, ANGLE] = turned + math.tau * np.round((state[ANGLE] - turned[0]) / math.tau)
    rows[:, OMEGA] = -qvel[:, 4]
    yield name, rows
