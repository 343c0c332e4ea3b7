"""Which numbered equations a case really uses: those whose function runs, not those it claims.

A function stands for the equations that open its docstring: `(2.44) d/dt ∂T/∂q̇ − …`.
"""

import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

HERE = str(Path(__file__).parents[1])
_OPENING = re.compile(r"\s*(?:\(2\.\d+\)(?:[-–](?:\(2\.\d+\))?)?(?:,| and)?\s*)+")
_NUMBER = re.compile(r"2\.\d+")


def equations(docstring: str | None) -> list[str]:
    """The equations a docstring opens with: "(2.23), (2.27) …" → ["2.23", "2.27"]."""
    opening = _OPENING.match(docstring or "")
    return _NUMBER.findall(opening.group()) if opening else []


def executed(work: Callable[[], Any]) -> set[str]:
    """Runs the work, and gives the equations of all functions of `reference` that ran."""
    codes: set[CodeType] = set()

    def note(frame: FrameType, event: str, _: Any) -> None:
        if event == "call":
            codes.add(frame.f_code)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(before)
    return {
        number
        for code in codes
        if code.co_filename.startswith(HERE) and code.co_consts
        for number in equations(code.co_consts[0] if isinstance(code.co_consts[0], str) else None)
    }
