"""Feet that stand one after the other: what stands is pinned, and a step is cut at a strike.

MuJoCo's floor is soft: it spreads a strike over several steps, an error of first order that every
further step of a gait multiplies. So a foot stands on a `connect` to where it came down, and the
strike is one impulse, from MuJoCo's own mass matrix and Jacobian.
"""

from dataclasses import dataclass, field

import mujoco
import numpy as np
from scipy.optimize import brentq

from ....cases.scene import Anchor, Scene
from ....cases.trajectory import Array
from ...stride import Stride, stride, strode

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_ROOT = 4e-16  # s: as well as a time is known
_SHORTEST = 1e-12  # of a step: what is left is rounding

Standing = dict[str, tuple[float, ...] | None]
"""By foot where it stands [m], or None."""


@dataclass
class Feet:
    """The feet of a scene in a model, and which of them stand."""

    model: mujoco.MjModel
    data: mujoco.MjData
    stride: Stride
    standing: Standing
    kept: Array = field(init=False)

    def __post_init__(self) -> None:
        self.kept = np.empty(mujoco.mj_stateSize(self.model, _STATE))

    def step(self, step: float) -> None:
        """One step [s], in as many parts as feet strike in it."""
        left = step
        while left > _SHORTEST * step:
            self._look()
            above = {name: y for name in self._swinging() if (y := self._height(name)) > 0.0}
            mujoco.mj_getState(self.model, self.data, self.kept, _STATE)
            self._take(left)
            down = [name for name in above if self._height(name) <= 0.0]
            if not down:
                break
            found = {name: self._root(name, above[name], left) for name in down}
            first = min(found, key=found.__getitem__)
            self._again(found[first])
            self._strike(first)
            left -= found[first]
        self.model.opt.timestep = step

    def remember(self) -> Standing:
        """What a reading of this state needs."""
        return dict(self.standing)

    def recall(self, noted: Standing) -> None:
        """The feet as they stood."""
        self.standing = dict(noted)
        for name, place in noted.items():
            self.data.eq_active[self.model.eq(name).id] = place is not None
            if place is not None:
                self.model.site_pos[self.model.site(name).id] = place

    def _look(self) -> None:
        mujoco.mj_kinematics(self.model, self.data)
        self.stride.look(self._place)

    def _swinging(self) -> list[str]:
        """The feet that the floor meets, and that do not stand on it."""
        return [name for name, meets in self.stride.meets.items() if meets and not self._on(name)]

    def _on(self, name: str) -> bool:
        return self.standing[name] is not None

    def _place(self, at: Anchor) -> tuple[float, float]:
        x, y, _ = self.data.site(str(at)).xpos
        return float(x), float(y)

    def _height(self, name: str) -> float:
        return self._place(self.stride.feet[name].at)[1]

    def _take(self, length: float) -> None:
        self.model.opt.timestep = length
        mujoco.mj_step(self.model, self.data)
        mujoco.mj_kinematics(self.model, self.data)

    def _again(self, length: float) -> None:
        mujoco.mj_setState(self.model, self.data, self.kept, _STATE)
        self._take(length)

    def _root(self, name: str, above: float, longest: float) -> float:
        """When the foot, now so high [m], is down, from the state that is kept [s]."""

        def height(length: float) -> float:
            if not length:
                return above
            self._again(length)
            return self._height(name)

        return float(brentq(height, 0.0, longest, xtol=_ROOT))

    def _strike(self, name: str) -> None:
        """The foot stands where it is, and the one behind is let go."""
        foot = self.stride.feet[name]
        behind = next(n for n, other in self.stride.feet.items() if other.at == foot.ahead_of)
        place = (*self._place(foot.at), 0.0)
        self.stride.meets = {**self.stride.meets, name: True, behind: False}
        self.recall({**self.standing, name: place, behind: None})
        stop(self.model, self.data)


def stop(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """The plastic impact with what holds from now on: M Δv = Jᵀ Λ, J (v + Δv) = 0.

    J is MuJoCo's own, of all equalities that are active: loops stay closed. In the plane one row of
    each `connect` is empty, so J M⁻¹ Jᵀ has no inverse but a pseudoinverse.
    """
    mujoco.mj_forward(model, data)
    rows = data.efc_J.reshape(-1, model.nv)[: data.ne]
    moved = np.zeros_like(rows)
    mujoco.mj_solveM(model, data, moved, np.ascontiguousarray(rows))
    data.qvel[:] -= moved.T @ (np.linalg.pinv(rows @ moved.T) @ data.efc_vel[: data.ne])
    data.qacc_warmstart[:] = 0.0  # of another set of constraints


def feet(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> Feet | None:
    """At the start of the data, where MJCF says which stand."""
    standing = [name for name in strode(scene) if data.eq_active[model.eq(name).id]]
    begun = stride(scene, standing)
    if begun is None:
        return None
    for name in begun.feet:  # a site in its body's origin would stay there: MuJoCo compiles it in
        model.site_sameframe[model.site(name).id] = mujoco.mjtSameFrame.mjSAMEFRAME_NONE
    places = {
        name: tuple(model.site(name).pos.tolist()) if name in standing else None
        for name in begun.feet
    }
    return Feet(model, data, begun, places)
