"""Every mistake that only a case in space can have: its place, its field, and what is said."""

import re
from pathlib import Path

import pytest
from given.spatial_case import SOUND

from textmech.cases.load import load
from textmech.cases.mistake import CaseError

ENGINES = {"mujoco": ("shipped", "tuned"), "pymunk": ("shipped", "tuned")}
TABLE = Path(__file__).with_name("mistakes.txt").read_text(encoding="utf-8")
EACH = re.findall(r"^- (.*)\n\+ (.*)\n(\d+:\d+): ([^:]*): (.*)$", TABLE, flags=re.MULTILINE)


def mistakes(tmp_path: Path, text: str) -> list[tuple[str, str, str]]:
    path = tmp_path / "case.yaml"
    path.write_text(text, encoding="utf-8")
    try:
        load(path, engines=ENGINES)
    except CaseError as error:
        return [(f"{m.line}:{m.column}", m.where, m.what) for m in error.mistakes]
    return []


def test_sound(tmp_path: Path) -> None:
    assert mistakes(tmp_path, SOUND) == []


def test_table_is_read_whole() -> None:
    assert len(EACH) == TABLE.count("\n- ") > 80


@pytest.mark.parametrize(("old", "new", "place", "field", "what"), EACH)
def test_each(tmp_path: Path, old: str, new: str, place: str, field: str, what: str) -> None:
    assert SOUND.count(old) == 1
    text = SOUND.replace(old, new.replace(r"\n", "\n"))
    assert mistakes(tmp_path, text) == [(place, field, what)]


@pytest.mark.parametrize("free", [False, True])
def test_a_mistaken_parameter_is_named_once(tmp_path: Path, free: bool) -> None:
    """What it spoils is neither judged nor computed with: lengths, tensors and axes."""
    text = SOUND.replace("along: [0, 3, 4]", "along: [0, 3, J]").replace("J: 0.05", "J: 0.05 q")
    text = text.replace("l: 0.8 m", "l: 0.8 q").replace("{slide: [1, 0, 0]}", "{slide: [1, J, 0]}")
    if free:  # the bar hangs on its spring alone
        text = text.replace("bar.start]", "box.center]")
        text = text.replace("universal: [bar.end, box", "universal: [box.center, top")
    assert [where for _, where, _ in mistakes(tmp_path, text)] == ["parameters.l", "parameters.J"]


def test_all_at_once(tmp_path: Path) -> None:
    """A broken part hides no other, and drags nothing along: q1's own quantities are not named."""
    text = SOUND.replace("axis: [0, 0, 2]", "axis: [0, 0]")
    text = text.replace("touch.slip: unknown", "touch.slp: unknown")
    text = text.replace("constant: [1.0, 0, 0]", "constant: [1.0]")
    text = text.replace("slide: [ground.O, bob.center]", "slide: [ground.O, bobb.center]")
    text = text.replace("y: 0, z: 0.25", "yy: 0, z: 0.25 kg")
    assert [(where, what) for _, where, what in mistakes(tmp_path, text)] == [
        ("scene.joints.q1.axis", "should be a list of 3, has 2"),
        ("scene.joints.rail.slide.1", "unknown body 'bobb'; did you mean 'bob'?"),
        ("scene.forces.hand.constant", "should be a list of 3, has 1"),
        ("initial.globe.yy", "unknown key 'yy'; did you mean 'y'?"),
        ("initial.globe.z", "is '0.25 kg', but m was expected"),
        ("allow.touch.slp", "unknown quantity 'touch.slp'; did you mean 'touch.slip'?"),
    ]
