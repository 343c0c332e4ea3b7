"""A body that nothing keeps from turning about an axis, and that has no inertia about it."""

from pathlib import Path

import pytest

from textmech.cases.load import load
from textmech.cases.mistake import CaseError

TEXT = """\
title: A body on its joints
scene:
  space: 3
  points: {{O: [0, 0, 0], Q: [1, 0, 0]}}
  bodies:
    rod: {body}
    box: {{block: {{mass: 1.0, size: [0.1, 0.1, 0.1]}}}}
  joints: {{{joints}}}
initial: {{box: {{x: 0}}}}
duration: 1.0
samples: 26
allow: {{box.x: 1.0e-3}}
"""
BAR = "{bar: {mass: 1.0, length: 0.5}, points: {side: [0.1, 0.2, 0], on: [0.1, 0, 0]}}"
THIN = "{rigid: {mass: 1.0, inertia: [0.5, 0.5, 1.0, -0.5, 0, 0]}, points: {P: [0.1, 0.1, 0]}}"


def said(tmp_path: Path, body: str, joints: str) -> list[str]:
    path = tmp_path / "case.yaml"
    path.write_text(TEXT.format(body=body, joints=joints), encoding="utf-8")
    try:
        load(path)
    except CaseError as error:
        return [f"{m.line} {m.where}: {m.what}" for m in error.mistakes]
    return []


@pytest.mark.parametrize(
    ("body", "joints"),
    [
        (BAR, ""),
        (BAR, "a: {ball: [ground.O, rod.start]}"),
        (BAR, "a: {ball: [ground.O, rod.on]}"),
        (BAR, "a: {ball: [ground.O, rod.start]}, b: {ball: [ground.Q, rod.end]}"),
        (BAR, "a: {hinge: [ground.O, rod.start], axis: [-2, 0, 0]}"),
        (BAR, "a: {universal: [ground.O, rod.start], axes: [[0, 1, 0], [1, 0, 0]]}"),
        (BAR, "a: {universal: [rod.end, box.center], axes: [[1, 0, 0], [0, 1, 0]]}"),
        (THIN, ""),
        (THIN, "a: {ball: [ground.O, rod.P]}"),
    ],
)
def test_turns_freely(tmp_path: Path, body: str, joints: str) -> None:
    (mistake,) = said(tmp_path, body, joints)
    assert mistake.startswith("6 scene.bodies.rod: ")
    bar = "'rod' is a slender bar: nothing keeps it from turning about its own axis, and it has "
    bar += "no inertia about that; give it as a `rigid` with a tensor"
    thin = "nothing keeps 'rod' from turning about [0.707, 0.707, 0], and it has no inertia about "
    assert mistake.endswith(bar if body == BAR else thin + "that")


@pytest.mark.parametrize(
    "joints",
    [
        "a: {hinge: [ground.O, rod.start], axis: [0, 0, 1]}",
        "a: {ball: [ground.O, rod.side]}",  # where its own axis swings about the point
        "a: {slide: [ground.O, rod.start], along: [1, 0, 0]}",
        "a: {weld: [box.center, rod.start]}",
        "a: {universal: [ground.O, rod.start], axes: [[0, 1, 0], [0, 0, 1]]}",
        "a: {ball: [ground.O, rod.start]}, b: {hinge: [rod.end, box.center], axis: [0, 1, 0]}",
        "a: {freedoms: {x: {slide: [0, 0, 1]}, t: {hinge: [0, 1, 0]}}, of: [ground.O, rod.start]}",
    ],
)
def test_held_or_with_inertia(tmp_path: Path, joints: str) -> None:
    assert said(tmp_path, BAR, joints) == []
