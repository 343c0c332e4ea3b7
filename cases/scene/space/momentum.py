"""Kinetic energy and momentum of a body in space, from its states (N, 13)."""

import numpy as np

from ...trajectory import Array
from ..body import Body
from ..frame import SPACE
from ..rotation import turned


def kinetic(body: Body, states: Array) -> Array:
    """(2.54) T = ½ m v² + ½ ωᵀ J ω [J] (N,), with ω and J in body axes."""
    v, omega = states[:, SPACE.velocity], states[:, SPACE.spin]
    turning = np.sum((omega @ body.tensor) * omega, axis=1)
    return 0.5 * body.mass * np.sum(v * v, axis=1) + 0.5 * turning


def momentum(body: Body, states: Array) -> dict[str, Array]:
    """(2.22) p = m v [kg m/s], (2.24) D₀ = r × m v + J ω [kg m²/s]: (N,) by axis of the ground."""
    p = body.mass * states[:, SPACE.velocity]
    own = turned(states[:, SPACE.attitude], states[:, SPACE.spin] @ body.tensor)
    D = np.cross(states[:, SPACE.place], p) + own
    return {
        **{axis: p[:, i] for i, axis in enumerate(SPACE.axes)},
        **{f"angular_{axis}": D[:, i] for i, axis in enumerate(SPACE.axes)},
    }
