"""What is seen of a model's own steps and not of its limit, in words; and what a solver costs."""

from dataclasses import replace
from types import ModuleType

import pytest
from given.otherwise import otherwise

from textmech.cases.find import models
from textmech.cases.load_model import load_model
from textmech.cases.model_case import ModelCase, of_model
from textmech.engines.own_model.opened import opened
from textmech.engines.own_model.quantities import Quantity
from textmech.reports.compare import own_seen, own_steps
from textmech.reports.compare.own_rows import modelled
from textmech.reports.compare.own_steps import limit_and_horizon, settings_of, steps, times_of
from textmech.reports.front.show.model import model_lines

WRIST = """\
<mujoco><option timestep="0.002" integrator="{integrator}"/><worldbody><body>
<joint name="wrist" axis="0 1 0" damping="1"/><geom size=".02" pos=".05 0 0" mass=".02"/>
</body></worldbody>
<actuator><position name="servo" joint="wrist" kp="1000" kv="100" {bound}/></actuator>
<keyframe><key qpos="0" ctrl=".3"/></keyframe></mujoco>"""
SHORT = WRIST.format(integrator="implicitfast", bound='forcerange="-20 20"')


def case_of(text: str) -> ModelCase:
    return replace(of_model("", "MJCF", "model", text), duration=0.4)


def seen_of(case: ModelCase, by: ModuleType = own_seen) -> own_seen.Seen:
    ready = opened(case)
    exact, until, _ = limit_and_horizon(ready, times_of(case, [ready.own.model.opt.timestep]))
    return by.seen(ready, exact, until)


def test_a_wrist_shakes_and_stays_short() -> None:
    shown = seen_of(case_of(SHORT))
    (words,) = shown.joints.values()
    assert words.startswith("wrist shakes at ")
    assert " short of its target; its own equations bring it there" in words
    assert any("at its force limit: servo in " in line for line in shown.beside)


def test_what_its_own_equations_do_as_well_is_none() -> None:
    """A servo that gravity holds short of its target is so for h → 0 as well."""
    text = SHORT.replace('kp="1000" kv="100"', 'kp=".05" kv=".002"')
    assert not seen_of(case_of(text)).joints


@pytest.mark.mutant("what the limit does as well is called the step's")
def test_a_limit_that_stays_short_is_asked() -> None:
    text = SHORT.replace('kp="1000" kv="100"', 'kp=".05" kv=".002"')
    wrong = otherwise(own_seen, " and arrives[k] < ARRIVES * off", "")
    assert seen_of(case_of(text), wrong).joints


def test_what_diverges_is_said_with_its_joint() -> None:
    (words,) = seen_of(case_of(WRIST.format(integrator="RK4", bound=""))).joints.values()
    assert words.startswith("wrist diverges after 0.0")


@pytest.mark.mutant("an energy's sign")
def test_energy_that_the_steps_lose() -> None:
    """A slide that a damper brakes: Euler's implicit damping brakes less than the law."""
    text = """\
<mujoco><option timestep="0.05" gravity="0 0 0"/><worldbody><body>
<joint name="rail" type="slide" axis="1 0 0" damping="4"/><geom size=".1" mass="1"/>
</body></worldbody><keyframe><key qpos="0" qvel="1"/></keyframe></mujoco>"""
    # After k steps m v² / 2 is 1 / 2 / 1.2^2k; by its law exp(-8 k h) / 2, which is less.
    case = case_of(text)
    (line,) = seen_of(case).beside
    assert line.startswith("its steps gain up to 0.0")
    wrong = otherwise(own_seen, "worst > 0", "worst < 0")
    assert seen_of(case, wrong).beside[0].startswith("its steps lose up to")


RESTS = """\
<mujoco><worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 .0995"><freejoint name="box"/>
<geom type="box" size=".1 .1 .1" mass="1"/></body></worldbody>
<keyframe><key qpos="0 0 .0995 1 0 0 0"/></keyframe></mujoco>"""


@pytest.mark.slow
def test_of_what_rests_no_energy_is_said_to_be_lost() -> None:
    """A tenth of a millijoule is several times all that it moves with, and nobody sees it."""
    case = case_of(RESTS)
    assert not modelled(case, ()).seen.beside
    assert seen_of(case).beside  # without regard to what is allowed


@pytest.mark.mutant("a ball that shakes about its second axis is called calm")
def test_a_ball_shakes_in_any_direction() -> None:
    quantity = Quantity("ball.turn", "rad", "joint", 3, 3)
    shown = own_seen.Seen({4: "ball shakes", 6: "other shakes"})
    assert shown.of(quantity) == "ball shakes"
    wrong = otherwise(own_seen, "quantity.first + quantity.wide", "quantity.first + 1")
    assert wrong.Seen(shown.joints).of(quantity) == ""


LANDS = """\
<mujoco><option timestep="0.002" iterations="1" ls_iterations="1"/><worldbody>
<geom type="plane" size="1 1 1"/>
<body pos="0 0 .06"><freejoint name="drops"/><geom type="capsule" size=".05" fromto="0 0 0 .3 0 0"/>
<body pos=".3 0 0"><joint axis="0 1 0"/><geom type="capsule" size=".05" fromto="0 0 0 .3 0 0"/>
</body></body></worldbody><keyframe><key qpos="0 0 .06 1 0 0 0 .3"/></keyframe></mujoco>"""


@pytest.mark.slow
def test_few_iterations_cost_what_a_row_of_its_own_says() -> None:
    case = case_of(LANDS)
    rows = {each.setting.name: each for each in steps(case, opened(case), ("solver",)).settings}
    assert rows["solver"].setting.options == {"iterations": 100, "ls_iterations": 50}
    q = next(iter(rows["own"].errors))
    few, many = (rows[name].errors[q].off for name in ("own", "solver"))
    assert few is not None
    assert many is not None
    assert few.max() > 1.5 * many.max()  # what one iteration costs is no less than half of the step


@pytest.mark.mutant("fewer iterations are no setting of their own")
def test_a_solver_as_it_ships_is_no_row(monkeypatch: pytest.MonkeyPatch) -> None:
    def names(text: str) -> list[str]:
        return [each.name for each in settings_of(opened(case_of(text)).own, ("solver",))]

    assert names(LANDS) == ["own", "solver"]
    assert names(LANDS.replace(' iterations="1" ls_iterations="1"', "")) == ["own"]
    wrong = otherwise(own_steps, "else has < value", "else has > value")
    monkeypatch.setattr(own_steps, "_has_less", wrong._has_less)
    assert names(LANDS) != ["own", "solver"]


@pytest.mark.slow
def test_run_says_it_on_its_first_screen_and_in_its_table() -> None:
    (case,) = load_model(models()["stiff_wrist"])
    done = modelled(case, ())
    (words,) = done.seen.joints.values()
    assert f"  {words}" in [*model_lines(done)]
    rows = {row.quantity: row for row in done.comparisons if row.setting == "own"}
    assert rows["wrist.angle"].because == words
    assert not any(row.because for q, row in rows.items() if q != "wrist.angle")
