"""What asks for endless work in space is said when the file is read, as in the plane."""

from pathlib import Path

import pytest

from textmech.cases.load import load
from textmech.cases.mistake import CaseError

TEXT = """\
title: A body on a hinge
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies:
    rod: {{bar: {{mass: 1.0, length: {length}}}}}
    ball: {{sphere: {{mass: 1, radius: 0.1}}}}
  joints: {{q: {{hinge: [ground.O, rod.start], axis: [0, 1, 0]}}}}
  forces: {{{forces}}}
  drive: {{{drive}}}
initial: {{q: {{angle: 0.3, omega: {omega}}}, ball: {{omega: {spin}}}}}
duration: 10.0
samples: {samples}
allow: {{q.angle: 1.0e-2}}
"""


def said(tmp_path: Path, **changed: object) -> list[str]:
    given = {"length": 0.5, "forces": "", "drive": "", "omega": 1, "spin": "[0, 0, 1]"}
    path = tmp_path / "case.yaml"
    path.write_text(TEXT.format(**given | {"samples": 26} | changed), encoding="utf-8")
    try:
        load(path)
    except CaseError as error:
        return [f"{m.where}: {m.what}" for m in error.mistakes if "limit" in m.what]
    return []


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"length": 1e-7}, "duration: scene.bodies.rod swings at 1.21e+04 rad/s"),
        ({"omega": 1e5}, "duration: initial.q swings at 1e+05 rad/s"),
        ({"spin": "[0, -1.0e6 rpm, 0]"}, "duration: initial.ball swings at 1.05e+05 rad/s"),
        ({"drive": "q.omega: 1.0e4"}, "duration: scene.drive.q.omega swings at 1e+04 rad/s"),
        ({"drive": "q.omega: {ramp: 1.0e3}"}, "scene.drive.q.omega swings at 1e+04 rad/s"),
        (
            {"drive": "q.omega: {sine: {amplitude: 1, angular_frequency: 1.0e4}}"},
            "scene.drive.q.omega swings at 1e+04 rad/s",
        ),
        (
            {"forces": "s: {spring: [ball.center, ground.O], stiffness: 1.0e8, rest_length: 0}"},
            "duration: scene.forces.s swings at 1e+04 rad/s",
        ),
        ({"samples": 200_000}, "samples: 200000 samples of 2 bodies, at most 1 of which hang"),
    ],
)
def test_endless_work_is_said_with_its_number(
    tmp_path: Path, changed: dict[str, object], words: str
) -> None:
    (mistake,) = said(tmp_path, **changed)
    assert words in mistake
    assert "--allow-long" in mistake


def test_what_takes_minutes_is_not_said(tmp_path: Path) -> None:
    assert said(tmp_path) == []
    assert said(tmp_path, omega=1e2, spin="[0, 0, 1.0e2]", drive="q.omega: {ramp: 10}") == []
