"""The start at which MuJoCo's soft floor carries what lies or rolls on it.

Put exactly on the floor, a disk is not in contact: it falls free for a step, and the settling
that follows is an error of first order, and wrong forces. So every point that touches is started
as deep as keeps its height from accelerating, which is the textbook's contact; and what sticks
creeps from the start as fast as MuJoCo's friction needs to hold it. In space a contact leaves out
how the touching point wanders over the body (J̇ v): there what rolls creeps, too.
"""

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from ....cases.scene import Contact, Pair, Scene
from ....cases.scene.frame import PLANE, SPACE
from ....cases.scene.motion import Motion
from ....cases.scene.rotation import turned
from ....cases.trajectory import Array, Trajectory
from ...engine import Start
from ..model.contact import lies, meet
from ..model.number_text import lifted
from ..model.planes import touching
from ..model.tree import AXES, called
from .point_forces import point_force_callbacks
from .signal import listening, signals

Mask = NDArray[np.bool_]

UPRIGHT = 1e6  # times as ready to sink as to turn: a start leans by less than a millionth of that
DEEP = 100.0  # h² · 1 m/s²: carries 10 m/s² in all recipes
DEEPEST = 1e9  # the same: with numbers held to a larger step a floor is softer
ROUNDS = 12  # of Newton's method at most: in contact all is nearly linear, and three do
STRIDE = 1e-5  # of the deepest, for differences: far above what MuJoCo's solver leaves over
KNOWN = 1e-7  # of the largest slope: below it is what differences leave of none
CONVERGED = 1e-8  # of the largest number: differences leave 1e-5 of that, and rounding 1e-10
HELD = 1e-2  # m/s²: MuJoCo's solver leaves 1e-3 with its own tolerance, and rounding less
NOTHING = 1e-9  # m/s²: a depth or creep that no place or velocity can hold
STILL = 1e-9  # m/s: what slips less is meant to stick


def settle(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, start: Start
) -> dict[str, tuple[float, float]]:
    """Depth [m] and creep [m/s] of each closed contact, by name; the data then starts there.

    What nothing carries, as a body whose joints hold its height, starts as it is.
    """
    every, space = touching(scene).values(), scene.frame is SPACE
    contacts = [contact for contact in every if space or lies(scene, contact, start)]
    pairs = [pair for pair in scene.pairs.values() if meet(scene, pair, start)]
    if not contacts and not pairs:
        return {}
    with listening(), signals(scene, point_force_callbacks(scene, model)):
        floor = Floor(scene, model, data, contacts, pairs)
        numbers = _carried(floor)
    mujoco.mj_resetDataKeyframe(model, data, 0)  # the run must not inherit a warm start
    floor.place(numbers)
    creeps, depths = floor.creeps_and_depths(numbers)
    sizes = zip(depths.tolist(), np.linalg.norm(creeps, axis=1).tolist(), strict=True)
    return dict(zip([contact.name for contact in (*contacts, *pairs)], sizes, strict=True))


def _carried(floor: "Floor") -> Array:
    """The floor's numbers: first depths alone, for friction holds by what they press."""
    depths = floor.is_depth
    deep = np.where(depths, DEEP, 0.0)
    while np.max(floor.accelerations(deep)[depths]) < 0 and np.max(deep) < DEEPEST:
        deep = 10 * deep
    lying = _held(floor, depths.copy(), deep)
    carries = lying[depths] > 0
    sticks = floor.sticks & np.repeat(carries, floor.tangents)
    return _held(floor, np.append(sticks, carries), lying)


def _held(floor: "Floor", held: Mask, guess: Array) -> Array:
    """The numbers at which nothing accelerates of what can be held.

    What cannot (a point that rises, a slip that friction is too weak for) is let go, the worst
    first: whether friction holds hangs on what else does.
    """
    while held.any():
        numbers = _newton(floor, held, np.where(held, guess, 0.0))
        rests = np.where(held, np.abs(floor.accelerations(numbers)), 0.0)
        if np.max(rests) <= HELD:
            return np.where(np.abs(numbers) > NOTHING, numbers, 0.0)
        slips = np.where(floor.is_depth, 0.0, rests)
        worst = int(np.argmax(slips if np.max(slips) > HELD else rests))
        held[worst] = False
        if floor.is_depth[worst]:
            first = (worst - floor.creeping) * floor.tangents
            held[first : first + floor.tangents] = False
    return np.zeros(len(held))


def _newton(floor: "Floor", held: Mask, numbers: Array) -> Array:
    """The numbers at which what is held does not accelerate, as near as they can take it away."""
    for _ in range(ROUNDS):
        now, size = floor.accelerations(numbers)[held], STRIDE * np.max(numbers[floor.is_depth])
        nudged = [floor.accelerations(numbers + x)[held] for x in size * np.eye(len(held))[held]]
        slopes = np.subtract(nudged, now) / size
        if not np.isfinite(slopes).all():
            break
        # Two corners of one block slip alike: of their creeps only a sum is known.
        before, step = numbers, np.zeros(len(held))
        step[held] = np.linalg.lstsq(np.transpose(slopes), -now, rcond=KNOWN)[0]
        numbers = np.where(floor.is_depth, np.maximum(before + step, 0.1 * before), before + step)
        if np.max(np.abs(numbers - before)) <= CONVERGED * np.max(np.abs(numbers)):
            break
    return numbers


