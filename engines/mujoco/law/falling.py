"""Friction that falls with the speed (2.90), at every RK4 stage of the driver's steps."""

from collections.abc import Callable, Sequence

import mujoco

from .friction import Slide
from .signal import Control, bound
from .touch import Touch


def falling(slides: Sequence[Slide | Touch]) -> list[Control]:
    """A callback for each joint whose friction is not the same all step long."""
    return [_falling(slide) for slide in slides if isinstance(slide, Slide) and not slide.steady]


def _falling(slide: Slide) -> Control:
    def bind(data: mujoco.MjData) -> Callable[[], None]:
        def control() -> None:
            if slide.sense:
                slide.engage()

        return control

    return bound(bind)
