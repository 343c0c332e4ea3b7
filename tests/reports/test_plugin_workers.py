"""The plug-in under pytest-xdist: its workers share what one of them has computed."""

from pathlib import Path

import pytest
from given.swing import SWING

pytest_plugins = ["pytester"]

# Each task that a worker gives to its processes, as one line.
COUNTED = """\
from textmech.reports import suite
spread = suite.spread

def counted(function, tasks, executor):
    with open({log!r}, "a") as file:
        for task in tasks:
            engine = getattr(getattr(task, "pair", task), "engine", None)
            name = f"{{engine.name}}.{{engine.setting}}" if engine else task.name
            file.write(f"{{function.__name__}} {{name}} {{getattr(task, 'realised', '')}}\\n")
    return spread(function, tasks, executor)

suite.spread = counted
"""


@pytest.mark.whole
def test_no_trial_runs_twice_and_nothing_stays(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Each of the two workers has items that need every row, and nothing may be remembered."""
    log, folder = tmp_path / "log", tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setenv("TMPDIR", str(folder))
    pytester.makefile(".yaml", swing=SWING)
    pytester.makeconftest(COUNTED.format(log=str(log)))
    done = pytester.runpytest_subprocess(
        "swing.yaml", "-v", "-n", "2", "--dist", "each", "--textmech-engine", "mujoco.tuned"
    )
    done.assert_outcomes(passed=2 * 3)
    done.stdout.fnmatch_lines_random(["*gw0*rod.angle*", "*gw1*rod.angle*"])
    assert sorted(log.read_text(encoding="utf-8").splitlines()) == [
        "_solved swing ",
        "planned mujoco.tuned ",
        "tried mujoco.tuned native",
    ]
    assert [path.name for path in folder.iterdir() if path.name.startswith("textmech")] == []
