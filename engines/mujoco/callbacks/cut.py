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
            found = {key: self._root(*what, left) for key, what in happens.items()}
            first = min(found, key=found.__getitem__)
            self._again(found[first])
            self._change(first)
            left -= found[first]
        self.model.opt.timestep = step

    def _root(self, begins: float, height: Height, longest: float) -> float:
        """When the height is zero, from the state that is kept [s]; begins: what it was there."""
        from scipy.optimize import brentq

        def after(length: float) -> float:
            if not length:
                return begins
            self._again(length)
            return height()

        return float(brentq(after, 0.0, longest, xtol=_ROOT))

    def _again(self, length: float) -> None:
        mujoco.mj_setState(self.model, self.data, self._kept, _STATE)
        self._take(length)

    def _take(self, length: float) -> None:
        self.model.opt.timestep = length
        mujoco.mj_step(self.model, self.data)

    def _begin(self) -> None:
        """Store what has to be known before a part of the step is taken."""

    @abstractmethod
    def _happens(self) -> Mapping[Key, tuple[float, Height]]:
        """By key, each event in the part just taken: its height at the beginning, and now."""

    @abstractmethod
    def _change(self, key: Key) -> None:
        """Set the model and its data to what holds from the event `key` on."""

    def _uncut(self) -> None:
        """Update what is known after a part in which nothing happens."""
