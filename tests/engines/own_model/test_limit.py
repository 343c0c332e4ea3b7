"""The limit of users' models, and their own steps, driven in time."""

from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.cases.fields.signal import Signal
from textmech.engines.own_model import equations as ours
from textmech.engines.own_model import limit as limits
from textmech.engines.own_model.limit import limit, stepped
from textmech.engines.own_model.model import OwnModel, compiled_text, joint_moves

Motion = Callable[[np.ndarray], np.ndarray]
TIMES = np.linspace(0.0, 1.0, 11)

DRIVEN = """\
<mujoco><option timestep="0.01" gravity="0 0 0"/><worldbody><body><joint name="slides" type="slide"
axis="1 0 0"/><geom size=".1" mass="2"/></body></worldbody>
<actuator><motor joint="slides"/></actuator><keyframe><key qpos="0"/></keyframe></mujoco>"""
"""x″ = u / 2."""

JUMP, KINK = 0.333, 0.25
STEP = Signal("step", (1.0,), times=(JUMP,))
TABLE = Signal("table", (1.0,), times=(0.0, KINK, 1.0), values=(0.0, 1.0, 0.0))
SINE = Signal("sine", (1.0,), angular_frequency=7.0)


def driven(law: Signal, text: str = DRIVEN) -> OwnModel:
    return replace(compiled_text(text), laws={0: law})


def after_step(t: np.ndarray) -> np.ndarray:
    """x of x″ = 1/2 from the jump on."""
    return np.maximum(t - JUMP, 0.0) ** 2 / 4


def by_table(t: np.ndarray) -> np.ndarray:
    """x of x″ = t / 2k up to the kink k, and from there (1 - t) / 2(1 - k)."""
    k, late = KINK, np.maximum(t - KINK, 0.0)
    early = np.minimum(t, k)
    rises = early**3 / (12 * k)
    return rises + k / 4 * late + late**2 / 4 - late**3 / (12 * (1 - k))


def by_sine(t: np.ndarray) -> np.ndarray:
    """x of x″ = sin(w t) / 2."""
    w = SINE.angular_frequency
    return (t / w - np.sin(w * t) / w**2) / 2


WANTED = [(STEP, after_step), (TABLE, by_table), (SINE, by_sine)]


@pytest.mark.parametrize(("law", "wanted"), WANTED)
def test_a_limit_is_driven_in_time(law: Signal, wanted: Motion) -> None:
    exact = limit(driven(law), TIMES)
    assert np.abs(exact.q[:, 0] - wanted(TIMES)).max() < 1e-9
    assert exact.error < 1e-9


@pytest.mark.parametrize(("law", "wanted"), WANTED)
def test_steps_take_the_control_of_their_beginning(law: Signal, wanted: Motion) -> None:
    """Their error is h/2 of the control's change, and of the order 1."""
    off = []
    for h in (0.01, 0.001, 0.0001):
        q = stepped(driven(law), TIMES, "RK4", h)
        assert q is not None
        off.append(np.abs(q[:, 0] - wanted(TIMES)).max())
    assert off[0] < 0.01
    assert off[2] < 0.03 * off[0]


BLOW = Signal("pulse", (1000.0,), times=(JUMP, JUMP + 1e-3))


def after_blow(t: np.ndarray) -> np.ndarray:
    """x of x″ = 500 for a millisecond from the jump on."""
    since = np.maximum(t - JUMP, 0.0)
    return 250 * np.minimum(since, 1e-3) ** 2 + 0.5 * np.maximum(since - 1e-3, 0.0)


