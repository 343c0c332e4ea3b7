"""The limit of users' models, and their own steps, driven in time."""

from collections.abc import Callable
from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.cases.fields.signal import Signal
from textmech.engines.own_model import limit as limits
from textmech.engines.own_model.limit import limit, stepped
from textmech.engines.own_model.model import OwnModel, compiled_text

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
        ("a corner that is stepped over", "for t in self.controls.corners if first < t < last",
         "for t in ()"),
        ("a control that stays what it was", "if self.controls.laws:", "if False:"),
    ],
)  # fmt: skip
def test_a_lost_corner_is_seen(what: str, was: str, now: str) -> None:
    """Where all rests before a blow, steps are as long as the samples and pass it."""
    wrong: ModuleType = otherwise(limits, was, now)
    assert np.abs(limit(driven(BLOW), TIMES).q[:, 0] - after_blow(TIMES)).max() < 1e-9
    assert np.abs(wrong.limit(driven(BLOW), TIMES).q[:, 0] - after_blow(TIMES)).max() > 0.1


@pytest.mark.mutant("a jump seen before its time")
def test_a_piece_sees_what_stands_before_the_jump_at_its_end() -> None:
    """Else the integrator creeps up to it: it is right, at more than twice the cost."""
    asked = [0, 0]
    for k, module in enumerate((limits, otherwise(limits, "min(t, self.before)", "t"))):
        own = driven(STEP)
        equations = module.Equations(own, own.start())
        equations.followed(TIMES, "DOP853", 1e-10)
        asked[k] = equations.asked
    assert asked[1] > 2 * asked[0]


@pytest.mark.mutant("a control one step late")
def test_a_control_is_there_with_the_step_that_begins_with_it() -> None:
    """At 0.7 s, which seven steps of 0.1 s are 1e-16 s ahead of or behind."""
    own = driven(replace(STEP, times=(0.7,)))
    late: ModuleType = otherwise(limits, "(k + SLIGHT)", "(k - SLIGHT)")
    ends = np.array([0.0, 1.0])
    assert stepped(own, ends, "RK4", 0.1) == pytest.approx(np.array([[0.0], [0.3**2 / 4]]))
    assert late.stepped(own, ends, "RK4", 0.1)[-1, 0] < 0.2**2 / 4 + 1e-9
