"""Tables of what a compiled model is: its options, its joints, its actuators, what is beside."""

from collections import Counter
from collections.abc import Iterable, Iterator

import mujoco
import numpy as np

from ...cases.trajectory import Array
from .limit import WORDS as OPTIONS
from .model import OwnModel
from .numbers import BIASES, GAINS, KINDS, OBJECT, WORDS, fixed_tendons
from .quantities import label
from .release import actuators, column

Table = list[list[str]]
"""Rows of cells, the head first."""
TRANSMISSION = mujoco.mjtTrn
TARGETS = {
    TRANSMISSION.mjTRN_JOINT: OBJECT.mjOBJ_JOINT,
    TRANSMISSION.mjTRN_JOINTINPARENT: OBJECT.mjOBJ_JOINT,
    TRANSMISSION.mjTRN_SLIDERCRANK: OBJECT.mjOBJ_SITE,
    TRANSMISSION.mjTRN_TENDON: OBJECT.mjOBJ_TENDON,
    TRANSMISSION.mjTRN_SITE: OBJECT.mjOBJ_SITE,
    TRANSMISSION.mjTRN_BODY: OBJECT.mjOBJ_BODY,
}
"""By transmission what an actuator drives."""
UNITS = {"hinge": "rad", "slide": "m", "ball": "rad"}
FLAGS = {"disableflags": mujoco.mjtDisableBit, "enableflags": mujoco.mjtEnableBit}
ALWAYS = ("timestep", "integrator", "cone", "solver", "iterations", "tolerance")


def options(m: mujoco.MjModel) -> list[str]:
    """Returns the step, the integrator, the solver, and what else is not as by default."""
    default, words = mujoco.MjOption(), list[str]()
    others = [name for name in dir(default) if not name.startswith("_") and name not in ALWAYS]
    for name in (*ALWAYS, *others):
        value, usual = getattr(m.opt, name), getattr(default, name)
        if name in FLAGS:
            words += _flags(name, int(value), int(usual))
        elif name in ALWAYS or not np.array_equal(value, usual):
            names = [word for word, number in OPTIONS.get(name, {}).items() if number == value]
            words.append(f"{name} {names[0] if names else _numbers(value)}")
    return words


def _flags(name: str, value: int, usual: int) -> Iterator[str]:
    for flag, bit in FLAGS[name].__members__.items():
        _, dash, word = flag.partition("_")
        if dash and (value ^ usual) & int(bit):
            enabled = bool(value & int(bit)) == (name == "enableflags")
            yield f"{word.lower()} {'enabled' if enabled else 'disabled'}"


def identity(m: mujoco.MjModel) -> list[str]:
    """Returns the model's name and mass, and how much there is of what no table has."""
    name = m.names[: m.names.index(b"\0")].decode(errors="replace")
    return [repr(name), f"{_numbers(m.body_mass.sum())} kg", *_other_counts(m)]


def joints(own: OwnModel) -> Table:
    """Returns a row for each joint: its body, its range, what acts in it, how it starts."""
    m, start = own.model, own.start()
    table = [["joint", "kind", "body", "range", "damping", "armature", "frictionloss", "spring",
              "motors' force", "start", "rate"]]  # fmt: skip
    for j in range(m.njnt):
        kind, body = KINDS[int(m.jnt_type[j])], label(m, OBJECT.mjOBJ_BODY, int(m.jnt_bodyid[j]))
        (q, q_end), (v, v_end) = (
            (addresses[j], [*addresses[1:], end][j])
            for addresses, end in ((m.jnt_qposadr, m.nq), (m.jnt_dofadr, m.nv))
        )
        unit = UNITS.get(kind, "")
        table.append([
            label(m, OBJECT.mjOBJ_JOINT, j), kind, body,
            _range(m.jnt_range[j], m.jnt_limited[j], unit),
            *(_common_value(values[v:v_end]) for values in (
                m.dof_damping, m.dof_armature, m.dof_frictionloss)),
            _spring(m.jnt_stiffness[j], m.qpos_spring[q:q_end], unit),
            _range(m.jnt_actfrcrange[j], m.jnt_actfrclimited[j]),
            f"{_numbers(start.qpos[q:q_end])} {unit if q_end - q == 1 else ''}".rstrip(),
            _numbers(start.qvel[v:v_end]) if start.qvel.any() else "",
        ])  # fmt: skip
    return _filled_columns(table)


def _spring(stiffness: float, rest: Array, unit: str) -> str:
    at = f"{_numbers(rest)} {unit}" if len(rest) == 1 else f"({_numbers(rest)})"
    return f"{_numbers(stiffness)} about {at}" if stiffness else ""


def motors(own: OwnModel) -> Table:
    """Returns a row for each actuator: what it drives, its gains, its ranges, how it starts."""
    m, start = own.model, own.start()
    table = [["actuator", "drives", "law", "gear", "control range", "force range", "control"]]
    first, count = column(m, "actuator_ctrladr"), column(m, "actuator_ctrlnum")
    for i in range(actuators(m)):
        gear = m.actuator_gear[column(m, "actuator_outadr")[i]]
        controls = slice(first[i], first[i] + count[i])
        ranges = zip(m.actuator_ctrlrange[controls], m.actuator_ctrllimited[controls], strict=True)
        table.append([
            label(m, OBJECT.mjOBJ_ACTUATOR, i), _target_name(m, i), _law(m, i),
            "" if np.array_equal(gear, [1, 0, 0, 0, 0, 0]) else _numbers(np.trim_zeros(gear, "b")),
            ", ".join(filter(None, (_range(*each) for each in ranges))),
            _range(m.actuator_forcerange[i], m.actuator_forcelimited[i]),
            _numbers(start.ctrl[controls]),
        ])  # fmt: skip
    return _filled_columns(table)


