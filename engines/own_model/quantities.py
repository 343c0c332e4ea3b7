"""Quantities of a model's motion that can be bounded, by its names: `elbow.angle`, `hand.place`."""

import copy
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import mujoco
import numpy as np

from ...cases.trajectory import Array
from .model import OwnModel, joint_moves
from .numbers import WORDS, element_name
from .release import actuators, column

Of = Literal["joint", "place", "turn", "sensor", "force", "energy"]
OBJECT = mujoco.mjtObj


@dataclass(frozen=True)
class Quantity:
    """A quantity of a model: its name and unit, of what it is, and which numbers of that."""

    name: str
    unit: str
    of: Of
    first: int = 0
    wide: int = 1


def quantities(model: mujoco.MjModel) -> Iterator[Quantity]:
    """Yields all that can be bounded: joints, bodies, sensors, forces of actuators, energy."""
    yield from joint_quantities(model)
    for i in range(1, model.nbody):
        name = label(model, OBJECT.mjOBJ_BODY, i)
        yield Quantity(f"{name}.place", "m", "place", i)
        yield Quantity(f"{name}.turn", "rad", "turn", i)
    for i in range(model.nsensor):
        name = label(model, OBJECT.mjOBJ_SENSOR, i)
        first, wide = int(model.sensor_adr[i]), int(model.sensor_dim[i])
        yield Quantity(f"{name}.value", "", "sensor", first, wide)
    for i in range(actuators(model)):
        name = label(model, OBJECT.mjOBJ_ACTUATOR, i)
        yield Quantity(f"{name}.force", "", "force", int(column(model, "actuator_outadr")[i]))
    yield Quantity("energy", "J", "energy")


def joint_quantities(model: mujoco.MjModel) -> Iterator[Quantity]:
    """Yields those of the joints; a free one has a place and a turn."""
    for i in range(model.njnt):
        name, first = label(model, OBJECT.mjOBJ_JOINT, i), int(model.jnt_dofadr[i])
        kind = int(model.jnt_type[i])
        for field, unit, shift, wide in FIELDS[kind]:
            yield Quantity(f"{name}.{field}", unit, "joint", first + shift, wide)


def coordinates(model: mujoco.MjModel) -> list[tuple[str, str]]:
    """Returns the name and the unit of each coordinate, in their order."""
    columns: list[tuple[str, str]] = []
    for i in range(model.njnt):
        name = label(model, OBJECT.mjOBJ_JOINT, i)
        columns += [
            (f"{name}.{field}", unit) for field, unit in COORDINATES[int(model.jnt_type[i])]
        ]
    return columns


TURN = [(field, "") for field in ("qw", "qx", "qy", "qz")]
COORDINATES = {
    0: [("x", "m"), ("y", "m"), ("z", "m"), *TURN],
    1: TURN,
    2: [("shift", "m")],
    3: [("angle", "rad")],
}
"""By a joint's type its coordinates."""
FIELDS = {
    0: (("place", "m", 0, 3), ("turn", "rad", 3, 3)),
    1: (("turn", "rad", 0, 3),),
    2: (("shift", "m", 0, 1),),
    3: (("angle", "rad", 0, 1),),
}
"""By a joint's type its quantities: name, unit, and which of its velocities move it."""


def label(model: mujoco.MjModel, kind: mujoco.mjtObj, number: int) -> str:
    """Returns an element's name in a table; one that a table would misread stands in quotes."""
    name = element_name(model, kind, number)
    if name.startswith("#"):
        return f"{WORDS[kind]} {number}"
    sound = (name[0].isalnum() or name[0] == "_") and not NUMBERED.fullmatch(name)
    return name if sound and name.isprintable() else repr(name)


NUMBERED = re.compile(r"[a-z]+ \d+")  # as those without a name are called


@dataclass(frozen=True)
class Motion:
    """Samples of a model's motion: times (N,) [s] and y (N, m + n + a) of (qpos, qvel, act)."""

    own: OwnModel
    times: Array
    y: Array

    @property
    def q(self) -> Array:
        """(N, m) the coordinates."""
        return self.y[:, : self.own.model.nq]


def differences(selection: Sequence[Quantity], a: Motion, b: Motion) -> dict[Quantity, Array]:
    """Returns by quantity (N, k) b minus a, in components; of a body's turn the angle alone."""
    by_joint = joint_moves(a.own.model, a.q, b.q)
    others = [quantity for quantity in selection if quantity.of != "joint"]
    ours, theirs = observed(others, a), observed(others, b)
    by_quantity: dict[Quantity, Array] = {}
    for quantity in selection:
        if quantity.of == "joint":
            by_quantity[quantity] = by_joint[:, quantity.first : quantity.first + quantity.wide]
        elif quantity.of == "turn":
            by_quantity[quantity] = _angles(ours[quantity], theirs[quantity])
        else:
            by_quantity[quantity] = theirs[quantity] - ours[quantity]
    return by_quantity


def _angles(p: Array, q: Array) -> Array:
    """(N, 1) [rad]: the angles of the turns from attitudes (N, 4) to others."""
    sign = np.where(np.einsum("ij,ij->i", p, q) < 0.0, -1.0, 1.0)[:, None]
    half = np.linalg.norm(p * sign - q, axis=1, keepdims=True) / 2
    return 4 * np.arcsin(np.minimum(half, 1.0))


def observed(selection: Sequence[Quantity], motion: Motion) -> dict[Quantity, Array]:
    """Returns (N, k) by quantity, none of a joint, as MuJoCo computes it in the motion's states."""
    values: dict[Quantity, list[Array]] = {quantity: [] for quantity in selection}
    if not selection:
        return {}
    own, m = motion.own, copy.copy(motion.own.model)
    m.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    data, controls = own.start(), own.controls
    for t, y in zip(motion.times, motion.y, strict=True):
        data.time, data.ctrl[:] = t, controls.at(float(t))
        data.qpos[:], data.qvel[:], data.act[:] = np.split(y, [m.nq, m.nq + m.nv])
        mujoco.mj_forward(m, data)
        for quantity, samples in values.items():
            samples.append(READ[quantity.of](data, quantity))
    return {quantity: np.array(samples) for quantity, samples in values.items()}


READ: Mapping[Of, Callable[[mujoco.MjData, Quantity], Array]] = {
    "place": lambda data, body: data.xpos[body.first].copy(),
    "turn": lambda data, body: data.xquat[body.first].copy(),
    "sensor": lambda data, s: data.sensordata[s.first : s.first + s.wide].copy(),
    "force": lambda data, actuator: data.actuator_force[[actuator.first]],
    "energy": lambda data, _: data.energy.sum(keepdims=True),
}
"""By what a quantity is of, its numbers in a state."""
