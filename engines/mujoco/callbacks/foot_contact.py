"""Feet that stand one after the other: what stands is pinned, and a step is cut at a strike.

MuJoCo's floor is soft: it spreads a strike over several steps, an error of first order that every
further step of a gait multiplies. So a foot stands on a `connect` to where it came down, and the
strike is one impulse, from MuJoCo's own mass matrix and Jacobian.
"""

import mujoco
import numpy as np

from ....cases.scene import Anchor, Scene
from ...foot_contact import Stride, stride, strode

Standing = dict[str, tuple[float, ...] | None]
"""By foot where it stands [m], or None."""

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_ROOT = 4e-16  # s: as well as a time is known
_SHORTEST = 1e-12  # of a step: what is left is rounding


class Feet:
    """The feet of a scene in a model, which of them stand, and steps that are cut at a strike."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, stride: Stride, standing: Standing
    ) -> None:
        self.model, self.data = model, data
        self.stride, self.standing = stride, standing
        self._begun = np.empty(mujoco.mj_stateSize(model, _STATE))
        self._equalities = {name: model.eq(name).id for name in stride.feet}
        self._sites = {name: model.site(name).id for name in stride.feet}
        ends = {end for foot in stride.feet.values() for end in (foot.at, foot.ahead_of) if end}
        self._places = {end: data.site_xpos[model.site(str(end)).id] for end in ends}

    def step(self, step: float) -> None:
        """Take one step [s], in as many parts as feet strike in it."""
        rest = step
        while rest > _SHORTEST * step:
            mujoco.mj_kinematics(self.model, self.data)
            self.stride.look(self._place)
            above = {
                name: height for name in self._swinging() if (height := self._height(name)) > 0.0
            }
            mujoco.mj_getState(self.model, self.data, self._begun, _STATE)
            self._take(rest)
            down = [name for name in above if self._height(name) <= 0.0]
            if not down:
                break
            lengths = {name: self._until_down(name, above[name], rest) for name in down}
            first = min(lengths, key=lengths.__getitem__)
            self._again(lengths[first])
            self._strike(first)
            rest -= lengths[first]
        self.model.opt.timestep = step

    def remember(self) -> Standing:
        """A copy of which feet stand, by which a reading restores this state."""
        return dict(self.standing)

    def recall(self, noted: Standing) -> None:
        """The feet as they stood."""
        self.standing = dict(noted)
        for name, place in noted.items():
            self.data.eq_active[self._equalities[name]] = place is not None
            if place is not None:
                self.model.site_pos[self._sites[name]] = place

    def _take(self, length: float) -> None:
        self.model.opt.timestep = length
        mujoco.mj_step(self.model, self.data)
        mujoco.mj_kinematics(self.model, self.data)  # a step leaves places as they were

    def _again(self, length: float) -> None:
        mujoco.mj_setState(self.model, self.data, self._begun, _STATE)
        self._take(length)

    def _until_down(self, name: str, above: float, longest: float) -> float:
        """The shortest part [s] of a step at whose end the foot, now `above` [m], is below."""
        from scipy.optimize import brentq

        def after(length: float) -> float:
            self._again(length)
            return self._height(name)

        if not after(longest):
            return longest
        root = brentq(lambda t: after(t) if t else above, 0.0, longest, xtol=_ROOT)
        beyond = _ROOT
        while root < longest and after(root) >= 0.0:
            root, beyond = min(root + beyond, longest), 2 * beyond
        return root

    def _swinging(self) -> list[str]:
        """The feet that the floor meets, and that do not stand on it."""
        meets = self.stride.meets.items()
        return [name for name, met in meets if met and self.standing[name] is None]

    def _place(self, at: Anchor) -> tuple[float, float]:
        place = self._places[at]
        return place.item(0), place.item(1)

    def _height(self, name: str) -> float:
        return self._place(self.stride.feet[name].at)[1]

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


def feet(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> Feet:
    """The feet of a scene that has some, at the start of the data: MJCF says which stand."""
    standing = [name for name in strode(scene) if data.eq_active[model.eq(name).id]]
    begun = stride(scene, standing)
    assert begun is not None
    for name in begun.feet:  # a site in its body's origin would stay there: MuJoCo compiles it in
        model.site_sameframe[model.site(name).id] = mujoco.mjtSameFrame.mjSAMEFRAME_NONE
    places = {
        name: tuple(model.site(name).pos.tolist()) if name in standing else None
        for name in begun.feet
    }
    return Feet(model, data, begun, places)
