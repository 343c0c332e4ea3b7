"""A scene as it is computed with: its bodies, what joins, drives and acts, and all its laws."""

import math
from typing import Any

import numpy as np

from second.bodies import body, three
from second.contacts import contact
from second.forces import TIMED, word
from second.geometry import Layout, driven, joint, law
from second.moving import Array

STANDARD = 9.80665  # m/s²


def gravity(scene: dict[str, Any], space: bool) -> Array:
    """The acceleration of gravity, after the words `gravity`, `incline` and `seen`."""
    down = np.array([0.0, 0.0, -1.0]) if space else np.array([0.0, -1.0, 0.0])
    told = scene.get("gravity", STANDARD)
    if told == "none":
        return np.zeros(3)
    if isinstance(told, list):
        return three(told)
    slope = scene.get("incline", 0.0)
    along = np.array([math.sin(slope), 0.0, 0.0])
    if scene.get("seen") == "from above":
        return told * along
    return told * (along + math.cos(slope) * down)


class Model:
    """A scene with everything by its name."""

    def __init__(self, scene: dict[str, Any]) -> None:
        space = scene.get("space") == 3
        self.gravity = gravity(scene, space)
        self.bodies = {
            name: body(name, i, told, space)
            for i, (name, told) in enumerate((scene.get("bodies") or {}).items())
        }
        ground = {name: driven(told) for name, told in (scene.get("points") or {}).items()}
        self.layout = Layout(space, self.bodies, ground)
        self.n = self.layout.n
        self.joints = {
            name: joint(name, told, self.layout)
            for name, told in (scene.get("joints") or {}).items()
        }
        self.dry = {
            name: told["dry_friction"]
            for name, told in (scene.get("joints") or {}).items()
            if "dry_friction" in told
        }
        self.angles: dict[str, slice] = {}
        self.turns = 0  # angles in space, which the motion sums up
        for name, j in self.joints.items():
            more = len(j.hinges) if space else 0
            self.angles[name] = slice(self.turns, self.turns + more)
            self.turns += more
        self.constraints = dict(scene.get("constraints") or {})
        self.heights: dict[str, float] = {}
        self.contacts = {n: contact(n, c) for n, c in (scene.get("contacts") or {}).items()}
        self.planes = {"floor": (np.zeros(3), np.array([0.0, 1.0, 0.0]))}
        for name, told in (scene.get("planes") or {}).items():
            self.planes[name] = three(told["at"]), three(told["normal"])
        self.forces = dict(scene.get("forces") or {})
        self.drives = dict(scene.get("drive") or {})
        self.inner = [n for n, f in self.forces.items() if word(f).endswith("muscle")]
        self.laws = {n: law(f) for n, f in self.forces.items() if word(f) in TIMED}
        self.laws |= {rate: law(told) for rate, told in self.drives.items()}
        self.laws |= {n: law(c["speed"]) for n, c in self.constraints.items() if "speed" in c}
        moved = [moves for _, moves in ground.values()]
        self.corners = sorted({t for l in (*self.laws.values(), *moved) for t in l.corners})

    def mass(self, R: dict[str, Array]) -> Array:
        """The mass matrix, of bodies that lie as R says."""
        M = np.zeros((self.n, self.n))
        for name, b in self.bodies.items():
            c, w = b.columns
            M[c, c] = b.mass * np.eye(c.stop - c.start)
            M[w, w] = R[name] @ b.inertia @ R[name].T if b.space else b.inertia[2, 2]
        return M
