"""States of all bodies from MuJoCo's kinematics, for a whole record at once."""

import mujoco
import numpy as np

from .....cases.scene.frame import SPACE
from .....cases.scene.rotation import UPRIGHT, inverse, turned
from .....cases.scene.space.scene import SpatialScene
from .....cases.trajectory import Array
from ....engine import Start
from ...tree import called
from .seen import Seen


def states(
    scene: SpatialScene, model: mujoco.MjModel, seen: Seen, start: Start
) -> dict[str, Array]:
    """(N, 13) of each body: r, quaternion and v of its centre of mass, ω in its own axes."""
    found = {}
    for name, body in scene.bodies.items():
        number = model.body(called(name)).id
        place, spin = seen["xpos"][:, number], seen["cvel"][:, number]
        # MuJoCo's velocities are those at the centre of mass of the whole tree.
        center = seen["subtree_com"][:, model.body_rootid[number]]
        rows = np.zeros((len(place), SPACE.width))
        rows[:, SPACE.place] = place
        rows[:, SPACE.velocity] = spin[:, 3:] + np.cross(spin[:, :3], place - center)
        if body.turns:
            attitude = seen["xquat"][:, number]
            rows[:, SPACE.attitude] = _continuous(attitude, np.array(start[name][SPACE.attitude]))
            rows[:, SPACE.spin] = turned(inverse(attitude), spin[:, :3])
        else:
            rows[:, SPACE.attitude] = UPRIGHT
        found[name] = rows
    return found


def _continuous(attitude: Array, first: Array) -> Array:
    """(N, 4) each with the sign that is nearer to the one before it."""
    before = np.vstack([first, attitude[:-1]])
    turns = np.where(np.sum(before * attitude, axis=1) < 0, -1.0, 1.0)
    return attitude * np.cumprod(turns)[:, None]
