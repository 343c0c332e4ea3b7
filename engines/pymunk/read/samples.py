"""A run read at its samples.

Reading must cost little beside a hundred steps: pymunk copies all bodies of a sample in one
call, and what the copies mean is worked out for all samples when the run is over.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pymunk.batch import BodyFields, Buffer

from ....cases.trajectory import Array, Trajectory
from ...signal import NEAR
from ..model.chipmunk_state import copier
from ..model.world import World
from ..stepping.run import Steps
from .health import sound
from .impulse import impulses

Counts = NDArray[np.int64]  # of steps

_FIELDS = (
    BodyFields.BODY_ID
    | BodyFields.POSITION
    | BodyFields.ANGLE
    | BodyFields.VELOCITY
    | BodyFields.ANGULAR_VELOCITY
)
_BUFFER = Buffer()  # one for all runs: pymunk never frees a buffer's memory


def sampled(
    world: World,
    run: Steps,
    times: Array,
    step: float,
    numbers: Mapping[str, Any],
    *,
    reactions: tuple[str, ...],
) -> Trajectory:
    """Runs from stop to stop; a stop copies the bodies, or what the last step's impulses were.

    Raises Diverged, if the motion is none.
    """
    midpoint = bool(numbers.get("time.midpoint"))
    samples: Counts = np.rint(times / step).astype(int)
    if max(abs(times - samples * step)) > 1e-9 * max(times[-1], step):
        raise ValueError(f"pymunk: the samples are no whole multiples of the step {step:g} s")
    corners = np.array(world.scene.corners()) / step
    stops, weights = _weights(samples, midpoint, corners)
    known, wanted = set(samples.tolist()), set(stops.ravel().tolist() if reactions else ())
    kept: list[list[float]] = []
    read, copy = impulses(world, reactions), copier(world.space, _FIELDS, _BUFFER)
    _BUFFER.clear()
    now = 0
    for stop in sorted(known | wanted):
        run(stop - now)
        now = stop
        if stop in known:
            copy()  # behind the earlier samples
        if stop in wanted:
            kept.append(read())
    rows = _states(world, times)
    ahead = step / 2 if midpoint else 0.0
    sound(world, rows, times - ahead, step)
    rows[:, :, :3] += ahead * rows[:, :, 3:]
    forces = np.reshape(kept, (len(wanted), len(reactions)))
    places = np.searchsorted(sorted(wanted), stops) if reactions else stops
    return Trajectory(
        times,
        {name: rows[:, i] for i, name in enumerate(world.bodies)},
        {
            name: np.sum(weights * forces[places, i], axis=1) / step
            for i, name in enumerate(reactions)
        },
    )


def _weights(samples: Counts, midpoint: bool, corners: Array) -> tuple[Counts, Array]:
    """Which steps' impulses give the force at each sample, and with what weights: (N, ·) each.

    The impulse of step n acts over its middle tₙ − h/2. Unless `midpoint`, it is read as what a
    user sees after the step. The first two steps settle the joints' gaps (5/8 and 11/8 of the
    force that holds a curved path), so the force at the start is extrapolated from the next two.

    corners: of the laws in time, in steps. What led to a sample on one is not what acts after it,
    and no step over one is a force at a sample beside it.
    """
    ahead = corners[None, :] - samples[:, None]
    if not midpoint:
        on = np.any(np.abs(ahead) < NEAR, axis=1)
        return np.maximum(samples + on, 1)[:, None], np.ones((len(samples), 1))
    before = np.any((ahead > NEAR - 1) & (ahead < NEAR), axis=1)
    after = np.any((ahead > NEAR) & (ahead < 1 - NEAR), axis=1) & ~before & (samples > 1)
    stops = np.column_stack([samples, samples + 1])
    weights = np.full(stops.shape, 0.5)
    for side, steps in ((before, (1, 2)), (after, (0, -1))):
        stops[side], weights[side] = samples[side, None] + steps, (1.5, -0.5)  # at h/2 and 3/2 h
    stops[samples == 0], weights[samples == 0] = (3, 4), (3.5, -2.5)  # at 5/2 h and 7/2 h
    return stops, weights


def _states(world: World, times: Array) -> Array:
    """(N, bodies, 6): x, y, angle, vx, vy, omega, as pymunk had them."""
    ids = np.frombuffer(_BUFFER.int_buf(), np.uintp).reshape(len(times), -1)[0].tolist()
    rows = np.frombuffer(_BUFFER.float_buf()).reshape(len(times), len(ids), 6)
    return rows[:, [ids.index(body.id) for body in world.bodies.values()]]  # a copy
