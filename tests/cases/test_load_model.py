"""Case files with a model of the user's own: what they say, and every mistake at its place."""

from pathlib import Path

import numpy as np
import pytest

from textmech.cases.load_model import has_model, load_model
from textmech.cases.mistake import CaseError

ACROBOT = """\
model: acrobot.xml
initial: {keyframe: low, joints: {shoulder: 30 deg, base: [0, 0, 1, 1, 0, 0, 0]}, rates: {elbow: 1}}
control: {servo: {sine: {amplitude: 0.5, angular_frequency: 3}}, other: 2}
contacts: off
duration: 2
samples: 21
allow: {joints: 1.0e-3, hand.place: 1 mm}
variants:
  loose: {allow: {joints: 0.1}}
  held: {control: {other: {held: {times: [0, 0.5, 1], values: [0, 1, 0]}}}}
"""


def written(folder: Path, text: str) -> Path:
    file = folder / "robot.yaml"
    file.write_text(text, encoding="utf-8")
    return file


def test_a_case_of_a_model_is_read(tmp_path: Path) -> None:
    file = written(tmp_path, ACROBOT)
    assert has_model(file)
    loose, held = load_model(file)
    assert loose.name == "robot.loose"
    assert loose.path == str(tmp_path / "acrobot.xml")
    assert loose.allow["joints"].value == 0.1
    assert loose.allow["hand.place"].value == 1e-3
    assert loose.initial.keyframe == "low"
    assert [n.value for n in loose.initial.joints["shoulder"]] == pytest.approx([np.pi / 6])
    assert not loose.contacts
    assert (loose.duration, loose.samples) == (2.0, 21)
    at = np.array([0.0, 0.4, 0.5, 0.9, 1.5])
    assert held.control["other"].at(at)[:, 0].tolist() == [0.0, 0.0, 1.0, 1.0, 0.0]
    assert held.control["other"].corners == (0.5, 1.0)
    assert loose.control["servo"].at(at)[1, 0] == pytest.approx(0.5 * np.sin(1.2))


def test_little_has_to_be_said(tmp_path: Path) -> None:
    (case,) = load_model(written(tmp_path, "model: robot.xml\n"))
    assert (case.duration, case.contacts) == (1.0, True)
    assert {name: bar.value for name, bar in case.allow.items()} == {"joints": 1e-3}


def test_a_scene_is_no_model(tmp_path: Path) -> None:
    assert not has_model(written(tmp_path, "title: x\nscene: {bodies: {}}\n"))
    assert not has_model(written(tmp_path, "{"))


@pytest.mark.parametrize(
    ("line", "where", "told"),
    [
        ("modle: x", "modle", "unknown key 'modle'"),
        ("initial: {joints: {shoulder: red}}", "initial.joints.shoulder", "should be a number"),
        ("initial: {joint: {shoulder: 1}}", "initial.joint", "did you mean 'joints'?"),
        ("control: {servo: {sin: {}}}", "control.servo.sin", "did you mean 'sine'?"),
        ("control: {servo: {held: {times: [1, 0], values: [0, 0]}}}", "control.servo.held",
         "`times` should rise"),
        ("contacts: maybe", "contacts", "unknown word 'maybe'"),
        ("duration: -2", "duration", "must be positive"),
        ("allow: {elbow.angle: 0}", "allow.elbow.angle", "must be positive"),
        ("allow: 0", "allow", "must be positive"),
        ("scene: {}", "scene", "a case has a `model` or a `scene`"),
        ("control: none.csv", "control", "none.csv: cannot be read"),
        ("variants: {a: {model: other.xml, titel: 1}}", "variants.a.titel", "unknown key"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_at_its_place(tmp_path: Path, line: str, where: str, told: str) -> None:
    with pytest.raises(CaseError) as error:
        load_model(written(tmp_path, f"model: robot.xml\n{line}\n"))
    (mistake,) = error.value.mistakes
    assert (mistake.where, mistake.line) == (where, 2)
    assert told in mistake.what


def test_all_mistakes_are_told_at_once(tmp_path: Path) -> None:
    with pytest.raises(CaseError) as error:
        load_model(written(tmp_path, "model: 3\nsamples: 1\nduration: 0\n"))
    assert [mistake.line for mistake in error.value.mistakes] == [1, 2, 3]


TABLE = "time,servo,other\n0,1,2\n0.5,3,4\n"


@pytest.mark.parametrize(
    ("control", "wanted"),
    [("policy.csv", [1.0, 3.0]), ("{table: policy.csv, between: lines}", [2.0, 3.0])],
)
def test_controls_come_from_a_table(tmp_path: Path, control: str, wanted: list[float]) -> None:
    (tmp_path / "policy.csv").write_text(TABLE, encoding="utf-8")
    (case,) = load_model(written(tmp_path, f"model: robot.xml\ncontrol: {control}\n"))
    at = np.array([0.25, 0.7])
    assert case.control["servo"].at(at)[:, 0].tolist() == wanted
    assert [*case.control] == ["servo", "other"]


@pytest.mark.parametrize(
    ("table", "told"),
    [
        ("", "should have a head"),
        ("time\n0\n1\n", "its first column"),
        ("t,a\n0,1\n1,1\n", "its first column"),
        ("time,a\n0,1\n", "at least 2 rows"),
        ("time,a\n0,1\n1\n", "at least 2 rows of 2 numbers"),
        ("time,a\n1,1\n0,1\n", "times should rise"),
        ("time,a\n0,nan\n1,1\n", "finite"),
        ("time,a\n0,x\n1,1\n", "should have a head"),
    ],
)
def test_a_damaged_table_is_refused(tmp_path: Path, table: str, told: str) -> None:
    (tmp_path / "policy.csv").write_text(table, encoding="utf-8")
    with pytest.raises(CaseError, match=r"policy\.csv") as error:
        load_model(written(tmp_path, "model: robot.xml\ncontrol: policy.csv\n"))
    assert told in str(error.value)
