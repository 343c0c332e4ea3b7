"""A user's model: compiled, or refused in the compiler's words, and what MuJoCo says of states."""

import copy
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import mujoco
import numpy as np

from ...cases.mistake import CaseError, Mistake
from ...cases.trajectory import Array
from ...cases.tree import BIAS, DRIVEN, MASS, PASSIVE, Tree
from .control import Controls, Law
from .numbers import element_name, numbers
from .places import Places, places
from .release import actuators, column, mass_matrix

VERSION = mujoco.__version__
LINE = re.compile(r"[Ll]ine(?: number)?[ =](\d+)")
RATE = 0.5  # rad/s, m/s: of rates that are drawn, so that no term of an equation rests
REACH = 0.5  # rad, m: how far coordinates are drawn about the start


@dataclass(frozen=True)
class State:
    """Coordinates q (m,), velocities v (n,), and controls u."""

    q: Array
    v: Array
    u: Array


@dataclass(frozen=True)
class OwnModel:
    """A compiled model, and the file that it is of."""

    file: str
    model: mujoco.MjModel
    laws: Mapping[int, Law] = field(default_factory=dict[int, Law])
    """What some controls follow, by their number; all others stay as they start."""
    begun: mujoco.MjData | None = None
    begins: str = ""
    """From where, in words, if it is not by default."""
    xml: str | Path | None = None
    """The text or the file that was compiled, if it was one."""

    @property
    def controls(self) -> Controls:
        """Its controls as functions of time."""
        return Controls(np.array(self.start().ctrl), self.laws)

    @cached_property
    def tree(self) -> Tree:
        """The model's numbers."""
        return numbers(self.model, self.start(), self.places)

    @cached_property
    def places(self) -> Places:
        """At which lines of its file its elements stand."""
        return places(self.model, self.xml, self.file)

    def start(self) -> mujoco.MjData:
        """Returns where it starts, by default as `drawn_start` has it with the first keyframe."""
        begun = self.begun or drawn_start(self.model, 0 if self.model.nkey else None)
        return copy.copy(begun)

    @property
    def started(self) -> str:
        """The start, in words."""
        if self.begins:
            return f"from {self.begins}"
        if self.model.nkey:
            name = element_name(self.model, mujoco.mjtObj.mjOBJ_KEY, 0)
            return f"from its keyframe {name}, with the keyframe's controls"
        return f"from where it stands, with rates up to {RATE} rad/s and m/s drawn by chance"

    def moving(self, duration: float) -> Iterator[State]:
        """Yields the states at its own steps from the start on, as far as they are numbers [s]."""
        data = self.start()
        for _ in range(int(duration / self.model.opt.timestep)):
            mujoco.mj_step(self.model, data)
            if any(int(data.warning[kind].number) for kind in BROKEN):
                return
            yield State(data.qpos.copy(), data.qvel.copy(), data.ctrl.copy())

    def drawn(self, count: int, seed: int = 0) -> Iterator[State]:
        """Yields so many states about the start, with rates, and controls within their range."""
        random, start, m = np.random.default_rng(seed), self.start(), self.model
        low, high = m.actuator_ctrlrange.T if m.nu else (np.zeros(0), np.zeros(0))
        limited = np.array(m.actuator_ctrllimited, dtype=bool)
        for _ in range(count):
            q = displaced(m, start.qpos, random.uniform(-REACH, REACH, m.nv))
            u = random.uniform(np.where(limited, low, -1.0), np.where(limited, high, 1.0))
            yield State(q, random.uniform(-RATE, RATE, m.nv), u)

    def parts(self, state: State) -> Mapping[str, Array]:
        """Returns MuJoCo's own parts of the equations of motion in a state."""
        m, data = self.model, self.start()
        data.qpos[:], data.qvel[:], data.ctrl[:] = state.q, state.v, state.u
        mujoco.mj_fwdPosition(m, data)
        mujoco.mj_fwdVelocity(m, data)
        mujoco.mj_fwdActuation(m, data)
        own = {BIAS: data.qfrc_bias, PASSIVE: data.qfrc_passive, DRIVEN: data.qfrc_actuator}
        return {MASS: mass_matrix(m, data)} | {
            part: np.array(values) for part, values in own.items()
        }

    def __str__(self) -> str:
        m = self.model
        integrator = mujoco.mjtIntegrator(m.opt.integrator).name.removeprefix("mjINT_")
        counts = {"body": m.nbody - 1, "joint": m.njnt, "degree of freedom": m.nv}
        counts |= {"actuator": actuators(m), "equality": m.neq}
        words = ", ".join(_count(word, number) for word, number in counts.items() if number)
        step = f"{m.opt.timestep * 1e3:.4g} ms, {integrator.lower()}"
        return (
            f"MuJoCo {mujoco.__version__} compiles it: {words or 'nothing moves'}; own step {step}"
        )


