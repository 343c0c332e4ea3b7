"""What touches in MuJoCo does when it is so deep in a plane or a body, and creeps so fast."""

from collections.abc import Sequence

import mujoco
import numpy as np

from ....cases.scene import Contact, Scene
from ....cases.scene.pair import Pair
from ....cases.trajectory import Array
from ..tree import spanning_tree
from .touching import OnBody, OnPlane

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
        """Of what touches there [m/s²]: how its slip grows, and how its height does."""
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
