"""The start as MuJoCo's positions and velocities, from the states of bodies."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ....cases.scene import GROUND, Scene
from ....cases.scene.frame import PLANE, SPACE
from ....cases.scene.motion import Motion
from ....cases.scene.rotation import UPRIGHT, inverse, product, turned
from ....cases.trajectory import ANGLE, OMEGA, Array
from ...engine import Start, begun
from .tree import Branch, Native, Tree, called, driven, natives, place, spanning_tree
from .tree import turned as turned_in_plane

Coordinates = tuple[list[float], list[float]]
"""Positions and velocities in MuJoCo's order: of a free body 7 and 6, of a ball 4 and 3."""


def started(scene: Scene, start: Start) -> dict[str, Coordinates]:
    """The start by MuJoCo's name of each body, and of each driven point, which is a body too."""
    tree = spanning_tree(scene)
    coordinates: dict[str, Coordinates] = {}
    for name in driven(scene):
        point = scene.points[name.partition(".")[2]].state(0.0)
        half = scene.frame.dimension
        coordinates[name] = list(point[:half]), list(point[half:])
    if scene.frame is PLANE:
        for branch in tree.branches:
            pairs = [
                _in_plane(scene, tree, branch, native, start) for native in natives(scene, branch)
            ]
            coordinates[called(branch.body)] = [q for q, _ in pairs], [v for _, v in pairs]
        return coordinates
    motion = begun(scene, start)
    for branch in tree.branches:
        coordinates[called(branch.body)] = _in_space(scene, tree, branch, motion)
    return coordinates


# In the plane: angles count whole turns, and a number that is given comes back to the last bit.


def _in_plane(
    scene: Scene, tree: Tree, branch: Branch, native: Native, start: Start
) -> tuple[float, float]:
    """The position of one of MuJoCo's joints, and its rate."""
    state = start[branch.body]
    if branch.joint is None:
        return state[native.of], state[3 + native.of]
    return (_turn if native.type == "hinge" else _shift)(scene, tree, branch, start)


def _turn(scene: Scene, tree: Tree, branch: Branch, start: Start) -> tuple[float, float]:
    state = start[branch.body]
    parent = start.get(tree.frame(scene, branch.parent), (0.0,) * 6)
    angle, omega = state[ANGLE] - parent[ANGLE], state[OMEGA] - parent[OMEGA]
    return (angle, omega) if branch.forward else (-angle, -omega)


def _shift(scene: Scene, tree: Tree, branch: Branch, start: Start) -> tuple[float, float]:
    joint = branch.joint
    assert joint is not None
    first, second = (place(scene, end, start) for end in (joint.a, joint.b))
    base = 0.0 if joint.a.body == GROUND else start[joint.a.body][ANGLE]
    u = turned_in_plane(joint.along, base)
    d = [after - before for before, after in zip(first, second, strict=True)]
    return d[0] * u[0] + d[1] * u[1], d[2] * u[0] + d[3] * u[1]


# In space.


def _in_space(scene: Scene, tree: Tree, branch: Branch, motion: Motion) -> Coordinates:
    if branch.joint is None:
        return _free(scene, branch.body, motion)
    joint: Any = branch.joint
    places, rates = joint.coordinates(motion)
    positions: list[float] = []
    velocities: list[float] = []
    for native in natives(scene, branch):
        if native.type == "ball":
            between, omega = _ball(scene, tree, branch, motion)
            positions += between
            velocities += omega
        else:
            positions.append(float(places[0, native.of]))
            velocities.append(float(rates[0, native.of]))
    return positions, velocities


def _free(scene: Scene, body: str, motion: Motion) -> Coordinates:
    """A freejoint's velocity stands in ground axes, its ω in the body's: as in a state."""
    state = motion.trajectory.states[body][0]
    columns: Iterator[slice] = iter((SPACE.place, SPACE.attitude, SPACE.velocity, SPACE.spin))
    r, q, v, omega = (state[column].tolist() for column in columns)
    return (r + q, v + omega) if scene.bodies[body].turns else (r, v)


def _ball(scene: Scene, tree: Tree, branch: Branch, motion: Motion) -> Coordinates:
    """The attitude against the parent's frame, and ω against it in the body's own axes."""
    q_a, omega_a = _axes(tree.frame(scene, branch.parent), motion)
    q_b, omega_b = _axes(branch.body, motion)
    between = product(inverse(q_a), q_b)
    return between.tolist(), (omega_b - turned(inverse(between), omega_a)).tolist()


def _axes(name: str, motion: Motion) -> tuple[Array, Array]:
    if name == GROUND:
        return np.array(UPRIGHT), np.zeros(3)
    state = motion.trajectory.states[name][0]
    return state[SPACE.attitude], state[SPACE.spin]