class Floor:
    """The start of a scene's points on planes and bodies, and what they do beside it.

    Its numbers [m/s²] are creeps over h, each contact's along its tangents, and then depths over
    h²; contacts with planes come first.
    """

    def __init__(
        self,
        scene: Scene,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        contacts: Sequence[Contact],
        pairs: Sequence[Pair],
    ) -> None:
        self._model, self._data, self._step = model, data, float(model.opt.timestep)
        self._touching = [
            *(OnPlane(scene, model, data, contact) for contact in contacts),
            *(OnBody(scene, model, data, pair) for pair in pairs),
        ]
        mujoco.mj_forward(model, data)
        self._qpos, self._qvel = data.qpos.copy(), data.qvel.copy()
        rows = np.stack([touching.rows() for touching in self._touching])
        along, up = rows[:, :-1].reshape(-1, model.nv), rows[:, -1]
        self.creeping, self.tangents = len(along), len(along) // len(up)
        self.is_depth = np.arange(len(along) + len(up)) >= self.creeping
        shifts, space = _shifts(model), scene.frame is SPACE
        self._sinks = -self._ways(up, shifts)
        self._creeps = self._ways(along, shifts if space else [])
        rubs = [contact.friction > 0 for contact in (*contacts, *pairs)]
        still = (np.abs(along @ self._qvel) <= STILL) & (not model.opt.noslip_iterations)
        self.sticks = (still | space) & np.repeat(rubs, self.tangents)

    def _ways(self, rows: Array, upright: list[int]) -> Array:
        """(nv, rows): the least motion that moves one point by 1 and keeps all loops closed.

        Least by the kinetic energy it would have, W⁻¹ Jᵀ (J W⁻¹ Jᵀ)⁻¹ with W the mass matrix; but
        what is free to sink upright does, for what leans at the start moves in another way.
        """
        model, data, points = self._model, self._data, len(rows)
        if data.ne:
            rows = np.vstack([rows, data.efc_J.reshape(-1, model.nv)[: data.ne]])
        given, lift = np.zeros_like(rows), np.zeros((len(upright), model.nv))
        mujoco.mj_solveM(model, data, given, np.ascontiguousarray(rows))
        mujoco.mj_solveM(model, data, lift, np.eye(model.nv)[upright])
        for dof, moved in zip(upright, lift, strict=True):
            given[:, dof] += UPRIGHT * moved[dof] * rows[:, dof]
        return given.T @ np.linalg.pinv(rows @ given.T)[:, :points]

    def creeps_and_depths(self, numbers: Array) -> tuple[Array, Array]:
        """(contacts, tangents) [m/s] and (contacts,) [m]."""
        creeps, depths = np.split(numbers, [self.creeping])
        return self._step * creeps.reshape(-1, self.tangents), self._step**2 * depths

    def place(self, numbers: Array) -> None:
        """Puts the data there."""
        creeps, depths = self.creeps_and_depths(numbers)
        self._data.qpos[:] = self._qpos
        mujoco.mj_integratePos(self._model, self._data.qpos, self._sinks @ depths, 1.0)
        self._data.qvel[:] = self._qvel + self._creeps @ creeps.ravel()

    def accelerations(self, numbers: Array) -> Array:
        """[m/s²] in the order of the numbers: how slips grow, and how heights do."""
        self.place(numbers)
        mujoco.mj_forward(self._model, self._data)
        mujoco.mj_rnePostConstraint(self._model, self._data)
        each = np.array([touching.acceleration() for touching in self._touching])
        return np.concatenate([each[:, :-1].ravel(), each[:, -1]])


def _shifts(model: mujoco.MjModel) -> list[int]:
    """The rates with which bodies on the ground move without turning, by their numbers."""
    wide = {int(mujoco.mjtJoint.mjJNT_FREE): 3, int(mujoco.mjtJoint.mjJNT_SLIDE): 1}
    joints = zip(model.jnt_dofadr.tolist(), model.jnt_type.tolist(), model.jnt_bodyid, strict=True)
    return [
        first + i
        for first, kind, body in joints
        if not model.body_parentid[body]
        for i in range(wide.get(kind, 0))
    ]


# Points that touch in MuJoCo at a start: how they move with all rates, how slip and gap grow.


_GEOM, _BODY = int(mujoco.mjtObj.mjOBJ_GEOM), int(mujoco.mjtObj.mjOBJ_BODY)
_SOON = 1e-5  # s: over so long the growth of two rates is looked at; off by 1e-10 of it


