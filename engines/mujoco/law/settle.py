"""The depth at which MuJoCo's soft floor carries a disk or a particle.

Put exactly on the floor, a disk is not in contact: it falls free for a step, and the settling
that follows is an error of first order. So it is started where its normal acceleration vanishes.
"""

import mujoco
from scipy.optimize import brentq

from ....cases.scene import CENTER, Scene
from ...engine import Start
from ..contact import CLOSED, height
from ..tree import spanning_tree
from .signal import signals

_DEEPEST = 1.0  # m, of a particle; a disk could be as deep as its radius


def settle(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, start: Start
) -> dict[str, float]:
    """Depth [m] of what lies on the floor by itself; what is joined rests on its joints.

    The data is at its start, and is so again afterwards.
    """
    free = {branch.body for branch in spanning_tree(scene).branches if branch.joint is None}
    depths = {}
    with signals(scene):
        for contact in scene.contacts.values():
            body = scene.bodies[contact.body]
            alone = body.name in free and contact.at.point == CENTER
            if alone and height(scene, contact, start) <= CLOSED:
                depths[body.name] = _depth(model, data, body.name, body.radius or _DEEPEST)
    mujoco.mj_resetDataKeyframe(model, data, 0)  # the run must not inherit a warm start
    return depths


def _depth(model: mujoco.MjModel, data: mujoco.MjData, body: str, deepest: float) -> float:
    place = data.joint(f"{body}.y")
    height = float(place.qpos[0])

    def rise(depth: float) -> float:
        place.qpos[0] = height - depth
        mujoco.mj_forward(model, data)
        return float(place.qacc[0])

    # Depth 0 is no contact at all; the smallest number above it that y can hold is.
    shallow = deep = 4e-16 * max(abs(height), 1.0)
    while rise(deep) < 0 and deep < deepest:
        deep *= 10
    carried = rise(shallow) < 0 < rise(deep)  # else it is lifted off, or pressed through the floor
    depth = brentq(rise, shallow, deep, xtol=shallow) if carried else 0.0
    place.qpos[0] = height
    return float(depth)
