"""MuJoCo behind the protocol of `engines.engine`: the door to scenes of the plane and of space."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import mujoco

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Plan, Realised, Refusal, Start
from ..heading import heading
from ..knobs import Knob, Options
from .adapter.compilation import NOMINAL, timestep
from .adapter.inverse_dynamics import answered
from .adapter.plane import PLANE
from .adapter.refuse import not_native, uncompilable
from .adapter.space.world import SPACE
from .adapter.world import World
from .model.rods import of_scene
from .model.script import commented, controls, drawn
from .settings import options, settings
from .settings.knobs import STEPS, cost, knobs
from .settings.snippet import option_notes, snippet
from .settings.user_options import as_options, unfit

_WORLDS: Mapping[int, World] = {2: PLANE, 3: SPACE}
"""By the dimension of the scene's frame."""


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

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        """Natively; edges, dry friction and corners of springs in other ways too, if tuned."""
        world = _world(scene)
        scene, start = world.built(scene, start)
        refusal = (
            world.unbuildable(scene)
            or unfit(self.options, list(world.recipes), world.worth(scene))
            or uncompilable(world.compiled, scene, start, self._plan(scene, start))
        )
        if refusal:
            return [Refusal("native", refusal)]
        without = [Refusal("native", why) for why in not_native(scene)]
        if without and not self._tuned:
            return without
        ways = world.ways(scene, start, tuned=self._tuned)
        return [*without, *(self._plan(scene, start, way) for way in ways)]

    def pace(self, scene: Scene) -> float:
        """See `Paced`; measured, an edge's law in Python with it."""
        return 1e-6 * (25 + 1.5 * len(scene.bodies) + 200 * len(scene.constraints))

    def _plan(self, scene: Scene, start: Start, realised: Realised = "native") -> Plan:
        world = _world(scene)
        if self._tuned:
            numbers = partial(world.tuned, scene, start=start)
        else:
            why = {"because": settings.GUIDE} if self._recommended else {}
            numbers = partial(world.with_own, self.options, scene, start, **why)
        return world.plan(scene, start, realised, numbers, settles=self._settles, tuned=self._tuned)

    def knobs(self, scene: Scene, start: Start) -> list[Knob]:
        """See `Tunable`."""
        world = _world(scene)
        scene, start = world.built(scene, start)
        bundles = {word: world.recipes[word](scene) for word in world.worth(scene)}
        best, lies = world.best(scene, start), world.closed(scene, start)
        rubs = any(contact.friction for contact in world.met(scene))
        return knobs(best, world.soft(scene), bundles, lies=lies, rubs=rubs)

    def recipe(self, scene: Scene, start: Start) -> Options:
        """See `Tunable`."""
        world = _world(scene)
        scene, start = world.built(scene, start)
        return as_options(world.best(scene, start), settled=world.closed(scene, start))

    def cost(self, options: Options, step: float, scene: Scene) -> float:
        """Evaluations of the dynamics in a simulated second: steps × stages."""
        return cost(options, step)

    def snippet(self, scene: Scene, start: Start, options: Options, step: float) -> str:
        """Elements of an MJCF file in which geoms touch, as users write them."""
        world = _world(scene)
        scene, start = world.built(scene, start)
        with_own = partial(world.with_own, scene=scene, start=start, tied_to=step)
        notes = option_notes(options, contacts=bool(world.worth(scene)), plane=world is PLANE)
        rubs = max((contact.friction for contact in world.met(scene)), default=None)
        return snippet(with_own(options), with_own({}), step, notes, friction=rubs)

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        """Physics as the compiled model holds it."""
        world = _world(scene)
        built, begun = world.built(scene, start)
        model = world.compiled(built, begun, NOMINAL, self._plan(built, begun))
        lent = built.bodies.keys() - scene.bodies
        found = world.measured(built, *model)
        return {name: x for name, x in found.items() if name.partition(".")[0] not in lent}

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> dict[str, Array | str]:
        """By `mj_inverse` and its sensors, whatever the setting: no number of one plays a part."""
        bare = _world(scene).mjcf(scene, start, [timestep(NOMINAL)])
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
        head, model = self._script(scene, start, step, plan, title=title)
        return head + commented([begins]) + drawn(model, *_world(scene).built(scene, start))

    def _script(
        self, scene: Scene, start: Start, step: float, plan: Plan, *, title: str = ""
    ) -> tuple[str, str]:
        """The comments, and the file without anything that is only seen."""
        world, choices = _world(scene), [timestep(step), *plan.choices(step)]
        options = self.recipe(scene, start) if self._tuned and plan.realised == "native" else {}
        scene, start = world.built(scene, start)
        model, *_ = world.placed(scene, start, step, plan, settles=self._settles)
        begun = model.key_qpos[0].tolist(), model.key_qvel[0].tolist()
        head = commented(heading(self, title, step, plan, options)) + controls(
            model, world.signals(scene)
        )
        return head, world.mjcf(scene, start, choices, begun)

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
        world, realised = _world(scene), plan.realised
        built, begun = world.built(scene, start)
        with world.lent(built, begun, step, plan, settles=self._settles) as lent:
            found = world.simulate(
                built, *lent, begun, times, reactions, realised=realised, every=record
            )
        return of_scene(scene, found)


def _world(scene: Scene) -> World:
    return _WORLDS[scene.frame.dimension]
