"""Users' models at their steps against their limit, and the limit against equations of our own."""

from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise
from scipy.integrate import solve_ivp

from textmech.cases.fields.number import Amount
from textmech.cases.model_case import JOINTS, TOLERANCE, ModelCase, of_model
from textmech.engines.own_model import equations as ours
from textmech.engines.own_model import limit as limits
from textmech.engines.own_model.limit import NoLimit, limit
from textmech.engines.own_model.model import OwnModel, compiled_text, joint_moves
from textmech.engines.own_model.opened import opened
from textmech.engines.own_model.step_law import with_step
from textmech.reference.formalisms import tree_equations
from textmech.reports.compare import own_steps
from textmech.reports.compare.own_steps import OWN, Stepped, Steps, steps

TIMES = np.linspace(0.0, 1.0, 11)

ACROBOT = """\
<mujoco><option timestep="0.01" integrator="RK4"/><worldbody><body><joint name="shoulder"
axis="0 1 0" damping=".05"/><geom type="capsule" size=".05 .5" pos="0 0 .5" mass="1"/>
<body pos="0 0 1"><joint name="elbow" axis="0 1 0" stiffness="2"/>
<geom type="capsule" size=".05 .5" pos="0 0 .5" mass="1"/></body></body></worldbody>
<actuator><position joint="elbow" kp="3"/></actuator></mujoco>"""

TUMBLER = """\
<mujoco><option timestep="0.005" gravity="0 0 0"/><worldbody><body><freejoint name="tumbles"/>
<inertial pos=".1 0 0" mass="1" diaginertia=".1 .2 .25"/></body></worldbody>
<keyframe><key qpos="0 0 0 1 0 0 0" qvel="1 0 0 .1 3 .1"/></keyframe></mujoco>"""

BALL = """\
<mujoco><option timestep="0.002"/><worldbody><geom type="plane" size="1 1 1"/>
<body pos="0 0 .105"><freejoint name="ball"/><geom size=".1" mass="1"/></body></worldbody>
</mujoco>"""

STIFF = """\
<mujoco><option timestep="0.01"><flag eulerdamp="disable"/></option><worldbody><body>
<joint name="wrist" axis="0 0 1" damping="5"/><geom size=".1" mass="1"/></body></worldbody>
</mujoco>"""


def case_of(text: str, tolerance: float = TOLERANCE) -> ModelCase:
    return replace(of_model("", "MJCF", "model", text), allow={JOINTS: Amount(tolerance)})


def stepped(text: str, tolerance: float = TOLERANCE) -> Steps:
    case = case_of(text, tolerance)
    return steps(case, opened(case))


def of(result: Steps, setting: str) -> Stepped:
    return next(each for each in result.settings if each.setting.name == setting)


def worst(stepped: Stepped) -> float:
    return max(
        float(np.max(error.off)) for error in stepped.errors.values() if error.off is not None
    )


def order(stepped: Stepped) -> float | None:
    last = [*stepped.errors.values()][-1].ladder
    return last.order if last else None


def by_our_equations(own: OwnModel, start: Any) -> np.ndarray:
    """q (N, m) of a model of hinges, by the equations of the textbook and scipy, without MuJoCo."""
    tree = own.tree

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        q, v = np.split(y, 2)
        bodies = tree_equations.moving(tree, q, v)
        forces = tree_equations.passive(tree, q, v, bodies).forces
        forces = forces + tree_equations.driven(tree, q, v, start.ctrl, bodies).forces
        forces = forces - tree_equations.bias(tree, bodies)
        return np.concatenate(
            [v, np.linalg.solve(tree_equations.mass_matrix(tree, bodies), forces)]
        )

    y = np.concatenate([start.qpos, start.qvel])
    found = solve_ivp(rate, (0.0, 1.0), y, "DOP853", TIMES, rtol=1e-11, atol=1e-13)
    return found.y.T[:, : own.model.nq]


