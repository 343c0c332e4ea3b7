"""A sound engine behind an adapter with one mistake, as people who write one make them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import degrees
from typing import Any, ClassVar

import numpy as np

from textmech.cases.scene import Scene
from textmech.cases.scene.rotation import turned
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines import make
from textmech.engines.engine import Engine, Plan, Refusal, Start

Rows = Callable[[Array], Array]


def columns(by: float, *names: str) -> Rows:
    """Columns of the plane times a number."""
    place = ("x", "y", "angle", "vx", "vy", "omega")
    return lambda rows: rows * [by if name in names else 1.0 for name in place]


def wound(rows: Array) -> Array:
    rows = rows.copy()
    rows[:, 2] = (rows[:, 2] + np.pi) % (2 * np.pi) - np.pi
    return rows


def scalar_last(rows: Array) -> Array:
    return rows[:, [0, 1, 2, 4, 5, 6, 3, *range(7, 13)]]


def in_ground_axes(rows: Array) -> Array:
    return np.hstack([rows[:, :10], turned(rows[:, 3:7], rows[:, 10:])])


READ: dict[str, Rows] = {
    "y down": columns(-1, "y", "vy", "angle", "omega"),
    "y and vy down": columns(-1, "y", "vy"),
    "clockwise": columns(-1, "angle", "omega"),
    "omega clockwise": columns(-1, "omega"),
    "degrees": columns(degrees(1), "angle", "omega"),
    "degrees a second": columns(degrees(1), "omega"),
    "wound": wound,
    "scalar last": scalar_last,
    "omega in ground axes": in_ground_axes,
    "nan": lambda rows: rows * np.nan,
}
"""What is read wrongly of every body."""


def otherwise(section: str, **changed: Any) -> Callable[[Scene], Scene]:
    """Every element of a section with other fields."""

    def made(scene: Scene) -> Scene:
        elements = {name: replace(one, **changed) for name, one in getattr(scene, section).items()}
        return replace(scene, **{section: elements})

    return made


def pushed_back(scene: Scene) -> Scene:
    hand: Any = scene.forces["hand"]
    back = replace(hand.signal, amplitude=tuple(-a for a in hand.signal.amplitude))
    return replace(scene, forces={**scene.forces, "hand": replace(hand, signal=back)})


def about_ends(scene: Scene) -> Scene:
    heavier = {n: replace(body, inertia=(body.about("start"),)) for n, body in scene.bodies.items()}
    return replace(scene, bodies=heavier)


TOLD: dict[str, Callable[[Scene], Scene]] = {
    "gravity up": lambda scene: replace(scene, gravity=tuple(-g for g in scene.gravity)),
    "no gravity": lambda scene: replace(scene, gravity=tuple(0.0 for _ in scene.gravity)),
    "pushed back": pushed_back,
    "no forces": lambda scene: replace(scene, forces={}),
    "inertia about an end": about_ends,
    "no friction": otherwise("contacts", static=0.0, kinetic=0.0),
    "bounces for ever": otherwise("contacts", restitution=1.0),
}
"""What the engine is told wrongly of the scene."""

NUMBERS: dict[str, Callable[[str, float], float]] = {
    "energy twice": lambda name, x: 2 * x if name.startswith("energy") else x,
    "inertia about the pin": lambda name, x: 4 * x if name.endswith("inertia") else x,
    "grams": lambda name, x: 1e3 * x if name.endswith("mass") else x,
}
"""What it reads back wrongly: of a bar J + m (l/2)² is 4 J."""


@dataclass(frozen=True)
class Mistaken:
    """The best setting of an engine of ours, and a mistake."""

    mistake: str = ""
    inner: str = "mujoco"
    setting: str = "tuned"
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "mistaken"
    version: str = "1.0"
    own_step: float | None = None
    offers: ClassVar[tuple[str, ...]] = ("tuned",)

    @property
    def engine(self) -> Engine:
        return make(self.inner, "tuned")

    def _told(self, scene: Scene) -> Scene:
        return TOLD.get(self.mistake, lambda scene: scene)(scene)

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        found = self.engine.plans(self._told(scene), start)
        if self.mistake == "lambda":
            return [replace(found[0], protocol=lambda step: "")]  # type: ignore[arg-type]
        return found

    def measure(self, scene: Scene, start: Start) -> Mapping[str, float]:
        found, change = self.engine.measure(scene, start), NUMBERS.get(self.mistake)
        return {name: change(name, x) for name, x in found.items()} if change else found

    def run(
        self, scene: Scene, start: Start, times: Array, step: float, plan: Plan,
        *, reactions: tuple[str, ...], record: bool = False,
    ) -> Trajectory:  # fmt: skip
        if self.mistake == "at rest":
            start = {name: (*row[:3], 0.0, 0.0, 0.0) for name, row in start.items()}
        scene = self._told(scene)
        found = self.engine.run(scene, start, times, step, plan, reactions=reactions, record=True)
        if self.mistake in ("late", "velocities late"):
            found = self._late(found, step)
        elif self.mistake == "ends":
            found = replace(found, states={n: _ends(scene, n, s) for n, s in found.states.items()})
        elif self.mistake == "forces":
            found = replace(found, reactions={n: -rows for n, rows in found.reactions.items()})
        elif self.mistake == "no forces told":
            found = replace(found, reactions={})
        elif self.mistake == "short record":
            found = replace(found, record=replace(found, record=None))
        elif self.mistake in READ:
            change = READ[self.mistake]
            found = replace(found, states={n: change(rows) for n, rows in found.states.items()})
        return found

    def _late(self, found: Trajectory, step: float) -> Trajectory:
        assert found.record is not None
        at = np.round(found.times / step).astype(int)
        then = {name: rows[np.maximum(at - 1, 0)] for name, rows in found.record.states.items()}
        if self.mistake == "late":
            return replace(found, states=then)
        half = {name: (rows + then[name]) / 2 for name, rows in found.states.items()}
        mixed = {n: np.hstack([rows[:, :3], half[n][:, 3:]]) for n, rows in found.states.items()}
        return replace(found, states=mixed)

    def script(self, *_: Any, **__: Any) -> str:
        return "pass\n"


def _ends(scene: Scene, name: str, states: Array) -> Array:
    """The states of the body's first end in place of its centre of mass."""
    end = scene.bodies[name].point(states, "start")
    return np.hstack([end[:, :2], states[:, 2:3], end[:, 2:], states[:, 5:]])
