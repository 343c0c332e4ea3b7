"""An open chain in space in the freedoms of its joints: of which states are claimed."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...cases.scene import GROUND, Anchor, Joint, Scene
from ..coverage import Numbered
from ..mechanism.kinematics.attitude import matrices, skew
from ..stated import Stated
from ..system import Mass, Pose, Vector

UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])


@dataclass(frozen=True)
class Moving(Numbered):
    """A frame on its way along the chain: r (3,), a unit quaternion, ṙ and ω in ground axes.

    Of K rates at once ṙ and ω are (3, K).
    """

    r: Any
    e: Any
    r_dot: Any
    omega: Any

    @property
    def R(self) -> Any:
        """(3, 3) whose columns are its axes in ground axes."""
        return matrices(self.e[None])[0]

    def at(self, x: Any) -> "Moving":
        """(2.1), (2.6) The same axes at a point x, in them: r + R x, ṙ + ω × R x."""
        d = self.R @ np.asarray(x)
        return Moving(self.r + d, self.e, self.r_dot - skew(d) @ self.omega, self.omega)

    def shifted(self, u: Any, s: Any, s_dot: Any) -> "Moving":
        """Along its axis u by s, with the rate ṡ."""
        there, along = self.at(np.asarray(u) * s), self.R @ np.asarray(u)
        r_dot = there.r_dot + np.multiply.outer(along, s_dot)
        return Moving(there.r, self.e, r_dot, self.omega)

    def turned(self, u: Any, phi: Any, phi_dot: Any) -> "Moving":
        """(2.3)–(2.5) About its axis u by φ: ω = ω + φ̇ u."""
        omega = self.omega + np.multiply.outer(self.R @ np.asarray(u), phi_dot)
        return Moving(self.r, _product(self.e, _turn(u, phi)), self.r_dot, omega)


class SpatialChain(Stated):
    """Each body hangs on one joint, whose first part is nearer to the ground."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        joints = scene.joints.values()
        names = [f"{joint.name}.{freedom.name}" for joint in joints for freedom in joint.freedoms]
        self.coordinates = tuple(names)
        self.masses = {body.name: Mass(body.mass, body.tensor) for body in scene.bodies.values()}

    def _bodies(self, q: Vector, v: Vector) -> dict[str, Moving]:
        """(2.11), (2.12) Every body's frame in its centre, as the coordinates have it.

        From joint to joint it is kept where the body hangs: over a centre that is far from both
        the way there and back would be rounded.
        """
        at = {name: (q[i], v[i]) for i, name in enumerate(self.coordinates)}
        still = np.zeros((3, *np.shape(v)[1:]))
        frames = {GROUND: (Moving(np.zeros(3), UPRIGHT, still, still), np.zeros(3))}
        while len(frames) <= len(self.scene.bodies):
            for joint in self.scene.joints.values():
                if joint.a.body in frames and joint.b.body not in frames:
                    part, hangs = frames[joint.a.body]
                    frame = self._moved(joint, part.at(self._point(joint.a) - hangs), at)
                    frames[joint.b.body] = frame, self._point(joint.b)
        return {name: frames[name][0].at(-frames[name][1]) for name in self.scene.bodies}

    def _moved(self, joint: Joint, frame: Moving, at: dict[str, tuple[Any, Any]]) -> Moving:
        """By all freedoms of the joint."""
        for freedom in joint.freedoms:
            goes = frame.shifted if freedom.kind == "shift" else frame.turned
            frame = goes(freedom.axis, *at[f"{joint.name}.{freedom.name}"])
        return frame

    def _point(self, anchor: Anchor) -> Any:
        if anchor.body == GROUND:
            return np.array(self.scene.points[anchor.point].at)
        return np.array(self.scene.bodies[anchor.body].points[anchor.point])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k, E_k by the coordinates, and their rates by (2.6)."""
        return {
            name: (*at.r, *at.e, *at.r_dot, *(at.R.T @ at.omega))
            for name, at in self._bodies(q, v).items()
        }

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = Σ ½ m ṙ_c² + ½ J_ik ω_i ω_k [J] of the rates (n,) or (n, K)."""
        energy: Any = 0.0
        for name, at in self._bodies(q, v).items():
            mass, omega = self.masses[name], at.R.T @ at.omega
            own = np.sum(omega * (mass.J @ omega), axis=0)
            energy = energy + (mass.m * np.sum(at.r_dot**2, axis=0) + own) / 2
        return energy

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −Σ m g·r_c [J]."""
        g, still = np.array(self.scene.gravity), np.zeros(len(q))
        bodies = self._bodies(q, still)
        return -sum(self.masses[name].m * (g @ at.r) for name, at in bodies.items())


def _turn(u: Any, phi: Any) -> Any:
    """(4,) about a unit vector."""
    return np.array([np.cos(phi / 2), *(np.sin(phi / 2) * np.asarray(u))])


def _product(a: Any, b: Any) -> Any:
    """(4,) first turned by b, then by a."""
    w, x = a[0] * b[0] - a[1:] @ b[1:], a[0] * b[1:] + b[0] * a[1:]
    return np.array([w, *(x + skew(a[1:]) @ b[1:])])
