"""Laws in time as controls of their actuators, set by MuJoCo's callback at every RK4 stage.

A control set between steps would be held during the step: first order, without a warning. In a step
with a corner it is held all the same, at the law's mean: else the stages would weigh a jump by
where they happen to lie, which is of first order with any integrator.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field

import mujoco

from ....cases.scene import Scene, Signal
from ...signal import NEAR, factor, mean
from ..model.drive import controls
from ..model.force import BY_ITSELF

Control = Callable[[mujoco.MjModel, mujoco.MjData], None]
Take = Callable[[int], None]


@dataclass
class Corners:
    """The corners [s] of a run's laws, and the step [s] that has one, while that is taken."""

    laws: Sequence[Signal]
    step: float
    now: float | None = field(default=None, init=False)

    @property
    def any(self) -> bool:
        """Whether there are any."""
        return any(law.corners for law in self.laws)

    def apart(self, take: Take) -> Take:
        """A function that takes n steps, so that one with a corner is taken alone."""
        alone = sorted(set(self._touched()))
        done = 0

        def taken(n: int) -> None:
            nonlocal done
            end = done + n
            for k in [k for k in alone if done <= k < end]:
                if k > done:
                    take(k - done)
                self.now = k * self.step
                take(1)
                self.now, done = None, k + 1
            if end > done:
                take(end - done)
            done = end

        return taken if alone else take

    def _touched(self) -> Iterator[int]:
        """The numbers of the steps with a corner inside or at an end."""
        for corner in {corner for law in self.laws for corner in law.corners}:
            place = corner / self.step
            yield from range(max(0, math.ceil(place - 1 - NEAR)), math.floor(place + NEAR) + 1)


def signals(
    scene: Scene, others: Sequence[Control] = (), corners: Corners | None = None
) -> AbstractContextManager[None]:
    """The controls of the scene's laws, and what else needs them set, while they are wanted."""
    return together([following(controls(scene), corners), *others])


def together(wanted: Sequence[Control | None]) -> AbstractContextManager[None]:
    """Install all controls, called one after the other, as the one callback that there is."""
    controls = [control for control in wanted if control is not None]
    if len(controls) < 2:
        return installed(controls[0] if controls else None)

    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        for each in controls:
            each(model, data)

    return installed(control)


@contextmanager
def installed(control: Control | None) -> Iterator[None]:
    """A callback is one for the whole process, compiling included: whose it was gets it back."""
    before = mujoco.get_mjcb_control()
    mujoco.set_mjcb_control(control)
    try:
        yield
    finally:
        mujoco.set_mjcb_control(before)


@contextmanager
def listening() -> Iterator[list[str]]:
    """MuJoCo's warnings as a list.

    Without someone who listens, MuJoCo writes them to MUJOCO_LOG.TXT in the user's folder.
    """
    messages: list[str] = []
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(messages.append)
    try:
        yield messages
    finally:
        mujoco.set_mju_user_warning(before)


def bound(bind: Callable[[mujoco.MjData], Callable[[], None]]) -> Control:
    """A callback that takes MuJoCo's arrays once: to fetch one at every stage costs half a law."""
    known: mujoco.MjData | None = None
    apply: Callable[[], None] = _nothing

    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        nonlocal known, apply
        if data is not known:
            known, apply = data, bind(data)
        apply()

    return control


def _nothing() -> None:
    """Before there are data."""


def following(laws: Sequence[Signal], corners: Corners | None = None) -> Control | None:
    """A callback for the actuators' controls, in their order, that do not follow by themselves."""
    factors = [(i, law, factor(law)) for i, law in enumerate(laws) if law.law not in BY_ITSELF]

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        controls = data.ctrl

        def control() -> None:
            t, now = data.time, corners and corners.now
            for i, law, size in factors:
                if now is not None and corners and law.corners:
                    controls[i] = mean(law, corners.step)(now)
                else:
                    controls[i] = size(t)

        return control

    return bound(bind) if factors else None