def _target_name(m: mujoco.MjModel, i: int) -> str:
    kind, number = TARGETS.get(TRANSMISSION(m.actuator_trntype[i])), int(m.actuator_trnid[i, 0])
    if kind is None:
        return TRANSMISSION(m.actuator_trntype[i]).name.removeprefix("mjTRN_").lower()
    name = label(m, kind, number)
    return name if name == f"{WORDS[kind]} {number}" else f"{WORDS[kind]} {name}"


def _law(m: mujoco.MjModel, i: int) -> str:
    """Returns the gains of a servo by their names in MJCF, of others gain and bias."""
    gain, bias = m.actuator_gainprm[i], m.actuator_biasprm[i]
    kinds = mujoco.mjtGain(m.actuator_gaintype[i]), mujoco.mjtBias(m.actuator_biastype[i])
    dynamics = mujoco.mjtDyn(m.actuator_dyntype[i])
    if kinds[0] not in GAINS or kinds[1] not in BIASES:
        words = [kinds[0].name.removeprefix("mjGAIN_").lower()]
    elif kinds != (GAINS[0], BIASES[1]):
        plain = gain[0] == 1.0 and kinds[1] == BIASES[0]
        words = ["motor"] if plain else [f"gain {_numbers(gain[0])}"]
        words = words if kinds[0] == GAINS[0] else [f"gain {_numbers(gain[:3])}"]
        words += [f"bias {_numbers(bias[:3])}"] if kinds[1] == BIASES[1] else []
    elif gain[0] and gain[0] == -bias[1] and not bias[0]:
        words = [f"kp {_numbers(gain[0])}", *([f"kv {_numbers(-bias[2])}"] if bias[2] else [])]
    elif gain[0] and gain[0] == -bias[2] and not bias[:2].any():
        words = [f"kv {_numbers(gain[0])}"]
    else:
        words = [f"gain {_numbers(gain[0])}", f"bias {_numbers(bias[:3])}"]
    if dynamics != mujoco.mjtDyn.mjDYN_NONE:
        words.append(f"{dynamics.name.removeprefix('mjDYN_').lower()} dynamics")
    return ", ".join(words)


def constraints(m: mujoco.MjModel) -> list[str]:
    """Returns how much there is of what constrains it, in words, as far as no flag disables it."""
    disabled = mujoco.mjtDisableBit
    touch = (m.geom_contype != 0) | (m.geom_conaffinity != 0)
    limits = int(m.jnt_limited.sum() + m.tendon_limited.sum())
    losses = int((m.dof_frictionloss != 0).sum() + (m.tendon_frictionloss != 0).sum())
    counts = {
        disabled.mjDSBL_CONTACT: (int(touch.sum()) + m.npair, "contacts"),
        disabled.mjDSBL_LIMIT: (limits, "limits"),
        disabled.mjDSBL_FRICTIONLOSS: (losses, "friction losses"),
        disabled.mjDSBL_EQUALITY: (int(m.eq_active0.sum()), "equalities"),
    }
    off = m.opt.disableflags
    off = -1 if off & disabled.mjDSBL_CONSTRAINT else off
    return [word for bit, (count, word) in counts.items() if count and not off & bit]


def _other_counts(m: mujoco.MjModel) -> list[str]:
    """Returns the numbers of geoms, equalities, tendons, sensors and so on, in words."""
    touch = (m.geom_contype != 0) | (m.geom_conaffinity != 0)
    fixed = len(fixed_tendons(m))
    kinds = Counter(mujoco.mjtEq(kind).name.removeprefix("mjEQ_").lower() for kind in m.eq_type)
    counts = {
        "geoms": (m.ngeom, {"may touch": int(touch.sum())}),
        "equalities": (m.neq, kinds),
        "tendons": (m.ntendon, {"fixed": fixed, "spatial": m.ntendon - fixed}),
        "sensors": (m.nsensor, {}), "mocap bodies": (m.nmocap, {}), "flexes": (m.nflex, {}),
        "keyframes": (m.nkey, {}), "plugins": (m.nplugin, {}),
    }  # fmt: skip
    words: list[str] = []
    for word, (number, parts) in counts.items():
        some = ", ".join(f"{n} {part}" for part, n in parts.items() if n)
        words += [f"{word}: {number}{f' ({some})' if some else ''}"] if number else []
    return words


def _filled_columns(table: Table) -> Table:
    """Returns the columns that hold anything."""
    columns = [k for k in range(len(table[0])) if any(row[k] for row in table[1:])]
    return [[row[k] for k in columns] for row in table]


def _range(ends: Array, limited: bool, unit: str = "") -> str:
    return f"{_numbers(ends[:1])} to {_numbers(ends[1:])} {unit}".rstrip() if limited else ""


def _common_value(values: Array) -> str:
    """Returns the values in words: one number if all are equal, empty if all are 0."""
    return _numbers(values[:1] if len({*values.tolist()}) == 1 else values) if values.any() else ""


def _numbers(values: Iterable[float] | float) -> str:
    return " ".join(f"{value:.4g}" for value in np.ravel(np.asarray(values)).tolist())
