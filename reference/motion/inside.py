"""The states inside a step, between its two ends."""

import numpy as np

from ..integrators.march import Method, Step, march
from ..system import Array
from .crossing import Within


def inside(step: Step, probe: Method) -> Within:
    """Those of an accepted step, each by a step of its own, or by several."""

    def state(h: float) -> Array:
        if h == 0.0 or h == step.t_next - step.t:
            return step.y_next if h else step.y
        there = step.y + probe.attempt(step.t, step.y, h, np.maximum(np.abs(step.y), step.floor))
        if np.isfinite(there).all():
            return there
        *_, last = march(probe, (step.t, step.t + h), step.y)  # a part may be harder than the whole
        return last.y_next

    return state
