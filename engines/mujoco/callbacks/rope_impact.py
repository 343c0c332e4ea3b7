"""Ropes by a driver: a step is cut where one comes taut, and its impact is taken at once.

So nothing is thrown back, and no step sees a force that begins in it. What holds a taut rope is
MuJoCo's limit; that of a slack one is switched off, for a stage may look too far ahead.
"""

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.trajectory import Array
from ..model.tree import dry_joints, spanning_tree
from .cut import Cut, Height
from .rope_limit import NEAR, Tendons, lengthen, ropes_of

FAR, FAST = 1e-2, 10.0  # of a rope's length, and steps at its rate: as near it is looked at


def catches(scene: Scene) -> bool:
    """Whether ropes are all that switches or gives way in the scene."""
    soft = scene.pressed or scene.constraints or dry_joints(scene)
    soft = soft or any(scene.one_sided()) or spanning_tree(scene).loops
    ropes = [*ropes_of(scene)]
    return bool(ropes) and not soft and len(ropes) == len([*scene.limits()])


class Catching(Cut[int]):
    """The ropes, and which of them [bool] are taut."""

    def __init__(self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        super().__init__(model, data)
        ropes = list(ropes_of(scene))
        self._tendons = Tendons(model, data, [model.tendon(rope.name).id for rope in ropes])
        self._most = np.array([rope.length for rope in ropes])
        self._ends = list(zip(self._tendons.numbers, self._most.tolist(), strict=True))
        self._lengths, self._speeds = data.ten_length, data.ten_velocity
        self.recall((self._over() > -NEAR * self._most) & (self._rates() > -NEAR * self._most))

    def remember(self) -> Any:
        """Which are taut."""
        return self.taut.copy()

    def recall(self, taut: Any) -> None:
        """Restore which ropes are taut, as `remember` gave them: MuJoCo's limits hold these."""
        self.taut = taut.copy()
        self.model.tendon_limited[self._tendons.numbers] = self.taut

    def step(self, step: float) -> None:
        """One step [s], in as many parts as ropes come taut in it."""
        if self._calm(step):
            mujoco.mj_step(self.model, self.data)
        else:
            super().step(step)

    def _happens(self) -> Mapping[int, Height]:
        """Ropes that came to their length."""
        crossed = np.flatnonzero((self._over() > 0.0) & ~self.taut).tolist()
        return {k: lambda k=k: float(self._over()[k]) for k in crossed}

    def _uncut(self) -> None:
        """Mark as slack each rope whose ends are closer than its length."""
        self.recall(self.taut & (self._over() >= 0.0))

    def _calm(self, step: float) -> bool:
        """Whether what is taut stays it, and what is slack is far from being taut.

        By what MuJoCo knows of the last step: what changes in one is small beside `FAR`.
        """
        for (number, most), taut in zip(self._ends, self.taut.tolist(), strict=True):
            gap, near = most - self._lengths.item(number), 0.0
            if not taut:
                near = FAR * most + FAST * step * abs(self._speeds.item(number))
            if not (gap < 0.0 if taut else gap > near):
                return False
        return True

    def _change(self, key: int) -> None:
        """(2.60) over the instant: no rope that pulls in it keeps a velocity along it."""
        mujoco.mj_forward(self.model, self.data)
        rows, v = self._tendons.rows(), self.data.qvel.copy()
        pulls, lets_go = [key], []
        while True:
            eased = self._tendons.eased(rows[pulls])
            impulses = np.linalg.solve(rows[pulls] @ eased.T, rows[pulls] @ v)
            after = v - impulses @ eased
            if (impulses < 0.0).any():  # a rope beside the first that would have to push
                lets_go.append(pulls.pop(int(np.argmin(impulses))))
                continue
            parts = self.taut & (rows @ after > NEAR * self._most)
            more = [int(k) for k in np.flatnonzero(parts) if k not in (*pulls, *lets_go)]
            if not more:
                break
            pulls.append(more[0])
        self.data.qvel[:] = after
        self.taut[key] = True
        self.recall(self.taut)
        lengthen(self._tendons, np.flatnonzero(self.taut))

    def _over(self) -> Array:
        """How much too long [m] each is."""
        return self._tendons.lengths - self._most

    def _rates(self) -> Array:
        return self._tendons.rows() @ self.data.qvel
