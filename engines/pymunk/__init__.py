"""pymunk behind the protocol of `engines.engine`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, ClassVar

import pymunk

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Cost, Plan, Realised, Refusal, Shape, Start
from ..heading import heading
from ..knobs import Knob, Options
from ..plain_shapes import CUBE, PLAIN, known_of, with_box, without_box
from .adapter import plans
from .adapter.claims import answered
from .adapter.plain_shapes import OURS, planned, refused, words
from .adapter.plans import numbers_by_name
from .adapter.refuse import why_not_native, why_unbuildable
from .adapter.script import text
from .callbacks.cut import cuts
from .callbacks.point_forces import states
from .model.plain_shapes import SHAPES
from .read.health import Left
from .read.measure import measured
from .read.record import Record
from .read.samples import sampled
from .settings import options
from .settings.knobs import STEPS, cost, knobs
from .settings.options import SHIPPED_STEP, own
from .settings.recipe import as_options, recipe
from .settings.snippet import snippet
from .stepping.run import placed, stepper
from .stepping.scene import FAR, build


@dataclass(frozen=True)
class Pymunk:
    """pymunk with one setting: shipped, tuned, or own (`options`: the user's)."""

    setting: str
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "pymunk"
    version: str = pymunk.version
    offers: ClassVar[tuple[str, ...]] = ("shipped", "tuned")
    steps: ClassVar[tuple[float, ...]] = STEPS

    def __post_init__(self) -> None:
        options.check(self.options)

    @property
    def own_step(self) -> float | None:
        """10 ms unless tuned or set by the user: pymunk has no step of its own."""
        return None if self._tuned else self.options.get("step", SHIPPED_STEP)

    @property
    def _tuned(self) -> bool:
        return self.setting == "tuned"

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        """Natively; if tuned, dampers, dry friction and edges by their laws, feet by a driver."""
        shape = self._shape
        refusal = why_unbuildable(scene) or (shape and refused(scene, shape, self.options))
        if refusal:
            return [Refusal("native", refusal)]
        without = [Refusal("native", why) for why in why_not_native(scene, start)]
        if without and not self._tuned:
            return without
        ways = plans.ways(scene, start) if self._tuned else ("native",)
        numbers = recipe(scene, start) if self._tuned else own(self.options, scene, start)
        shipped = self.setting == "shipped"
        built = [plans.plan(scene, start, way, numbers, shipped=shipped) for way in ways]
        return [
            *without,
            *(planned(plan, scene, start, shape) if shape else plan for plan in built),
        ]

    def pace(self, scene: Scene) -> float:
        """See `Paced`; measured on chains: sweeps grow by the square of the joints."""
        joints = len(scene.joints)
        if not self._tuned:
            sweeps = self.options.get("iterations", 10)
            if sweeps != options.BY_THE_SCENE:
                return 1e-6 * (20 + 0.02 * sweeps * joints)
        return 1e-6 * (20 + 0.17 * joints**2.5)

    def knobs(self, scene: Scene, start: Start) -> list[Knob]:
        """See `Tunable`."""
        return knobs(scene, start)

    def recipe(self, scene: Scene, start: Start) -> Options:
        """See `Tunable`."""
        return as_options(scene, start)

    def cost(self, scene: Scene, start: Start) -> Cost:
        """See `Tunable`."""
        return cost(scene, start)

    def shapes(self, scene: Scene, start: Start) -> list[Shape]:
        """See `Plain`: a `Poly` or a `Circle`."""
        return [
            Shape(words(scene, start, shape), {"shapes": shape})
            for shape in (PLAIN, CUBE)
            if not refused(scene, shape, {})
        ]

    @property
    def _shape(self) -> str:
        """Which of a user's models it builds, as the option `shapes` says; empty: ours."""
        return self.options.get("shapes", "")

    def own_contacts(self, scene: Scene) -> str:
        """See `Plain`."""
        return OURS if scene.pressed else ""

    def snippet(self, scene: Scene, start: Start, options: Options, step: float) -> str:
        """Lines of Python for a script with a `space`, as users write it."""
        timed = any(law.law != "constant" for law in scene.laws())
        return snippet(own(options, scene, start)(step), step, timed=timed)

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        """Physics as pymunk's objects hold it, with which no number of a setting has to do."""
        if not self._shape:
            return measured(build(scene, start, {}, "native"))
        world = build(*with_box(scene, start, self._shape), {SHAPES: self._shape}, "native")
        return known_of(scene, measured(world))

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> dict[str, Array | str]:
        """By the objects of one space, whatever the setting: no number of one plays a part."""
        return answered(build(scene, start, {}, "native"), states, wanted)

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
        """A Python script that needs only pymunk."""
        numbers = numbers_by_name(plan.choices(step))
        options = self.recipe(scene, start) if self._tuned and plan.realised == "native" else {}
        head = heading(self, title, step, plan, options)
        if self._shape:
            scene, start = with_box(scene, start, self._shape)
        return text(scene, start, step, numbers, head, duration)

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
        """The motion, by `space.step(h)` between samples; once more where the floor was short."""
        numbers = numbers_by_name(plan.choices(step))
        wanted = tuple(name for name in reactions if name not in plan.withheld)
        shape = self._shape
        built, begun = with_box(scene, start, shape) if shape else (scene, start)
        again = partial(_run, built, begun, times, step, plan.realised, wanted, record)
        try:
            motion = again(numbers)
        except Left:
            motion = again(numbers | {"ground.reach": FAR})
        return without_box(scene, motion, shape) if shape else motion


def _run(
    scene: Scene,
    start: Start,
    times: Array,
    step: float,
    realised: Realised,
    wanted: tuple[str, ...],
    record: bool,
    numbers: Mapping[str, Any],
) -> Trajectory:
    world = placed(scene, start, step, numbers, realised)
    felt = tuple(name for name in wanted if name not in scene.inner())
    felt_by = {*scene.contacts, *scene.pairs, *world.limits}
    touching = tuple(name for name in felt if name.rpartition(".")[0] in felt_by)
    midpoint = bool(numbers.get("time.midpoint"))
    kept = Record(world, step, midpoint, touching, cuts(scene)) if record else None
    steps = stepper(world, step, numbers, realised, kept and kept.keep)
    motion = sampled(world, steps, times, step, numbers, reactions=felt)
    motion = replace(motion, reactions={**motion.reactions, **states(world, times, step)})
    return replace(motion, record=kept.trajectory()) if kept else motion
