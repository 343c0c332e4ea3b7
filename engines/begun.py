"""A start as elements look at it: a motion of one row."""

import numpy as np

from ..cases.scene import Scene
from ..cases.scene.motion import Motion
from ..cases.trajectory import Trajectory
from .engine import Start


def begun(scene: Scene, start: Start) -> Motion:
    """The start."""
    states = {name: np.array([start[name]]) for name in scene.bodies}
    return Motion(scene.bodies, scene.points, Trajectory(np.zeros(1), states, {}), scene.joints)
