"""Friction that changes during a step, at every RK4 stage of the driver's: (2.90), and (2.87) of a
contact whose normal force changes."""

from collections.abc import Callable, Sequence

import mujoco

from .friction import Slide
from .signal import Control, bound
from .smooth import alone
from .touch import Touch


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
