"""MuJoCo's answers about states: its sensors, its mass matrix, and its inverse dynamics."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.scene.frame import PLANE
from ....cases.scene.point import CENTER
from ....cases.scene.states import MASS_MATRIX
from ....cases.trajectory import Array
from ..callbacks.signal import installed, listening
from ..model.force import lacking
from ..model.number_text import written
from ..model.scene import LEAST
from ..model.tree import called, freedoms_left, natives, spanning_tree
from ..read.measure import tensor
from .compilation import started

Read = Callable[[], Any]

_SENSED = {
    **{field: ("framepos", i) for i, field in enumerate(("x", "y", "z"))},
    **{field: ("framelinvel", i) for i, field in enumerate(("vx", "vy", "vz"))},
    **{field: ("framelinacc", i) for i, field in enumerate(("ax", "ay", "az"))},
    **{field: ("frameangacc", i) for i, field in enumerate(("alpha_x", "alpha_y", "alpha_z"))},
    **{field: ("gyro", i) for i, field in enumerate(("omega_1", "omega_2", "omega_3"))},
}
_ENTRIES = {
    "inertia": (2, 2), "inertia_11": (0, 0), "inertia_22": (1, 1), "inertia_33": (2, 2),
    "inertia_12": (0, 1), "inertia_13": (0, 2), "inertia_23": (1, 2),
}  # fmt: skip


def answered(
    scene: Scene, text: str, states: Mapping[str, Array], wanted: Sequence[str]
) -> dict[str, Array | str]:
    """For each wanted quantity its samples, or why there are none. text: the scene as MJCF."""
    with listening(), installed(None):
        try:
            model, data = started(mujoco.MjModel.from_xml_string(shaped(text, scene)))
        except ValueError as refusal:
            what = " ".join(str(refusal).split())
            return dict.fromkeys(wanted, f"engine: MuJoCo does not take the shapes: {what}")
        joints = [model.joint(name) for name, _ in _coordinates(scene, states).values()]
        places, dofs = ([int(of[0]) for of in each] for each in zip(
            *((joint.qposadr, joint.dofadr) for joint in joints), strict=True
        ))  # fmt: skip
        refusals = {name: _withheld(scene, name) for name in wanted}
        read = {n: _reader(scene, model, data, n, states, dofs) for n in wanted if not refusals[n]}
        seen: dict[str, list[Any]] = {name: [] for name in read}
        for row in np.stack(list(states.values()), axis=1):
            data.qpos[places], data.qvel[dofs], data.qacc[dofs] = row.T
            mujoco.mj_inverse(model, data)
            mujoco.mj_energyVel(model, data)
            mujoco.mj_energyPos(model, data)
            mujoco.mj_subtreeVel(model, data)
            for name, samples in seen.items():
                samples.append(read[name]())
    answers = {name: np.array(samples, float) for name, samples in seen.items()}
    matrices = {name: answers[name].ravel() for name in answers if name == MASS_MATRIX}
    return {**refusals, **answers, **matrices}


def _withheld(scene: Scene, name: str) -> str:
    """Why a quantity is not told, or nothing."""
    part, _, field = name.partition(".")
    if part in scene.forces:
        alone = "adapter: what a damping of joints exerts is not asked of MuJoCo"
        return next((why for force, why in lacking(scene) if force.name == part), alone)
    if field in _ENTRIES and scene.bodies[part].shape == "rigid":
        return f"adapter: {part} has no shape from which MuJoCo could compute it"
    return ""


def _coordinates(scene: Scene, names: Mapping[str, Any]) -> dict[str, tuple[str, str]]:
    """MuJoCo's joint of each coordinate, and the quantity that moves it."""
    if scene.frame is PLANE:
        return {name: (name, "") for name in names}
    joints = dict(_natives(scene))
    return {name: joints[name] for name in names}


def _natives(scene: Scene) -> Iterator[tuple[str, tuple[str, str]]]:
    for branch in spanning_tree(scene).branches:
        assert branch.joint is not None  # each body hangs on one
        joint = branch.joint.name
        for native in natives(scene, branch):
            freedom = freedoms_left(scene, branch.joint)[native.of]
            yield f"{joint}.{freedom.name}", (native.name, f"{joint}.{freedom.effort}")


