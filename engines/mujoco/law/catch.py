"""Ropes by a driver: a step is cut where one comes taut, and its impact is taken at once.

So nothing is thrown back, and no step sees a force that begins in it. What holds a taut rope is
MuJoCo's limit; that of a slack one is switched off, for a stage may look too far ahead.
"""

from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np
from scipy.optimize import brentq

from ....cases.scene import Scene
from ....cases.trajectory import Array
from ..tree import spanning_tree
from .taut import NEAR, Tendons, lengthen

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_ROOT = 4e-16  # s: as well as a time is known
_SHORTEST = 1e-12  # of a step: what is left is rounding


def catches(scene: Scene) -> bool:
    """Whether ropes are all that switches or gives way in the scene."""
    dry = any(joint.dry_friction for joint in scene.joints.values())
    soft = scene.contacts or scene.constraints or dry
    soft = soft or any(scene.one_sided()) or any(scene.stops())
    return any(scene.ropes()) and not soft and not spanning_tree(scene).loops


@dataclass
class Catching:
    """The ropes, and which of them [bool] are taut."""

    scene: Scene
    model: mujoco.MjModel
    data: mujoco.MjData
    taut: Any = field(init=False)

    def __post_init__(self) -> None:
        ropes = list(self.scene.ropes())
        numbers = [self.model.tendon(rope.name).id for rope in ropes]
        self._tendons = Tendons(self.model, self.data, numbers)
        self._most = np.array([rope.length for rope in ropes])
        self._kept = np.empty(mujoco.mj_stateSize(self.model, _STATE))
        self.recall((self._over() > -NEAR * self._most) & (self._rates() > -NEAR * self._most))

    def remember(self) -> Any:
        """Which are taut."""
        return self.taut.copy()

    def recall(self, taut: Any) -> None:
        """What `remember` gave: limits hold what is taut."""
        self.taut = taut.copy()
        self.model.tendon_limited[self._tendons.numbers] = self.taut

    def step(self, step: float) -> None:
        """One step [s], in as many parts as ropes come taut in it."""
        left = step
        while left > _SHORTEST * step:
            mujoco.mj_getState(self.model, self.data, self._kept, _STATE)
            over = self._after(left)
            crossed = np.flatnonzero((over > 0.0) & ~self.taut)
            if not len(crossed):
                self.recall(self.taut & (over >= 0.0))
                break
            found = {int(k): self._root(int(k), left) for k in crossed}
            first = min(found, key=found.__getitem__)
            self._again(found[first])
            self._catch(first)
            left -= found[first]
        self.model.opt.timestep = step

    def _catch(self, first: int) -> None:
        """(2.60) over the instant: no rope that pulls in it keeps a velocity along it."""
        mujoco.mj_forward(self.model, self.data)
        rows, v = self._tendons.rows(), self.data.qvel.copy()
        pulls, lets_go = [first], []
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
        self.taut[first] = True
        self.recall(self.taut)
        lengthen(self._tendons, np.flatnonzero(self.taut))

    def _root(self, k: int, longest: float) -> float:
        """When rope k is as long as it is, from the state that is kept [s]."""

        def over(length: float) -> float:
            return float(self._again(length)[k]) if length else -NEAR * float(self._most[k])

        return float(brentq(over, 0.0, longest, xtol=_ROOT))

    def _again(self, length: float) -> Array:
        mujoco.mj_setState(self.model, self.data, self._kept, _STATE)
        return self._after(length)

    def _after(self, length: float) -> Array:
        self.model.opt.timestep = length
        mujoco.mj_step(self.model, self.data)
        return self._over()

    def _over(self) -> Array:
        """How much too long [m] each is."""
        return self._tendons.lengths - self._most

    def _rates(self) -> Array:
        return self._tendons.rows() @ self.data.qvel
