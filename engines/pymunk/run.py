"""Stepping pymunk and reading it at the samples.

Midpoint protocol: pymunk moves bodies by h v first and then changes v. Every body is started
h/2 back along its velocity, so that the engine's positions belong to tₙ − h/2 when its
velocities belong to tₙ; positions are read h/2 ahead. Forces at positions then act at the
middle of a step, which makes the method time-symmetric, and of second order.

Reading must cost little beside a hundred steps: pymunk copies all bodies of a sample in one
call, and what the copies mean is worked out for all samples when the run is over.
"""

from collections.abc import Callable, Mapping
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pymunk.arbiter import Arbiter
from pymunk.batch import BodyFields, Buffer, get_space_bodies
from pymunk.body import Body

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Diverged, Realised, Start
from .contact import closed, sink
from .law.force import forces
from .scene import FAR, build
from .world import World

Steps = Callable[[int], None]
Counts = NDArray[np.int64]  # of steps

_FIELDS = (
    BodyFields.BODY_ID
    | BodyFields.POSITION
    | BodyFields.ANGLE
    | BodyFields.VELOCITY
    | BodyFields.ANGULAR_VELOCITY
)
_BUFFER = Buffer()  # one for all runs: pymunk never frees a buffer's memory


def placed(
    scene: Scene, start: Start, step: float, numbers: Mapping[str, Any], realised: Realised
) -> World:
    """The world where a setting starts it: wheels seeded, bodies half a step back."""
    world = build(scene, start, numbers, realised)
    for contact in closed(scene, start):
        sink(scene.bodies[contact.body], world.wheels[contact.name], numbers.get("start.seed", 0.0))
    if numbers.get("time.midpoint"):
        for body in (*world.bodies.values(), *world.driven.values()):
            body.position -= step / 2 * body.velocity
            body.angle -= step / 2 * body.angular_velocity
    return world


def stepper(world: World, step: float, numbers: Mapping[str, Any], realised: Realised) -> Steps:
    """A function that runs n steps, with the forces pymunk has to be told before each."""
    one = world.space.step
    applied = forces(
        world, step, midpoint=bool(numbers.get("time.midpoint")), law=realised == "law"
    )
    done = 0

    def free(n: int) -> None:
        for _ in repeat(None, n):
            one(step)

    def forced(n: int) -> None:
        nonlocal done
        for i in range(done, done + n):
            t = i * step
            for apply in applied:
                apply(t)
            one(step)
        done += n

    return forced if applied else free


def simulate(
    world: World,
    run: Steps,
    times: Array,
    step: float,
    *,
    reactions: tuple[str, ...],
    midpoint: bool,
) -> Trajectory:
    """Runs from stop to stop; a stop copies the bodies, or what the last step's impulses were."""
    samples: Counts = np.rint(times / step).astype(int)
    if max(abs(times - samples * step)) > 1e-9 * max(times[-1], step):
        raise ValueError(f"pymunk: the samples are no whole multiples of the step {step:g} s")
    stops, weights = _weights(samples, midpoint)
    known, wanted = set(samples.tolist()), set(stops.ravel().tolist() if reactions else ())
    impulses: list[list[float]] = []
    _BUFFER.clear()
    now = 0
    for stop in sorted(known | wanted):
        run(stop - now)
        now = stop
        if stop in known:
            get_space_bodies(world.space, _FIELDS, _BUFFER)  # behind the earlier samples
        if stop in wanted:
            impulses.append(_impulses(world, reactions))
    rows = _states(world, times)
    if midpoint:
        rows[:, :, :3] += step / 2 * rows[:, :, 3:]
    kept = np.reshape(impulses, (len(wanted), len(reactions)))
    places = np.searchsorted(sorted(wanted), stops) if reactions else stops
    return Trajectory(
        times,
        {name: rows[:, i] for i, name in enumerate(world.bodies)},
        {
            name: np.sum(weights * kept[places, i], axis=1) / step
            for i, name in enumerate(reactions)
        },
    )


def _weights(samples: Counts, midpoint: bool) -> tuple[Counts, Array]:
    """Which steps' impulses give the force at each sample, and with what weights: (N, ·) each.

    The impulse of step n acts over its middle tₙ − h/2. Unless `midpoint`, it is read as what a
    user sees after the step. The first two steps settle the joints' gaps (5/8 and 11/8 of the
    force that holds a curved path), so the force at the start is extrapolated from the next two.
    """
    if not midpoint:
        return np.maximum(samples, 1)[:, None], np.ones((len(samples), 1))
    stops = np.column_stack([samples, samples + 1])
    weights = np.full(stops.shape, 0.5)
    stops[samples == 0], weights[samples == 0] = (3, 4), (3.5, -2.5)  # at 5/2 h and 7/2 h
    return stops, weights


def _states(world: World, times: Array) -> Array:
    """(N, bodies, 6): x, y, angle, vx, vy, omega, as pymunk had them."""
    ids = np.frombuffer(_BUFFER.int_buf(), np.uintp).reshape(len(times), -1)[0].tolist()
    rows = np.frombuffer(_BUFFER.float_buf()).reshape(len(times), len(ids), 6)
    rows = rows[:, [ids.index(body.id) for body in world.bodies.values()]]  # a copy
    finite = np.isfinite(rows).all(axis=(1, 2))
    outside = np.hypot(rows[:, :, 0], rows[:, :, 1]) > FAR
    far = np.any(outside & world.bounded, axis=1)
    if far.any() or not finite.all():
        first = np.argmax(far | ~finite)
        left = f"a body left the floor's or a groove's {FAR:g} m"
        what = left if far[first] else "not finite any more"
        raise Diverged(f"pymunk: {what} at t = {times[first]:g} s")
    return rows


def _impulses(world: World, reactions: tuple[str, ...]) -> list[float]:
    """Of the last step [N s], by quantity."""
    row: list[float] = []
    floor = {contact: _contact(world.wheel(contact)) for contact in world.wheels}
    for quantity in reactions:
        part, _, what = quantity.rpartition(".")
        if part in world.joints:
            row.append(world.joints[part][0].impulse)
        else:
            row.append(floor[part][0 if what == "tangent" else 1])
    return row


def _contact(wheel: Body) -> list[float]:
    """The floor's impulse on the wheel, x and y; zero where they do not touch."""
    total = [0.0, 0.0]
    wheel.each_arbiter(_add, total)
    return total


def _add(arbiter: Arbiter, total: list[float]) -> None:
    x, y = arbiter.total_impulse
    total[0] += x
    total[1] += y
