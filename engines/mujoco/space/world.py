"""What MuJoCo does with scenes in space, with one setting."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from ....cases.space.scene import SpatialScene
from ....cases.trajectory import Array, Trajectory
from ...engine import Engine, Plan, Refusal, Start
from ...heading import heading
from ..compilation import NOMINAL, timestep
from ..refuse import NO_EDGE
from ..script import commented
from .compilation import compiled, placed
from .plans import plan
from .read.measure import measured
from .refuse import unbuildable, uncompilable
from .run import simulate
from .scene import mjcf
from .settings import tuned, with_own


@dataclass(frozen=True)
class Space:
    """The verbs of `Engine` for a `SpatialScene`; engine: whose setting it is."""

    engine: Engine
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def _tuned(self) -> bool:
        return self.engine.setting == "tuned"

    def plans(self, scene: SpatialScene, start: Start) -> Sequence[Plan | Refusal]:
        """Natively, or why not; edges by our law, if tuned."""
        refusal = unbuildable(scene) or uncompilable(scene, start, self._plan(scene, start))
        if refusal:
            return [Refusal("native", refusal)]
        without = [Refusal("native", NO_EDGE)] if scene.constraints else []
        return without if without and not self._tuned else [*without, self._plan(scene, start)]

    def _plan(self, scene: SpatialScene, start: Start) -> Plan:
        own = partial(with_own, self.options, scene)
        numbers = partial(tuned, scene) if self._tuned else own
        return plan(scene, start, numbers, tuned=self._tuned)

    def measure(self, scene: SpatialScene, start: Start) -> dict[str, float]:
        """Physics as the compiled model holds it."""
        return measured(scene, *compiled(scene, start, NOMINAL, self._plan(scene, start)))

    def bare(self, scene: SpatialScene, start: Start) -> str:
        """The scene as MJCF, with no number of a setting."""
        return mjcf(scene, start, [timestep(NOMINAL)])

    def script(
        self, scene: SpatialScene, start: Start, step: float, plan: Plan, *, title: str = ""
    ) -> str:
        """The MJCF file with its start as a keyframe."""
        choices = [timestep(step), *plan.choices(step)]
        model, *_ = placed(scene, start, step, plan, settles=self._tuned)
        begun = model.key_qpos[0].tolist(), model.key_qvel[0].tolist()
        text = mjcf(scene, start, choices, begun)
        return commented(heading(self.engine, title, step, plan)) + text

    def run(
        self,
        scene: SpatialScene,
        start: Start,
        times: Array,
        step: float,
        plan: Plan,
        *,
        reactions: tuple[str, ...],
        record: bool = False,
    ) -> Trajectory:
        """The motion, stepped by `mj_step(model, data, n)` between samples or steps."""
        model, data, _ = placed(scene, start, step, plan, settles=self._tuned)
        return simulate(scene, model, data, start, times, reactions, every=record)

    def plain(self, scene: SpatialScene, start: Start, step: float, plan: Plan) -> None:
        """Nobody has written it for space."""
