"""From a case of a model to its start, its controls and its bars, by the model's own names."""

from dataclasses import replace

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.cases.fields.number import Amount
from textmech.cases.fields.signal import Signal
from textmech.cases.mistake import CaseError, Path, Source
from textmech.cases.model_case import (
    JOINTS,
    TOLERANCE,
    ModelCase,
    ModelStart,
    RandomRates,
    of_model,
)
from textmech.engines.own_model import quantities as module
from textmech.engines.own_model.opened import opened
from textmech.engines.own_model.quantities import Motion, differences, quantities

ROBOT = """\
<mujoco><worldbody><geom type="plane" size="1 1 1"/>
<body name="base" pos="0 0 1"><freejoint name="base"/><geom size=".1" mass="1"/>
<body name="arm"><joint name="turn" axis="0 1 0"/><geom size=".1" mass="1" pos="1 0 0"/>
<body name="hand"><joint name="shift" type="slide" axis="1 0 0"/><geom size=".1" mass="1"/>
<body><joint type="ball"/><geom size=".1" mass="1" pos="0 0 1"/></body></body></body></body>
</worldbody>
<actuator><motor name="motor" joint="turn"/><position name="servo" joint="shift" kp="5"/></actuator>
<sensor><jointpos name="encoder" joint="turn"/></sensor>
<keyframe><key name="home" qpos="0 0 2 1 0 0 0 .1 .2 1 0 0 0" ctrl="3 .2"/></keyframe></mujoco>"""


def case_of(**changes: object) -> ModelCase:
    return replace(of_model("", "MJCF", "robot", ROBOT), **changes)  # type: ignore[arg-type]


def numbers(*values: float) -> tuple[Amount, ...]:
    return tuple(map(Amount, values))


def test_a_joint_without_a_bar_has_that_of_its_unit() -> None:
    """Neither of a force nor of an energy; without any the bar of a model alone."""
    allow = {"turn.angle": Amount(0.2), "shift.shift": Amount(0.01), "energy": Amount(1e-9)}
    bars = opened(case_of(allow=allow)).joint_bars.tolist()
    assert bars == [0.01, 0.01, 0.01, 0.2, 0.2, 0.2, 0.2, 0.01, 0.2, 0.2, 0.2]
    assert set(opened(case_of(allow={"energy": Amount(50.0)})).joint_bars) == {TOLERANCE}


def test_a_start_is_set_over_the_keyframe_by_name() -> None:
    initial = ModelStart("home", {"turn": numbers(0.3)}, {"shift": numbers(2.0)})
    start = opened(case_of(initial=initial)).own.start()
    assert start.qpos.tolist() == [0, 0, 2, 1, 0, 0, 0, 0.3, 0.2, 1, 0, 0, 0]
    assert start.qvel.tolist() == [0, 0, 0, 0, 0, 0, 0, 2.0, 0, 0, 0]
    assert start.ctrl.tolist() == [3.0, 0.2]


def test_a_quaternion_becomes_one_of_unit_length() -> None:
    initial = ModelStart(joints={"base": numbers(1, 2, 3, 0, 2, 0, 0)})
    assert opened(case_of(initial=initial)).own.start().qpos[:7].tolist() == [1, 2, 3, 0, 1, 0, 0]


def test_rates_by_chance_are_the_same_again() -> None:
    initial = ModelStart(random_rates=RandomRates(0.2, 7))
    one, other = (opened(case_of(initial=initial)).own.start().qvel for _ in range(2))
    assert one.tolist() == other.tolist()
    assert 0.0 < np.abs(one).max() <= 0.2


def test_a_control_follows_its_law_and_begins_with_it() -> None:
    own = opened(case_of(control={"motor": Signal("polynomial", (1.0,), values=(1.0, 2.0))})).own
    assert own.start().ctrl.tolist() == [1.0, 0.2]
    assert own.controls.at(0.5).tolist() == [2.0, 0.2]


def test_contacts_can_be_off() -> None:
    on, off = (opened(case_of(contacts=way)).own.model.opt.disableflags for way in (True, False))
    assert on != off


def test_every_name_has_its_quantities() -> None:
    own = opened(case_of()).own
    names = [quantity.name for quantity in quantities(own.model)]
    assert names == [
        "base.place", "base.turn", "turn.angle", "shift.shift", "joint 3.turn",
        "base.place", "base.turn", "arm.place", "arm.turn", "hand.place", "hand.turn",
        "body 4.place", "body 4.turn", "encoder.value", "motor.force", "servo.force", "energy",
    ]  # fmt: skip


