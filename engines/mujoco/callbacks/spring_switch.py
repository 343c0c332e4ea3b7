"""Springs of one side by a driver: a step is cut where one begins or ends to act.

So no step crosses the corner of a force, and RK4 keeps its order.
"""

from collections.abc import Mapping

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.trajectory import Array
from ..model.tree import dry_joints
from .cut import Cut, Height
from .rope_limit import Tendons

_NEAR = 1e-9  # m: a spring that starts so near its rest length is told by its first step


def has_corners(scene: Scene) -> bool:
    """Whether springs of one side are all that switches or gives way in the scene."""
    gives = scene.pressed or scene.constraints or dry_joints(scene) or any(scene.limits())
    return any(scene.one_sided()) and not gives


class Corners(Cut[int]):
    """The springs, and on which side [sign] of its rest length each is."""

    def __init__(self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        super().__init__(model, data)
        springs = list(scene.one_sided())
        numbers = [model.tendon(spring.name).id for spring in springs]
        self._tendons = Tendons(model, data, numbers)
        self._rests = np.array([spring.rest_length for spring in springs])
        over = self._over()
        self.sides = np.where(np.abs(over) > _NEAR, np.sign(over), 0.0)

    def _happens(self) -> Mapping[int, Height]:
        """Springs that came to the other side."""
        crossed = np.flatnonzero(self._over() * self.sides < 0.0).tolist()
        return {k: lambda k=k: float(self._over()[k]) for k in crossed}

    def _change(self, key: int) -> None:
        self.sides[key] = -self.sides[key]

    def _uncut(self) -> None:
        """A spring that began at its rest length is told by where it went."""
        self.sides = np.where(self.sides, self.sides, np.sign(self._over()))

    def _over(self) -> Array:
        """λ − λ₀ [m] of each."""
        return self._tendons.lengths - self._rests