class OnPlane:
    """A disk's rim, a sphere or a point on a plane of the ground."""

    def __init__(
        self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, contact: Contact
    ) -> None:
        self._model, self._data = model, data
        self._geom = mujoco.mj_name2id(model, _GEOM, contact.name)
        self._body, body = int(model.geom_bodyid[self._geom]), scene.bodies[contact.body]
        self._radius = 0.0 if contact.ideal == "pivot" else body.radius or 0.0
        self._axle = body.axle if contact.rim else None
        along = [lifted(contact.plane.along)] if scene.frame is PLANE else AXES[:2]
        self._axes = np.array([*along, lifted(contact.plane.normal)])

    def rows(self) -> Array:
        """(tangents and normal, nv): how the lowest point moves along its plane, and from it."""
        moves = np.zeros((3, self._model.nv))
        lowest = self._data.geom_xpos[self._geom] + self._arm(np.zeros(3))[0]
        mujoco.mj_jac(self._model, self._data, moves, None, lowest, self._body)
        return self._axes @ moves

    def acceleration(self) -> Array:
        """[m/s²] how fast the velocity of the lowest point changes while it wanders over the body.

        (v + ω × a)˙ = v̇ + ω̇ × a + ω × ȧ, with a from the centre to the lowest point.
        """
        speed, growth = np.zeros(6), np.zeros(6)
        mujoco.mj_objectVelocity(self._model, self._data, _GEOM, self._geom, speed, 0)
        mujoco.mj_objectAcceleration(self._model, self._data, _GEOM, self._geom, growth, 0)
        arm, rate = self._arm(speed[:3])
        # MuJoCo's accelerations are those of a frame that falls: gravity is missing in them.
        real = growth[3:] + self._model.opt.gravity
        return self._axes @ (real + np.cross(growth[:3], arm) + np.cross(speed[:3], rate))

    def _arm(self, omega: Array) -> tuple[Array, Array]:
        axle = None if self._axle is None else turned(self._data.xquat[self._body], self._axle)
        return lowest_arm(self._radius, self._axes[-1], axle, omega)


def lowest_arm(radius: float, up: Array, axle: Array | None, omega: Array) -> tuple[Array, Array]:
    """From the centre to the lowest point, and its rate; without an axle of a sphere."""
    if axle is None:
        return -radius * up, np.zeros(3)
    turning = np.cross(omega, axle)
    steep = up - (axle @ up) * axle
    changing = -(turning @ up) * axle - (axle @ up) * turning
    size = np.linalg.norm(steep)
    direction = steep / size
    return -radius * direction, -radius * (changing - (direction @ changing) * direction) / size


class OnBody:
    """A point or rim of a body that touches another body."""

    def __init__(
        self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, pair: Pair
    ) -> None:
        self._scene, self._model, self._data, self._pair = scene, model, data, pair
        self._bodies = {
            name: int(model.body(called(name)).id) for name in (pair.body, pair.touched)
        }

    def rows(self) -> Array:
        """(2, nv): how it slips on the other body, and moves away from it."""
        motion = self._motion([0.0])
        (x, y), (nx, ny) = self._pair.place(motion)[0], self._pair.normal_and_gap(motion)[0][0]
        place = np.array([x, y, 0.0])
        jacobians = np.zeros((2, 3, self._model.nv))
        for jacobian, body in zip(jacobians, self._bodies.values(), strict=True):
            mujoco.mj_jac(self._model, self._data, jacobian, None, place, body)
        moves = jacobians[0] - jacobians[1]
        return np.array([ny * moves[0] - nx * moves[1], nx * moves[0] + ny * moves[1]])

    def acceleration(self) -> Array:
        """[m/s²] how its slip grows, and how fast the gap does ever more."""
        rates = self._pair.slip_and_gap_rate(self._motion([-_SOON, _SOON]))
        return np.diff(rates)[:, 0] / (2 * _SOON)

    def _motion(self, times: list[float]) -> Motion:
        """Both bodies a little before and after, as their accelerations have it."""
        t = np.array(times)[:, None]
        states: dict[str, Array] = {}
        for name, body in self._bodies.items():
            place, rate, growth = self._state(body)
            states[name] = np.hstack([place + rate * t + growth * t * t / 2, rate + growth * t])
        bodies = self._scene.bodies
        return Motion(bodies, self._scene.points, Trajectory(t[:, 0], states, {}))

    def _state(self, body: int) -> tuple[Array, Array, Array]:
        """x, y, angle of a body, and their first and second rates, (3,) each."""
        rate, growth = np.zeros(6), np.zeros(6)
        mujoco.mj_objectVelocity(self._model, self._data, _BODY, body, rate, 0)
        mujoco.mj_objectAcceleration(self._model, self._data, _BODY, body, growth, 0)
        growth[3:] += self._model.opt.gravity  # MuJoCo counts what holds as −g
        turned = self._data.xmat[body]
        x, y, _ = self._data.xipos[body]
        return (
            np.array([x, y, np.arctan2(turned[3], turned[0])]),
            rate[[3, 4, 2]],
            growth[[3, 4, 2]],
        )
