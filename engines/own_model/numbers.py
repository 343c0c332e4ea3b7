"""The numbers of a compiled model, for whoever writes its equations down without MuJoCo."""

from collections.abc import Iterable, Iterator

import mujoco
import numpy as np

from ...cases.trajectory import Array
from ...cases.tree import (
    BIAS,
    DRIVEN,
    MASS,
    PARTS,
    PASSIVE,
    Kind,
    Line,
    Link,
    Motor,
    Tree,
    TreeJoint,
)
from .places import Places
from .release import actuators, column

KINDS: dict[int, Kind] = {0: "free", 1: "ball", 2: "slide", 3: "hinge"}
DISABLED = mujoco.mjtDisableBit
OBJECT = mujoco.mjtObj
GAINS = (mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtGain.mjGAIN_AFFINE)
BIASES = (mujoco.mjtBias.mjBIAS_NONE, mujoco.mjtBias.mjBIAS_AFFINE)
WORDS = {
    OBJECT.mjOBJ_BODY: "body", OBJECT.mjOBJ_JOINT: "joint", OBJECT.mjOBJ_GEOM: "geom",
    OBJECT.mjOBJ_SENSOR: "sensor", OBJECT.mjOBJ_ACTUATOR: "actuator", OBJECT.mjOBJ_SITE: "site",
    OBJECT.mjOBJ_TENDON: "tendon", OBJECT.mjOBJ_FLEX: "flex", OBJECT.mjOBJ_PLUGIN: "plugin",
    OBJECT.mjOBJ_EQUALITY: "equality",
}  # fmt: skip
"""What the kinds of elements are called."""
JOINTS = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)


def numbers(model: mujoco.MjModel, start: mujoco.MjData, places: Places) -> Tree:
    """Returns the model's numbers; `unread` of them tells what no equation of a tree says.

    start: tells where bodies stand that a user moves (`mocap`); places: the lines of what is told.
    """
    m, flags = model, model.opt.disableflags
    springs, damps = not flags & DISABLED.mjDSBL_SPRING, not flags & DISABLED.mjDSBL_DAMPER
    weight = np.zeros(3) if flags & DISABLED.mjDSBL_GRAVITY else np.array(m.opt.gravity)
    links = [_link(m, start, body) for body in range(1, m.nbody)]
    joints = {joint.v: joint for link in links for joint in link.joints}
    acts = not flags & DISABLED.mjDSBL_ACTUATION
    return Tree(
        links,
        m.nv,
        weight,
        np.array(m.dof_armature),
        np.array(m.dof_damping) if damps else np.zeros(m.nv),
        [*_springs(m, joints)] if springs else (),
        [_tendon(m, i, springs=springs, damps=damps) for i in fixed_tendons(m)],
        [_motor(m, i) for i in range(actuators(m)) if acts and not _unread_actuator(m, i)],
        _clamped_ranges(m),
        np.array([bool(m.jnt_actgravcomp[j]) for j in m.dof_jntid], dtype=bool),
        _unread(m, places),
    )


def element_name(model: mujoco.MjModel, kind: mujoco.mjtObj, number: int) -> str:
    """Returns the name of an element; its number, if it has none."""
    return mujoco.mj_id2name(model, kind, number) or f"#{number}"


def element(m: mujoco.MjModel, places: Places, kind: mujoco.mjtObj, number: int) -> str:
    """Returns kind and name of an element, with its line where that is known."""
    return places.after(f"{WORDS[kind]} {element_name(m, kind, number)}", (kind, number))


def plugins(m: mujoco.MjModel) -> Iterator[tuple[mujoco.mjtObj, int]]:
    """Yields the elements that have a plugin; of one that none has the plugin itself."""
    of = {
        OBJECT.mjOBJ_BODY: m.body_plugin, OBJECT.mjOBJ_GEOM: m.geom_plugin,
        OBJECT.mjOBJ_ACTUATOR: m.actuator_plugin, OBJECT.mjOBJ_SENSOR: m.sensor_plugin,
    }  # fmt: skip
    for kind, each in of.items():
        yield from ((kind, int(i)) for i in np.flatnonzero(each >= 0))
    for plugin in set(range(m.nplugin)) - {int(i) for each in of.values() for i in each}:
        yield OBJECT.mjOBJ_PLUGIN, plugin


