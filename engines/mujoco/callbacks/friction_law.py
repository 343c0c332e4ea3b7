"""Dry friction as a law: the force of (2.89), set before every step to its mean over the step.

What slides is pushed; what sticks is held by MuJoCo's `frictionloss`. Pushing matters near a
reversal: `frictionloss` aims at v = 0, so it would push the other way before the speed is zero.
"""

import mujoco

from .contact_friction import Touch
from .friction import Slide, starts

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
    if isinstance(slide, Touch):
        slide.look()
    now, mass = slide.applied()
    soon = now if slide.before is None else 2 * now - slide.before  # at the end of the step
    slide.before = now
    if slide.sense and slide.sense * speed <= 0:
        slide.sense = 0
    if slide.sense:
        _sliding(slide, now, soon, mass)
        return
    soon += slide.weakens if now > 0 else -slide.weakens  # as if the bound stayed
    if sense := starts(slide.friction, now) or starts(slide.friction, soon):
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
    slide.sense = starts(slide.friction, now + part * (soon - now))
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