def test_the_limit_is_the_motion_of_the_textbooks_equations() -> None:
    own = compiled_text(ACROBOT)
    exact = limit(own, TIMES)
    assert exact.error < 1e-7
    assert np.abs(exact.q - by_our_equations(own, own.start())).max() < 1e-8


@pytest.mark.mutant("{what}")
@pytest.mark.parametrize(
    ("what", "was", "now"),
    [
        ("a limit without the controls", '"act", "ctrl",', '"act",'),
        ("a limit with another gravity", "self.fine = copy",
         "self.model.opt.gravity[2] = -9.80665; self.fine = copy"),
    ],
)  # fmt: skip
def test_another_limit_is_seen(
    what: str, was: str, now: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    own, wrong = compiled_text(ACROBOT), otherwise(ours, was, now)
    start = own.start()
    start.ctrl[:] = 1.0
    wanted = by_our_equations(own, start)
    assert np.abs(limit(own, TIMES, start).q - wanted).max() < 1e-8
    monkeypatch.setattr(limits, "Equations", wrong.Equations)
    assert np.abs(limit(own, TIMES, start).q - wanted).max() > 1e-5


def test_orders_are_those_of_the_methods() -> None:
    rk4, euler = (of(stepped(ACROBOT), setting) for setting in (OWN, "shipped"))
    assert order(rk4) == pytest.approx(4, abs=0.2)
    assert order(euler) == pytest.approx(1, abs=0.2)  # of h/4 and h/8
    assert rk4.keeps == 0.04
    assert worst(euler) > 50 * worst(rk4) > 0.0


@pytest.mark.mutant("a quaternion that turns the other way")
def test_a_free_body_tumbles_as_its_steps_do(monkeypatch: pytest.MonkeyPatch) -> None:
    """The middle axis: by RK4, which is exact to 1e-9 at small steps."""
    own = compiled_text(TUMBLER)
    exact, fine = limit(own, TIMES), limits.stepped(own, TIMES, "RK4", 0.00125)
    assert fine is not None
    assert np.abs(joint_moves(own.model, exact.q, fine)).max() < 1e-7
    wrong = otherwise(ours, "q + 4], v[at : at + 3])", "q + 4], -v[at : at + 3])")
    monkeypatch.setattr(limits, "Equations", wrong.Equations)
    other = limit(own, TIMES)
    assert np.abs(joint_moves(own.model, other.q, fine)).max() > 1e-2


def test_what_diverges_has_no_error() -> None:
    own = of(stepped(STIFF), OWN)
    assert own.y is None
    assert own.keeps is None or own.keeps < 0.01


def test_a_contact_has_a_limit_and_finer_steps_reach_it() -> None:
    own = of(stepped(BALL), OWN)
    assert own.keeps is not None
    assert 0.0 < worst(own) < 0.01


@pytest.mark.mutant("a contact whose law follows the step")
def test_the_law_is_that_of_the_models_own_step() -> None:
    """With a time constant below two steps `refsafe` raises it: what is finer is no other law."""
    text = BALL.replace("<geom ", '<geom solref=".001 1" ')
    own = compiled_text(text)
    wrong: ModuleType = otherwise(limits, "] = least", "] *= 1.0")
    exact = limit(own, TIMES)
    fine = {module: module.stepped(own, TIMES, "RK4", 2e-5) for module in (limits, wrong)}
    off = {module: np.abs(joint_moves(own.model, exact.q, q)).max() for module, q in fine.items()}
    assert off[limits] < 1e-5
    assert off[wrong] > 1e-4


@pytest.mark.mutant("finer steps of a law that no finer step has")
def test_contacts_of_two_kinds_have_no_finer_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """`refsafe` acts on what MuJoCo mixes of two geoms, and not on each."""
    text = BALL.replace('<geom size=".1"', '<geom size=".1" solref=".001 1"')
    own = compiled_text(text)
    assert "pair by pair" in stepped(text).note
    assert own_steps._rungs(own) == (4.0, 2.0, 1.0)
    monkeypatch.setattr(own_steps, "apart_by_pairs", lambda model: False)
    assert min(own_steps._rungs(own)) < 1.0


EARLY = '<general joint="elbow" dyntype="filter" dynprm=".1" actearly="true"/>'
LATE = '<position joint="elbow" kp="3" delay="0.02" nsample="4"/>'


@pytest.mark.parametrize(("words", "why"), [(LATE, "delay"), (EARLY, "actearly")])
def test_what_hangs_on_the_step_has_no_limit(words: str, why: str) -> None:
    text = ACROBOT.replace('<position joint="elbow" kp="3"/>', words)
    own = compiled_text(text)
    assert with_step(own)
    with pytest.raises(NoLimit, match=why):
        stepped(text)


def test_a_rough_limit_judges_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no integrator comes through, its own small steps stand for the limit."""
    monkeypatch.setattr(ours, "LEAST", 10)
    monkeypatch.setattr(ours, "MOST", 10)
    monkeypatch.setattr(limits, "MOST_STEPS", 0)
    rough = stepped(ACROBOT.replace('integrator="RK4"', ""), tolerance=1e-6)
    assert rough.limit.method == "small steps"
    assert all(each.keeps is None for each in rough.settings)


def test_a_disturbance_that_grows_ends_what_is_judged(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(own_steps, "DISTURBED", 1e-4)
    assert stepped(ACROBOT, tolerance=2e-4).until < 1.0
    assert stepped(ACROBOT, tolerance=1.0).until == pytest.approx(1.0, abs=0.05)


PRESSED = BALL.replace('<geom size=".1" mass="1"/>', '<geom size=".1" mass="1"/><site name="s" '
                       'type="box" size=".2 .2 .2"/>').replace(
    "</worldbody>", '</worldbody><sensor><touch name="press" site="s"/></sensor>')  # fmt: skip


@pytest.mark.mutant("a limit that is compared with itself")
def test_the_limit_of_a_force_is_known_by_its_own_unit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two answers that are 1e-4 m apart may be newtons apart, and that is the allowed place's."""
    allow = {"press.value": Amount(1.0), "ball.place": Amount(0.1)}
    case = replace(of_model("", "MJCF", "model", PRESSED), allow=allow)
    ready, times = opened(case), np.linspace(0.0, 0.2, 11)
    exact = limit(ready.own, times)
    coarser = exact.y.copy()
    coarser[6:, 2] -= 1e-4  # m, of the contact's depth
    rough = replace(exact, coarser=coarser)
    place, press = sorted(own_steps.limit_doubts(ready, rough).items(), key=lambda d: d[0].name)
    assert place[1].tolist() == pytest.approx([0.0] * 6 + [1e-4] * 5)
    assert press[1][5] == 0.0
    assert press[1][6] > 0.3  # N
    monkeypatch.setattr(own_steps, "limit", lambda *given, **within: rough)
    _, until, late = own_steps.limit_and_horizon(ready, times)
    assert until == times[5]
    assert late.startswith("later press.value of the limit is known to ")
    same = otherwise(own_steps, "(exact.coarser, exact.y)", "(exact.y, exact.y)")
    assert not any(doubt.any() for doubt in same.limit_doubts(ready, rough).values())


@pytest.mark.mutant("a model that agrees at its start alone")
def test_a_tolerance_below_the_disturbance_judges_nothing() -> None:
    case = replace(of_model("", "MJCF", "model", ACROBOT), allow={"energy": Amount(1e-12)})
    with pytest.raises(NoLimit, match="a disturbance of 1e-09 exceeds a tolerance at once"):
        steps(case, opened(case))
    agrees = otherwise(own_steps, "if horizon == exact.times[0] < end:", "if False:")
    assert agrees.steps(case, opened(case)).until == 0.0
