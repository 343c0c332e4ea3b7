"""The equations of users' models against the textbook's: random ones, public ones, and mistakes."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from given.machines.random_models import public_models, random_model
from given.otherwise import otherwise

from textmech.cases.mistake import CaseError
from textmech.cases.tree import BIAS, CONSTRAINTS, DRIVEN, MASS, PASSIVE, Link, Tree
from textmech.engines.own_model import model, numbers
from textmech.engines.own_model.model import compiled, compiled_text
from textmech.reference.formalisms import tree_equations
from textmech.reports.compare import own_equations
from textmech.reports.compare.own_equations import equations, lines

STATES = 6


def held(text: str, tree: Callable[[Tree], Tree] = lambda tree: tree) -> dict[str, bool]:
    """Which part holds, of a model whose numbers are another's in our hands."""
    asked = compiled_text(text)
    asked.__dict__["tree"] = tree(asked.tree)
    return {part.name: part.holds for part in equations(asked, STATES)}


@pytest.mark.parametrize(
    "seed", [*range(4), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(4, 40))]
)
def test_any_models_equations_are_the_textbooks(seed: int) -> None:
    parts = equations(compiled_text(random_model(seed)), STATES)
    assert {part.name: part.holds for part in parts} == dict.fromkeys(
        (MASS, BIAS, PASSIVE, DRIVEN, CONSTRAINTS), True
    )
    assert all(part.states == STATES for part in parts if part.name in (MASS, BIAS, PASSIVE))
    assert not any(part.unread for part in parts)


CHAIN = """\
<mujoco><worldbody><body name="arm" gravcomp=".3"><inertial pos=".2 0 .1" mass="2"
  diaginertia=".02 .03 .04"/><joint name="shoulder" axis="0 1 0" stiffness="3" damping=".2"
  springref=".4" armature=".05" ref=".1"/>
<body name="hand" pos=".5 0 0"><inertial pos="0 .1 0" mass="1" diaginertia=".01 .02 .02"/>
  <joint name="rail" type="slide" axis="1 0 0"/><joint name="wrist" axis="0 0 1" pos=".05 0 0"/>
</body></body></worldbody>
<actuator><position joint="shoulder" kp="20" forcerange="-5 5"/></actuator></mujoco>"""


FREE = (-np.inf, np.inf)


def other_hand(change: Callable[[Link], Link]) -> Callable[[Tree], Tree]:
    return lambda tree: replace(tree, links=[*tree.links[:-1], change(tree.links[-1])])


MISTAKES: dict[str, tuple[Callable[[Tree], Tree], set[str]]] = {
    "a hand's inertia 1e-9 off": (
        other_hand(lambda hand: replace(hand, J=hand.J * (1 + 1e-9))), {MASS},
    ),
    "a hand that is nowhere lifted": (
        lambda tree: replace(tree, links=[replace(x, lifted=0.0) for x in tree.links]), {PASSIVE},
    ),
    "a wrist's axis that is turned": (
        other_hand(lambda hand: replace(hand, joints=[
            hand.joints[0], replace(hand.joints[1], axis=np.array([0.0, 1e-6, 1.0]))
        ])), {MASS, BIAS},
    ),
    "no armature": (lambda tree: replace(tree, armature=0 * tree.armature), {MASS}),
    "gravity as on the sea": (
        lambda tree: replace(tree, gravity=np.array([0.0, 0.0, -9.80665])), {BIAS, PASSIVE},
    ),
    "a servo without a bound": (
        lambda tree: replace(tree, motors=[replace(x, force=FREE) for x in tree.motors]),
        {DRIVEN},
    ),
}  # fmt: skip


@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_another_number_is_seen(mistake: str) -> None:
    change, parts = MISTAKES[mistake]
    assert all(held(CHAIN).values())
    assert {name for name, holds in held(CHAIN, change).items() if not holds} == parts


LINES = {
    "an axis that does not turn with its body": (
        "w_rate = cross(turning, w)", "w_rate = 0 * cross(turning, w)"
    ),
    "a rail that does not turn with its body": (
        "s_rate = cross(turning, axes.t) -", "s_rate = -"
    ),
    "no ω × J ω": ("_times(bodies.J, bodies.alpha) + turning", "_times(bodies.J, bodies.alpha)"),
    "a turn about the origin in place of the anchor": (
        "return anchor - hung @ joint.anchor, hung", "return anchor - E @ joint.anchor, hung",
    ),
    "a joint's zero that plays no part": ("float(q[joint.q]) - joint.zero", "float(q[joint.q])"),
    "a spring that rests at zero": ("rest[:shifts] - now, np", "-now, np"),
}  # fmt: skip


