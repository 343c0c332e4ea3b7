"""Dry friction by a driver: a step is cut where something stops or breaks loose.

So every step is smooth: what sticks is held, what slides is pushed by a constant force.
"""

from collections.abc import Callable, Mapping

import mujoco

from .contact_friction import Touch
from .cut import Cut, Height
from .friction import Slide
from .signal import Control, bound
from .smooth import alone


class Rubbing(Cut[int]):
    """One slide or contact with dry friction: held while it sticks, pushed while it slides."""

    def __init__(self, slide: Slide | Touch) -> None:
        super().__init__(slide.model, slide.data)
        self._slide = slide

    def _begin(self) -> None:
        if isinstance(self._slide, Touch):
            self._slide.look()
        self._slide.engage()

    def _happens(self) -> Mapping[int, Height]:
        """The stop of a slide, or its start."""
        return {self._slide.sense: self._passed} if self._passed() > 0.0 else {}

    def _passed(self) -> float:
        """Positive when the event is over: the speed has changed its sign, the force its bound."""
        slide = self._slide
        if slide.sense:
            return -slide.sense * slide.speed
        mujoco.mj_forward(self.model, self.data)
        applied, _ = slide.applied()
        static = slide.friction.static
        return max(applied - static.forward, -static.backward - applied)

    def _change(self, key: int) -> None:
        """Set the sense after the event: 0, or the way that the force points."""
        if key:
            self._slide.halt()
        mujoco.mj_forward(self.model, self.data)
        applied, _ = self._slide.applied()
        self._slide.sense = self._slide.starts(applied)


# Friction that changes during a step, at every RK4 stage of the driver's: (2.90), and (2.87) of a
# contact whose normal force changes.


def falling(slide: Slide | Touch) -> list[Control]:
    """A callback, unless the friction is the same all step long."""
    if isinstance(slide, Touch):
        return [_pressed(slide)]
    return [] if slide.steady else [_falling(slide)]


def _falling(slide: Slide) -> Control:
    """By the speed."""

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        def control() -> None:
            if slide.sense:
                slide.engage()

        return control

    return bound(bind)


def _pressed(touch: Touch) -> Control:
    """By the normal force: it carries all else that acts on a body, as long as that touches."""
    up = int(touch.model.joint(f"{touch.contact.body}.y").dofadr[0])

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        acting = alone(touch.model, data, up)

        def control() -> None:
            if touch.sense:
                touch.carried(max(0.0, -acting()) if data.ncon else 0.0)
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
