"""How steps are taken: by MuJoCo alone, with our law before each, or by our driver."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from ....cases.scene import Scene
from ...engine import Realised
from .contact_friction import Touch, one_touch, touches
from .driver import bounded, driven_step, falling, room
from .foot_contact import Feet, feet
from .friction import Slide, slides, smooth_only
from .rope_impact import Catching, catches
from .signal import Control
from .spring_switch import Corners


@dataclass
class Steps:
    """Takes steps, and notes for every sample which slides stick."""

    model: mujoco.MjModel
    data: mujoco.MjData
    slides: list[Slide | Touch | Feet | Catching]
    take: Callable[[int], None]
    controls: list[Control] = field(default_factory=list)  # what every stage needs of us
    alone: bool = True  # whether MuJoCo's own loop takes them
    noted: list[tuple[Any, ...]] = field(default_factory=list)

    def begin(self) -> None:
        """At the first sample a force may be beyond static friction already."""
        dry = [slide for slide in self.slides if isinstance(slide, Slide | Touch)]
        if dry:
            mujoco.mj_forward(self.model, self.data)
        for slide in dry:
            applied, _ = slide.applied()
            slide.sense = slide.sense or slide.starts(applied)

    def note(self) -> None:
        """Remember the senses of the slides."""
        if self.slides:
            self.noted.append(tuple([slide.remember() for slide in self.slides]))

    def keep(self, rows: NDArray[np.int64]) -> None:
        """Keep only the notes of the samples `rows`."""
        if self.noted:
            self.noted = [self.noted[row] for row in rows.tolist()]

    def recall(self, sample: int) -> None:
        """Friction as it was at a sample, for reading forces."""
        for slide, noted in zip(self.slides, self.noted[sample] if self.noted else (), strict=True):
            slide.recall(noted)


def caught(catching: Catching, step: float) -> Callable[[int], None]:
    """Steps [s] that are cut where a rope comes taut."""

    def take(n: int) -> None:
        for _ in range(n):
            catching.step(step)

    return take


def stepping(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, realised: Realised) -> Steps:
    """Steps of the model's size; smooth friction is a callback and needs nothing here."""
    ours = realised != "native" and not (smooth_only(scene) and not one_touch(scene))
    dry = slides(scene, model, data) if ours else []
    touching = touches(scene, model, data) if ours else []
    found = [*dry, *touching]
    walks = feet(scene, model, data) if realised == "driver" else None
    step = float(model.opt.timestep)
    if walks is not None:

        def by_feet(n: int) -> None:
            for _ in range(n):
                walks.step(step)

        return Steps(model, data, [walks], by_feet, alone=False)
    if realised == "driver" and catches(scene):
        catching = Catching(scene, model, data)
        return Steps(model, data, [catching], caught(catching, step), alone=False)

    def native(n: int) -> None:
        mujoco.mj_step(model, data, n)

    def by_law(n: int) -> None:
        for _ in range(n):
            for slide in found:
                bounded(slide)
            mujoco.mj_step(model, data)

    kept = room(model)

    def by_driver(n: int) -> None:
        for _ in range(n):
            driven_step(found, step, kept)

    corners = Corners(scene, model, data) if realised == "driver" and not found else None

    def by_corners(n: int) -> None:
        assert corners is not None
        for _ in range(n):
            corners.step(step)

    ways = {"native": native, "law": by_law, "driver": by_driver if found else by_corners}
    stages = falling(found) if realised == "driver" else []
    take = ways[realised] if found or corners else native
    return Steps(model, data, found, take, stages, alone=take is native)
