"""What MuJoCo does with planar scenes, with one setting."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import mujoco

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Engine, Plain, Plan, Realised, Refusal, Start
from ..heading import heading
from .compilation import NOMINAL, compiled, lent, settled, timestep
from .plain import plain
from .plans import plan, ways
from .read.measure import measured
from .refuse import not_native, unbuildable, uncompilable
from .run import simulate
from .scene import mjcf
from .script import text
from .settings import tuned, with_own


@dataclass(frozen=True)
class Plane:
    """The verbs of `Engine` for a planar scene; engine: whose setting it is."""

    engine: Engine
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def _tuned(self) -> bool:
        return self.engine.setting == "tuned"

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        """Natively; with dry friction also by its law and by a driver, if tuned."""
        refusal = unbuildable(scene) or uncompilable(scene, start, self._plan(scene, start))
        if refusal:
            return [Refusal("native", refusal)]
        without = [Refusal("native", why) for why in not_native(scene)]
        if without and not self._tuned:
            return without
        found = (self._plan(scene, start, way) for way in ways(scene, start, tuned=self._tuned))
        return [*without, *found]

    def _plan(self, scene: Scene, start: Start, realised: Realised = "native") -> Plan:
        if self._tuned:
            numbers = partial(tuned, scene, start=start)
        else:
            numbers = partial(with_own, self.options, scene)
        return plan(scene, start, realised, numbers, tuned=self._tuned)

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        """Physics as the compiled model holds it."""
        return measured(scene, *compiled(scene, start, NOMINAL, self._plan(scene, start)))

    def bare(self, scene: Scene, start: Start) -> str:
        """The scene as MJCF, with no number of a setting."""
        return mjcf(scene, start, [timestep(NOMINAL)])

    def script(
        self, scene: Scene, start: Start, step: float, plan: Plan, *, title: str = ""
    ) -> str:
        """The MJCF file with its start as a keyframe."""
        choices = [timestep(step), *plan.choices(step)]
        model, *_ = self._placed(scene, start, step, plan)
        begun = model.key_qpos[0].tolist(), model.key_qvel[0].tolist()
        return text(scene, start, choices, begun, heading(self.engine, title, step, plan))

    def _placed(
        self, scene: Scene, start: Start, step: float, plan: Plan
    ) -> tuple[mujoco.MjModel, mujoco.MjData, Mapping[str, float]]:
        """As the script would be loaded: MuJoCo's floor gives way to a weight, so tuned settles."""
        if self._tuned:
            return settled(scene, start, step, plan)
        return *compiled(scene, start, step, plan), {}

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
        with lent(scene, start, step, plan, settles=self._tuned) as (model, data):
            return simulate(
                scene, model, data, start, times, reactions, realised=plan.realised, every=record
            )

    def plain(
        self, scene: Scene, start: Start, step: float, plan: Plan
    ) -> Callable[[float], Plain] | None:
        """`mj_step(model, data, n)` on the file of `show`, or our law's force before each step."""
        return plain(scene, start, plan, self.script(scene, start, step, plan))
