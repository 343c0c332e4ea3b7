"""pymunk behind the protocol of `engines.engine`."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import pymunk

from ...cases.scene import GROUND, Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Choice, Realised, State
from . import settings
from .contact import closed
from .law.friction import ruled
from .read.measure import measured
from .read.record import Record
from .run import placed, simulate, stepper
from .scene import build, oblique
from .script import text


@dataclass(frozen=True)
class Pymunk:
    """pymunk with one setting: shipped, tuned, or own (`options`: the user's)."""

    setting: str
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "pymunk"
    version: str = pymunk.version
    comment: tuple[str, str] = ("# ", "")

    def __post_init__(self) -> None:
        settings.own(self.options)

    @property
    def own_step(self) -> float | None:
        """10 ms unless tuned or set by the user: pymunk has no step of its own."""
        return None if self.setting == "tuned" else self.options.get("step", settings.SHIPPED_STEP)

    def realisations(self, scene: Scene) -> tuple[Realised, ...]:
        """Dampers also by their law: pymunk applies its own after the kick, a first order.

        Dry friction too: pymunk's has one bound, where the textbook's has up to four.
        """
        law = any(scene.dampers()) or ruled(scene)
        return ("native", "law") if law and self.setting == "tuned" else ("native",)

    def refuses(self, scene: Scene) -> str | None:
        """What would abort the process, or what pymunk has no joint or no shape for."""
        for body in scene.bodies.values():
            inertia = 1.0 if body.inertia is None else body.inertia
            if not (0 < body.mass < math.inf and 0 < inertia < math.inf):
                return f"engine: pymunk takes only positive finite masses, {body.name} has none"
        for part in (*scene.joints.values(), *scene.springs(), *scene.dampers()):
            if part.a.body == part.b.body:
                where = "the ground" if part.a.body == GROUND else part.a.body
                return f"engine: {part.name} joins {where} to itself, on which pymunk aborts"
        for joint in scene.joints.values():
            first = joint.a.body
            if (
                (joint.shifts or not joint.turns)
                and first != GROUND
                and not scene.bodies[first].turns
            ):
                return f"adapter: {joint.name} starts at a particle, which has no axes"
        return None

    def withholds(self, scene: Scene, quantity: str) -> str | None:
        """A constraint's impulse has no direction."""
        part, _, what = quantity.rpartition(".")
        if part in scene.joints and what in ("fx", "fy", "torque", "friction"):
            return "engine: pymunk reports a joint's impulse as a magnitude only"
        return None

    def tied(self, scene: Scene) -> bool:
        """Nothing in the recipe follows the step but the protocol itself."""
        return False

    def exponents(self, scene: Scene, realised: Realised, *, held: bool) -> tuple[int, ...]:
        """Symplectic Euler 1, 2; the midpoint protocol 2, 3, except where pymunk spoils it.

        An impact, and a part that turns back without a rest, take whole steps: measured, 1.
        """
        damped = realised == "native" and any(damper.damping for damper in scene.dampers())
        rubbed = realised == "native" and any(j.dry_friction for j in scene.joints.values())
        met = realised == "native" and any(c.switches for c in scene.contacts.values())
        oblique_slide = any(oblique(scene, joint) for joint in scene.joints.values())
        spoilt = damped or rubbed or met or oblique_slide
        return (2, 3) if self.setting == "tuned" and not spoilt else (1, 2)

    def protocol(self, scene: Scene, start: State, step: float, realised: Realised) -> str:
        """The half step along the velocities, and how deep a contact is started in the floor."""
        numbers = self._numbers(scene, step)
        words = []
        if numbers.get("time.midpoint"):
            words.append(f"started {step / 2:g} s back, positions read {step / 2:g} s ahead")
        if numbers.get("start.seed") and (touching := closed(scene, start)):
            bodies = ", ".join(dict.fromkeys(contact.body for contact in touching))
            words.append(f"{bodies} started {numbers['start.seed']:g} m in the floor")
        return "; ".join(words)

    def choices(self, scene: Scene, step: float) -> list[Choice]:
        """The setting's numbers as attributes of pymunk's Space and constraints."""
        if self.setting == "tuned":
            return settings.tuned(scene)
        return settings.with_own(self.options, scene)

    def _numbers(self, scene: Scene, step: float) -> dict[str, Any]:
        return {choice.name: choice.value for choice in self.choices(scene, step)}

    def script(self, scene: Scene, start: State, step: float) -> str:
        """A Python script that needs only pymunk."""
        return text(scene, start, step, self._numbers(scene, step))

    def measure(self, scene: Scene, start: State) -> dict[str, float]:
        """Physics as pymunk's objects hold it."""
        return measured(build(scene, start, self._numbers(scene, 1.0), "native"))

    def run(
        self,
        scene: Scene,
        start: State,
        times: Array,
        step: float,
        *,
        tied_to: float,
        realised: Realised,
        reactions: tuple[str, ...],
        record: bool = False,
    ) -> Trajectory:
        """The motion, by `space.step(h)` between samples."""
        numbers = self._numbers(scene, tied_to)
        world = placed(scene, start, step, numbers, realised)
        readable = tuple(name for name in reactions if not self.withholds(scene, name))
        midpoint = bool(numbers.get("time.midpoint"))
        steps = stepper(world, step, numbers, realised)
        kept = Record(world, steps, step, midpoint) if record else None
        run = kept.run if kept else steps
        motion = simulate(world, run, times, step, reactions=readable, midpoint=midpoint)
        return replace(motion, record=kept.trajectory()) if kept else motion

    def prepare(
        self, scene: Scene, start: State, step: float, *, realised: Realised
    ) -> Callable[[int], None]:
        """pymunk's bare loop on the same world, with the same forces."""
        numbers = self._numbers(scene, step)
        return stepper(placed(scene, start, step, numbers, realised), step, numbers, realised)
