"""pymunk behind the protocol of `engines.engine`."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import pymunk

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Choice, Plan, Refusal, Start
from ..heading import heading
from . import settings
from .plans import named, plan, ways
from .read.measure import measured
from .read.record import Record
from .refuse import unbuildable
from .run import placed, simulate, stepper
from .scene import build
from .script import text


@dataclass(frozen=True)
class Pymunk:
    """pymunk with one setting: shipped, tuned, or own (`options`: the user's)."""

    setting: str
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "pymunk"
    version: str = pymunk.version
    offers: ClassVar[tuple[str, ...]] = ("shipped", "tuned")

    def __post_init__(self) -> None:
        settings.own(self.options)

    @property
    def own_step(self) -> float | None:
        """10 ms unless tuned or set by the user: pymunk has no step of its own."""
        return None if self._tuned else self.options.get("step", settings.SHIPPED_STEP)

    @property
    def _tuned(self) -> bool:
        return self.setting == "tuned"

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        """Natively; if tuned, dampers and dry friction also by their laws."""
        refusal = unbuildable(scene)
        if refusal:
            return [Refusal("native", refusal)]
        choices = self._choices(scene)
        return [
            plan(scene, start, way, choices, tuned=self._tuned)
            for way in ways(scene, tuned=self._tuned)
        ]

    def _choices(self, scene: Scene) -> list[Choice]:
        """The setting's numbers as attributes of pymunk's Space and constraints."""
        return settings.tuned(scene) if self._tuned else settings.with_own(self.options, scene)

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        """Physics as pymunk's objects hold it."""
        return measured(build(scene, start, named(self._choices(scene)), "native"))

    def script(
        self, scene: Scene, start: Start, step: float, plan: Plan, *, title: str = ""
    ) -> str:
        """A Python script that needs only pymunk."""
        numbers = named(plan.choices(step))
        return text(scene, start, step, numbers, heading(self, title, step, plan))

    def run(
        self,
        scene: Scene,
        start: Start,
        times: Array,
        step: float,
        plan: Plan,
        *,
        reactions: tuple[str, ...],
        record: bool = False,
    ) -> Trajectory:
        """The motion, by `space.step(h)` between samples."""
        numbers = named(plan.choices(step))
        world = placed(scene, start, step, numbers, plan.realised)
        readable = tuple(name for name in reactions if name not in plan.withheld)
        midpoint = bool(numbers.get("time.midpoint"))
        steps = stepper(world, step, numbers, plan.realised)
        kept = Record(world, steps, step, midpoint) if record else None
        run = kept.run if kept else steps
        motion = simulate(world, run, times, step, reactions=readable, midpoint=midpoint)
        return replace(motion, record=kept.trajectory()) if kept else motion

    def loop(self, scene: Scene, start: Start, step: float, plan: Plan) -> Callable[[int], None]:
        """pymunk's bare loop on the same world, with the same forces."""
        numbers = named(plan.choices(step))
        world = placed(scene, start, step, numbers, plan.realised)
        return stepper(world, step, numbers, plan.realised)
