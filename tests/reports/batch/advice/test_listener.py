"""What is said while advice is searched for: shipped at once, and on Ctrl-C the nearest so far."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
from given import scenes
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reports.batch.advice import advise
from textmech.reports.batch.advice.advice_rows import Advised, Requirement
from textmech.reports.batch.advice.advise import Listener, advised
from textmech.reports.batch.selection import choose_engines
from textmech.reports.show.advice import shipped_lines, stopped_lines

ASKED = Requirement(None, 2.0)
STILL = """\
scene:
  gravity: none
  bodies: {ball: {particle: {mass: 2.0}}}
initial: {ball: {x: 0, y: 0, vx: 0, vy: 0}}
duration: 1.0
samples: SAMPLES
allow: {ball.x: 1.0e-3}
"""


def interrupted(monkeypatch: pytest.MonkeyPatch) -> tuple[list[str], list[str]]:
    """The lines before the search, and those after it was interrupted."""
    heard: dict[str, list[str]] = {"begun": [], "stopped": []}

    def note(word: str, lines: Any) -> Any:
        def say(ready: Sequence[Advised]) -> None:
            heard[word] += [line for one in ready for line in lines(one)]

        return say

    def search(*given: object) -> None:
        assert heard["begun"]  # it was said before
        raise KeyboardInterrupt

    monkeypatch.setattr(advise, "_searched", search)
    listener = Listener(note("begun", shipped_lines), note("stopped", stopped_lines))
    cases, engines = [scenes.EVERY["leaking_pendulum"]], choose_engines(["mujoco"], ["shipped"])
    with (
        pytest.raises(KeyboardInterrupt),
        advised(cases, engines, ASKED, progress=lambda *_: None, jobs=1, listener=listener),
    ):
        pass
    return heard["begun"], heard["stopped"]


@pytest.mark.slow
def test_shipped_is_told_before_the_search_and_the_nearest_after_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    begun, stopped = interrupted(monkeypatch)
    assert begun[1].startswith("leaking_pendulum in mujoco 4")
    assert begun[1].endswith(", as shipped, 2 ms")
    assert begun[2].startswith("    energy lost: ")
    assert begun[3].startswith("    worst: energy.total ×1.2")
    assert stopped[1].endswith("interrupted after 1 run; the nearest so far")
    assert "    to paste" in stopped


def refusals(case: Case, module: Any = advise) -> list[str]:
    """Why each engine has no advice on the case."""
    engines = choose_engines([], ["shipped"])
    with module.advised([case], engines, ASKED, progress=lambda *_: None, jobs=1) as found:
        return [one.way.because for one in found]


@pytest.mark.slow
@pytest.mark.mutant("a mistaken file is refused by the engine whose step misses its samples")
def test_a_mistaken_file_is_refused_with_its_place(tmp_path: Path) -> None:
    """Of 26 samples each step meets all, and of 24 neither does."""
    for samples in ("26", "24"):
        case = scenes.typed(tmp_path, STILL.replace("SAMPLES", samples), tail="")
        with pytest.raises(CaseError) as caught:
            refusals(case)
        assert [mistake.where for mistake in caught.value.mistakes] == ["allow.ball.x"]
    blamed = otherwise(advise, "if key not in own and wrong[key]", "if False")
    whys = refusals(case, blamed)
    assert len(whys) == 2
    assert all(why.startswith("there is no reference: ") for why in whys)
