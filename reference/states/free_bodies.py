"""Free bodies of the plane in x, y and angle: of which states are claimed."""

from typing import Any

from ...cases.scene import Scene
from ...cases.scene.states import coordinates
from ..stated import Stated
from ..system import Mass, Pose, Vector


class FreeBodies(Stated):
    """Nothing joins them."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.coordinates = scene, tuple(coordinates(scene))
        self.masses = {
            body.name: Mass(body.mass, body.moment if body.turns else None)
            for body in scene.bodies.values()
        }

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.9) X_k, E_k: a free body's coordinates are its own parameters."""
        at = {name: (q[i], v[i]) for i, name in enumerate(self.coordinates)}
        found: dict[str, Pose] = {}
        for name in self.masses:
            both = [at.get(f"{name}.{own}", (0.0, 0.0)) for own in ("x", "y", "angle")]
            found[name] = (*(place for place, _ in both), *(rate for _, rate in both))
        return found

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = Σ ½ m ṙ_c² + ½ J₃₃ ω² [J]."""
        energy: Any = 0.0
        for name, (*_, vx, vy, omega) in self.poses(t, q, v).items():
            mass = self.masses[name]
            energy = energy + (mass.m * (vx**2 + vy**2) + (mass.J or 0.0) * omega**2) / 2
        return energy

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −Σ m g·r_c [J]."""
        gx, gy = self.scene.gravity
        places = self.poses(t, q, 0.0 * q)
        return -sum(self.masses[n].m * (gx * x + gy * y) for n, (x, y, *_) in places.items())
