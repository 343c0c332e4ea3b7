"""From a case of a model to the compiled model: its start, what drives it, and what is claimed."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from ...cases.fields.number import Amount, NumberMistake, check_angle, check_unit
from ...cases.mistake import CaseError, Mistake, Path, nearest
from ...cases.model_case import JOINTS, TOLERANCE, Law, ModelCase, ModelStart
from ...cases.trajectory import Array
from .model import OwnModel, compiled, compiled_text, drawn_rates, drawn_start
from .numbers import element_name
from .quantities import Quantity, joint_quantities, quantities
from .release import actuators, column

OBJECT = mujoco.mjtObj
WIDTHS = {0: (7, 6), 1: (4, 3), 2: (1, 1), 3: (1, 1)}
UNITS = {2: "m", 3: "rad"}
"""By a joint's type, of one that has a coordinate."""


@dataclass(frozen=True)
class Opened:
    """A case's model, started and driven as the case says, and the bar of each quantity."""

    own: OwnModel
    bars: Mapping[Quantity, float]

    @property
    def joint_bars(self) -> Array:
        """The bar of each velocity (n,), rad or m; the least of its unit where its joint has none.

        Without any of its unit it is what a model alone is allowed.
        """
        each = np.empty(self.own.model.nv)
        for joint in joint_quantities(self.own.model):
            like = [bar for q, bar in self.bars.items() if (q.of, q.unit) == ("joint", joint.unit)]
            bar = self.bars.get(joint, min(like, default=TOLERANCE))
            each[joint.first : joint.first + joint.wide] = bar
        return each


def opened(case: ModelCase) -> Opened:
    """Compiles a case's model. Raises CaseError with the compiler's words, or of unknown names."""
    own = _compiled(case)
    model = own.model
    if not case.contacts:
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    mistakes: list[Mistake] = []
    laws: dict[int, Law] = {}
    for name, law in case.control.items():
        number = _number(model, OBJECT.mjOBJ_ACTUATOR, name, case, ("control", name), mistakes)
        if number is not None:
            laws[int(column(model, "actuator_ctrladr")[number])] = law
    data = _start(own, case, mistakes)
    bars = dict(_bars(model, case, mistakes))
    if mistakes:
        raise CaseError(mistakes)
    started = replace(own, laws=laws, begun=data, begins=_start_words(model, case.initial))
    for number in laws:
        data.ctrl[number] = started.controls.at(0.0)[number]
    return Opened(started, bars)


def _compiled(case: ModelCase) -> OwnModel:
    if isinstance(case.given, str):
        return compiled_text(case.given, case.file)
    if case.given is not None:
        return OwnModel(case.file, case.given)
    try:
        return compiled(case.path)
    except CaseError as error:
        if not case.source.lines:  # the model is what was named
            mistakes = [replace(mistake, file=case.file) for mistake in error.mistakes]
            raise CaseError(mistakes) from None
        mistakes = [case.mistake(("model",), str(mistake)) for mistake in error.mistakes]
        raise CaseError(mistakes) from None


def _number(
    model: mujoco.MjModel,
    kind: mujoco.mjtObj,
    name: str,
    case: ModelCase,
    path: Path,
    mistakes: list[Mistake],
) -> int | None:
    """Returns an element's number; notes a mistake, and returns None, where it has none."""
    number = mujoco.mj_name2id(model, kind, name)
    if number >= 0:
        return number
    names = _names(model, kind)
    word = {OBJECT.mjOBJ_ACTUATOR: "actuator", OBJECT.mjOBJ_JOINT: "joint"}.get(kind, "keyframe")
    hint = nearest(name, names) if names else f"; it has no {word} with a name"
    mistakes.append(case.mistake(path, f"the model has no such {word}: {name!r}{hint}"))
    return None


