"""A run of a model's own steps as a Python script that needs MuJoCo and numpy alone."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from pprint import pformat
from typing import Any

import mujoco

from ...cases.fields.signal import Signal
from ...cases.model_case import Law, Steps
from .equations import SLIGHT
from .limit import SOLREF, WORDS
from .model import BROKEN, OwnModel

WIDTH = 96  # letters of a line of numbers
STARTS = ("qpos", "qvel", "act", "ctrl", "mocap_pos", "mocap_quat")


def script(
    own: OwnModel, file: str, options: Mapping[str, Any], h: float, steps: int, every: int
) -> list[str]:
    """Returns the lines of a script that makes so many steps h [s], and prints q at every n-th.

    What it makes is bit for bit what `stepped_states` makes. options: of `mjOption`, over the
    model's own.
    """
    lines = [*_model(own, file, options, h), *_start(own), *_loop(own, h, steps, every)]
    numpy = ["import numpy as np"] if any("np." in line for line in lines) else []
    return ["import mujoco", *numpy, "", *lines]


def _model(own: OwnModel, file: str, options: Mapping[str, Any], h: float) -> Iterator[str]:
    m, step = own.model, own.model.opt.timestep
    yield f"model = mujoco.MjModel.from_xml_path({file!r})"
    if m.opt.disableflags & CONTACT:
        yield f"model.opt.disableflags |= mujoco.{CONTACT}"
    for name, value in options.items():
        word = WORDS.get(name, {}).get(value)
        yield f"model.opt.{name} = " + (repr(value) if word is None else f"mujoco.{word}")
    if h != step:
        yield f"model.opt.timestep = {h!r}"
    columns = {f"model.{name}": getattr(m, name) for name in SOLREF}
    columns["model.opt.o_solref"] = m.opt.o_solref
    short = [
        name for name, solref in columns.items()
        if ((solref[..., 0] > 0) & (solref[..., 0] < 2 * step)).any()
    ]  # fmt: skip
    if h < step and short and not m.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_REFSAFE:
        yield "# refsafe raises what is below 2h: that stays as it is at the model's own step"
        yield f"for solref in ({', '.join(short)},):"
        yield "    times = solref[..., :1]"
        yield f"    times[(times > 0) & (times < {2 * step!r})] = {2 * step!r}"


def _start(own: OwnModel) -> Iterator[str]:
    yield "data = mujoco.MjData(model)"
    start, fresh = own.start(), mujoco.MjData(own.model)
    for name in STARTS:
        values = getattr(start, name)
        if values.tobytes() != getattr(fresh, name).tobytes():
            yield f"data.{name}[:] = {_literal(values.tolist())}"


CONTACT = mujoco.mjtDisableBit.mjDSBL_CONTACT


def _loop(own: OwnModel, h: float, steps: int, every: int) -> Iterator[str]:
    tables: list[str] = []

    def named(values: Sequence[float]) -> str:
        """Returns the name of an array, which is written down once."""
        text = f"np.array({_literal([*values])})"
        if text not in tables:
            tables.append(text)
        return f"table_{tables.index(text)}"

    driven = {
        control: _law(law, named) for control, law in own.laws.items() if not _is_constant(law)
    }
    yield from (f"table_{k} = {text}" for k, text in enumerate(tables))
    yield "broken = ("
    yield from (f"    mujoco.{kind}," for kind in BROKEN)
    yield ")"
    yield f"h, steps, every = {h!r}, {steps}, {every}"
    yield "print(0.0, *data.qpos)"
    yield "for k in range(steps):"
    if driven:
        yield f"    t = (k + {SLIGHT!r}) * h  # what jumps at the beginning of a step has jumped"
    yield from (f"    data.ctrl[{control}] = {law}" for control, law in driven.items())
    yield from LOOP.splitlines()


LOOP = """\
    mujoco.mj_step(model, data)
    if any(data.warning[kind].number for kind in broken):
        raise SystemExit(f"diverges in the step from {k * h} s")
    if (k + 1) % every == 0:
        print((k + 1) * h, *data.qpos)
"""


def _literal(values: list[Any]) -> str:
    return pformat(values, width=WIDTH, compact=True)


def _is_constant(law: Law) -> bool:
    return isinstance(law, Signal) and law.law == "constant"


def _law(law: Law, named: Callable[[Sequence[float]], str]) -> str:
    """Returns a law in time as an expression of t, in the very operations of its noun."""
    if isinstance(law, Steps):
        place = f'np.searchsorted({named(law.times)}, t, side="right") - 1'
        return f"{named(law.values)}[max({place}, 0)]"
    assert isinstance(law, Signal)
    w, phase, times, values = law.angular_frequency, law.phase, law.times, law.values
    factor = {
        "ramp": lambda: "t",
        "sine": lambda: f"np.sin({w!r} * t + {phase!r})",
        "step": lambda: f"(t >= {times[0]!r})",
        "pulse": lambda: f"({times[0]!r} <= t < {times[1]!r})",
        "polynomial": lambda: f"np.polynomial.polynomial.polyval(t, {named(values)})",
        "table": lambda: f"np.interp(t, {named(times)}, {named(values)})",
    }[law.law]()
    return f"{factor} * {law.amplitude[0]!r}"