def test_bars_are_of_all_joints_and_of_names() -> None:
    allow = {JOINTS: Amount(0.1), "turn.angle": Amount(0.2), "hand.place": Amount(0.3)}
    bars = {q.name: bar for q, bar in opened(case_of(allow=allow)).bars.items()}
    assert bars["turn.angle"] == 0.2
    assert (bars["shift.shift"], bars["hand.place"], bars["base.turn"]) == (0.1, 0.3, 0.1)


@pytest.mark.parametrize(
    ("changes", "where", "told"),
    [
        ({"initial": ModelStart("hom")}, "initial.keyframe", "did you mean 'home'?"),
        ({"initial": ModelStart(joints={"trun": numbers(1)})}, "initial.joints.trun", "'turn'"),
        ({"initial": ModelStart(joints={"base": numbers(1)})}, "initial.joints.base",
         "should be 7 numbers, has 1"),
        ({"initial": ModelStart(rates={"turn": numbers(1, 2)})}, "initial.rates.turn",
         "should be 1 number, has 2"),
        ({"initial": ModelStart(joints={"base": numbers(0, 0, 0, 0, 0, 0, 0)})},
         "initial.joints.base", "its quaternion should not be 0"),
        ({"initial": ModelStart(joints={"turn": numbers(90.0)})}, "initial.joints.turn", "90 deg"),
        ({"control": {"servoo": Signal("constant", (1.0,))}}, "control.servoo", "'servo'"),
        ({"allow": {"hand.plaice": Amount(1.0)}}, "allow.hand.plaice", "'hand.place'"),
        ({"allow": {"turn.angle": Amount(1.0, "[length]", "1 m")}}, "allow.turn.angle", "rad"),
    ],
)  # fmt: skip
def test_an_unknown_name_is_told_at_its_place(
    changes: dict[str, object], where: str, told: str
) -> None:
    places: dict[Path, tuple[int, int]] = {
        ("initial",): (2, 1),
        ("control",): (3, 1),
        ("allow",): (4, 1),
    }
    source = Source("robot.yaml", ("", "", "", ""), places)
    with pytest.raises(CaseError) as error:
        opened(case_of(source=source, **changes))
    (mistake,) = error.value.mistakes
    assert (mistake.where, mistake.file) == (where, "robot.yaml")
    assert mistake.line > 1
    assert told in mistake.what


def test_motions_differ_by_what_they_say() -> None:
    """A turn of the arm by 0.3 moves the hand by 2 sin 0.15 of its distance."""
    own = opened(case_of()).own
    y = np.concatenate([own.start().qpos, own.start().qvel])[None]
    other = y.copy()
    other[0, 7] += 0.3
    times = np.zeros(1)
    by_name = {
        quantity.name: float(np.linalg.norm(off))
        for quantity, off in differences(
            [*quantities(own.model)], Motion(own, times, y), Motion(own, times, other)
        ).items()
    }
    assert by_name["turn.angle"] == pytest.approx(0.3)
    assert by_name["hand.turn"] == pytest.approx(0.3, abs=1e-12)
    assert by_name["hand.place"] == pytest.approx(2 * np.sin(0.15) * 0.2)
    assert by_name["encoder.value"] == pytest.approx(0.3)
    assert by_name["shift.shift"] == by_name["servo.force"] == 0.0
    assert by_name["energy"] > 0.1


def test_names_that_a_table_would_misread_are_quoted() -> None:
    text = ROBOT.replace('"turn"', '"=HYPERLINK(1)"').replace('"shift"', '"#3"')
    names = [q.name for q in quantities(opened(case_of(given=text)).own.model)]
    assert "'=HYPERLINK(1)'.angle" in names
    assert all(name[0] not in "=+-@#" for name in names)


@pytest.mark.mutant("half a turn, whose attitudes are at right angles, taken for two thirds")
def test_half_a_turn_is_no_less() -> None:
    p, q = np.array([[1.0, 0.0, 0.0, 0.0]]), np.array([[0.0, 1.0, 0.0, 0.0]])
    assert module._angles(p, q) == pytest.approx(np.pi)
    was = 'np.where(np.einsum("ij,ij->i", p, q) < 0.0, -1.0, 1.0)'
    blind = otherwise(module, was, 'np.sign(np.einsum("ij,ij->i", p, q))')
    assert blind._angles(p, q) != pytest.approx(np.pi)
