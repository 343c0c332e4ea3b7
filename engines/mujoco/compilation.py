"""One compilation of a scene for all steps: the step, and what follows it, go into a copy.

The copy holds, field by field, what compiling the script of that step gives (tested).
"""

import copy
from functools import lru_cache

import mujoco

from ...cases.scene import Scene
from ..engine import Choice, Plan, Start
from .law.settle import settle
from .law.signal import installed
from .law.touch import one_touch, touches
from .run import listening, started
from .scene import mjcf

NOMINAL = 1e-3  # s: with which a scene is compiled; any step would do

# Where the compiled model holds the numbers that may follow the step.
_HELD = {
    "connect.solref": "eq_solref",
    "pair.solref": "pair_solref",
    "pair.solreffriction": "pair_solreffriction",
    "slide.solreffriction": "dof_solref",
}


def compiled(
    scene: Scene, start: Start, step: float, plan: Plan
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The model with the plan's numbers at the step [s], and data at the start.

    Raises ValueError with what MuJoCo does not take.
    """
    nominal = plan.numbers(NOMINAL)
    model = copy.copy(_model(mjcf(scene, start, [timestep(NOMINAL), *nominal])))
    model.opt.timestep = step
    for choice, before in zip(plan.choices(step), nominal, strict=True):
        if choice.value != before.value:
            _write(scene, model, choice)
    return started(model)


def settled(
    scene: Scene, start: Start, step: float, plan: Plan
) -> tuple[mujoco.MjModel, mujoco.MjData, dict[str, float]]:
    """The same with its start, the keyframe, as deep in the floor as it is carried: depths [m]."""
    model, data = compiled(scene, start, step, plan)
    if plan.realised == "law" and one_touch(scene):
        touches(scene, model, data)  # friction of MuJoCo's own would press it into the floor
    depths = settle(scene, model, data, start)
    model.key_qpos[0], model.key_qvel[0] = data.qpos, data.qvel
    return model, data, depths


def timestep(step: float) -> Choice:
    """The step as an attribute of the MJCF file."""
    return Choice("option.timestep", step, "the case's step")


@lru_cache(maxsize=1)  # the rungs of a trial follow each other
def _model(text: str) -> mujoco.MjModel:
    with listening(), installed(None):
        return mujoco.MjModel.from_xml_string(text)


def _write(scene: Scene, model: mujoco.MjModel, choice: Choice) -> None:
    held = getattr(model, _HELD[choice.name])
    if not choice.name.startswith("slide."):
        held[:] = choice.value
        return
    for joint in scene.joints.values():
        if joint.dry_friction is not None:
            held[model.joint(joint.name).dofadr[0]] = choice.value
