"""The bound below which a quantity is zero: all that the reference's own rounding leaves of one."""

import numpy as np

from ..trajectory import Trajectory
from . import Scene
from .observe import observe
from .quantity import table

STILL = 1e-9  # of the largest value of its kind: what the reference's own rounding leaves of a zero


def still(scene: Scene, record: Trajectory, name: str) -> float:
    """The bound below which values of a quantity of the reference are zero, in its unit."""
    u = observe(scene, record, name)
    return STILL * max(float(np.max(np.abs(u))), _peers(scene, record, name))


def _peers(scene: Scene, record: Trajectory, name: str) -> float:
    """The largest of all places, rates or forces of the scene: what trembles is small beside it."""
    quantity = table(scene)[name]
    columns = scene.frame.alike(quantity.unit)
    peers = [states[:, columns] for states in record.states.values()]
    if quantity.kind == "force":
        peers += list(record.reactions.values())
    return max((float(np.max(np.abs(x), initial=0.0)) for x in peers), default=0.0)
