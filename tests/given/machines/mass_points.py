"""Rigid bodies as mass points with the same m and J: the book's integrals over dm as sums."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from textmech.cases.scene.frame import PLANE, SPACE
from textmech.reference.formalisms.derivative import along
from textmech.reference.laws.rotation import axes
from textmech.reference.system import Array, Mass, Mode, Pose, Vector

ASIDE = np.array([[0.0, -1.0], [1.0, 0.0]])  # ω × x = ω ASIDE x in the plane


def elements(mass: Mass) -> tuple[Array, Array]:
    """Masses (N,) and places (N, 2 or 3) in body axes, about the centre of mass.

    In space ∫ x xᵀ dm = ½ tr J − J: two points on each of its axes.
    """
    J = np.asarray(mass.J)
    if J.ndim == 0:
        radius = np.sqrt(mass.J / mass.m)
        return np.full(4, mass.m / 4), radius * np.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
    squares, ways = np.linalg.eigh(np.trace(J) / 2 * np.eye(3) - J)
    x = (ways * np.sqrt(3 * squares / mass.m)).T
    return np.full(6, mass.m / 6), np.concatenate([x, -x])


def rows(pose: Pose) -> Vector:
    """E of a pose: body axes as rows."""
    if len(pose) == SPACE.width:
        return axes(pose[SPACE.attitude])
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    return np.array([[cos, sin], [-sin, cos]])


@dataclass(frozen=True)
class Elements:
    """The mass elements of a mode's only body."""

    mode: Mode

    def _body(self, t: Any, q: Any, v: Any) -> tuple[Mass, Pose]:
        ((name, pose),) = self.mode.poses(t, q, v).items()
        return self.mode.masses[name], pose

    @property
    def dm(self) -> Array:
        """(N,) [kg]."""
        (mass,) = self.mode.masses.values()
        return elements(mass)[0]

    def r(self, t: Any, q: Any) -> Vector:
        """(N, d) where they are."""
        still = 0.0 * q[: len(q) - ("q3" in self.mode.coordinates)]  # ω has one number less
        mass, pose = self._body(t, q, still)
        frame = SPACE if len(pose) == SPACE.width else PLANE
        return np.array(pose[frame.place]) + elements(mass)[1] @ rows(pose)

    def r_dot(self, t: Any, q: Any, v: Any) -> Vector:
        """(2.6) ṙ = ṙ_c + ω × x, (N, d)."""
        mass, pose = self._body(t, q, v)
        x, E = elements(mass)[1], rows(pose)
        if len(pose) == SPACE.width:
            return np.array(pose[SPACE.velocity]) + np.cross(np.array(pose[SPACE.spin]), x) @ E
        return np.array(pose[PLANE.velocity]) + pose[5] * (x @ E @ ASIDE.T)

    def r_ddot(self, t: float, q: Array, v: Array, a: Array) -> Array:
        """(N, d) at the accelerations v̇ = a."""
        return along(self.r_dot, (t, q, v), (1.0, self.mode.rates(t, q, v), a))

    def slopes(self, t: float, q: Array) -> Array:
        """∂r/∂q (N, d, m)."""
        units = np.eye(len(q))
        return np.stack([along(lambda q: self.r(t, q), (q,), (e,)) for e in units], axis=-1)

    def forces(self, t: float, q: Array, v: Array) -> Array:
        """dF (N, d): applied forces at the centre as weights are, a moment as a couple."""
        mass, pose = self._body(t, q, v)
        m, x = elements(mass)
        dF = np.zeros(x.shape)
        for load in self.mode.loads(t, q, v):
            dF += np.outer(m / mass.m, load.force)
            if load.moment:
                dF += m[:, None] * (x @ rows(pose) @ ASIDE.T) * (load.moment / mass.J)
        return dF
