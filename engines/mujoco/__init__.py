"""MuJoCo behind the protocol of `engines.engine`, for scenes of the plane and of space."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import mujoco

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Cost, Plan, Realised, Refusal, Shape, Start
from ..heading import heading
from ..knobs import Knob, Options
from ..plain_shapes import CYLINDER, SHAPES, with_box
from .adapter import plain_shapes
from .adapter.compilation import NOMINAL, compiled, lent, placed, timestep
from .adapter.inverse_dynamics import answered
from .adapter.plans import plan, ways
from .adapter.refuse import uncompilable, why_not_native, why_unbuildable
from .adapter.run import simulate
from .model.contact import closed, recipes, worth
from .model.drive import controls
from .model.number_text import attributes, of_one
from .model.planes import met
from .model.rods import of_scene, with_rods
from .model.scene import mjcf
from .model.script import commented, control_script, drawn
from .read.measure import measured
from .settings import options, settings
from .settings.knobs import STEPS, cost, knobs
from .settings.options import as_options, why_recipe_unfit
from .settings.snippet import option_notes, snippet


@dataclass(frozen=True)
class MuJoCo:
    """MuJoCo with one setting: shipped, recommended, tuned, or own (`options`: the user's)."""

    setting: str
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "mujoco"
    version: str = mujoco.__version__
    offers: ClassVar[tuple[str, ...]] = ("shipped", "recommended", "tuned")
    steps: ClassVar[tuple[float, ...]] = STEPS

    def __post_init__(self) -> None:
        if self._recommended:
            object.__setattr__(self, "options", settings.RECOMMENDED)
        options.check(self.options)

    @property
    def own_step(self) -> float | None:
        """2 ms, MuJoCo's default, unless tuned or set by the user."""
        return None if self._tuned else self.options.get("step", settings.SHIPPED_STEP)

    @property
    def _tuned(self) -> bool:
        return self.setting == "tuned"

    @property
    def _recommended(self) -> bool:
        return self.setting == "recommended"

    @property
    def _settles(self) -> bool:
        return self._tuned or bool(self.options.get("settled"))

    @property
    def _shape(self) -> str:
        """Which of a user's models it builds, as the option `shapes` says; empty: ours."""
        return self.options.get("shapes", "")

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        """Natively; if tuned, edges and dry friction also by their laws, feet by a driver."""
        scene, start = with_rods(scene, start)
        refusal = (
            why_unbuildable(scene)
            or why_recipe_unfit(self.options, list(recipes(scene)), worth(scene))
            or (self._shape and plain_shapes.refused(scene, self._shape, self.options))
            or uncompilable(scene, start, self._plan(scene, start))
        )
        if refusal:
            return [Refusal("native", refusal)]
        without = [Refusal("native", why) for why in why_not_native(scene)]
        if without and not self._tuned:
            return without
        each = ways(scene, start, tuned=self._tuned)
        return [*without, *(self._plan(scene, start, way) for way in each)]

    def pace(self, scene: Scene) -> float:
        """See `Paced`; measured, an edge's law in Python with it."""
        return 1e-6 * (25 + 1.5 * len(scene.bodies) + 200 * len(scene.constraints))

    def _plan(self, scene: Scene, start: Start, realised: Realised = "native") -> Plan:
        if self._tuned:
            numbers = partial(settings.tuned, scene, start=start)
        else:
            why = {"because": settings.GUIDE} if self._recommended else {}
            numbers = partial(settings.with_own, self.options, scene, start, **why)
        decided = plan(scene, start, realised, numbers, settles=self._settles, tuned=self._tuned)
        return plain_shapes.planned(decided, scene, start, self._shape) if self._shape else decided

    def knobs(self, scene: Scene, start: Start) -> list[Knob]:
        """See `Tunable`."""
        return knobs(*self._built(scene, start))

    def recipe(self, scene: Scene, start: Start) -> Options:
        """See `Tunable`."""
        scene, start = self._built(scene, start)
        return as_options(settings.best(scene, start), settled=closed(scene, start))

    def _built(self, scene: Scene, start: Start) -> tuple[Scene, Start]:
        """The scene as its numbers are chosen for: with what stands for particles or distances."""
        return with_box(scene, start, self._shape) if self._shape else with_rods(scene, start)

    def cost(self, scene: Scene, start: Start) -> Cost:
        """Evaluations of the dynamics in a simulated second: steps × stages."""
        return cost

    def shapes(self, scene: Scene, start: Start) -> list[Shape]:
        """See `Plain`: a geom with a free joint; a disk that lies as a cylinder is another body."""
        return [
            Shape(
                plain_shapes.words(scene, start, shape), {"shapes": shape}, held=shape != CYLINDER
            )
            for shape in SHAPES
            if not plain_shapes.refused(scene, shape, {})
        ]

    def own_contacts(self, scene: Scene) -> str:
        """See `Plain`."""
        return plain_shapes.OURS[scene.frame] if met(scene) else ""

    def snippet(self, scene: Scene, start: Start, options: Options, step: float) -> str:
        """Elements of an MJCF file in which geoms touch, as users write them."""
        bodies, shape = scene.bodies, options.get("shapes")
        touching = Counter(contact.body for contact in met(scene))
        points = max(touching.values(), default=0)
        if shape:
            points = plain_shapes.points(scene, shape)
            scene, start = with_box(scene, start, shape)
        scene, start = with_rods(scene, start)
        with_own = partial(settings.with_own, scene=scene, start=start, tied_to=step)
        notes = option_notes(options, scene, [name for name in scene.bodies if name not in bodies])
        frictions = {contact.name: contact.friction for contact in met(scene)}
        return snippet(
            with_own(options), with_own({}), step, notes, frictions=frictions, points=points
        )

    def _plain(self, scene: Scene, start: Start, step: float, plan: Plan) -> str:
        """A user's model, behind what is pasted of the plan's numbers."""
        shipped = settings.with_own({}, scene, start, step)
        choices = plan.choices(step)
        pasted = snippet(choices, shipped, step, [], frictions={})
        numbers = {choice.name: choice.value for choice in choices}
        alone = {name: attributes(numbers, of_one(name)) for name in scene.contacts}
        return plain_shapes.plain_mjcf(scene, start, self._shape, pasted, alone)

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        """Physics as the compiled model holds it."""
        if self._shape:
            plan = self._plan(scene, start)
            return plain_shapes.measured(scene, self._plain(scene, start, NOMINAL, plan))
        built, begun = with_rods(scene, start)
        model, data = compiled(built, begun, NOMINAL, self._plan(built, begun))
        bars = built.bodies.keys() - scene.bodies
        numbers = measured(built, model, data)
        return {name: x for name, x in numbers.items() if name.partition(".")[0] not in bars}

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> dict[str, Array | str]:
        """By `mj_inverse` and its sensors, whatever the setting: no number of one plays a part."""
        bare = mjcf(scene, start, [timestep(NOMINAL)])
        return answered(scene, bare, states, wanted)

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
        """The MJCF file with its start as a keyframe, headed by comments, and shapes to be seen."""
        runs = f"{round(duration / step)} steps are {duration:g} s"
        begins = f"the start is its keyframe: mj_resetDataKeyframe(model, data, 0); {runs}"
        if self._shape:
            head = commented([*heading(self, title, step, plan, {}), begins])
            return head + self._plain(scene, start, step, plan)
        head, model = self._script(scene, start, step, plan, title=title)
        return head + commented([begins]) + drawn(model, *with_rods(scene, start))

    def _script(
        self, scene: Scene, start: Start, step: float, plan: Plan, *, title: str = ""
    ) -> tuple[str, str]:
        """The comments, and the file without anything that is only seen."""
        choices = [timestep(step), *plan.choices(step)]
        options = self.recipe(scene, start) if self._tuned and plan.realised == "native" else {}
        scene, start = with_rods(scene, start)
        model, *_ = placed(scene, start, step, plan, settles=self._settles)
        begun = model.key_qpos[0].tolist(), model.key_qvel[0].tolist()
        head = commented(heading(self, title, step, plan, options)) + control_script(
            model, controls(scene)
        )
        return head, mjcf(scene, start, choices, begun)

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
        """The motion, stepped by `mj_step(model, data, n)` between samples or steps."""
        if self._shape:
            text = self._plain(scene, start, step, plan)
            wanted = tuple(name for name in reactions if name not in plan.withheld)
            return plain_shapes.run(scene, start, times, self._shape, text, wanted, record=record)
        built, begun = with_rods(scene, start)
        with lent(built, begun, step, plan, settles=self._settles) as (model, data):
            motion = simulate(
                built, model, data, begun, times, reactions, realised=plan.realised, every=record
            )
        return of_scene(scene, motion)
