"""Dry friction by a driver: a step is repeated until its end falls on the event.

So every step is smooth: what sticks is held, what slides is pushed by a constant force.
"""

from collections.abc import Sequence

import mujoco
import numpy as np

from ....cases.trajectory import Array
from .friction import Slide
from .touch import Touch


def room(model: mujoco.MjModel) -> Array:
    """For the state before a step, which is taken again where an event lies in it."""
    return np.empty(mujoco.mj_stateSize(model, _STATE))


def driven_step(slides: Sequence[Slide | Touch], step: float, kept: Array) -> None:
    """One step, cut at every event in it; kept: its `room`."""
    model, data = slides[0].model, slides[0].data
    left = step
    while left > _SHORTEST * step:
        for slide in slides:
            slide.engage()
        taken, over = _until_event(model, data, slides, left, kept)
        left -= taken
        for slide in slides if over else ():
            if _passed(slide) > 0:
                _switch(slide)
    model.opt.timestep = step


_SHORTEST = 1e-12  # of a step: what is left is rounding


def _passed(slide: Slide | Touch) -> float:
    """Positive when the event is over: the speed has changed its sign, the force its bound."""
    if slide.sense:
        return -slide.sense * slide.speed
    mujoco.mj_forward(slide.model, slide.data)
    applied, _ = slide.applied()
    static = slide.friction.static
    return max(applied - static.forward, -static.backward - applied)


def _until_event(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    slides: Sequence[Slide | Touch],
    longest: float,
    kept: Array,
) -> tuple[float, bool]:
    """Step to the first event, just over it, or the longest way [s]; and which of the two."""
    mujoco.mj_getState(model, data, kept, _STATE)

    def over(length: float) -> bool:
        model.opt.timestep = length
        mujoco.mj_step(model, data)
        return any(_passed(slide) > 0 for slide in slides)

    if not over(longest):
        return longest, False
    low, high = 0.0, longest
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        mujoco.mj_setState(model, data, kept, _STATE)
        low, high = (low, middle) if over(middle) else (middle, high)
    mujoco.mj_setState(model, data, kept, _STATE)
    over(high)
    return high, True


_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_HALVINGS = 45  # 3e-14 of a step


def _switch(slide: Slide | Touch) -> None:
    """What has stopped rests, or goes on the way that the force points; what broke loose slides."""
    if slide.sense:
        slide.halt()
        mujoco.mj_forward(slide.model, slide.data)
    applied, _ = slide.applied()
    slide.sense = slide.starts(applied)
