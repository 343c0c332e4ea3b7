"""A whole engine behind textmech's protocol: free particles with springs, dampers and pushes.

Semi-implicit Euler: velocities by the forces at the old places, then places by the new velocities.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from textmech.cases.scene import GROUND, Anchor, Damper, Push, Scene, Spring
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Plan, Refusal, Start
from textmech.engines.heading import heading
from textmech.engines.law import tension
from textmech.engines.signal import value


@dataclass(frozen=True)
class Toy:
    """The engine as its users get it; it has no other setting, and no options."""

    setting: str
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "toy"
    version: str = "1.0"
    own_step: float = 1e-3  # s
    offers: ClassVar[tuple[str, ...]] = ("shipped",)

    def __post_init__(self) -> None:
        if self.options:
            raise ValueError("\n".join(f"toy.{name}: unknown option" for name in self.options))

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        """One way, of first order, for what is free and does not turn."""
        if scene.joints or scene.contacts or scene.pairs:
            return [Refusal("native", "engine: toy has no joints and no contacts")]
        if any(body.turns for body in scene.bodies.values()):
            return [Refusal("native", "engine: toy knows particles only")]
        return [Plan("native", held=(1, 2))]

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        """It holds nothing of its own but masses and gravity."""
        masses = {f"{body.name}.mass": body.mass for body in scene.bodies.values()}
        return masses | {"gravity.x": scene.gravity[0], "gravity.y": scene.gravity[1]}

    def run(
        self, scene: Scene, start: Start, times: Array, step: float, plan: Plan,
        *, reactions: tuple[str, ...], record: bool = False,
    ) -> Trajectory:  # fmt: skip
        """Every step is kept; the samples are some of them."""
        now = {name: np.array(row) for name, row in start.items()}
        every = np.arange(round(times[-1] / step) + 1) * step
        kept = {name: np.empty((len(every), 6)) for name in now}
        for i, t in enumerate(every.tolist()):
            for name, row in now.items():
                kept[name][i] = row
            forces = self._forces(scene, now, t)
            for name, row in now.items():
                row[3:5] += step * (
                    np.array(scene.gravity) + forces[name] / scene.bodies[name].mass
                )
                row[:2] += step * row[3:5]
        samples = slice(None, None, (len(every) - 1) // (len(times) - 1))
        states = {name: rows[samples] for name, rows in kept.items()}
        return Trajectory(times, states, {}, record=Trajectory(every, kept, {}) if record else None)

    def script(
        self,
        scene: Scene,
        start: Start,
        step: float,
        plan: Plan,
        *,
        title: str = "",
        duration: float = 1.0,
    ) -> str:
        """It has no files; what would head one."""
        return "".join(f"# {line}\n" for line in heading(self, title, step, plan))

    def _forces(self, scene: Scene, now: Mapping[str, Array], t: float) -> dict[str, Array]:
        """The force [N] on every particle but its gravity."""
        total = {name: np.zeros(2) for name in (*scene.bodies, GROUND)}

        def point(anchor: Anchor) -> tuple[Array, Array]:
            if anchor.body != GROUND:
                return now[anchor.body][:2], now[anchor.body][3:5]
            ground = scene.points[anchor.point]
            velocity = np.array(ground.velocity)
            return ground.at + velocity * t, velocity

        for force in scene.forces.values():
            if isinstance(force, Push):
                total[force.at.body] += value(force.signal, t)
            elif isinstance(force, Spring | Damper):
                (a, va), (b, vb) = point(force.a), point(force.b)
                length = float(np.hypot(*(b - a)))
                along = (b - a) / length
                pull = tension(force, length, float(along @ (vb - va))) * along
                total[force.a.body] += pull
                total[force.b.body] -= pull
        return total
