"""Motion of touching points in MuJoCo at given depths in a plane or a body, and given creeps."""

from collections.abc import Sequence

import mujoco
import numpy as np

from ....cases.scene import Contact, Scene
from ....cases.scene.motion import Motion
from ....cases.scene.pair import Pair
from ....cases.trajectory import Array, Trajectory
from ..model.tree import called, spanning_tree

UPRIGHT = 1e3  # times as ready to sink as to turn: a start leans by less than a thousandth of that


class Floor:
    """The start of a scene's points on planes and bodies, and what they do beside it.

    `depths` [m] and `creeps` [m/s] are (contacts,) each, those with planes first.
    """

    def __init__(
        self,
        scene: Scene,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        contacts: Sequence[Contact],
        pairs: Sequence[Pair] = (),
    ) -> None:
        self.model, self.data = model, data
        self._touching = [
            *(OnPlane(scene, model, data, contact) for contact in contacts),
            *(OnBody(scene, model, data, pair) for pair in pairs),
        ]
        mujoco.mj_forward(model, data)
        self._qpos, self._qvel = data.qpos.copy(), data.qvel.copy()
        count = len(self._touching)
        self.depths, self.creeps = np.zeros(count), np.zeros(count)
        self.heights = [touching.height for touching in self._touching]
        along, up = np.stack([touching.rows() for touching in self._touching], axis=1)
        self.slips = along @ self._qvel
        self._sinks = -self._ways(up, _falling(scene, model))
        self._creeps = self._ways(along, [])

    def _ways(self, rows: Array, upright: list[int]) -> Array:
        """(nv, contacts): the least motion that moves one point by 1 and keeps all loops closed.

        Least by the kinetic energy it would have, W⁻¹ Jᵀ (J W⁻¹ Jᵀ)⁻¹ with W the mass matrix; but
        what is free to sink upright does, for what leans at the start moves in another way.
        """
        model, data, points = self.model, self.data, len(rows)
        if data.ne:
            rows = np.vstack([rows, data.efc_J.reshape(-1, model.nv)[: data.ne]])
        given, lift = np.zeros_like(rows), np.zeros((len(upright), model.nv))
        mujoco.mj_solveM(model, data, given, np.ascontiguousarray(rows))
        mujoco.mj_solveM(model, data, lift, np.eye(model.nv)[upright])
        for dof, moved in zip(upright, lift, strict=True):
            given[:, dof] += UPRIGHT * moved[dof] * rows[:, dof]
        return given.T @ np.linalg.pinv(rows @ given.T)[:, :points]

    def place(self) -> None:
        """Puts the data there; a hinge or a slide has one number, so they add up."""
        self.data.qpos[:] = self._qpos + self._sinks @ self.depths
        self.data.qvel[:] = self._qvel + self._creeps @ self.creeps

    def acceleration(self, i: int) -> tuple[float, float]:
        """Accelerations [m/s²] at contact i: how its slip grows, and how its height does."""
        self._look()
        return self._touching[i].acceleration()

    def accelerations(self) -> Array:
        """(2, contacts): of all that touches."""
        self._look()
        return np.transpose([touching.acceleration() for touching in self._touching])

    def _look(self) -> None:
        self.place()
        mujoco.mj_forward(self.model, self.data)
        mujoco.mj_rnePostConstraint(self.model, self.data)


def _falling(scene: Scene, model: mujoco.MjModel) -> list[int]:
    """The numbers of the rates with which free bodies move without turning."""
    free = [branch.body for branch in spanning_tree(scene).branches if branch.joint is None]
    return [int(model.joint(f"{body}.{axis}").dofadr[0]) for body in free for axis in ("x", "y")]


# Points that touch in MuJoCo at a start: how they move with all rates, how gap and slip grow.


_GEOM, _BODY = int(mujoco.mjtObj.mjOBJ_GEOM), int(mujoco.mjtObj.mjOBJ_BODY)
_SOON = 1e-5  # s: over so long the growth of two rates is looked at; off by 1e-10 of it


class OnPlane:
    """A disk's rim or a point on a plane of the ground."""

    def __init__(
        self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, contact: Contact
    ) -> None:
        self._model, self._data = model, data
        self._gravity = model.opt.gravity
        self._geom = mujoco.mj_name2id(model, _GEOM, contact.name)
        self._radius = scene.bodies[contact.body].radius or 0.0
        self._along = np.array((*contact.plane.along, 0.0))
        self._normal = np.array((*contact.plane.normal, 0.0))
        self._plane = contact.plane

    @property
    def height(self) -> float:
        """[m] of its centre or point above the plane."""
        return float(self._plane.height(*self._data.geom_xpos[self._geom, :2]))

    def rows(self) -> Array:
        """(2, nv): how the lowest point moves along its plane and away from it."""
        found = np.zeros((3, self._model.nv))
        lowest = self._data.geom_xpos[self._geom] - self._radius * self._normal
        body = int(self._model.geom_bodyid[self._geom])
        mujoco.mj_jac(self._model, self._data, found, None, lowest, body)
        return np.array([self._along @ found, self._normal @ found])

    def acceleration(self) -> tuple[float, float]:
        """Accelerations [m/s²] of the lowest point: how its slip grows, and how its height does."""
        found = np.zeros(6)
        mujoco.mj_objectAcceleration(self._model, self._data, _GEOM, self._geom, found, 0)
        real = found[3:] + self._gravity  # MuJoCo counts what holds as −g
        along = float(self._along @ real)
        return along + self._radius * float(found[2]), float(self._normal @ real)


class OnBody:
    """A point or rim of a body that touches another body."""

    def __init__(
        self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, pair: Pair
    ) -> None:
        self._scene, self._model, self._data, self._pair = scene, model, data, pair
        self._bodies = {
            name: int(model.body(called(name)).id) for name in (pair.body, pair.touched)
        }

    @property
    def height(self) -> float:
        """[m] of its place: what rounding is relative to."""
        return float(np.max(np.abs(self._pair.place(self._motion([0.0])))))

    def rows(self) -> Array:
        """(2, nv): how it slips on the other body, and moves away from it."""
        motion = self._motion([0.0])
        (x, y), (nx, ny) = self._pair.place(motion)[0], self._pair.normal(motion)[0][0]
        place = np.array([x, y, 0.0])
        each = np.zeros((2, 3, self._model.nv))
        for found, body in zip(each, self._bodies.values(), strict=True):
            mujoco.mj_jac(self._model, self._data, found, None, place, body)
        moves = each[0] - each[1]
        return np.array([ny * moves[0] - nx * moves[1], nx * moves[0] + ny * moves[1]])

    def acceleration(self) -> tuple[float, float]:
        """[m/s²] how its slip grows, and how fast the gap does ever more."""
        slip, parting = self._pair.moves(self._motion([-_SOON, _SOON]))
        return float(np.diff(slip)[0]) / (2 * _SOON), float(np.diff(parting)[0]) / (2 * _SOON)

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
