"""Maximal coordinates in the plane: x, y and angle of each body."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....cases.scene import Scene
from ...system import Pose
from .frame import PLANE
from .kinematics import Layout, Slots


@dataclass(frozen=True)
class Coordinates(Layout):
    """q = (x, y, angle) of each body in the scene's order; a particle has no angle."""

    scene: Scene
    frame = PLANE

    @cached_property
    def slots(self) -> dict[str, Slots]:
        """Where each body's numbers begin: in q and in v at the same places."""
        return {name: Slots(xy, phi, xy, phi) for name, (xy, phi) in self.columns.items()}

    @cached_property
    def columns(self) -> dict[str, tuple[int, int | None]]:
        """body → (index of x, index of the angle or None)."""
        at, columns = 0, {}
        for body in self.scene.bodies.values():
            columns[body.name] = (at, at + 2 if body.turns else None)
            at += 3 if body.turns else 2
        return columns

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The coordinate at each place of q, as a quantity: `crank.x`, `crank.angle`."""
        return tuple(self._names())

    def _names(self) -> Iterator[str]:
        for body in self.scene.bodies.values():
            yield from (f"{body.name}.x", f"{body.name}.y")
            if body.turns:
                yield f"{body.name}.angle"

    @cached_property
    def rate_names(self) -> tuple[str, ...]:
        """The velocity at each place of v: `crank.vx`, `crank.omega`."""
        words = {"x": "vx", "y": "vy", "angle": "omega"}
        parts = (name.rpartition(".") for name in self.names)
        return tuple(f"{body}.{words[field]}" for body, _, field in parts)

    @cached_property
    def inner(self) -> dict[str, int]:
        """Where the inner states of forces stand, behind the bodies' coordinates."""
        return {name: len(self.names) + i for i, name in enumerate(self.scene.inner())}

    @cached_property
    def turning(self) -> NDArray[np.bool_]:
        """Which coordinates are angles, (n,)."""
        return np.array([name.endswith(".angle") for name in self.names])

    @cached_property
    def masses(self) -> list[float]:
        """The diagonal of the mass matrix: m, m, J for each body."""
        return [
            entry
            for body in self.scene.bodies.values()
            for entry in (body.mass, body.mass, *body.inertia)
        ]

    def inertia(self, body: Any) -> float | None:
        """J [kg m²] of a body; None of a particle."""
        return body.moment if body.turns else None

    def T(self, q: Any, v: Any) -> Any:
        """(2.54) T = ½ Σ m ṙ_c² + ½ Σ J ω² [J] of the rates v (n,) or (n, K)."""
        M = np.array(self.masses)
        v = v[: len(M)]
        return 0.5 * M.dot(v * v)

    def rates(self, q: Any, v: Any) -> Any:
        """q̇ = v."""
        return v

    def poses(self, q: Any, v: Any) -> dict[str, Pose]:
        """(2.8) R_k, E_k of each body: its entries of q and v (n,), a particle's angle being 0."""
        return {
            name: (
                q[xy],
                q[xy + 1],
                0.0 if phi is None else q[phi],
                v[xy],
                v[xy + 1],
                0.0 if phi is None else v[phi],
            )
            for name, (xy, phi) in self.columns.items()
        }

    def place(self, poses: Mapping[str, Pose]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """q and v (n,) of given poses; behind the bodies' coordinates the inner states."""
        q, v = np.zeros(len(self.masses) + len(self.inner)), np.zeros(len(self.masses))
        for name, place in self.inner.items():
            q[place] = poses[name][0]
        for name, (xy, phi) in self.columns.items():
            x, y, angle, vx, vy, omega = poses[name]
            q[xy : xy + 2], v[xy : xy + 2] = (x, y), (vx, vy)
            if phi is not None:
                q[phi], v[phi] = angle, omega
        return q, v

    def velocities(self, poses: Mapping[str, Pose]) -> Any:
        """v (n,) of given poses, real or complex."""
        rates: list[Any] = []
        for name, (_, phi) in self.columns.items():
            rates += poses[name][3 : 5 if phi is None else 6]
        return np.array(rates)