def drawn_start(
    model: mujoco.MjModel, keyframe: int | None, *, still: bool = False
) -> mujoco.MjData:
    """Returns a keyframe with its controls, or where the model stands.

    There position servos hold where they are, all else is not driven, and unless it is to be still
    rates are drawn by chance, as rest hides much.
    """
    data, m = mujoco.MjData(model), model
    if keyframe is not None:
        mujoco.mj_resetDataKeyframe(m, data, keyframe)
        return data
    mujoco.mj_forward(m, data)
    for i in np.flatnonzero(m.actuator_biasprm[:, 1] == -m.actuator_gainprm[:, 0]):
        if m.actuator_gainprm[i, 0]:
            control, length = (column(m, f"actuator_{of}adr")[i] for of in ("ctrl", "out"))
            data.ctrl[control] = data.actuator_length[length]
    if not still:
        data.qvel[:] = drawn_rates(m)
    return data


def drawn_rates(model: mujoco.MjModel, most: float = RATE, seed: int = 0) -> Array:
    """(n,) rates up to `most` [rad/s, m/s], drawn by chance."""
    return np.random.default_rng(seed).uniform(-most, most, model.nv)


def joint_moves(model: mujoco.MjModel, start: Array, end: Array) -> Array:
    """(N, n) [rad, m] displacement of each joint between two coordinates (N, m)."""
    joints = np.empty((len(start), model.nv))
    for row, a, b in zip(joints, start, end, strict=True):
        mujoco.mj_differentiatePos(model, row, 1.0, a, b)
    return joints


def image(model: mujoco.MjModel) -> bytes:
    """Returns all numbers of a compiled model."""
    buffer = np.empty(mujoco.mj_sizeModel(model), dtype=np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer.tobytes()


def displaced(model: mujoco.MjModel, q: Array, by: Array) -> Array:
    """Returns coordinates q (m,) displaced in each joint by (n,) [rad, m]."""
    other = np.array(q)
    mujoco.mj_integratePos(model, other, by, 1.0)
    return other


PLURALS = {"body": "bodies", "degree of freedom": "degrees of freedom", "equality": "equalities"}
WARNINGS = mujoco.mjtWarning
BROKEN = (WARNINGS.mjWARN_BADQPOS, WARNINGS.mjWARN_BADQVEL, WARNINGS.mjWARN_BADQACC)


def _count(word: str, number: int) -> str:
    return f"{number} {word if number == 1 else PLURALS.get(word, f'{word}s')}"


def compiled(file: str) -> OwnModel:
    """Compiles an MJCF or URDF file. Raises CaseError with the compiler's words and line."""
    return compiled_by(file, lambda: mujoco.MjModel.from_xml_path(file), Path(file))


def compiled_text(text: str, name: str = "MJCF") -> OwnModel:
    """Compiles the text of a model; name: what it is called. Raises CaseError as `compiled`."""
    return compiled_by(name, lambda: mujoco.MjModel.from_xml_string(text), text)


def compiled_by(
    file: str, compile_: Callable[[], mujoco.MjModel], xml: str | Path | None = None
) -> OwnModel:
    """Returns the model that a function compiles, of some XML. Raises CaseError as `compiled`."""
    try:
        own = OwnModel(file, compile_(), xml=xml)
    except (ValueError, OSError, mujoco.FatalError) as error:
        words = " ".join(str(error).split())
        line = LINE.search(words)
        what = f"MuJoCo {mujoco.__version__} does not compile it: {words}"
        place = (int(line[1]), 1) if line else (0, 0)
        raise CaseError([Mistake(file, *place, "", what)]) from None
    start = own.start()
    for name in ("qpos", "qvel", "act", "ctrl"):
        values = getattr(start, name)
        if not np.all(np.abs(values) < mujoco.mjMAXVAL):
            what = f"its first keyframe should hold numbers below {mujoco.mjMAXVAL:.0e}"
            raise CaseError([Mistake(file, 0, 0, f"keyframe.{name}", what)])
    return own
