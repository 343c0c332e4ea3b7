"""Stepping pymunk and reading it at the samples.

Midpoint protocol: pymunk moves bodies by h v first and then changes v. Every body is started
h/2 back along its velocity, so that the engine's positions belong to tₙ − h/2 when its
velocities belong to tₙ; positions are read h/2 ahead. Forces at positions then act at the
middle of a step, which makes the method time-symmetric, and of second order.
"""

import math
from collections.abc import Callable, Mapping
from itertools import repeat
from typing import Any

import numpy as np
from pymunk.body import Body
from pymunk.vec2d import Vec2d

from cases.scene import Scene
from cases.trajectory import Array, Trajectory
from engines.engine import Diverged, Realised, State
from engines.pymunk.force import forces
from engines.pymunk.scene import FAR, World, build
from engines.pymunk.touch import closed, sink

Steps = Callable[[int], None]


def placed(
    scene: Scene, start: State, step: float, numbers: Mapping[str, Any], realised: Realised
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
    """Runs from stop to stop; a stop reads the bodies, or what the last step's impulses were."""
    samples = np.rint(times / step).astype(int).tolist()
    if max(abs(times - np.multiply(samples, step))) > 1e-9 * max(times[-1], step):
        raise ValueError(f"pymunk: the samples are no whole multiples of the step {step:g} s")
    weights = [_weights(sample, midpoint) for sample in samples] if reactions else []
    wanted = {stop for weight in weights for stop in weight}
    states, impulses = [], {}
    known, now = set(samples), 0
    for stop in sorted(known | wanted):
        run(stop - now)
        now = stop
        if stop in known:
            states.append(_state(world, stop * step))
        if stop in wanted:
            impulses[stop] = np.array(_impulses(world, reactions))
    rows = np.array(states, float).reshape(len(states), -1, 6)
    if midpoint:
        rows[:, :, :3] += step / 2 * rows[:, :, 3:]
    acting = np.array([sum(w * impulses[n] for n, w in weight.items()) for weight in weights])
    return Trajectory(
        times,
        {name: rows[:, i] for i, name in enumerate(world.bodies)},
        {name: acting[:, i] / step for i, name in enumerate(reactions)},
    )


def _weights(sample: int, midpoint: bool) -> dict[int, float]:
    """Which steps' impulses give the force at a sample, and with what weight.

    The impulse of step n acts over its middle tₙ − h/2. Unless `midpoint`, it is read as what a
    user sees after the step. The first two steps settle the joints' gaps (5/8 and 11/8 of the
    force that holds a curved path), so the force at the start is extrapolated from the next two.
    """
    if not midpoint:
        return {max(sample, 1): 1.0}
    if sample == 0:
        return {3: 3.5, 4: -2.5}  # at 5/2 h and 7/2 h
    return {sample: 0.5, sample + 1: 0.5}


def _state(world: World, t: float) -> list[float]:
    """x, y, angle, vx, vy, omega of body after body, as pymunk has them."""
    row: list[float] = []
    for body in world.bodies.values():
        row += (*body.position, body.angle, *body.velocity, body.angular_velocity)
    if not math.isfinite(sum(row)):
        raise Diverged(f"pymunk: not finite any more at t = {t:g} s")
    if world.bounded and any(body.position.length > FAR for body in world.bodies.values()):
        raise Diverged(f"pymunk: a body left the floor's or a groove's {FAR:g} m at t = {t:g} s")
    return row


def _impulses(world: World, reactions: tuple[str, ...]) -> list[float]:
    """Of the last step [N s], by quantity."""
    row = []
    for quantity in reactions:
        part, _, what = quantity.rpartition(".")
        if part in world.joints:
            row.append(world.joints[part][0].impulse)
        else:
            row.append(_contact(world.wheel(part))[0 if what == "tangent" else 1])
    return row


def _contact(wheel: Body) -> Vec2d:
    """The floor's impulse on the wheel; zero where they do not touch."""
    found: list[Vec2d] = []
    wheel.each_arbiter(lambda arbiter: found.append(arbiter.total_impulse))
    return sum(found, Vec2d(0.0, 0.0))
