"""Sines as controls of their actuators, set by MuJoCo's callback at every RK4 stage.

A control set between steps would be held during the step: first order, without a warning.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager

import mujoco

from ....cases.scene import Scene, Signal
from ..force import signals as laws

Control = Callable[[mujoco.MjModel, mujoco.MjData], None]


def signals(scene: Scene, others: Sequence[Control] = ()) -> AbstractContextManager[None]:
    """The scene's sines, and what else needs them set, while they are wanted."""
    return together([swinging(laws(scene)), *others])


def together(wanted: Sequence[Control | None]) -> AbstractContextManager[None]:
    """All of them, one after the other, as the one callback that there is."""
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


def swinging(laws: Sequence[Signal]) -> Control | None:
    """What sets the controls of those of the actuators whose laws are sines, in their order."""
    sines = [
        (i, law.angular_frequency, law.phase) for i, law in enumerate(laws) if law.law == "sine"
    ]

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        controls = data.ctrl

        def control() -> None:
            t = data.time
            for i, frequency, phase in sines:
                controls[i] = math.sin(frequency * t + phase)

        return control

    return bound(bind) if sines else None
