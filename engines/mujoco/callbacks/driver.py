"""Dry friction by a driver: a step is repeated until its end falls on the event.

So every step is smooth: what sticks is held, what slides is pushed by a constant force.
"""

from collections.abc import Callable, Sequence

import mujoco
import numpy as np

from ....cases.trajectory import Array
from .contact_friction import Touch
from .friction import Slide
from .signal import Control, bound
from .smooth import alone


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
    """Set the sense of a slide after an event: 0, or the way that the force points.

    What has stopped rests, or goes on the way that the force points; what broke loose slides.
    """
    if slide.sense:
        slide.halt()
        mujoco.mj_forward(slide.model, slide.data)
    applied, _ = slide.applied()
    slide.sense = slide.starts(applied)


# Friction that changes during a step, at every RK4 stage of the driver's: (2.90), and (2.87) of a
# contact whose normal force changes.


def falling(slides: Sequence[Slide | Touch]) -> list[Control]:
    """A callback for each whose friction is not the same all step long."""
    found = []
    for slide in slides:
        if isinstance(slide, Touch):
            found.append(_pressed(slide))
        elif not slide.steady:
            found.append(_falling(slide))
    return found


def _falling(slide: Slide) -> Control:
    """By the speed."""

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        def control() -> None:
            if slide.sense:
                slide.engage()

        return control

    return bound(bind)


def _pressed(touch: Touch) -> Control:
    """By the normal force, which carries all else that acts on a body that only touches."""
    up = int(touch.model.joint(f"{touch.contact.body}.y").dofadr[0])

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        acting = alone(touch.model, data, up)

        def control() -> None:
            if touch.sense:
                touch.carried(-acting())
                touch.engage()

        return control

    return bound(bind)


# Dry friction as a law: the force of (2.89), set before every step to its mean over the step.
#
# What slides is pushed; what sticks is held by MuJoCo's `frictionloss`. Pushing matters near a
# reversal: `frictionloss` aims at v = 0, so it would push the other way before the speed is zero.


_FAR = 6  # steps to a stop: until then the force is the same all step long, whatever comes next


def bounded(slide: Slide | Touch) -> None:
    """Set the friction of the step to come by (2.89)."""
    speed = slide.speed
    gained, slide.last = speed - slide.last, speed
    if slide.steady and slide.sense and slide.sense * speed > _FAR * abs(gained) > 0:
        slide.push(-slide.sense * slide.brakes(slide.sense, speed))
        slide.before = None
        return
    mujoco.mj_forward(slide.model, slide.data)
    now, mass = slide.applied()
    soon = now if slide.before is None else 2 * now - slide.before  # at the end of the step
    slide.before = now
    if slide.sense and slide.sense * speed <= 0:
        slide.sense = 0
    if slide.sense:
        _sliding(slide, now, soon, mass)
        return
    soon += slide.weakens if now > 0 else -slide.weakens  # as if the bound stayed
    if sense := slide.starts(now) or slide.starts(soon):
        slide.sense = sense
        slide.push(-sense * _breaking_loose(slide, now, soon))
    else:
        slide.hold()


def _sliding(slide: Slide | Touch, now: float, soon: float, mass: float) -> None:
    """Brakes; if it stops within the step, it then rests or goes on the other way."""
    model, before = slide.model, slide.sense
    h, mean = model.opt.timestep, (now + soon) / 2
    brakes, gained = _braking(slide, mean, h / mass)
    if before * (slide.speed + gained) > 0:
        slide.push(brakes)
        return
    part = -slide.speed / gained  # of the step, until it stops
    slide.sense = slide.starts(now + part * (soon - now))
    if slide.sense:
        after = -slide.sense * slide.brakes(slide.sense, 0.0)
        slide.push(part * brakes + (1 - part) * after)
    else:
        slide.push(-mean - slide.speed * mass / h)


def _braking(slide: Slide | Touch, applied: float, inverse: float) -> tuple[float, float]:
    """Friction [N] and what it leaves of the speed [m/s] gained in a step; inverse: of m/h.

    What changes with the speed is taken in the middle of the motion, once that is known.
    """
    speed, sense = slide.speed, slide.sense
    brakes = -sense * slide.brakes(sense, speed)
    gained = inverse * (applied + brakes)
    if not slide.steady:
        after = sense * max(0.0, sense * (speed + gained))
        brakes = -sense * slide.brakes(sense, (speed + after) / 2)
        gained = inverse * (applied + brakes)
    return brakes, gained


def _breaking_loose(slide: Slide | Touch, now: float, soon: float) -> float:
    """A constant force [N] with the impulse of holding first and braking then."""
    now, soon = slide.sense * now, slide.sense * soon
    static = slide.friction.static
    limit = static.forward if slide.sense > 0 else static.backward
    brakes = slide.brakes(slide.sense, 0.0)
    if now >= limit:
        return brakes
    slipping = (soon - limit) / (soon - now)  # the part of the step
    return (now + soon) / 2 - slipping * ((limit + soon) / 2 - brakes)
