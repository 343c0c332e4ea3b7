"""Of two free bodies in space the one is named that is not placed, and nothing of the other."""

from pathlib import Path

import pytest
from given.otherwise import otherwise
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.reference.start import spatial_closure
from textmech.reference.start.assembly import assemble
from textmech.reference.start.spatial_closure import SpatialClosure

BODY = "{rigid: {mass: 1.0, inertia: [0.02, 0.03, 0.025, 0, 0, 0]}}"
SCENE = f"""\
scene:
  space: 3
  gravity: none
  bodies: {{one: {BODY}, other: {BODY}}}
initial:
  one: {{x: 0, y: 0, z: 0, attitude: {{axis: [0, 0, 1], angle: 0.3}}, omega: [1, 0, 0]}}
  other: {{y: 1, z: 0, attitude: {{axis: [0, 0, 1], angle: 0.3}}}}
allow: {{one.x: 1.0e-3}}
"""


def said(tmp_path: Path) -> str:
    case = typed(tmp_path, SCENE)
    with pytest.raises(CaseError) as refused:
        assemble(case)
    return str(refused.value)


@pytest.mark.mutant("the attitude of a body named where its place is open")
def test_only_what_is_open_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    told = said(tmp_path)
    assert "other.x" in told
    assert "attitude" not in told
    other = otherwise(spatial_closure, '"vx": "x", ', "").SpatialClosure
    monkeypatch.setattr(SpatialClosure, "_open_places", other._open_places)
    assert "other.attitude" in said(tmp_path)
