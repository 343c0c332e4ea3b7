"""Two free bodies in space, joined by a spring off their centres: a pair that tumbles and falls."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from textmech.reference.laws.momentum import spin_rate
from textmech.reference.system import Array, Mode, Only, Pose, Vector

from ..laws.momenta import Acting, System, spatial
from ..laws.spatial_laws import matrix

G = np.array([0.0, 0.0, -9.80665])
MASSES = (1.3, 0.7)
TENSORS = (  # with products of inertia: the body axes are not principal
    np.array([[0.05, -0.01, 0.004], [-0.01, 0.04, 0.006], [0.004, 0.006, 0.03]]),
    np.array([[0.02, 0.003, 0.0], [0.003, 0.015, -0.002], [0.0, -0.002, 0.012]]),
)
HOOKS = (np.array([0.2, 0.1, -0.05]), np.array([-0.1, 0.15, 0.1]))  # in body axes
STIFFNESS, LENGTH = 40.0, 0.3


@dataclass(frozen=True)
class SpringPair(Mode):
    """q = (r, e) and v = (ṙ, ω) of each body in turn, ω in body axes."""

    coordinates = tuple(f"{x}{k}" for k in (1, 2) for x in ("x", "y", "z", "w", "i", "j", "k"))

    def start(self) -> tuple[Array, Array]:
        """Tumbling, 0.6 m apart."""
        q = [0, 0, 1, 1, 0, 0, 0, 0.6, 0.1, 1.1, 0.8, 0, 0.6, 0]
        v = [0.4, -0.3, 2, 1, 2, -3, -0.5, 0.6, 1, -2, 1, 4]
        return np.array(q, float), np.array(v, float)

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """ė = ½ e ∘ (0, ω)."""
        found: list[Any] = []
        for k in (0, 1):
            w, e = q[7 * k + 3], q[7 * k + 4 : 7 * k + 7]
            omega = v[6 * k + 3 : 6 * k + 6]
            found += [
                *v[6 * k : 6 * k + 3],
                -(e @ omega) / 2,
                *(w * omega + np.cross(e, omega)) / 2,
            ]
        return np.array(found)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.23), (2.33) under weight and spring."""
        places, attitudes = q.reshape(2, 7)[:, :3], [matrix(e) for e in q.reshape(2, 7)[:, 3:]]
        hooks = [r + R @ x for r, R, x in zip(places, attitudes, HOOKS, strict=True)]
        line = hooks[1] - hooks[0]
        length = np.linalg.norm(line)
        pull = STIFFNESS * (length - LENGTH) * line / length  # on the first body
        found: list[float] = []
        for k, (R, J) in enumerate(zip(attitudes, TENSORS, strict=True)):
            force = pull if k == 0 else -pull
            M_c = R.T @ np.cross(hooks[k] - places[k], force)
            found += [*(force / MASSES[k] + G), *spin_rate(J, v[6 * k + 3 : 6 * k + 6], M_c)]
        return np.array(found)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """As the state is."""
        parts = zip(q.reshape(2, 7), v.reshape(2, 6), strict=True)
        return dict(zip(("one", "two"), ((*q, *v) for q, v in parts), strict=True))


def pair(times: Array, y: Array) -> System:
    """The two bodies along a motion (N, 26), and their weights."""
    columns = {"one": [*range(7), *range(14, 20)], "two": [*range(7, 14), *range(20, 26)]}
    bodies = {
        name: spatial(m, J, y[:, columns[name]])
        for name, m, J in zip(columns, MASSES, TENSORS, strict=True)
    }
    weights = [Acting(b.r, np.tile(b.m * G, (len(times), 1))) for b in bodies.values()]
    return System(times, bodies, weights)


FREE = Only(SpringPair())
