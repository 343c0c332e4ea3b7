"""A user's model with one number changed, compiled anew, and what to write into which element.

It is compiled from its file, for the compiler makes other numbers of each, such as the gain that a
damping ratio stands for.
"""

import copy
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any
from xml.sax.saxutils import quoteattr

import mujoco
import numpy as np

from ...cases.model_case import ModelCase
from .limit import data_from
from .model import OwnModel

ARMATURES = (0.001, 0.01, 0.1)  # kg m², kg: by tens, as the smallest that cures is looked for
GAINS = (0.5, 0.1)  # of a servo's kv
OBJECT = mujoco.mjtObj


@dataclass(frozen=True)
class Changed:
    """A change in words, the model with it, and what to write into its file."""

    words: str
    own: OwnModel
    lines: tuple[str, ...]


@dataclass(frozen=True)
class _Edit:
    """A number of an element: `armature`, or an actuator's velocity gain."""

    element: str
    number: int
    value: float

    def __call__(self, element: Any) -> None:
        if self.element == "joint":
            element.armature = self.value
        else:
            element.biasprm[2] = -self.value


def changes(case: ModelCase, own: OwnModel, dofs: Sequence[int]) -> tuple[Iterator[Changed], ...]:
    """Returns two kinds of change, each from the smallest on: armature on the joints of some
    velocities, and less kv of their servos."""
    joints = [int(own.model.dof_jntid[k]) for k in dofs]
    return _armatures(case, own, joints), _gains(case, own, joints)


def _armatures(case: ModelCase, own: OwnModel, joints: Sequence[int]) -> Iterator[Changed]:
    m = own.model
    for value in ARMATURES:
        lighter = [j for j in joints if value > m.dof_armature[m.jnt_dofadr[j]]]
        if lighter:
            edits = [_Edit("joint", joint, value) for joint in lighter]
            lines = tuple(f'in {_joint(m, j)} write armature="{value:g}"' for j in lighter)
            yield Changed(f"armature {value:g}", _compiled(case, own, edits), lines)


def _gains(case: ModelCase, own: OwnModel, joints: Sequence[int]) -> Iterator[Changed]:
    m = own.model
    servos = [i for joint in joints for i in _servos(m, joint)]
    for part in GAINS if servos else ():
        less = {i: float(f"{-part * m.actuator_biasprm[i, 2]:.6g}") for i in servos}
        edits = [_Edit("actuator", i, kv) for i, kv in less.items()]
        lines = tuple(_gain(m, i, kv) for i, kv in less.items())
        words = f"kv {', '.join(f'{kv:g}' for kv in less.values())}"
        yield Changed(words, _compiled(case, own, edits), lines)


def _servos(m: mujoco.MjModel, joint: int) -> list[int]:
    """Returns the actuators on a joint that have a velocity gain, by their numbers."""
    on = (m.actuator_trntype == mujoco.mjtTrn.mjTRN_JOINT) & (m.actuator_trnid[:, 0] == joint)
    return [int(i) for i in np.flatnonzero(on & (m.actuator_biasprm[:, 2] < 0))]


def option(attributes: Mapping[str, Any]) -> tuple[str, ...]:
    """Returns the element to paste at the end of <mujoco>, of attributes that are not its own."""
    words = (
        f'{name}="{value:.10g}"' if isinstance(value, float) else f'{name}="{value}"'
        for name, value in attributes.items()
    )
    return (f"at the end of <mujoco> paste <option {' '.join(words)}/>",) if attributes else ()


def _compiled(case: ModelCase, own: OwnModel, edits: Sequence[_Edit]) -> OwnModel:
    """Returns the model with joints or actuators edited, and the flags that its case changed.

    A model without a file is not compiled anew: what hangs on the number alone follows it.
    """
    if case.given is None or isinstance(case.given, str):
        text = case.given
        spec = mujoco.MjSpec.from_string(text) if text else mujoco.MjSpec.from_file(case.path)
        spec.compile()  # from here on elements know their numbers
        for edit in edits:
            edit(next(e for e in getattr(spec, f"{edit.element}s") if e.id == edit.number))
        model = spec.compile()
    else:
        model = copy.copy(case.given)
        for edit in edits:
            edit(getattr(model, edit.element)(edit.number))
        mujoco.mj_setConst(model, mujoco.MjData(model))
    model.opt.disableflags = own.model.opt.disableflags
    return replace(own, model=model, begun=data_from(model, own.start()))


def _joint(m: mujoco.MjModel, joint: int) -> str:
    if name := mujoco.mj_id2name(m, OBJECT.mjOBJ_JOINT, joint):
        return f"<joint name={quoteattr(name)} …>"
    body = int(m.jnt_bodyid[joint])
    name = mujoco.mj_id2name(m, OBJECT.mjOBJ_BODY, body)
    whose = f"<body name={quoteattr(name)} …>" if name else f"body {body}, counted from the top"
    return f"joint {joint - int(m.body_jntadr[body]) + 1} of {whose}"


def _gain(m: mujoco.MjModel, i: int, kv: float) -> str:
    name = mujoco.mj_id2name(m, OBJECT.mjOBJ_ACTUATOR, i)
    place = f"the actuator name={quoteattr(name)}" if name else f"actuator {i}, counted from 0"
    rest = " ".join(f"{number:.10g}" for number in (*m.actuator_biasprm[i, :2], -kv))
    return f'in {place} write kv="{kv:g}" (in a <general>: biasprm="{rest}")'