def _link(m: mujoco.MjModel, start: mujoco.MjData, body: int) -> Link:
    R = np.zeros(9)
    mujoco.mju_quat2Mat(R, m.body_iquat[body])
    R = R.reshape(3, 3)
    mocap = m.body_mocapid[body]
    place, attitude = m.body_pos[body], m.body_quat[body]
    if mocap >= 0:
        place, attitude = start.mocap_pos[mocap], start.mocap_quat[mocap]
    first = m.body_jntadr[body]
    return Link(
        element_name(m, OBJECT.mjOBJ_BODY, body),
        int(m.body_parentid[body]) - 1,
        np.array(place),
        np.array(attitude),
        float(m.body_mass[body]),
        np.array(m.body_ipos[body]),
        R @ np.diag(m.body_inertia[body]) @ R.T,
        [_joint(m, j) for j in range(first, first + m.body_jntnum[body])],
        float(m.body_gravcomp[body]),
    )


def _joint(m: mujoco.MjModel, j: int) -> TreeJoint:
    return TreeJoint(
        element_name(m, OBJECT.mjOBJ_JOINT, j),
        KINDS[int(m.jnt_type[j])],
        int(m.jnt_qposadr[j]),
        int(m.jnt_dofadr[j]),
        np.array(m.jnt_pos[j]),
        np.array(m.jnt_axis[j]),
        float(m.qpos0[m.jnt_qposadr[j]]),
    )


def _springs(
    m: mujoco.MjModel, joints: dict[int, TreeJoint]
) -> Iterator[tuple[TreeJoint, float, Array]]:
    for j in np.flatnonzero(m.jnt_stiffness):
        joint = joints[int(m.jnt_dofadr[j])]
        wide = {"free": 7, "ball": 4}.get(joint.kind, 1)
        rest = np.array(m.qpos_spring[joint.q : joint.q + wide])
        yield joint, float(m.jnt_stiffness[j]), rest


def fixed_tendons(m: mujoco.MjModel) -> list[int]:
    """Returns the numbers of tendons whose length is a sum of coordinates."""
    joint = mujoco.mjtWrap.mjWRAP_JOINT
    return [i for i in range(m.ntendon) if mujoco.mjtWrap(m.wrap_type[m.tendon_adr[i]]) == joint]


def _moment_arms(m: mujoco.MjModel, tendon: int) -> Array:
    """Returns the derivative of a fixed tendon's length by each velocity's coordinate (nv,)."""
    coefficients = np.zeros(m.nv)
    for k in range(m.tendon_adr[tendon], m.tendon_adr[tendon] + m.tendon_num[tendon]):
        coefficients[m.jnt_dofadr[m.wrap_objid[k]]] += m.wrap_prm[k]
    return coefficients


def _tendon(m: mujoco.MjModel, i: int, *, springs: bool, damps: bool) -> Line:
    """Returns a fixed tendon as a spring and damper on a sum of coordinates."""
    return Line(
        element_name(m, OBJECT.mjOBJ_TENDON, i),
        _moment_arms(m, i),
        (float(m.tendon_lengthspring[i, 0]), float(m.tendon_lengthspring[i, 1])),
        float(m.tendon_stiffness[i]) if springs else 0.0,
        float(m.tendon_damping[i]) if damps else 0.0,
        float(m.tendon_armature[i]),
    )


def _unread_actuator(m: mujoco.MjModel, i: int) -> str:
    """Returns in words which feature of an actuator no equation here has; else empty."""
    target, transmission = m.actuator_trnid[i, 0], mujoco.mjtTrn(m.actuator_trntype[i])
    if m.actuator_plugin[i] >= 0:
        return "a plugin"
    if column(m, "actuator_ctrlnum")[i] != 1:
        return "another number of controls than one"
    if column(m, "actuator_delay")[i]:
        return "a delay"
    if mujoco.mjtDyn(m.actuator_dyntype[i]) != mujoco.mjtDyn.mjDYN_NONE:
        return "a state of its own"
    if mujoco.mjtGain(m.actuator_gaintype[i]) not in GAINS:
        return "another gain than an affine one"
    if mujoco.mjtBias(m.actuator_biastype[i]) not in BIASES:
        return "another bias than an affine one"
    if transmission == mujoco.mjtTrn.mjTRN_TENDON:
        return "" if target in fixed_tendons(m) else "a spatial tendon"
    if transmission not in JOINTS:
        return "another transmission than a joint or a tendon"
    return "" if KINDS[int(m.jnt_type[target])] in ("slide", "hinge") else "a ball or free joint"