def _reader(
    scene: Scene,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    name: str,
    states: Mapping[str, Array],
    dofs: list[int],
) -> Read:
    """A function that reads one quantity of MuJoCo's present state."""
    part, _, field = name.rpartition(".")
    if name == MASS_MATRIX:
        return partial(_mass_matrix, model, data, dofs)
    if part in ("energy", "momentum"):
        return partial(_of_all, model, data, name)
    if part in scene.joints:
        efforts = [effort for _, effort in _coordinates(scene, states).values()]
        dof = dofs[efforts.index(name)]
        return lambda: data.qfrc_inverse[dof]
    if field in _ENTRIES:
        entry = tensor(model, model.body(called(part)).id)[_ENTRIES[field]]
        return lambda: entry
    at = part if "." in part else f"{part}.{CENTER}"
    if field == "attitude":
        attitude = data.sensor(sensor("framequat", at)).data
        return lambda: attitude.copy()
    if field == "speed":
        velocity = data.sensor(sensor("framelinvel", at)).data
        return lambda: np.linalg.norm(velocity)
    kind, i = _SENSED[field]
    values = data.sensor(sensor(kind, at)).data
    # MuJoCo's linear acceleration is that against free fall
    falling = model.opt.gravity[i] if kind == "framelinacc" else 0.0
    return lambda: values[i] + falling


def _mass_matrix(model: mujoco.MjModel, data: mujoco.MjData, dofs: list[int]) -> Array:
    """(n, n) in the order of the coordinates."""
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    return full[np.ix_(dofs, dofs)]


def _of_all(model: mujoco.MjModel, data: mujoco.MjData, name: str) -> float:
    """Energies [J], momentum, and angular momentum about the origin."""
    potential, kinetic = data.energy
    p = data.subtree_linvel[0] * model.body_subtreemass[0]
    D = data.subtree_angmom[0] + np.cross(data.subtree_com[0], p)
    energies = {"kinetic": kinetic, "potential": potential, "total": kinetic + potential}
    quantities = {f"energy.{key}": x for key, x in energies.items()}
    quantities |= {f"momentum.{axis}": x for axis, x in zip("xyz", p, strict=True)}
    quantities |= {f"momentum.angular_{axis}": x for axis, x in zip("xyz", D, strict=True)}
    return float((quantities | {"momentum.angular": D[2]})[name])


# A scene's MJCF file with shapes for inertias, which MuJoCo's compiler computes, and sensors.


THIN = 1e-7  # m, half of what is ideally thin: 1e-14 of its inertia

SENSORS = ("framepos", "framequat", "framelinvel", "gyro", "framelinacc", "frameangacc")


def shaped(text: str, scene: Scene) -> str:
    """The MJCF with geoms in place of the inertials of ideal shapes, and sensors at all points."""
    root = ET.fromstring(text)
    elements = {element.attrib["name"]: element for element in root.iter("body")}
    sensors = ET.SubElement(root, "sensor")
    for body in scene.bodies.values():
        if (shape := _shape(body)) is not None:
            element = elements[called(body.name)]
            element.remove(element.find("inertial"))  # type: ignore[arg-type]
            given = {"mass": written(body.mass), "contype": "0", "conaffinity": "0"}
            ET.SubElement(element, "geom", {**given, **shape})
        for point in body.points:
            at = f"{body.name}.{point}"
            for kind in SENSORS:
                where = {"site": at} if kind == "gyro" else {"objtype": "site", "objname": at}
                ET.SubElement(sensors, kind, where, name=sensor(kind, at))
    return ET.tostring(root, encoding="unicode")


def sensor(kind: str, at: str) -> str:
    """Its name: what it measures, and at which point."""
    return f"{kind} {at}"


def _shape(body: Any) -> dict[str, str] | None:
    """The geom of an ideal shape; None of what is given by its numbers."""
    match body.shape:
        case "bar":
            half = float(np.linalg.norm(np.subtract(body.points["end"], body.points["start"]))) / 2
            # a light one is thicker: about its own axis MuJoCo takes no less than LEAST of any body
            thin = max(THIN, math.sqrt(3 * LEAST / body.mass))
            return {"type": "box", "size": written(half, thin, thin)}
        case "disk":
            axle = getattr(body, "axle", None) or (0.0, 0.0, 1.0)
            return {"type": "cylinder", "size": written(body.radius, THIN), "zaxis": written(*axle)}
        case "sphere":
            return {"type": "sphere", "size": written(body.radius)}
        case "block":
            edges = [x / 2 for x in body.size]
            return {"type": "box", "size": written(*[*edges, THIN][:3])}
    return None
