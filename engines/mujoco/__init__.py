"""MuJoCo behind the protocol of `engines.engine`: the door to scenes of the plane and of space."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import mujoco

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Plain, Plan, Refusal, Start
from . import options, settings
from .claims import answered
from .plane import Plane
from .space.world import Space

_WORLDS: Mapping[int, type[Any]] = {2: Plane, 3: Space}
"""By the dimension of the scene's frame."""


@dataclass(frozen=True)
class MuJoCo:
    """MuJoCo with one setting: shipped, tuned, or own (`options`: the user's)."""

    setting: str
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "mujoco"
    version: str = mujoco.__version__
    offers: ClassVar[tuple[str, ...]] = ("shipped", "tuned")

    def __post_init__(self) -> None:
        options.check(self.options)

    @property
    def own_step(self) -> float | None:
        """2 ms, MuJoCo's default, unless tuned or set by the user."""
        tuned = self.setting == "tuned"
        return None if tuned else self.options.get("step", settings.SHIPPED_STEP)

    def _world(self, scene: Scene) -> Any:
        return _WORLDS[scene.frame.dimension](self, self.options)

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        """Natively; in the plane, with dry friction, also by its law and by a driver, if tuned."""
        return self._world(scene).plans(scene, start)

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        """Physics as the compiled model holds it."""
        return self._world(scene).measure(scene, start)

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> dict[str, Array | str]:
        """By `mj_inverse` and its sensors, whatever the setting: no number of one plays a part."""
        return answered(scene, self._world(scene).bare(scene, start), states, wanted)

    def script(
        self, scene: Scene, start: Start, step: float, plan: Plan, *, title: str = ""
    ) -> str:
        """The MJCF file with its start as a keyframe."""
        return self._world(scene).script(scene, start, step, plan, title=title)

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
        return self._world(scene).run(
            scene, start, times, step, plan, reactions=reactions, record=record
        )

    def plain(
        self, scene: Scene, start: Start, step: float, plan: Plan
    ) -> Callable[[float], Plain] | None:
        """`mj_step(model, data, n)` on the file of `show`, or our law's force before each step."""
        return self._world(scene).plain(scene, start, step, plan)
