"""How steps are taken: by MuJoCo alone, with our laws, or cut where a foot strikes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from ....cases.scene import Scene
from .contact_friction import Touch, one_touch, touches
from .edge import edges
from .foot_contact import Feet, feet
from .friction import Slide, slides, smooth_only, starts
from .friction_law import bounded
from .signal import Control
from .smooth import smooth


@dataclass
class Steps:
    """Takes steps, and notes for every sample which slides stick."""

    model: mujoco.MjModel
    data: mujoco.MjData
    slides: Sequence[Slide | Touch | Feet]
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
            slide.sense = slide.sense or starts(slide.friction, applied)

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


Stepper = Callable[[Scene, mujoco.MjModel, mujoco.MjData], Steps]
"""A function that makes the `Steps` of a run, each of the model's size."""


def native(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> Steps:
    """Steps of MuJoCo's own loop."""
    return Steps(model, data, [], partial(mujoco.mj_step, model, data))


def by_law(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> Steps:
    """Steps with edges and smooth friction at every stage, and other dry friction before each."""
    rubbing = _rubbing(scene, model, data)
    controls = [*smooth(scene, model), *edges(scene, model)]
    if not rubbing:
        return replace(native(scene, model, data), controls=controls)

    def step() -> None:
        for slide in rubbing:
            bounded(slide)
        mujoco.mj_step(model, data)

    return Steps(model, data, rubbing, _repeated(step), controls, alone=False)


def at_strikes(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> Steps:
    """Steps that are cut where a foot strikes."""
    walks = feet(scene, model, data)
    step = partial(walks.step, float(model.opt.timestep))
    return Steps(model, data, [walks], _repeated(step), alone=False)


def _rubbing(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> list[Slide | Touch]:
    """The dry friction that is set before a step: smooth friction is a callback."""
    if smooth_only(scene) and not one_touch(scene):
        return []
    return [*slides(scene, model, data), *touches(scene, model, data)]


def _repeated(step: Callable[[], None]) -> Callable[[int], None]:
    def take(n: int) -> None:
        for _ in range(n):
            step()

    return take
