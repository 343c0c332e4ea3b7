"""A chain of five bodies on skew hinges, with its own Newton and Euler: no equation is shared.

Newton (2.23) and Euler (2.27) of each body from the tip inward, by rotation matrices.
"""

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from textmech.cases.scene import Scene, Signal
from textmech.cases.trajectory import Array
from textmech.engines.engine import Start

from ..adapters.engine_space import hinge, rigid, spatial, state
from .spatial_motions import turn

G = np.array([0.0, 0.0, -9.80665])
N = 5
_RANDOM = np.random.default_rng(3)
AXES = [a / np.linalg.norm(a) for a in _RANDOM.normal(size=(N, 3))]
INNER, OUTER = _RANDOM.uniform(-0.3, 0.3, (2, N, 3))
MASSES = _RANDOM.uniform(0.5, 2.0, N)


def _tensor() -> Array:
    """Of a body with mass everywhere: tr(S) − S of a positive S."""
    A = _RANDOM.normal(size=(3, 3))
    S = 0.01 * A @ A.T + 0.005 * np.eye(3)
    return np.trace(S) * np.eye(3) - S


TENSORS = [_tensor() for _ in range(N)]
Q, Q_DOT = _RANDOM.uniform(-1.0, 1.0, (2, N))
BODIES = [
    rigid(f"b{i}", float(MASSES[i]), TENSORS[i], {"inner": INNER[i], "outer": OUTER[i]})
    for i in range(N)
]


def chain(*, back: tuple[int, ...] = (), drives: dict[str, Signal] | None = None) -> Scene:
    """The scene; the joints `back` name their outer body first."""
    joints = []
    for i in range(N):
        ends = "ground.O" if i == 0 else f"b{i - 1}.outer", f"b{i}.inner"
        a, b = ends[::-1] if i in back else ends
        joints.append(hinge(f"j{i}", a, b, AXES[i] * (-1) ** (i in back)))
    return spatial(BODIES, joints, drives=drives)


def start(q: Array, q_dot: Array) -> Start:
    """The states of all bodies."""
    found = {}
    for i, (R, w, _, r, v, *_) in enumerate(_kinematics(q, q_dot, np.zeros(N))):
        quaternion = Rotation.from_matrix(R).as_quat(scalar_first=True)
        found[f"b{i}"] = state(r, quaternion, v, R.T @ w)
    return found


def wrenches(q: Array, q_dot: Array, q_ddot: Array) -> tuple[Array, Array, Array]:
    """Forces (N, 3), moments about inner points (N, 3), torques (N,) from inside; ground axes."""
    F, M, at = np.zeros(3), np.zeros(3), np.zeros(3)
    found: list[Any] = []
    kinematics = _kinematics(q, q_dot, q_ddot)
    for i in reversed(range(N)):
        R, w, alpha, r, _, a, p, n = kinematics[i]
        J = R @ TENSORS[i] @ R.T
        f = MASSES[i] * (a - G)
        M = M + _cross(at - p, F) + J @ alpha + _cross(w, J @ w) + _cross(r - p, f)
        F, at = F + f, p
        found.append((F, M, M @ n))
    forces, moments, torques = zip(*reversed(found), strict=True)
    return np.array(forces), np.array(moments), np.array(torques)


def accelerations(q: Array, q_dot: Array, given: dict[int, float] | None = None) -> Array:
    """(N,) of the hinges that no torque turns; given: the accelerations of the others."""
    prescribed = given or {}
    free = [i for i in range(N) if i not in prescribed]
    found = np.array([prescribed.get(i, 0.0) for i in range(N)])
    bias = wrenches(q, q_dot, found)[2]
    still = wrenches(q, np.zeros(N), np.zeros(N))[2]
    M = np.array([wrenches(q, np.zeros(N), e)[2] - still for e in np.eye(N)[free]]).T
    found[free] = np.linalg.solve(M[free], -bias[free])
    return found


def _kinematics(q: Array, q_dot: Array, q_ddot: Array) -> list[tuple[Any, ...]]:
    """R, ω, ω̇, r, v, a of each body, and its hinge's place and axis."""
    R, w, alpha = np.eye(3), np.zeros(3), np.zeros(3)
    p, v, a = np.zeros((3, 3))
    found = []
    for i in range(N):
        n = R @ AXES[i]
        alpha = alpha + n * q_ddot[i] + _cross(w, n * q_dot[i])
        w, R, hinged = w + n * q_dot[i], R @ turn(AXES[i], q[i]), p
        p, v, a = _carried(p, v, a, w, alpha, R @ -INNER[i])
        found.append((R, w, alpha, p, v, a, hinged, n))
        p, v, a = _carried(p, v, a, w, alpha, R @ OUTER[i])
    return found


def _carried(p: Any, v: Any, a: Any, w: Any, alpha: Any, d: Any) -> tuple[Any, Any, Any]:
    """Place, velocity and acceleration of a point d further on."""
    turning = _cross(w, d)
    return p + d, v + turning, a + _cross(alpha, d) + _cross(w, turning)


def _cross(a: Any, b: Any) -> Any:
    """numpy's own takes ten times as long."""
    return np.array(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )
