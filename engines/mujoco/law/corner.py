"""Springs of one side by a driver: a step is cut where one begins or ends to act.

So no step crosses the corner of a force, and RK4 keeps its order.
"""

from dataclasses import dataclass, field

import mujoco
import numpy as np
from scipy.optimize import brentq

from ....cases.scene import Scene
from ....cases.trajectory import Array

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_NEAR = 1e-9  # m: a spring that starts so near its rest length is told by its first step
_ROOT = 4e-16  # s: as well as a time is known
_SHORTEST = 1e-12  # of a step: what is left is rounding


def has_corners(scene: Scene) -> bool:
    """Whether springs of one side are all that switches in the scene."""
    dry = any(joint.dry_friction for joint in scene.joints.values())
    return any(scene.one_sided()) and not (scene.pressed or scene.constraints or dry)


@dataclass
class Corners:
    """The springs, and on which side [sign] of its rest length each is."""

    scene: Scene
    model: mujoco.MjModel
    data: mujoco.MjData
    sides: Array = field(init=False)

    def __post_init__(self) -> None:
        springs = list(self.scene.one_sided())
        self._tendons = [self.model.tendon(spring.name).id for spring in springs]
        self._rests = np.array([spring.rest_length for spring in springs])
        self._kept = np.empty(mujoco.mj_stateSize(self.model, _STATE))
        over = self._over()
        self.sides = np.where(np.abs(over) > _NEAR, np.sign(over), 0.0)

    def step(self, step: float) -> None:
        """One step [s], in as many parts as there are corners in it."""
        left = step
        while left > _SHORTEST * step:
            mujoco.mj_getState(self.model, self.data, self._kept, _STATE)
            over = self._after(left)
            crossed = np.flatnonzero(over * self.sides < 0.0)
            if not len(crossed):
                self.sides = np.where(self.sides, self.sides, np.sign(over))
                break
            found = {k: self._root(int(k), left) for k in crossed}
            first = min(found, key=found.__getitem__)
            self._again(found[first])
            self.sides[first] = -self.sides[first]
            left -= found[first]
        self.model.opt.timestep = step

    def _root(self, k: int, longest: float) -> float:
        """When spring k is at its rest length, from the state that is kept [s]."""

        def over(length: float) -> float:
            return float(self._again(length)[k]) if length else self.sides[k] * _NEAR

        return float(brentq(over, 0.0, longest, xtol=_ROOT))

    def _again(self, length: float) -> Array:
        mujoco.mj_setState(self.model, self.data, self._kept, _STATE)
        return self._after(length)

    def _after(self, length: float) -> Array:
        self.model.opt.timestep = length
        mujoco.mj_step(self.model, self.data)
        return self._over()

    def _over(self) -> Array:
        """λ − λ₀ [m] of each; a step leaves the lengths of its beginning."""
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_tendon(self.model, self.data)
        return self.data.ten_length[self._tendons] - self._rests
