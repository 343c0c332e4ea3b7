"""The depth at which MuJoCo's soft floor carries a disk.

Put exactly on the floor, a disk is not in contact: it falls free for a step, and the settling
that follows is an error of first order. So it is started where its normal acceleration vanishes.
"""

import mujoco
from scipy.optimize import brentq

from cases.scene import Scene
from engines.mujoco.run import load
from engines.mujoco.tree import spanning_tree

DEEPEST = 1e-3  # of the radius: a floor softer than this carries nothing


def settle(scene: Scene, text: str) -> dict[str, float]:
    """Depth [m] of each disk that lies on the floor by itself; a joined one rests on its joints."""
    free = {branch.body for branch in spanning_tree(scene).branches if branch.joint is None}
    model, data = load(text)
    depths = {}
    for contact in scene.contacts.values():
        body = scene.bodies[contact.body]
        if body.name in free and body.radius is not None:
            depths[body.name] = _depth(model, data, body.name, DEEPEST * body.radius)
    return depths


def _depth(model: mujoco.MjModel, data: mujoco.MjData, body: str, deepest: float) -> float:
    height = data.joint(f"{body}.y").qpos[0]

    def rise(depth: float) -> float:
        data.joint(f"{body}.y").qpos[0] = height - depth
        mujoco.mj_forward(model, data)
        return float(data.joint(f"{body}.y").qacc[0])

    # Depth 0 is no contact at all; the smallest number above it that y can hold is.
    shallow = 4e-16 * max(abs(height), 1.0)
    depth = brentq(rise, shallow, deepest, xtol=shallow) if rise(shallow) < 0 else 0.0
    data.joint(f"{body}.y").qpos[0] = height
    return float(depth)
