"""One compilation of a scene for all steps: the step, and what follows it, go into a copy.

The copy holds, field by field, what compiling the script of that step gives (tested).
"""

import copy
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import mujoco

from ....cases.scene import Scene
from ....cases.trajectory import Array
from ...engine import Choice, Plan, Start
from ..callbacks.contact_friction import one_touch, touches
from ..callbacks.point_forces import acting
from ..callbacks.rope_limit import draw, ropes_of
from ..callbacks.settle import settle
from ..callbacks.signal import installed, listening
from ..model.force import lean
from ..model.number_text import EACH
from ..model.scene import mjcf
from ..settings.groups import GROUPS, single

NOMINAL = 1e-3  # s: with which a scene is compiled; any step would do

# Fields that a run writes: what follows the step, friction by our laws, the start in the floor.
_WRITTEN = (*(field for group in GROUPS.values() for field in group.fields.values()),)
_WRITTEN += ("dof_frictionloss", "pair_friction", "site_pos", "site_sameframe")
_WRITTEN += ("key_qpos", "key_qvel")


def started(model: mujoco.MjModel) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The model, and data at its start."""
    with listening(), installed(None), acting(None):
        data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def compiled(
    scene: Scene, start: Start, step: float, plan: Plan
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The model with the plan's numbers at the step [s], and data at the start.

    Raises ValueError with what MuJoCo does not take.
    """
    nominal = plan.numbers(NOMINAL)
    model, data = started(copy.copy(_model(_text(scene, start, nominal))))
    _number(scene, model, step, plan, nominal)
    return model, data


def placed(
    scene: Scene, start: Start, step: float, plan: Plan, *, settles: bool
) -> tuple[mujoco.MjModel, mujoco.MjData, dict[str, Any]]:
    """The model and data of `compiled` with the start as keyframe, settled if `settles`.

    By name, how deep [m] what touches settles in the floor and how fast [m/s] it creeps there, and
    how much too long [m] ropes are.
    """
    model, data = compiled(scene, start, step, plan)
    return model, data, _settle(scene, model, data, start, plan) if settles else {}


@dataclass(frozen=True)
class _Built:
    """A scene's model and data; fields: what a run may write into the model, as compiled."""

    text: str
    model: mujoco.MjModel
    data: mujoco.MjData
    fields: Mapping[str, Array]


_SHELF: list[_Built] = []  # one at most, while nobody runs it


@contextmanager
def lent(
    scene: Scene, start: Start, step: float, plan: Plan, *, settles: bool
) -> Iterator[tuple[mujoco.MjModel, mujoco.MjData]]:
    """Lend the model and data of `compiled`, or `placed`, to one run: the next rung gets the same.

    A copy of a model and new data cost as much as compiling it. What a failing run leaves behind
    is not used again.
    """
    nominal = plan.numbers(NOMINAL)
    text = _text(scene, start, nominal)
    built = _SHELF.pop() if _SHELF else None
    if built is None or built.text != text:
        model, data = started(copy.copy(_model(text)))
        built = _Built(text, model, data, {name: getattr(model, name).copy() for name in _WRITTEN})
    for name, values in built.fields.items():
        getattr(built.model, name)[:] = values
    _number(scene, built.model, step, plan, nominal)
    mujoco.mj_resetDataKeyframe(built.model, built.data, 0)
    if settles:
        _settle(scene, built.model, built.data, start, plan)
    yield built.model, built.data
    _SHELF[:] = [built]


def _settle(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, start: Start, plan: Plan
) -> dict[str, Any]:
    if plan.realised != "native" and one_touch(scene):
        touches(scene, model, data)  # friction of MuJoCo's own would press it into the floor
    moved: dict[str, Any] = {**settle(scene, model, data, start)}
    lean(scene, model, data)
    roped = any(ropes_of(scene))
    moved |= draw(scene, model, data) if roped else {}
    model.key_qpos[0], model.key_qvel[0] = data.qpos, data.qvel
    if roped:
        mujoco.mj_resetDataKeyframe(model, data, 0)  # nothing is left of what was looked at
    return moved


def timestep(step: float) -> Choice:
    """The step as an attribute of the MJCF file."""
    return Choice("option.timestep", step, "the case's step")


def _text(scene: Scene, start: Start, nominal: Sequence[Choice]) -> str:
    return mjcf(scene, start, [timestep(NOMINAL), *nominal])


@lru_cache(maxsize=1)  # the rungs of a trial follow each other
def _model(text: str) -> mujoco.MjModel:
    with listening(), installed(None), acting(None):
        return mujoco.MjModel.from_xml_string(text)


def _number(
    scene: Scene, model: mujoco.MjModel, step: float, plan: Plan, nominal: Sequence[Choice]
) -> None:
    """The step, and what of the numbers is not as it was compiled."""
    model.opt.timestep = step
    for choice, before in zip(plan.choices(step), nominal, strict=True):
        if choice.value != before.value:
            _write(scene, model, choice)


def _write(scene: Scene, model: mujoco.MjModel, choice: Choice) -> None:
    where, _, name = choice.name.rpartition(".")
    word, _, element = where.partition(".")
    group = single(scene)[element] if word == EACH else GROUPS[word]
    places = group.single(scene)[element] if word == EACH and group.single else group.places
    getattr(model, group.fields[name])[places(scene, model)] = choice.value
