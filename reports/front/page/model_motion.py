"""A user's model as the page draws it: its limit, and the steps of each setting."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ....cases.mistake import CaseError
from ....cases.scene.frame import SPACE
from ....cases.scene.rotation import turned
from ....cases.trajectory import Array
from ....engines.mujoco.callbacks.signal import listening
from ....engines.own_model import drawing as own_drawing
from ....engines.own_model.limit import stepped_states
from ....engines.own_model.model import OwnModel
from ....engines.own_model.opened import Opened, opened
from ....engines.own_model.quantities import Motion as Moved
from ....engines.own_model.quantities import Quantity, differences, observed
from ...compare.judge.metric import sizes
from ...compare.own_rows import ENGINE, NATIVE, Modelled
from ...compare.own_steps import Setting, Stepped, Steps
from . import poses
from .digits import few_digits, few_digits_of_each
from .drawing import LIMIT, Drawing, Motion, thinned

FINE = 400  # states of a motion, about, of which as many are kept as are needed to draw it
MOST = 4  # times as many poses as samples, of steps that are drawn
LOOKS = 60  # states in which it is looked how far a motion reaches
DIGITS = 4  # of a length, of the size of the motion: it is some hundred points wide
AROUND = 3  # times what moves reaches: what of the ground is further off is not drawn


def model_motion(model: Modelled) -> Motion | None:
    """Returns the limit of a model, what differs from it, and all curves; None without a limit."""
    if model.steps is None:
        return None
    try:
        with listening():
            return _motion(opened(model.case), model.steps)
    except CaseError:  # its file is another one by now
        return None


def _motion(ready: Opened, steps: Steps) -> Motion:
    own, limit = ready.own, steps.limit
    right, drawing = own_drawing.states(own, limit.y), _drawing(own, limit.y)
    ghosts: dict[str, Mapping[str, Any] | None] = {}
    for each in steps.settings:
        if each.y is not None:
            ghosts[_way(each)] = _ghost(own, drawing, limit.times, each.setting, each.y, right)
    finer, y = own_drawing.refined(own, limit.times, limit.y, math.ceil(FINE / len(limit.times)))
    closely = drawing.poses(finer, poses.moves(own_drawing.states(own, y)), poses.CLOSE)
    return drawing.motion(LIMIT, closely.rounded(), ghosts, _curves(ready, steps))


def _way(each: Stepped) -> str:
    return f"{ENGINE}.{each.setting.name}.{NATIVE}"


def _ghost(
    own: OwnModel,
    drawing: Drawing,
    times: Array,
    setting: Setting,
    y: Array,
    right: Mapping[str, Array],
) -> Mapping[str, Any] | None:
    """Returns the poses of a setting's steps; None where the limit's drawing covers them.

    held: at its samples y alone, where it shakes and would need far more of them.
    """
    samples = own_drawing.states(own, y)
    if drawing.covers(samples, right):
        return None
    count = round(float(times[-1]) / setting.step)
    each = setting.step * np.unique([*range(0, count, math.ceil(count / FINE)), count])
    states = stepped_states(own, each, setting.options, setting.step)
    if states is not None:
        shown = drawing.poses(each, poses.moves(own_drawing.states(own, states)), poses.GHOST)
        if len(shown.times) <= MOST * len(times):
            return shown.rounded()
    return {**poses.Poses(times, poses.moves(samples)).rounded(), "held": True}


def _drawing(own: OwnModel, y: Array) -> Drawing:
    lines, states = own_drawing.outlines(own.model), own_drawing.states(own, y)
    reaches = {body: _reach(lines.get(body, [])) for body in states}
    ground, *bodies = states  # the first is the ground
    places = np.concatenate([_corners(states[body], lines[body]) for body in bodies])
    middle = (places.max(axis=0) + places.min(axis=0)) / 2
    size = float(np.ptp(places, axis=0).max()) or 1.0
    lines[ground] = [
        line
        for line in lines.get(ground, [])
        if np.linalg.norm(line - middle, axis=1).max() <= AROUND * size
    ]
    digits = DIGITS - math.ceil(math.log10(size))

    def few(place: Array) -> list[float]:
        return (np.round(place, digits) + 0.0).tolist()

    planes = [_below(floor, middle) for floor in own_drawing.floors(own.model)]
    sketch = {
        "bodies": {
            body: {"lines": [few(line) for line in lines[body]], "dot": not lines[body]}
            for body in states
            if body != ground or lines[body]
        },
        "links": [],
        "joints": [{"at": [body, few(at)]} for body, at in own_drawing.pivots(own.model)],
        "blades": [],
        "planes": [{"floor": [few(row) for row in plane]} for plane in planes],
        "ground": [],
    }
    return Drawing(SPACE, size, sketch, reaches)


def _corners(rows: Array, lines: list[Array]) -> Array:
    """(M, 3) [m] the places of a body and of its lines' corners in some of its states (N, 13)."""
    rows, corners = rows[thinned(len(rows), LOOKS)], np.concatenate([np.zeros((1, 3)), *lines])
    places = rows[:, None, SPACE.place] + turned(rows[:, None, SPACE.attitude], corners)
    return places.reshape(-1, 3)


def _reach(lines: list[Array]) -> float:
    return max((float(np.linalg.norm(line, axis=1).max()) for line in lines), default=0.0)


def _below(floor: Array, middle: Array) -> Array:
    """Returns a plane with its place where the middle of the motion stands on it."""
    at, *axes = floor
    return np.stack([at + sum(axis * (axis @ (middle - at)) for axis in axes), *axes])


def _curves(ready: Opened, steps: Steps) -> dict[str, Any]:
    """By quantity, at every sample: the limit, and by how much each setting is off it."""
    own, bars, limit = ready.own, ready.bars, steps.limit
    kept = thinned(len(limit.times))
    right = Moved(own, limit.times, limit.y)
    values = _values(ready, right)
    off: dict[Quantity, dict[str, Any]] = {quantity: {} for quantity in bars}
    for each in steps.settings:
        if each.y is not None:
            stepped = differences([*bars], right, Moved(own, limit.times, each.y))
            for quantity, rows in stepped.items():
                curve = rows[:, 0] if quantity in values else sizes(rows)
                if np.isfinite(curve).all():
                    off[quantity][_way(each)] = {"curve": few_digits_of_each(curve[kept])}
    nothing = np.zeros(len(limit.times))
    return {
        "times": few_digits(limit.times[kept]),
        "until": float(f"{steps.until:.6g}") if steps.late else None,
        "quantities": {
            quantity.name: {
                "reference": few_digits(values.get(quantity, nothing)[kept]),
                "off": off[quantity],
            }
            for quantity in bars
        },
    }


def _values(ready: Opened, motion: Moved) -> dict[Quantity, Array]:
    """Returns (N,) of each quantity that is one number."""
    m = ready.own.model
    single = [quantity for quantity in ready.bars if quantity.wide == 1 and quantity.of != "turn"]
    others = [quantity for quantity in single if quantity.of in ("sensor", "force", "energy")]
    values = {quantity: rows[:, 0] for quantity, rows in observed(others, motion).items()}
    joints = [quantity for quantity in single if quantity.of == "joint"]
    places = m.jnt_qposadr[m.dof_jntid[[quantity.first for quantity in joints]]]
    return values | dict(zip(joints, motion.q[:, places].T, strict=True))
