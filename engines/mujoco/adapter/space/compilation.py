"""A scene in space as MuJoCo's model, with data at the start."""

from collections.abc import Iterator
from contextlib import contextmanager

import mujoco

from .....cases.scene import Scene
from ....engine import Plan, Start
from ...callbacks.signal import installed, listening
from ...callbacks.space.settle import settle
from ...model.space.scene import mjcf
from ..compilation import timestep
from ..run import started


def compiled(
    scene: Scene, start: Start, step: float, plan: Plan
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The model with the plan's numbers at the step [s], and data at the start.

    Raises ValueError with what MuJoCo does not take.
    """
    text = mjcf(scene, start, [timestep(step), *plan.choices(step)])
    with listening(), installed(None):
        model = mujoco.MjModel.from_xml_string(text)
    return started(model)


def placed(
    scene: Scene, start: Start, step: float, plan: Plan, *, settles: bool
) -> tuple[mujoco.MjModel, mujoco.MjData, dict[str, tuple[float, float]]]:
    """Model and data, started as the floor carries it; depths [m] and creeps [m/s] by body."""
    model, data = compiled(scene, start, step, plan)
    with listening():
        return model, data, settle(scene, model, data, start) if settles else {}


@contextmanager
def lent(
    scene: Scene, start: Start, step: float, plan: Plan, *, settles: bool
) -> Iterator[tuple[mujoco.MjModel, mujoco.MjData]]:
    """Lend the model and data of `placed` to one run; each run compiles its own."""
    model, data, _ = placed(scene, start, step, plan, settles=settles)
    yield model, data
