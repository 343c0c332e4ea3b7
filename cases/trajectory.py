"""A motion as samples addressed by name; what a reference and an engine both answer with."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

X, Y, ANGLE, VX, VY, OMEGA = range(6)  # the columns of a body's states in the plane


@dataclass(frozen=True)
class Trajectory:
    """Samples of a motion.

    times: (N,) s. states: body → (N, 6), the columns x, y, angle, vx, vy, omega of its centre
    of mass; in space (N, 13), the columns r, unit quaternion, v and ω in body axes, as `SPACE` has
    them. reactions: quantity (`pin.fx`, `touch.normal`) → (N,), as the producer gives them: what
    acts in the state of the row itself, neither the mean over a step nor what led to it; where
    something jumps, what acts after it.
    record: every step of a motion that switches, from which event times are read. phase: in the
    reference's record, the number of the smooth piece that a row belongs to; an event stands there
    twice, as the last row of one piece and the first of the next. ended: by the number of a piece,
    in the words of the mechanism what ended it, as `touch lands`; empty where nothing with a name
    did. switches: (K,) s, when the reference changes from one smooth piece to the next; an engine
    has none to tell. blows: (K,) s, those of them at which velocities jump. endless: (K,) s, of
    each pile of events without end the times that the reference has followed; it leaves out the
    rest. near: in space, by joint (N, K), its turns [rad] as whoever made the motion counted them
    on the way: attitudes tell them but for whole turns. fastest: how fast [rad/s] the fastest of
    them goes on the way.
    """

    times: Array
    states: Mapping[str, Array]
    reactions: Mapping[str, Array]
    record: "Trajectory | None" = None
    phase: NDArray[np.int64] | None = None
    ended: tuple[str, ...] = ()
    switches: Array = field(default_factory=lambda: np.zeros(0))
    blows: Array = field(default_factory=lambda: np.zeros(0))
    endless: tuple[Array, ...] = ()
    near: Mapping[str, Array] = field(default_factory=dict)
    fastest: float = 0.0
