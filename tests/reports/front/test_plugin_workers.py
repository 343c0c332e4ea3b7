"""The plug-in under pytest-xdist: its workers share what one of them has computed."""

from pathlib import Path

import pytest
from given.scenes.swing import SWING

pytest_plugins = ["pytester"]

# Each task that a worker gives to its processes, as one line.
COUNTED = """\
from textmech.reports.runs import task_results as results
spread = results.spread

def counted(function, tasks, executor, beat):
    with open({log!r}, "a") as file:
        for task in tasks:
            step = task.step if function.__name__ == "climbed" else ""
            file.write(f"{{function.__name__}} {{step}}\\n")
    return spread(function, tasks, executor, beat)

results.spread = counted
"""


@pytest.mark.slow
def test_workers_of_other_projects_make_no_folder(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    pytester.makepyfile(
        "import glob, os\n"
        "def test_own(): assert not glob.glob(os.environ['TMPDIR'] + '/textmech-*')"
    )
    pytester.runpytest_subprocess("-n", "2").assert_outcomes(passed=1)


@pytest.mark.slow
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
    done_once = sorted(log.read_text(encoding="utf-8").split())
    steps = [step for step in done_once if step[0].isdigit()]
    assert len(set(steps)) == len(steps) > 2  # the rungs of its one ladder
    kinds = [*["climbed"] * len(steps), "judged", "planned", "solved"]
    assert done_once == [*steps, *kinds]
    assert [path.name for path in folder.iterdir() if path.name.startswith("textmech")] == []
