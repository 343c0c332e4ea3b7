"""MuJoCo behind the protocol of `engines.engine`."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import mujoco

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Choice, Realised, State
from . import options, settings
from .contact import falls
from .law.friction import followed, smooth_only
from .law.settle import settle
from .law.signal import signals
from .law.smooth import smooth
from .law.stepping import stepping
from .read.measure import measured
from .refuse import unbuildable, uncompilable
from .run import heard, load, simulate
from .scene import HEAVY, mjcf
from .tree import driven


@dataclass(frozen=True)
class MuJoCo:
    """MuJoCo with one setting: shipped, tuned, or own (`options`: the user's)."""

    setting: str
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "mujoco"
    version: str = mujoco.__version__
    comment: tuple[str, str] = ("<!-- ", " -->")

    def __post_init__(self) -> None:
        options.check(self.options)

    @property
    def own_step(self) -> float | None:
        """2 ms, MuJoCo's default, unless tuned or set by the user."""
        return None if self.setting == "tuned" else self.options.get("step", settings.SHIPPED_STEP)

    def realisations(self, scene: Scene) -> tuple[Realised, ...]:
        """MuJoCo's own elements; dry friction, of which it knows one number, in other ways too."""
        if self.setting != "tuned" or not followed(scene):
            return ("native",)
        return ("native", "law") if smooth_only(scene) else ("native", "law", "driver")

    def refuses(self, scene: Scene) -> str | None:
        """What MuJoCo has no element for, the adapter does not build, or the compiler refuses."""
        return unbuildable(scene) or uncompilable(scene, self.choices(scene, 1e-3))

    def withholds(self, scene: Scene, quantity: str) -> str | None:
        """Nothing: a joint's force and moment and a contact's force can all be read."""
        return None

    def tied(self, scene: Scene) -> bool:
        """The soft constraints of the tuned recipe follow the step."""
        return self.setting == "tuned" and settings.ties(scene)

    def exponents(self, scene: Scene, realised: Realised, *, held: bool) -> tuple[int, ...]:
        """Euler, contacts, corners of dry friction 1, 2; RK4 4, 5; constraints that follow 2, 3."""
        integrator = {c.name: c.value for c in self.choices(scene, 1e-3)}["option.integrator"]
        dry = any(joint.dry_friction for joint in scene.joints.values())
        if integrator != "RK4" or scene.contacts or (dry and realised != "driver"):
            return (1, 2)
        return (4, 5) if held or dry or not self.tied(scene) else (2, 3)

    def protocol(self, scene: Scene, start: State, step: float, realised: Realised) -> str:
        """Driven points, and how deep a disk is started in the floor."""
        words = []
        if any(driven(scene)):
            words.append(f"driven points are masses of {HEAVY:g} kg")
        if realised == "law":
            when = "stage" if smooth_only(scene) else "step"
            words.append(f"dry friction by our law before every {when}")
        if realised == "driver":
            words.append("steps cut at the events of dry friction")
        if self.setting == "tuned" and falls(scene, start):
            words.append("starts above the floor: contacts are tuned for impacts")
        depths = self._depths(scene, start, *self._loaded(scene, start, step, step))
        words += [f"{name} started {depth:.1e} m in the floor" for name, depth in depths.items()]
        return "; ".join(words)

    def _depths(
        self, scene: Scene, start: State, model: mujoco.MjModel, data: mujoco.MjData
    ) -> dict[str, float]:
        """How deep a disk must start to be carried: MuJoCo's floor gives way to a weight."""
        if self.setting != "tuned" or not scene.contacts:
            return {}
        return settle(scene, model, data, start)

    def choices(self, scene: Scene, step: float, start: State | None = None) -> list[Choice]:
        """The setting's numbers as attributes of the MJCF file; what falls needs its own."""
        if self.setting == "tuned":
            return settings.tuned(scene, step, start)
        return settings.with_own(self.options, scene, step)

    def script(self, scene: Scene, start: State, step: float) -> str:
        """The MJCF file with its start as a keyframe."""
        depths = self._depths(scene, start, *self._loaded(scene, start, step, step))
        return self._text(scene, start, step, step, depths)

    def _text(
        self,
        scene: Scene,
        start: State,
        step: float,
        tied_to: float,
        depths: Mapping[str, float] = MappingProxyType({}),
    ) -> str:
        timestep = Choice("option.timestep", step, "the case's step")
        return mjcf(scene, start, [timestep, *self.choices(scene, tied_to, start)], depths)

    def _loaded(
        self, scene: Scene, start: State, step: float, tied_to: float
    ) -> tuple[mujoco.MjModel, mujoco.MjData]:
        return load(self._text(scene, start, step, tied_to))

    def _settled(
        self, scene: Scene, start: State, step: float, tied_to: float
    ) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """As `script` would load it, compiled once."""
        model, data = self._loaded(scene, start, step, tied_to)
        for name, depth in self._depths(scene, start, model, data).items():
            data.joint(f"{name}.y").qpos[0] -= depth
        return model, data

    def measure(self, scene: Scene, start: State) -> dict[str, float]:
        """Physics as the compiled model holds it."""
        return measured(scene, *self._loaded(scene, start, 1e-3, 1e-3))

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
        """The motion, stepped by `mj_step(model, data, n)` between samples or steps."""
        model, data = self._settled(scene, start, step, tied_to)
        return simulate(
            scene, model, data, start, times, reactions, realised=realised, every=record
        )

    def prepare(
        self, scene: Scene, start: State, step: float, *, realised: Realised
    ) -> Callable[[int], None]:
        """MuJoCo's bare loop, with the same callbacks installed."""
        model, data = self._settled(scene, start, step, step)
        steps = stepping(scene, model, data, realised)
        laws = smooth(scene, model) if realised == "law" else []

        def take(n: int) -> None:
            with heard(), signals(scene, laws):
                steps.take(n)

        return take
