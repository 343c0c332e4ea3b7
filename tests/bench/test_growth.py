"""Scenes of many bodies or samples: each is solved in seconds, or refused in seconds."""

import json
from pathlib import Path

import pytest

from bench import growth
from bench.growth import REFUSED, SOLVED, chain, free, grown, hung, scenes
from textmech.cases.load import load
from textmech.cases.mistake import CaseError

TOO_LARGE = {"pendulum, 250001 samples": "250001 samples of 1 body are 250001 rows"}


@pytest.mark.slow
@pytest.mark.parametrize("scene", scenes())
def test_a_scene_is_read_or_refused_with_what_is_too_large(tmp_path: Path, scene: str) -> None:
    file = tmp_path / "grown.yaml"
    file.write_text(json.dumps(scenes()[scene], indent=1), encoding="utf-8")
    if scene not in TOO_LARGE:
        assert len(load(file)) == 1
        return
    with pytest.raises(CaseError) as caught:
        load(file)
    (mistake,) = caught.value.mistakes
    assert TOO_LARGE[scene] in mistake.what
    assert "the limit is 200000" in mistake.what


@pytest.mark.slow
def test_each_kind_is_solved_and_certified(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of each kind a small one, in the same words."""
    small = {
        "chain": chain(2),
        "chain in space": chain(2, space=True),
        "hung": hung(2),
        "springs": free(3, growth.BAR, 1),
        "springs in space": free(3, growth.BOX, 1, space=True),
        "samples": chain(1) | {"samples": 250_001},
    }
    monkeypatch.setattr(growth, "scenes", lambda: small)
    holds, solve = [], growth.solve
    monkeypatch.setattr(growth, "solve", lambda case: holds.append(solve(case).holds))
    found = list(grown())
    assert [row.scene for row in found] == list(small)
    assert holds == [True] * 5
    assert [bool(row.refusal) for row in found] == [False] * 5 + [True]
    assert [row.bound for row in found] == [SOLVED] * 5 + [REFUSED]
    assert all(row.seconds >= 0.0 for row in found)
