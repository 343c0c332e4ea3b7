"""Maximal coordinates in space: r and a unit quaternion of each body, velocities ṙ and ω."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....cases.scene import Scene
from ....cases.scene.body import Body
from ....cases.scene.forces.turning import Turning
from ...system import Pose
from .attitude import rates, spin
from .frame import SPACE
from .kinematics import Layout, Slots

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
STILL = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class SpatialCoordinates(Layout):
    """q = (r, quaternion) and v = (ṙ, ω) of each body in the scene's order; ω in body axes."""

    scene: Scene
    frame = SPACE

    @cached_property
    def slots(self) -> dict[str, Slots]:
        """The columns of each body by its name."""
        columns, m, n = {}, 0, 0
        for body in self.scene.bodies.values():
            turns = body.turns
            columns[body.name] = Slots(m, m + 3 if turns else None, n, n + 3 if turns else None)
            m, n = m + (7 if turns else 3), n + (6 if turns else 3)
        return columns

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The coordinate at each place of q: `top.x`, `top.e0` … `top.e3` of the quaternion."""
        names: list[str] = []
        for body in self.scene.bodies.values():
            names += [f"{body.name}.{axis}" for axis in "xyz"]
            names += [f"{body.name}.e{i}" for i in range(4)] if body.turns else []
        return tuple(names)

    @cached_property
    def inner(self) -> dict[str, int]:
        """Where in q, behind the bodies, the angles stand whose turns are counted."""
        return {name: len(self.names) + i for i, name in enumerate(wound(self.scene))}

    @cached_property
    def rate_names(self) -> tuple[str, ...]:
        """The velocity at each place of v: `top.vx`, `top.omega_1`."""
        names: list[str] = []
        for body in self.scene.bodies.values():
            names += [f"{body.name}.v{axis}" for axis in "xyz"]
            names += [f"{body.name}.omega_{i}" for i in (1, 2, 3)] if body.turns else []
        return tuple(names)

    @property
    def size(self) -> int:
        """The number n of velocities."""
        return len(self.rate_names)

    @cached_property
    def turning(self) -> NDArray[np.bool_]:
        """Which velocities are those of turns, (n,)."""
        return np.array([".omega_" in name for name in self.rate_names])

    @cached_property
    def M(self) -> NDArray[np.float64]:
        """The mass matrix (n, n): m·1 and J of each body, constant in body axes."""
        M = np.zeros((self.size, self.size))
        for body in self.scene.bodies.values():
            at = self.slots[body.name]
            M[at.r_dot : at.r_dot + 3, at.r_dot : at.r_dot + 3] = body.mass * np.eye(3)
            if at.omega is not None:
                M[at.omega : at.omega + 3, at.omega : at.omega + 3] = body.tensor
        return M

    @cached_property
    def masses(self) -> list[float]:
        """Inertia along each velocity alone, (n,): m, and of a turn the largest of J."""
        return [
            entry
            for body in self.scene.bodies.values()
            for entry in [body.mass] * 3
            + ([float(np.max(np.linalg.eigvalsh(body.tensor)))] * 3 if body.turns else [])
        ]

    def inertia(self, body: Body) -> NDArray[np.float64] | None:
        """J (3, 3) [kg m²] of a body in its axes; None of a particle."""
        return body.tensor if body.turns else None

    @cached_property
    def _inertias(self) -> tuple[Any, Any, Any]:
        """(B, 3) where the r stand in q, the masses (B,), and J (K, 3, 3) of those that turn."""
        bodies = self.scene.bodies.values()
        places = np.add.outer([at.r for at in self.slots.values()], range(3))
        tensors = np.array([b.tensor for b in bodies if b.turns]).reshape(-1, 3, 3)
        return places, np.array([b.mass for b in bodies]), tensors

    def T(self, q: Any, v: Any) -> Any:
        """(2.54) T = ½ Σ m ṙ_c² + ½ Σ ω·J ω [J] of the rates q̇ (m,) or (m, K)."""
        places, m, J = self._inertias
        r_dot = v[places]  # (B, 3, …)
        energy = 0.5 * np.tensordot(m, (r_dot * r_dot).sum(axis=1), 1)
        if len(J):
            each = (..., *[None] * (np.ndim(v) - 1))  # one attitude for all of many rates
            q_k, rates = q[self.attitudes].T[each], np.moveaxis(v[self.attitudes], 1, 0)
            omega = spin(q_k, rates)  # (3, K, …)
            turned = omega * np.einsum("kij,jk...->ik...", J, omega)
            energy = energy + 0.5 * turned.sum(axis=(0, 1))
        return energy

    def poses(self, q: Any, v: Any) -> dict[str, Pose]:
        """(2.8) R_k, E_k of each body: r, the quaternion with its length 1, ṙ, ω."""
        return {name: self._pose(at, q, v) for name, at in self.slots.items()}

    def _pose(self, at: Slots, q: Any, v: Any) -> Pose:
        r, r_dot = q[at.r : at.r + 3], v[at.r_dot : at.r_dot + 3]
        if at.attitude is None or at.omega is None:
            return (*r, *UPRIGHT, *r_dot, *STILL)
        e = q[at.attitude : at.attitude + 4]
        return (*r, *(e / np.sqrt(np.sum(e * e))), *r_dot, *v[at.omega : at.omega + 3])

    def place(self, poses: Mapping[str, Pose]) -> tuple[Any, Any]:
        """q (m,) and v (n,) of given poses."""
        q, v = [], []
        for name, at in self.slots.items():
            pose = poses[name]
            q += [*pose[0:3], *(() if at.attitude is None else pose[3:7])]
            v += [*pose[7:10], *(() if at.omega is None else pose[10:13])]
        return np.array(q), np.array(v)

    def velocities(self, poses: Mapping[str, Pose]) -> Any:
        """v (n,) of given poses, real or complex."""
        return self.place(poses)[1]

    @cached_property
    def attitudes(self) -> NDArray[np.intp]:
        """(K, 4) where the quaternions of the bodies that turn stand in q."""
        return self._those([at.attitude for at in self.slots.values()], 4)

    @cached_property
    def spins(self) -> NDArray[np.intp]:
        """(K, 3) where their ω stand in v."""
        return self._those([at.omega for at in self.slots.values()], 3)

    @staticmethod
    def _those(begins: list[int | None], width: int) -> NDArray[np.intp]:
        kept = [range(begin, begin + width) for begin in begins if begin is not None]
        return np.array(kept, dtype=np.intp).reshape(-1, width)

    @cached_property
    def _straight(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        places = [at.r + i for at in self.slots.values() for i in range(3)]
        return np.array(places, np.intp), np.array(
            [at.r_dot + i for at in self.slots.values() for i in range(3)], np.intp
        )

    def rates(self, q: Any, v: Any) -> Any:
        """(2.5), (2.6) q̇ (m,) of q and v: ṙ, and ½ q ∘ (0, ω)."""
        q_dot = np.empty(len(self.names), np.result_type(q, v))
        to, of = self._straight
        q_dot[to] = v[of]
        if len(self.attitudes):
            q_dot[self.attitudes] = rates(q[self.attitudes], v[self.spins])
        return q_dot


def wound(scene: Any) -> dict[str, Turning]:
    """The turns of which a torsion spring in space counts the whole ones: by quantity, one."""
    return {counted_as(force): force for force in scene.forces.values() if force.winds}


def counted_as(force: Turning) -> str:
    """The quantity of the angle about which a force acts: `q1.angle`, `joint.theta`."""
    return f"{force.about}.{force.turn or 'angle'}"
