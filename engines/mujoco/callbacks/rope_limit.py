"""Ropes that are taut: where MuJoCo's soft limits have to stand to pull as much as they do.

A limit asks of the velocity along its tendon the change −b ṙ − k r, and leaves out what the turn of
the tendon adds to it, J̇ v. On a circle it comes to pull enough where it is J̇ v/k too long. So
long it is started, or its force would be wrong until it is.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.scene.forces.force import Rope, of_kind
from ....cases.trajectory import Array

NEAR = 1e-9  # of a rope's length: so near its end it is taut
BEHIND = 1e-12  # of a length: a limit that is just met pulls nothing
AHEAD = 1e-6  # s: over which the turn of a tendon is measured


@dataclass(frozen=True)
class Tendons:
    """Some of a model's tendons, as the data has them."""

    model: mujoco.MjModel
    data: mujoco.MjData
    numbers: Sequence[int]

    @property
    def lengths(self) -> Array:
        """(K,) [m] at the data's places, which a step leaves behind."""
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_tendon(self.model, self.data)
        return self.data.ten_length[self.numbers]

    def rows(self) -> Array:
        """J (K, n), of the lengths that were asked for last."""
        model, rows = self.model, np.zeros((self.model.ntendon, self.model.nv))
        for i in self.numbers:
            at = model.ten_J_rowadr[i] + np.arange(model.ten_J_rownnz[i])
            rows[i, model.ten_J_colind[at]] = self.data.ten_J[at]
        return rows[self.numbers]

    def turning(self) -> Array:
        """(K,) J̇ v [m/s²]."""
        places, v = self.data.qpos.copy(), self.data.qvel
        rates = []
        for ahead in (AHEAD, -AHEAD):
            self.data.qpos[:] = places + ahead * v
            _ = self.lengths
            rates.append(self.rows() @ v)
        self.data.qpos[:] = places
        return (rates[0] - rates[1]) / (2 * AHEAD)


def ropes_of(scene: Scene) -> Iterator[Rope]:
    """The scene's ropes."""
    return of_kind(Rope, scene.forces.values())


def draw(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """Moves the data, the least way in M, to where ropes that are taut pull rightly.

    Returns how much too long [m] each of them is.
    """
    ropes = list(ropes_of(scene))
    tendons = Tendons(model, data, [model.tendon(rope.name).id for rope in ropes])
    mujoco.mj_forward(model, data)
    rows, most = tendons.rows(), np.array([rope.length for rope in ropes])
    rates, turning = rows @ data.qvel, tendons.turning()
    free = turning + rows @ data.qacc_smooth
    pulls = (tendons.lengths > most * (1 - NEAR)) & (rates > -NEAR * most) & (free > 0.0)
    taut = np.flatnonzero(pulls)
    if not len(taut):
        return {}
    numbers = np.array(tendons.numbers)[taut]
    k = -model.tendon_solref_lim[numbers, 0] * model.tendon_solimp_lim[numbers, 0]
    longer = np.maximum(np.maximum(turning[taut], 0.0) / k, BEHIND * most[taut])
    eased = np.zeros((len(taut), model.nv))  # M⁻¹ Jᵀ, transposed
    mujoco.mj_solveM(model, data, eased, np.ascontiguousarray(rows[taut]))
    data.qpos += np.linalg.solve(rows[taut] @ eased.T, longer) @ eased
    return {ropes[i].name: more for i, more in zip(taut.tolist(), longer.tolist(), strict=True)}
