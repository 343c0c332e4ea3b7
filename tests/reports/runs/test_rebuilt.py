"""No row of a rebuilt engine is an old one, and pytest can be told to remember nothing."""

import importlib
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from given.scenes.swing import SWING

from textmech.reports.runs.processes import termination as ending

pytest_plugins = ["pytester"]
ONE = "pymunk.tuned"
STEP = "cpSpaceStep(self._space, dt)"
PROMISED = "reach: {pymunk: {rod.angle: 9.0e-3}}\n"  # that a row beyond is red


@pytest.fixture
def rebuilt(tmp_path: Path) -> Path:
    """pymunk of the same version, whose every step is a fifth too long."""
    for name in ("pymunk", "cffi"):
        installed = Path(importlib.import_module(name).__file__ or "").parent
        shutil.copytree(installed, tmp_path / "alt" / name)
        for other in installed.parent.glob(f"{name}-*.dist-info"):
            shutil.copytree(other, tmp_path / "alt" / other.name)
    space = tmp_path / "alt" / "pymunk" / "space.py"
    text = space.read_text(encoding="utf-8")
    assert STEP in text
    space.write_text(text.replace(STEP, STEP.replace("dt", "1.2 * dt")), encoding="utf-8")
    return tmp_path / "alt"


def started(
    *words: object, folder: Path, alt: Path | None = None, flags: tuple[str, ...] = ()
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *flags, "-m", *map(str, words)],
        cwd=folder,
        env=os.environ | {"TEXTMECH_CACHE": str(folder / "cache"), "PYTHONPATH": str(alt or "")},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


@pytest.mark.slow
@pytest.mark.mutant("an engine that was rebuilt under the same version is answered for by the old")
def test_a_rebuilt_engine_is_another_one_for_run_and_for_pytest(
    rebuilt: Path, tmp_path: Path
) -> None:
    (tmp_path / "swing.yaml").write_text(SWING + PROMISED, encoding="utf-8")
    run = ("textmech.reports.front.cli", "run", "swing.yaml", "--engine", ONE)
    test = ("pytest", "-p", "no:cacheprovider", "swing.yaml", "--textmech-engine", ONE)
    for words in (run, test):
        assert started(*words, folder=tmp_path).returncode == 0
        done = started(*words, folder=tmp_path, alt=rebuilt)
        assert done.returncode == 1, done.stdout
        assert started(*words, folder=tmp_path).returncode == 0


@pytest.mark.slow
def test_pytest_remembers_nothing_if_it_is_told_so(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("TEXTMECH_CACHE", str(tmp_path / "cache"))
    pytester.makefile(".yaml", swing=SWING)
    words = ("swing.yaml", "--textmech-engine", ONE)
    pytester.runpytest_subprocess(*words, "--textmech-no-cache").assert_outcomes(passed=3)
    assert not (tmp_path / "cache").exists()
    pytester.runpytest_subprocess(*words).assert_outcomes(passed=3)
    kept = [path for path in (tmp_path / "cache").rglob("*") if path.is_file()]
    for path in kept:
        path.write_bytes(b"")
    pytester.runpytest_subprocess(*words, "--textmech-no-cache").assert_outcomes(passed=3)
    assert kept
    assert all(path.stat().st_size == 0 for path in kept)


@pytest.mark.slow
def test_without_docstrings_a_run_is_refused_and_no_equation_is_lost(tmp_path: Path) -> None:
    """`python -OO` would write a table of what is covered in which nothing is."""
    (tmp_path / "swing.yaml").write_text(SWING, encoding="utf-8")
    run = ("textmech.reports.front.cli", "run", "swing.yaml", "--engine", ONE, "--out", "o")
    test = ("pytest", "-p", "no:cacheprovider", "swing.yaml", "--textmech-engine", ONE)
    for words in (run, test):
        done = started(*words, folder=tmp_path, flags=("-OO",))
        assert done.returncode == 2
        assert "takes the docstrings away" in done.stdout + done.stderr
    assert not (tmp_path / "o").exists()  # made for it, and empty
    assert [path for path in (tmp_path / "cache").rglob("*") if path.is_file()] == []


WATCHING = """\
import subprocess
import sys
import time
inner = '''
import time
from textmech.reports.runs.processes import termination
termination.with_parent()
print("now", flush=True)
time.sleep(60)
'''
subprocess.Popen([sys.executable, "-c", inner], stdout=sys.stderr)
time.sleep(60)
"""


@pytest.mark.slow
@pytest.mark.mutant("a worker of pytest goes on measuring when the session was killed")
def test_a_worker_whose_session_was_killed_ends_soon() -> None:
    with subprocess.Popen(
        [sys.executable, "-c", WATCHING], stderr=subprocess.PIPE, text=True
    ) as session:
        assert session.stderr
        assert session.stderr.readline() == "now\n"
        session.kill()
        killed = time.monotonic()
        assert session.stderr.read() == ""  # to its end: nobody holds it any more
        assert time.monotonic() - killed < 20 * ending.OFTEN  # else it sleeps a minute
