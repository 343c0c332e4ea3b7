"""The start at which MuJoCo's soft floor carries what rolls on it.

Exactly on the floor nothing touches, and a contact leaves out how the touching point wanders over
the body (J̇ v): it must slip to be held back as a rolling body is. So each body starts as deep, and
creeps as fast, as keeps the velocity of its lowest point from changing. Both fall with the step.
"""

from collections.abc import Callable, Mapping

import mujoco
import numpy as np

from .....cases.scene import Scene
from .....cases.scene.contact import Contact
from .....cases.scene.frame import SPACE
from .....cases.scene.rotation import turned
from .....cases.trajectory import Array
from ....engine import Start
from ...model.space.scene import signals
from ...model.space.start import started
from ...model.spatial_tree import spanning_tree
from ...model.tree import called
from ..signal import following, installed

CLOSE = 1e-8  # m/s²: what is left of the lowest points' accelerations, where it can be solved
ROUNDS = 30  # of Newton's method at most: in contact all is nearly linear, and three do
DEEP = 100.0  # h² · 1 m/s²: carries 10 m/s² in both recipes, so that friction holds from there on
STRIDE = 1e-3  # of its differences: far above what MuJoCo's solver leaves over


def settle(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, start: Start
) -> dict[str, tuple[float, float]]:
    """Depth [m] and creep [m/s] of each body that rolls; afterwards the keyframe starts there.

    What cannot be solved (a body whose joints hold its height) is started as it is.
    """
    contacts = list(scene.contacts.values())
    if not contacts:
        return {}
    h = model.opt.timestep

    def sunk(x: Array) -> Start:
        shifts = {c.body: x[3 * i : 3 * i + 3] * (-h * h, h, h) for i, c in enumerate(contacts)}
        return _moved(scene, start, shifts)

    def left(x: Array) -> Array:
        _place(scene, model, data, sunk(x))
        mujoco.mj_forward(model, data)
        mujoco.mj_rnePostConstraint(model, data)
        return np.concatenate([_acceleration(scene, model, data, c) for c in contacts])

    with installed(following(signals(scene))):
        x = _zero(left, np.tile([DEEP, 0.0, 0.0], len(contacts)))
    x = np.zeros(3 * len(contacts)) if x is None else x
    mujoco.mj_resetDataKeyframe(model, data, 0)  # the run must not inherit a warm start
    _place(scene, model, data, sunk(x))
    model.key_qpos[0], model.key_qvel[0] = data.qpos, data.qvel
    return {
        c.body: (h * h * x[3 * i], h * float(np.hypot(*x[3 * i + 1 : 3 * i + 3])))
        for i, c in enumerate(contacts)
    }


def _zero(left: Callable[[Array], Array], x: Array) -> Array | None:
    """Where nothing is left, by Newton's method; depths, every third entry, stay positive."""
    for _ in range(ROUNDS):
        now = left(x)
        if np.max(np.abs(now)) < CLOSE:
            return x
        slopes = [(left(x + STRIDE * e) - now) / STRIDE for e in np.eye(len(x))]
        try:
            after = x - np.linalg.solve(np.transpose(slopes), now)
        except np.linalg.LinAlgError:  # joints hold the body: nothing can be moved
            return None
        after[::3] = np.maximum(after[::3], 0.1 * x[::3])
        x = after
    return None


def _moved(scene: Scene, start: Start, shifts: Mapping[str, Array]) -> Start:
    """Bodies, and what hangs on them, sunk and pushed along the floor: (−depth, vx, vy)."""
    tree, found = spanning_tree(scene), {name: list(state) for name, state in start.items()}
    for root, (down, vx, vy) in shifts.items():
        for name in tree.subtree(root):
            found[name][SPACE.place.stop - 1] += float(down)
            found[name][SPACE.velocity.start] += float(vx)
            found[name][SPACE.velocity.start + 1] += float(vy)
    return {name: tuple(state) for name, state in found.items()}


def _place(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, start: Start) -> None:
    for name, (places, rates) in started(scene, start).items():
        number = model.body(name).id
        q = model.jnt_qposadr[model.body_jntadr[number]]
        v = model.body_dofadr[number]
        data.qpos[q : q + len(places)] = places
        data.qvel[v : v + len(rates)] = rates


def _acceleration(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, contact: Contact
) -> Array:
    """(3,) how fast the velocity of the lowest point changes while it wanders over the body.

    (v + ω × a)˙ = v̇ + ω̇ × a + ω × ȧ, with a from the centre to the lowest point.
    """
    number = model.body(called(contact.body)).id
    six, speed = np.zeros(6), np.zeros(6)
    kind = mujoco.mjtObj.mjOBJ_XBODY
    mujoco.mj_objectAcceleration(model, data, kind, number, six, 0)
    mujoco.mj_objectVelocity(model, data, kind, number, speed, 0)
    body, omega = scene.bodies[contact.body], speed[:3]
    arm, rate = _arm(body.radius or 0.0, None, omega)
    if contact.ideal == "pivot":
        arm = turned(data.xquat[number], body.points[contact.at.point])
        rate = np.cross(omega, arm)
    elif contact.rim:
        axle = turned(data.xquat[number], body.axle)
        arm, rate = _arm(body.radius or 0.0, axle, omega)
    # MuJoCo's accelerations are those of a frame that falls: gravity is missing in them.
    linear = six[3:] + model.opt.gravity
    return linear + np.cross(six[:3], arm) + np.cross(omega, rate)


def _arm(radius: float, axle: Array | None, omega: Array) -> tuple[Array, Array]:
    """From the centre to the lowest point, and its rate; without an axle of a sphere."""
    up = np.array([0.0, 0.0, 1.0])
    if axle is None:
        return -radius * up, np.zeros(3)
    turning = np.cross(omega, axle)
    steep = up - axle[2] * axle
    changing = -turning[2] * axle - axle[2] * turning
    size = np.linalg.norm(steep)
    direction = steep / size
    return -radius * direction, -radius * (changing - (direction @ changing) * direction) / size
