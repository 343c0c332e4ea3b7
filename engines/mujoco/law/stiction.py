"""Dry friction as a law: MuJoCo's `frictionloss`, set before every step by (2.89)."""

import mujoco

from .friction import Slide


def bounded(slide: Slide) -> None:
    """Set the friction of the step to come by (2.89), averaged over a step that breaks loose."""
    model, data = slide.model, slide.data
    mujoco.mj_forward(model, data)
    now, mass = slide.applied()
    soon = now if slide.before is None else 2 * now - slide.before  # at the end of the step
    slide.before = now
    if slide.sense and slide.sense * slide.speed <= 0:
        slide.sense = 0
    if not slide.sense:
        slide.sense = slide.starts(now) or slide.starts(soon)
        model.dof_frictionloss[slide.dof] = (
            _breaking_loose(slide, now, soon) if slide.sense else slide.holds
        )
        return
    brakes = slide.brakes(slide.sense)
    model.dof_frictionloss[slide.dof] = brakes
    gained = model.opt.timestep * ((now + soon) / 2 - slide.sense * brakes) / mass
    if slide.sense * (slide.speed + gained) <= 0:
        slide.sense = 0  # it comes to rest in this step


def _breaking_loose(slide: Slide, now: float, soon: float) -> float:
    """A constant bound [N] with the impulse of holding first and braking then."""
    now, soon = slide.sense * now, slide.sense * soon
    static = slide.friction.static
    limit = static.forward if slide.sense > 0 else static.backward
    brakes = slide.brakes(slide.sense)
    if now >= limit:
        return brakes
    slipping = (soon - limit) / (soon - now)  # the part of the step
    return (now + soon) / 2 - slipping * ((limit + soon) / 2 - brakes)
