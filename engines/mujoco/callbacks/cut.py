"""Steps of MuJoCo's that are cut where something happens in them: at a corner, a catch, a strike.

So no step crosses what its integrator does not know, and it keeps its order.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import Generic, TypeVar

import mujoco
import numpy as np

Height = Callable[[], float]
"""What changes its sign where something happens; the step before it left places behind."""
Key = TypeVar("Key", int, str)

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_ROOT = 4e-16  # s: as well as a time is known
_SHORTEST = 1e-12  # of a step: what is left is rounding


class Cut(ABC, Generic[Key]):
    """Steps of a model with its data."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self.model, self.data = model, data
        self._kept = np.empty(mujoco.mj_stateSize(model, _STATE))

    def step(self, step: float) -> None:
        """One step [s], in as many parts as something happens in it."""
        left = step
        while left > _SHORTEST * step:
            self._begin()
            mujoco.mj_getState(self.model, self.data, self._kept, _STATE)
            self._take(left)
            happens = self._happens()
            if not happens:
                self._uncut()
                break
            found = {key: self._just_over(height, left) for key, height in happens.items()}
            first = min(found, key=found.__getitem__)
            self._again(found[first])
            self._change(first)
            left -= found[first]
        self.model.opt.timestep = step

    def _just_over(self, height: Height, longest: float) -> float:
        """The shortest part [s] of those from the kept state that end with the height's new sign.

        As the part begins the sign is the other; but what has only just begun is zero there, or by
        rounding on either side of it, so the sign is not asked for.
        """
        from scipy.optimize import brentq

        def after(length: float) -> float:
            self._again(length)
            return height()

        ends = after(longest)
        if not ends:
            return longest
        root = brentq(lambda length: after(length) if length else -ends, 0.0, longest, xtol=_ROOT)
        beyond = _ROOT
        while root < longest and after(root) * ends <= 0.0:
            root, beyond = min(root + beyond, longest), 2 * beyond
        return root

    def _again(self, length: float) -> None:
        mujoco.mj_setState(self.model, self.data, self._kept, _STATE)
        self._take(length)

    def _take(self, length: float) -> None:
        self.model.opt.timestep = length
        mujoco.mj_step(self.model, self.data)

    def _begin(self) -> None:
        """Store what has to be known before a part of the step is taken."""

    @abstractmethod
    def _happens(self) -> Mapping[Key, Height]:
        """By key, the height of each event in the part just taken."""

    @abstractmethod
    def _change(self, key: Key) -> None:
        """Set the model and its data to what holds from the event `key` on."""

    def _uncut(self) -> None:
        """Update what is known after a part in which nothing happens."""
