"""The start as MuJoCo's positions and velocities, from the states of bodies."""

from collections.abc import Iterator

import numpy as np

from .....cases.scene import GROUND, Scene
from .....cases.scene.frame import SPACE
from .....cases.scene.joint import Joint
from .....cases.scene.motion import Motion
from .....cases.scene.rotation import UPRIGHT, inverse, product, turned
from .....cases.trajectory import Array, Trajectory
from ....engine import Start
from ..spatial_tree import natives, spanning_tree
from ..tree import Branch, Tree, called, driven

Coordinates = tuple[list[float], list[float]]
"""Positions and velocities in MuJoCo's order: of a free body 7 and 6, of a ball 4 and 3."""


def started(scene: Scene, start: Start) -> dict[str, Coordinates]:
    """By MuJoCo's name of each body, that of a driven point too."""
    tree = spanning_tree(scene)
    found: dict[str, Coordinates] = {}
    for name in driven(scene):
        point = scene.points[name.partition(".")[2]]
        found[name] = list(point.at), list(point.velocity)
    once = {name: np.array([state]) for name, state in start.items()}
    motion = Motion(scene.bodies, scene.points, Trajectory(np.zeros(1), once, {}))
    for branch in tree.branches:
        found[called(branch.body)] = _coordinates(scene, tree, branch, motion)
    return found


def _coordinates(
    scene: Scene, tree: Tree[Joint], branch: Branch[Joint], motion: Motion
) -> Coordinates:
    if branch.joint is None:
        return _free(scene, branch.body, motion)
    places, rates = branch.joint.coordinates(motion)
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


def _ball(scene: Scene, tree: Tree[Joint], branch: Branch[Joint], motion: Motion) -> Coordinates:
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
