"""Ropes that are taut: where MuJoCo's soft limits have to stand to pull as much as they do.

A limit asks of the velocity along its tendon the change −b ṙ − k r, and leaves out what the turn of
the tendon adds to it, J̇ v. On a circle it comes to pull enough where it is J̇ v/k too long. So
long it is started, or its force would be wrong until it is.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from ....cases.scene import Scene
from ....cases.scene.forces.force import Rope, of
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

    def eased(self, rows: Array) -> Array:
        """M⁻¹ Jᵀ of some rows, transposed (K, n), of the data's last `mj_forward`."""
        found = np.zeros_like(rows)
        if len(rows):
            mujoco.mj_solveM(self.model, self.data, found, np.ascontiguousarray(rows))
        return found


def ropes_of(scene: Scene) -> Iterator[Rope]:
    """The scene's ropes."""
    return of(Rope, scene.forces.values())


def draw(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """Moves the data to where ropes that are taut pull rightly; how much too long [m] they are."""
    ropes = list(ropes_of(scene))
    tendons = Tendons(model, data, [model.tendon(rope.name).id for rope in ropes])
    mujoco.mj_forward(model, data)
    rows, most = tendons.rows(), np.array([rope.length for rope in ropes])
    rates = rows @ data.qvel
    free = tendons.turning() + rows @ data.qacc_smooth
    taut = (tendons.lengths > most * (1 - NEAR)) & (rates > -NEAR * most) & (free > 0.0)
    moved = lengthen(tendons, np.flatnonzero(taut))
    return {rope.name: more for rope, more in zip(ropes, moved.tolist(), strict=True) if more}


def lengthen(tendons: Tendons, taut: NDArray[np.intp]) -> Array:
    """Moves the data the least way, in M, to where each that is taut pulls rightly; (K,) [m]."""
    model, data, moved = tendons.model, tendons.data, np.zeros(len(tendons.numbers))
    if not len(taut):
        return moved
    numbers = np.array(tendons.numbers)[taut]
    k = -model.tendon_solref_lim[numbers, 0] * model.tendon_solimp_lim[numbers, 0]
    most = model.tendon_range[numbers, 1]
    moved[taut] = np.maximum(np.maximum(tendons.turning()[taut], 0.0) / k, BEHIND * most)
    mujoco.mj_forward(model, data)
    rows = tendons.rows()[taut]
    eased = tendons.eased(rows)
    data.qpos += np.linalg.solve(rows @ eased.T, moved[taut]) @ eased
    return moved
