"""What points that touch MuJoCo's planes do when they are so deep in them, and creep so fast."""

from collections.abc import Sequence

import mujoco
import numpy as np

from ....cases.scene import Contact, Scene
from ....cases.trajectory import Array
from ..tree import spanning_tree

UPRIGHT = 1e3  # times as ready to sink as to turn: a start leans by less than a thousandth of that
_GEOM = int(mujoco.mjtObj.mjOBJ_GEOM)


class Floor:
    """The start of a scene's points on their planes, and what they do beside it.

    `depths` [m] and `creeps` [m/s] are (contacts,) each.
    """

    def __init__(
        self,
        scene: Scene,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        contacts: Sequence[Contact],
    ) -> None:
        self.model, self.data = model, data
        self._gravity = model.opt.gravity
        self._geoms = [mujoco.mj_name2id(model, _GEOM, contact.name) for contact in contacts]
        self._radii = [scene.bodies[contact.body].radius or 0.0 for contact in contacts]
        self._along = np.array([(*contact.plane.along, 0.0) for contact in contacts])
        self._normal = np.array([(*contact.plane.normal, 0.0) for contact in contacts])
        mujoco.mj_forward(model, data)
        self._qpos, self._qvel = data.qpos.copy(), data.qvel.copy()
        self.depths, self.creeps = np.zeros(len(contacts)), np.zeros(len(contacts))
        planes = [contact.plane for contact in contacts]
        places = data.geom_xpos[self._geoms, :2]
        self.heights = [p.height(x, y) for p, (x, y) in zip(planes, places, strict=True)]
        along, up = self._rows()
        self.slips = along @ self._qvel
        self._sinks = -self._ways(up, _falling(scene, model))
        self._creeps = self._ways(along, [])

    def _rows(self) -> tuple[Array, Array]:
        """(contacts, nv) each: how the lowest points move along their planes and away from them."""
        rows = np.zeros((len(self._geoms), 3, self.model.nv))
        for row, geom, arm in zip(rows, self._geoms, self._arms(), strict=True):
            lowest = self.data.geom_xpos[geom] - arm
            body = int(self.model.geom_bodyid[geom])
            mujoco.mj_jac(self.model, self.data, row, None, lowest, body)
        return tuple(np.einsum("ci,cin->cn", way, rows) for way in (self._along, self._normal))

    def _arms(self) -> Array:
        """(contacts, 3): from the lowest points to the centres [m]."""
        return np.array(self._radii)[:, None] * self._normal

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
        """Of the lowest point [m/s²]: how its slip grows, and how its height does."""
        self.place()
        found = np.zeros(6)
        mujoco.mj_forward(self.model, self.data)
        mujoco.mj_rnePostConstraint(self.model, self.data)
        mujoco.mj_objectAcceleration(self.model, self.data, _GEOM, self._geoms[i], found, 0)
        real = found[3:] + self._gravity  # MuJoCo counts what holds as −g
        along = float(self._along[i] @ real)
        return along + self._radii[i] * float(found[2]), float(self._normal[i] @ real)


def _falling(scene: Scene, model: mujoco.MjModel) -> list[int]:
    """The numbers of the rates with which free bodies move without turning."""
    free = [branch.body for branch in spanning_tree(scene).branches if branch.joint is None]
    return [int(model.joint(f"{body}.{axis}").dofadr[0]) for body in free for axis in ("x", "y")]
