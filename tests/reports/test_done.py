"""Whenever a run is interrupted, what it says of its reports is true."""

import sys
from pathlib import Path
from types import FrameType
from typing import Any

import pandas as pd
import pytest

from textmech.reports.command import done
from textmech.reports.output import write

FRAMES = {"advice.csv": pd.DataFrame({"case": ["swing"], "cost": [2.0]})}
LOOKED_AT = (done.__file__, write.__file__)


class Strike:
    """Interrupts once, at the n-th line of those files."""

    def __init__(self, at: int) -> None:
        self.left = at

    def __call__(self, frame: FrameType, event: str, _: Any) -> "Strike":
        if event == "line" and frame.f_code.co_filename in LOOKED_AT:
            self.left -= 1
            if self.left == 0:
                raise KeyboardInterrupt
        return self


def interrupted(at: int, out: Path) -> bool:
    """Whether the writing was struck there."""
    before = sys.gettrace()
    sys.settrace(Strike(at))
    try:
        done.written(FRAMES, out)
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


def test_what_is_said_is_what_is_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two of 16 strikes at that moment were told as `nothing was written`, and it was."""
    at, said = 0, set[bool]()
    struck = True
    while struck:
        at += 1
        monkeypatch.setattr(done, "DONE", [])
        out = tmp_path / str(at)
        struck = interrupted(at, out)
        there = (out / "advice.csv").exists()
        assert bool(done.DONE) == there, at
        said.add(struck and there)
    assert at > 10
    assert said == {True, False}  # it was struck before they were there, and after