def _motor(m: mujoco.MjModel, i: int) -> Motor:
    target, control = m.actuator_trnid[i, 0], column(m, "actuator_ctrladr")[i]
    if mujoco.mjtTrn(m.actuator_trntype[i]) == mujoco.mjtTrn.mjTRN_TENDON:
        moments = _moment_arms(m, target)
    else:
        moments = np.zeros(m.nv)
        moments[m.jnt_dofadr[target]] = 1.0
    clamps = m.actuator_ctrllimited[control] and not m.opt.disableflags & DISABLED.mjDSBL_CLAMPCTRL
    affine = mujoco.mjtGain(m.actuator_gaintype[i]) == mujoco.mjtGain.mjGAIN_AFFINE
    biased = mujoco.mjtBias(m.actuator_biastype[i]) == mujoco.mjtBias.mjBIAS_AFFINE
    off = m.opt.disableactuator & (1 << int(m.actuator_group[i])) if m.actuator_group[i] >= 0 else 0
    gain = np.array(m.actuator_gainprm[i, :3])
    return Motor(
        element_name(m, OBJECT.mjOBJ_ACTUATOR, i),
        np.zeros(m.nv) if off else moments * m.actuator_gear[column(m, "actuator_outadr")[i], 0],
        int(control),
        gain if affine else gain * [1.0, 0.0, 0.0],
        np.array(m.actuator_biasprm[i, :3]) if biased else np.zeros(3),
        _range(m.actuator_ctrlrange[control], clamps),
        _range(m.actuator_forcerange[i], m.actuator_forcelimited[i]),
    )


def _range(pair: Array, limited: bool) -> tuple[float, float]:
    return (float(pair[0]), float(pair[1])) if limited else (-np.inf, np.inf)


def _clamped_ranges(m: mujoco.MjModel) -> Array:
    """Returns the least and the greatest actuator force on each velocity (nv, 2)."""
    bounds = np.tile([-np.inf, np.inf], (m.nv, 1))
    for j in np.flatnonzero(m.jnt_actfrclimited):
        if KINDS[int(m.jnt_type[j])] in ("slide", "hinge"):
            bounds[m.jnt_dofadr[j]] = m.jnt_actfrcrange[j]
    return bounds


def _unread(m: mujoco.MjModel, places: Places) -> dict[str, list[str]]:
    """Returns the elements that are not in the equations, by the part that lacks them."""
    unread: dict[str, list[str]] = {part: [] for part in PARTS}
    joint, tendon, actuator = OBJECT.mjOBJ_JOINT, OBJECT.mjOBJ_TENDON, OBJECT.mjOBJ_ACTUATOR

    def add(part: str, kind: mujoco.mjtObj, numbers: Iterable[int], what: str) -> None:
        for i in map(int, numbers):
            unread[part].append(f"{element(m, places, kind, i)}: {what}")

    for i in range(actuators(m)):
        if what := _unread_actuator(m, i):
            add(DRIVEN, actuator, [i], what)
    spatial = [i for i in range(m.ntendon) if i not in fixed_tendons(m)]
    pulls = (m.tendon_stiffness != 0) | (m.tendon_damping != 0)
    add(PASSIVE, tendon, [i for i in spatial if pulls[i]], "a spring or damper in space")
    heavy = [i for i in spatial if m.tendon_armature[i]]
    add(MASS, tendon, heavy, "an armature in space")
    add(BIAS, tendon, heavy, "an armature in space")
    add(DRIVEN, tendon, np.flatnonzero(m.tendon_actfrclimited), "a bound of all its actuators")
    for kind, stiff in ((joint, "jnt_stiffnesspoly"), (tendon, "tendon_stiffnesspoly")):
        bent = np.flatnonzero(column(m, stiff).any(axis=1))
        add(PASSIVE, kind, bent, "a stiffness that is no constant")
    soft = {int(m.dof_jntid[i]) for i in np.flatnonzero(column(m, "dof_dampingpoly").any(axis=1))}
    add(PASSIVE, joint, sorted(soft), "a damping that is no constant")
    curved = np.flatnonzero(column(m, "tendon_dampingpoly").any(axis=1))
    add(PASSIVE, tendon, curved, "a damping that is no constant")
    for kind, bends in ((joint, "jnt_plasticadr"), (tendon, "tendon_plasticadr")):
        add(PASSIVE, kind, np.flatnonzero(column(m, bends) >= 0), "a spring that yields")
    damped = (column(m, "actuator_damping") != 0) | column(m, "actuator_dampingpoly").any(axis=1)
    add(PASSIVE, actuator, np.flatnonzero(damped), "a damping of its own")
    add(MASS, actuator, np.flatnonzero(column(m, "actuator_armature")), "an armature of its own")
    if m.opt.density or m.opt.viscosity:
        option = places.after("option", "density" if m.opt.density else "viscosity")
        unread[PASSIVE].append(f"{option}: a fluid (density, viscosity)")
    add(PASSIVE, OBJECT.mjOBJ_FLEX, range(m.nflex), "its bending and stretching")
    for kind, i in plugins(m):
        add(PASSIVE, kind, [i], "a plugin")
    return {part: words for part, words in unread.items() if words}
