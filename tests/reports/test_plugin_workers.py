"""The plug-in under pytest-xdist: its workers share what one of them has computed."""

import os
import signal
import sys
import tempfile
import time
from pathlib import Path
from subprocess import DEVNULL, Popen

import pytest
from given.swing import SWING

from textmech.reports.system.temporary_folder import MARK, passing

pytest_plugins = ["pytester"]

# Each task that a worker gives to its processes, as one line.
COUNTED = """\
from textmech.reports.batch import task_results as results
spread = results.spread

def counted(function, tasks, executor, beat):
    with open({log!r}, "a") as file:
        for task in tasks:
            step = task.step if function.__name__ == "climbed" else ""
            file.write(f"{{function.__name__}} {{step}}\\n")
    return spread(function, tasks, executor, beat)

results.spread = counted
"""


def marked(among: Path) -> list[Path]:
    """The folders that workers share, once they say whose they are."""
    marks = among.glob(f"textmech-shared-*/{MARK}")
    return [mark.parent for mark in marks if mark.stat().st_size]


@pytest.mark.slow
def test_what_killed_workers_shared_goes_with_the_next_run(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    pytester.makefile(".yaml", swing=SWING)
    words = [sys.executable, "-m", "pytest", "swing.yaml", "-n", "2", "--textmech-no-cache"]
    with Popen(words, cwd=pytester.path, start_new_session=True, stdout=DEVNULL) as process:
        until = time.monotonic() + 60.0
        while not (found := marked(tmp_path)) and time.monotonic() < until:
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGKILL)
    assert found
    assert found[0].is_dir()
    until = time.monotonic() + 60.0  # a worker killed as it starts may hold the mark a while
    while found[0].exists() and time.monotonic() < until:
        with passing("textmech-shared-"):
            time.sleep(0.01)
    assert not found[0].exists()


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
