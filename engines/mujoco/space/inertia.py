"""An inertia tensor as MuJoCo takes it: principal moments, and the attitude of their axes.

MuJoCo's own `fullinertia` refuses a third of all thin disks that are turned: rounding makes their
largest moment exceed the sum of the others. Here it is cut to the sum.
"""

import mujoco
import numpy as np

from ....cases.scene.rotation import Quaternion
from ....cases.trajectory import Array
from ..scene import LEAST

ROUNDING = 1e-13  # of the largest moment: what is beyond is no rounding, and MuJoCo's to refuse


def principal(tensor: Array) -> tuple[tuple[float, float, float], Quaternion | None]:
    """Moments [kg m²], none below MuJoCo's least, and the attitude of their axes; None: the body's.

    A slender bar's moment about its own axis becomes 1e-15.
    """
    if np.array_equal(tensor, np.diag(np.diag(tensor))):
        return _possible(np.diag(tensor)), None
    moments, axes = np.linalg.eigh(tensor)
    if np.linalg.det(axes) < 0:
        axes[:, 0] = -axes[:, 0]
    return _possible(moments), _quaternion(axes)


def _possible(moments: Array) -> tuple[float, float, float]:
    """No moment exceeds the sum of the others, by rounding."""
    found = np.maximum(moments, LEAST)
    largest = int(np.argmax(found))
    rest = float(sum(np.delete(found, largest)))
    if 0 < found[largest] - rest <= ROUNDING * rest:
        found[largest] = rest
    return float(found[0]), float(found[1]), float(found[2])


def _quaternion(axes: Array) -> Quaternion:
    """Of a rotation matrix."""
    found = np.empty(4)
    mujoco.mju_mat2Quat(found, axes.ravel())
    w, x, y, z = found.tolist()
    return w, x, y, z