@pytest.mark.mutant("{line}")
@pytest.mark.parametrize("line", LINES)
def test_a_wrong_line_is_seen(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong: ModuleType = otherwise(tree_equations, *LINES[line])
    monkeypatch.setattr(own_equations, "textbook", wrong)
    assert not all(held(CHAIN).values())


COUPLED = """\
<mujoco><worldbody>
<body><joint name="left" axis="0 0 1"/><geom size=".1"/></body>
<body pos="1 0 0"><joint name="right" axis="0 0 1"/><geom size=".1"/></body></worldbody>
<tendon><fixed name="belt" armature="{0}"><joint joint="left" coef="1"/>
<joint joint="right" coef="1"/></fixed></tendon></mujoco>"""


def test_an_armature_that_couples_branches_is_none_of_mujocos() -> None:
    """Its mass matrix has no entry there: 2 rad/s² are 1 and 0, and should be 1.9 and -0.9."""
    parts = equations(compiled_text(COUPLED.format(0.1)), STATES)
    assert [part.name for part in parts if not part.holds] == [MASS]
    assert parts[0].joint == "left and right"
    assert "tendon belt couples branches by its armature" in "\n".join(lines(parts))
    assert all(held(COUPLED.format(0)).values())


def test_what_is_not_read_is_said_and_not_compared() -> None:
    text = CHAIN.replace("<worldbody>", '<option density="1.2"/><worldbody>')
    text = text.replace(
        "</actuator>", '<muscle name="biceps" joint="wrist" lengthrange="0 1"/></actuator>'
    )
    parts = {part.name: part for part in equations(compiled_text(text), STATES)}
    assert parts[PASSIVE].off is parts[DRIVEN].off is None
    assert parts[MASS].holds
    assert parts[MASS].states == STATES
    text = "\n".join(lines(parts.values()))
    assert "not compared: option (MJCF:1): a fluid (density, viscosity)" in text
    assert "not compared: actuator biceps (MJCF:7): a state of its own" in text


def test_actuators_that_are_off_are_none() -> None:
    """Their controls are there all the same."""
    text = CHAIN.replace("<worldbody>", '<option><flag actuation="disable"/></option><worldbody>')
    parts = {part.name: part for part in equations(compiled_text(text), STATES)}
    assert parts[DRIVEN].off is None
    assert all(part.holds for part in parts.values())


CARRIED = """\
<mujoco><worldbody><body name="hand" mocap="true" pos="1 0 0">
<body pos="0 0 .3"><joint axis="0 1 0"/>
<inertial pos=".2 0 0" mass="1" diaginertia=".1 .1 .1"/></body></body></worldbody>
<keyframe><key mpos="0 2 0" mquat=".6 .8 0 0"/></keyframe></mujoco>"""


@pytest.mark.mutant("a body that the user moves stands where the file put it")
def test_what_hangs_on_a_moved_body_is_where_the_keyframe_put_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert all(held(CARRIED).values())
    monkeypatch.setattr(model, "numbers", otherwise(numbers, "if mocap >= 0:", "if False:").numbers)
    assert not held(CARRIED)[BIAS]


def test_names_that_are_empty_or_strange_are_named() -> None:
    text = CHAIN.replace('"wrist"', '"wrist&#10;; rm -rf ~"').replace(' name="rail"', "")
    parts = equations(compiled_text(text), STATES)
    assert all(part.holds for part in parts)
    assert compiled_text(text).tree.named(1) == "#1"


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ('<mujoco>\n<worldbody><body><joint type="hing"/></body></worldbody></mujoco>', 2, "hing"),
        ("<mujoco>\n<worldbody>", 2, "ELEMENT"),
        ('<mujoco>\n<include file="gone.xml"/></mujoco>', 2, "gone.xml"),
    ],
)
def test_what_does_not_compile_is_told_with_its_line(
    tmp_path: Path, text: str, line: int, words: str
) -> None:
    file = tmp_path / "robot.xml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        compiled(str(file))
    (mistake,) = caught.value.mistakes
    assert mistake.line == line
    assert words in mistake.what


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("number", ["nan", "1e200"])
def test_a_keyframe_without_numbers_is_a_mistake(number: str) -> None:
    key = f'<keyframe><key qpos="0 {number} 0"/></keyframe></mujoco>'
    with pytest.raises(CaseError, match=r"keyframe\.qpos: its first keyframe should hold numbers"):
        compiled_text(CHAIN.replace("</mujoco>", key))


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("file", public_models(), ids=lambda file: file.stem)
def test_public_models_equations_are_the_textbooks(file: Path) -> None:
    parts = equations(compiled(str(file)), 20)
    assert all(part.holds and (part.off or 0.0) <= 1e-12 for part in parts)
    unread = {part.name for part in parts if part.unread}
    assert unread == ({PASSIVE} if file.stem.startswith("swimmer") else set())