def _names(model: mujoco.MjModel, kind: mujoco.mjtObj) -> list[str]:
    counts = {OBJECT.mjOBJ_ACTUATOR: actuators(model), OBJECT.mjOBJ_JOINT: model.njnt}
    names = (mujoco.mj_id2name(model, kind, i) for i in range(counts.get(kind, model.nkey)))
    return [name for name in names if name]


def _start(own: OwnModel, case: ModelCase, mistakes: list[Mistake]) -> mujoco.MjData:
    model, initial = own.model, case.initial
    keyframe = 0 if model.nkey else None
    if initial.keyframe is not None:
        path = ("initial", "keyframe")
        keyframe = _number(model, OBJECT.mjOBJ_KEY, initial.keyframe, case, path, mistakes)
    data = drawn_start(model, keyframe, still=initial != ModelStart())
    if initial.random_rates is not None:
        data.qvel[:] = drawn_rates(model, initial.random_rates.most, initial.random_rates.seed)
    for key, given, into in (
        ("joints", initial.joints, data.qpos),
        ("rates", initial.rates, data.qvel),
    ):
        for name, numbers in given.items():
            path = ("initial", key, name)
            joint = _number(model, OBJECT.mjOBJ_JOINT, name, case, path, mistakes)
            if joint is None:
                continue
            try:
                _fill(model, joint, numbers, into, rate=key == "rates")
            except NumberMistake as error:
                mistakes.append(case.mistake(path, str(error)))
    return data


def _start_words(model: mujoco.MjModel, initial: ModelStart) -> str:
    """Returns in words from where a case starts; nothing, if it is as by default."""
    if initial == ModelStart():
        return ""
    words = "where it stands"
    if model.nkey or initial.keyframe:
        words = f"its keyframe {initial.keyframe or element_name(model, OBJECT.mjOBJ_KEY, 0)}"
    if initial.random_rates is not None:
        most, seed = initial.random_rates.most, initial.random_rates.seed
        words += f", with rates up to {most:g} drawn by chance (seed {seed})"
    over = [*initial.joints, *(f"the rate of {name}" for name in initial.rates)]
    return f"{words}; {', '.join(over)} as its case says" if over else words


def _fill(
    model: mujoco.MjModel, joint: int, numbers: Sequence[Amount], into: np.ndarray, *, rate: bool
) -> None:
    kind = int(model.jnt_type[joint])
    wide = WIDTHS[kind][rate]
    first = (model.jnt_dofadr if rate else model.jnt_qposadr)[joint]
    if len(numbers) != wide:
        what = "number" if wide == 1 else "numbers"
        raise NumberMistake(f"should be {wide} {what}, has {len(numbers)}")
    unit = UNITS.get(kind)
    if unit is not None:
        unit = f"{unit}/s" if rate else unit
        numbers = [check_angle(check_unit(number, unit), unit) for number in numbers]
    values = np.array([number.value for number in numbers], dtype=np.float64)
    if not rate and wide > 1:
        length = np.linalg.norm(values[-4:])
        if not length:
            raise NumberMistake("its quaternion should not be 0")
        values[-4:] /= length
    into[first : first + wide] = values


def _bars(
    model: mujoco.MjModel, case: ModelCase, mistakes: list[Mistake]
) -> Iterator[tuple[Quantity, float]]:
    """Yields each quantity that is bounded, of all joints first, with its bar."""
    known = {quantity.name: quantity for quantity in quantities(model)}
    bars: dict[Quantity, float] = {}
    if (all_joints := case.allow.get(JOINTS)) is not None:
        bars |= dict.fromkeys(joint_quantities(model), all_joints.value)
    for name, bar in case.allow.items():
        path = ("allow", name)
        if name == JOINTS:
            continue
        if name not in known:
            hint = nearest(name, [JOINTS, *known])
            mistakes.append(case.mistake(path, f"the model has no such quantity: {name!r}{hint}"))
            continue
        quantity = known[name]
        try:
            bars[quantity] = check_unit(bar, quantity.unit or None).value
        except NumberMistake as error:
            mistakes.append(case.mistake(path, str(error)))
    yield from bars.items()