@pytest.mark.mutant("{what}")
@pytest.mark.parametrize(
    ("what", "was", "now"),
    [
        ("a corner that is stepped over",
         "self.controls.corners if times[0] < t < times[-1]]", "()]"),
        ("a control that stays what it was", "self.controls.at(min(t, self.before))", "0.0"),
    ],
)  # fmt: skip
def test_a_lost_corner_is_seen(
    what: str, was: str, now: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where all rests before a blow, steps are as long as the samples and pass it."""
    assert np.abs(limit(driven(BLOW), TIMES).q[:, 0] - after_blow(TIMES)).max() < 1e-9
    monkeypatch.setattr(limits, "Equations", otherwise(ours, was, now).Equations)
    assert np.abs(limit(driven(BLOW), TIMES).q[:, 0] - after_blow(TIMES)).max() > 0.1


@pytest.mark.mutant("a jump seen before its time")
def test_a_piece_sees_what_stands_before_the_jump_at_its_end() -> None:
    """Else the integrator creeps up to it: it is right, at half as much cost again."""
    asked = [0, 0]
    for k, module in enumerate((ours, otherwise(ours, "min(t, self.before)", "t"))):
        own = driven(STEP)
        equations = module.Equations(own, own.start())
        equations.followed(TIMES, limits._fine(1))
        asked[k] = module.MOST - equations.left
    assert asked[1] > 1.5 * asked[0]


@pytest.mark.mutant("a control one step late")
def test_a_control_is_there_with_the_step_that_begins_with_it() -> None:
    """At 0.7 s, which seven steps of 0.1 s are 1e-16 s ahead of or behind."""
    own = driven(replace(STEP, times=(0.7,)))
    late: ModuleType = otherwise(limits, "at((k + SLIGHT) * h)", "at((k - SLIGHT) * h)")
    ends = np.array([0.0, 1.0])
    assert stepped(own, ends, "RK4", 0.1) == pytest.approx(np.array([[0.0], [0.3**2 / 4]]))
    assert late.stepped(own, ends, "RK4", 0.1)[-1, 0] < 0.2**2 / 4 + 1e-9


SERVO = """\
<mujoco><option timestep="0.002" integrator="implicitfast"/><worldbody><body>
<joint name="wrist" axis="0 1 0"/><geom size=".02" pos=".05 0 0" mass=".1"/></body></worldbody>
<actuator><position joint="wrist" kp="1000" kv="100" forcerange="-20 20"/></actuator>
<keyframe><key qpos="0" ctrl=".3"/></keyframe></mujoco>"""
"""(kv h / M_eff is above 700, and its servo at its limit at first."""


def test_a_stiff_servo_is_integrated_by_an_implicit_method() -> None:
    exact = limit(compiled_text(SERVO), TIMES)
    assert "Radau" in exact.method
    assert exact.error < 1e-6
    assert exact.q[-1, 0] == pytest.approx(0.3, abs=1e-3)


TWO_KINDS = """\
<mujoco><option timestep="0.004"/><worldbody>
<geom type="plane" size="1 1 1" solref=".001 1"/>
<body pos="0 0 .102"><freejoint name="ball"/><geom size=".1" mass="1" solref=".001 1"/></body>
<body pos="1 0 .102"><freejoint name="other"/><geom size=".1" mass="1"/></body></worldbody>
<keyframe><key qpos="0 0 .102 1 0 0 0 1 0 .102 1 0 0 0"/></keyframe></mujoco>"""
SHORT = np.linspace(0.0, 0.2, 21)


SMALL_STEPS = {
    "a law of the small step": ("mujoco.mj_forward(m, d)\n            mujoco.mj_implicit",
                                "mujoco.mj_forward(fine, d)\n            mujoco.mj_implicit"),
    "steps of another length": ("h = fine.opt.timestep =", "h = fine.opt.timestep = 1.01 *"),
}  # fmt: skip


@pytest.mark.parametrize(
    ("what", "was", "now"),
    [
        ("nothing", "self.steps += count", "self.steps += count"),
        *(
            pytest.param(what, *line, marks=pytest.mark.mutant(what))
            for what, line in SMALL_STEPS.items()
        ),
    ],
)
def test_small_steps_reach_what_the_integrators_do(
    what: str, was: str, now: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of contacts of two kinds too, of which `refsafe` raises one: the law is the own step's."""
    own = compiled_text(TWO_KINDS)
    exact = limit(own, SHORT)
    assert "small steps" not in exact.method
    assert exact.error < 1e-6
    module: Any = otherwise(ours, was, now)
    module.MOST = module.LEAST = 10
    monkeypatch.setattr(limits, "Equations", module.Equations)
    rough = limit(own, SHORT, within=1e-5)
    assert rough.method == "small steps"
    off = float(np.abs(joint_moves(own.model, rough.q, exact.q)).max())
    near = off < 2 * max(rough.error, 1e-6)
    good = near and rough.error < 1e-5 and rough.fineness.parts > limits.PARTS
    assert good is (what == "nothing")


@pytest.mark.mutant("a limit's error beside an answer of the same tolerances")
@pytest.mark.parametrize("was", [None, "equations.followed(times, _coarse(fineness.parts // 2))"])
def test_both_answers_of_a_finer_limit_are_new(
    was: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where no small steps are taken they would else be one, and the error 0."""
    asked: list[ours.Fineness] = []

    class Noted(ours.Equations):
        def followed(self, times: np.ndarray, to: ours.Fineness) -> np.ndarray:
            asked.append(to)
            return super().followed(times, to)

    monkeypatch.setattr(ours, "MOST", 10)
    monkeypatch.setattr(ours, "LEAST", 10)
    module: Any = limits if was is None else otherwise(limits, was, "fine")
    monkeypatch.setattr(module, "Equations", Noted)
    module.limit(compiled_text(TWO_KINDS), SHORT, within=1e-5)
    assert len(asked) > 2
    coarse, fine = asked[-2:]
    other = coarse.smooth > fine.smooth and coarse.parts * 2 == fine.parts
    assert other is (was is None)


def test_a_disturbance_is_followed_as_finely_as_the_limit() -> None:
    own = compiled_text(SERVO)
    start, exact = own.start(), limit(own, TIMES)
    start.qpos[0] += 1e-6
    off = np.abs(limits.repeat_limit(own, exact, start) - exact.y)[:, 0]
    assert off[0] == pytest.approx(1e-6)
    assert off[-1] < 1e-6


@pytest.mark.mutant("a limit of constraints that are solved as roughly as the model says")
@pytest.mark.parametrize("lost", ["iterations", "ls_iterations"])
def test_constraints_are_solved_whatever_iterations_a_model_has(
    lost: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A chain that falls upon a plane: files for MJX have one iteration, of few searches."""
    exact = limit(compiled_text(FALLING), SHORT[:9])
    few = FALLING.replace("<option ", '<option iterations="1" ls_iterations="1" ')
    assert np.array_equal(limit(compiled_text(few), SHORT[:9]).q, exact.q)
    less = {name: value for name, value in ours.EXACT_SOLVER.items() if name != lost}
    monkeypatch.setattr(ours, "EXACT_SOLVER", less)
    assert not np.array_equal(limit(compiled_text(few), SHORT[:9]).q, exact.q)


FALLING = """\
<mujoco><option timestep="0.002"/><worldbody><geom type="plane" size="1 1 1"/>
<body pos="0 0 .06"><freejoint/><geom type="capsule" size=".05" fromto="0 0 0 .3 0 0"/>
<body pos=".3 0 0"><joint axis="0 1 0"/><geom type="capsule" size=".05" fromto="0 0 0 .3 0 0"/>
<body pos=".3 0 0"><joint axis="0 0 1"/><geom type="capsule" size=".05" fromto="0 0 0 .3 0 .1"/>
</body></body></body></worldbody><keyframe><key qpos="0 0 .06 1 0 0 0 .1 0"
qvel="1 .5 -.5 1 0 0 0 0"/></keyframe></mujoco>"""


@pytest.mark.mutant("an activation without its range")
def test_an_activation_stays_in_its_range(monkeypatch: pytest.MonkeyPatch) -> None:
    own = compiled_text(INTEGRATING)
    wanted = stepped(own, TIMES, "implicitfast", 1e-4)
    exact = limit(own, TIMES)
    assert wanted is not None
    assert exact.y[-1, 2] == pytest.approx(0.2, abs=1e-6)
    assert np.abs(exact.q - wanted).max() < 1e-3
    monkeypatch.setattr(ours, "_act_range", lambda m: np.array([[-np.inf], [np.inf]]))
    assert np.abs(limit(own, TIMES).q - wanted).max() > 0.1


INTEGRATING = """\
<mujoco><option timestep="0.002" gravity="0 0 0"/><worldbody><body>
<joint name="turns" axis="0 0 1" damping="1"/><geom size=".1" mass="1" pos=".3 0 0"/></body>
</worldbody><actuator><intvelocity joint="turns" kp="10" kv="1" actrange="-.2 .2"/></actuator>
<keyframe><key qpos="0" ctrl="1"/></keyframe></mujoco>"""
