"""MuJoCo behind the protocol of `engines.engine`."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import mujoco

from cases.scene import Scene
from cases.trajectory import Array, Trajectory
from engines.engine import Choice, Realised, State
from engines.mujoco import settings
from engines.mujoco.readout import measured
from engines.mujoco.run import load, signals, simulate
from engines.mujoco.scene import HEAVY, mjcf
from engines.mujoco.settle import settle
from engines.mujoco.tree import spanning_tree


@dataclass(frozen=True)
class MuJoCo:
    """MuJoCo with one setting: shipped, tuned, or own (`options`: the user's)."""

    setting: str
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "mujoco"
    version: str = mujoco.__version__
    comment: tuple[str, str] = ("<!-- ", " -->")

    def __post_init__(self) -> None:
        settings.own(self.options)

    @property
    def own_step(self) -> float | None:
        """2 ms, MuJoCo's default, unless tuned or set by the user."""
        return None if self.setting == "tuned" else self.options.get("step", settings.SHIPPED_STEP)

    def realisations(self, scene: Scene) -> tuple[Realised, ...]:
        """Springs, dampers, pushes and contacts are all MuJoCo's own elements."""
        return ("native",)

    def refuses(self, scene: Scene) -> str | None:
        """Loops close by `connect`, which is a pin."""
        for joint in spanning_tree(scene).loops:
            if joint.kind != "pin":
                return f"engine: MuJoCo has no constraint that closes a loop by the {joint.kind} {joint.name}"
        for joint in scene.joints.values():
            a = scene.bodies.get(joint.a.body)
            if joint.kind != "pin" and a is not None and not a.turns:
                return f"adapter: {joint.name} starts at a particle, which has no axes"
        return None

    def withholds(self, scene: Scene, quantity: str) -> str | None:
        """MuJoCo gives moments about other points than the joint's; the adapter leaves them."""
        part, _, what = quantity.rpartition(".")
        if part in scene.joints and what == "torque":
            return "adapter: the moment a joint holds is not read from MuJoCo"
        return None

    def tied(self, scene: Scene) -> bool:
        """The soft constraints of the tuned recipe follow the step."""
        return self.setting == "tuned" and settings.ties(scene)

    def exponents(self, scene: Scene, realised: Realised, *, held: bool) -> tuple[int, ...]:
        """Euler and contacts 1, 2; RK4 4, 5; constraints that follow the step 2, 3."""
        integrator = {c.name: c.value for c in self.choices(scene, 1e-3)}["option.integrator"]
        if integrator != "RK4" or scene.contacts:
            return (1, 2)
        return (4, 5) if held or not self.tied(scene) else (2, 3)

    def protocol(self, scene: Scene, start: State, step: float, realised: Realised) -> str:
        """Driven points, and how deep a disk is started in the floor."""
        words = []
        if any(point.driven for point in scene.points.values()):
            words.append(f"driven points are masses of {HEAVY:g} kg")
        depths = self._depths(scene, start, step, step)
        words += [f"{name} started {depth:.1e} m in the floor" for name, depth in depths.items()]
        return "; ".join(words)

    def _depths(
        self, scene: Scene, start: State, step: float, tied_to: float
    ) -> dict[str, float]:
        """How deep each disk must start to be carried: MuJoCo's floor gives way to a weight."""
        if self.setting != "tuned" or not scene.contacts:
            return {}
        return settle(scene, self._text(scene, start, step, tied_to))

    def choices(self, scene: Scene, step: float) -> list[Choice]:
        """The setting's numbers as attributes of the MJCF file."""
        if self.setting == "tuned":
            return settings.tuned(scene, step)
        return settings.with_own(self.options, scene, step)

    def script(self, scene: Scene, start: State, step: float) -> str:
        """The MJCF file with its start as a keyframe."""
        return self._settled(scene, start, step, step)

    def _text(self, scene: Scene, start: State, step: float, tied_to: float) -> str:
        timestep = Choice("option.timestep", step, "the case's step")
        return mjcf(scene, start, [timestep, *self.choices(scene, tied_to)])

    def measure(self, scene: Scene, start: State) -> dict[str, float]:
        """Physics as the compiled model holds it."""
        return measured(scene, *load(self._text(scene, start, 1e-3, 1e-3)))

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
    ) -> Trajectory:
        """The motion, stepped by `mj_step(model, data, n)` between samples."""
        return simulate(scene, self._settled(scene, start, step, tied_to), times, reactions)

    def prepare(
        self, scene: Scene, start: State, step: float, *, realised: Realised
    ) -> Callable[[int], None]:
        """MuJoCo's bare loop, with the same callbacks installed."""
        model, data = load(self._settled(scene, start, step, step))

        def steps(n: int) -> None:
            with signals(scene):
                mujoco.mj_step(model, data, n)

        return steps

    def _settled(self, scene: Scene, start: State, step: float, tied_to: float) -> str:
        moved = {name: list(state) for name, state in start.items()}
        for name, depth in self._depths(scene, start, step, tied_to).items():
            moved[name][1] -= depth
        return self._text(scene, {k: tuple(s) for k, s in moved.items()}, step, tied_to)  # type: ignore[misc]
