"""Engines of other packages: found, imported when they are asked for, and not in the way."""

import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

import pytest
from given import command
from given.forked import forked

from textmech import engines

CASE = """\
title: A ball that falls
scene: {bodies: {ball: {particle: {mass: 2.0}}}}
initial: {ball: {x: 0, y: 0}}
duration: 0.4
samples: 6
allow: {ball.y: 1.0e-2}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """With two distributions on the path: one engine is not there, one fails when imported."""
    for name, module in (("absent", "nowhere"), ("failing", "failing_engine")):
        info = tmp_path / "path" / f"{name}-1.0.dist-info"
        info.mkdir(parents=True)
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text(f"[textmech.engines]\n{name} = {module}:Engine\n")
    (tmp_path / "path" / "failing_engine.py").write_text("raise OSError('no libGL')\n")
    (tmp_path / "ball.yaml").write_text(CASE, encoding="utf-8")
    return tmp_path


def python(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join(filter(None, [str(folder / "path"), os.environ.get("PYTHONPATH", "")]))
    return subprocess.run(
        [sys.executable, *words],
        capture_output=True,
        text=True,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": path},
        timeout=120,
        check=False,
    )


def textmech(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """The command where no engine has been asked for yet, in a fork."""

    def run() -> subprocess.CompletedProcess[str]:
        sys.path.insert(0, str(folder / "path"))
        for kept in (engines._found, engines._maker):
            kept.cache_clear()
        warnings.simplefilter("default")  # here they are errors
        return command.textmech(*words, folder=folder)

    return forked(run)


@pytest.mark.slow
def test_what_cannot_be_imported_does_not_stop_the_others(folder: Path) -> None:
    declared = "deviates: {failing.shipped: {ball.y: {limit: 1.0, because: it is soft}}}\n"
    (folder / "ball.yaml").write_text(CASE + declared, encoding="utf-8")
    done = textmech(folder, "run", "ball.yaml")
    assert done.returncode == 0, done.stderr
    assert all(re.search(rf"in {name} \S+ tuned", done.stdout) for name in ("mujoco", "pymunk"))
    assert "warning: failing (failing_engine:Engine) cannot be imported" in done.stderr
    assert "OSError: no libGL" in done.stderr
    assert "warning: absent (nowhere:Engine) cannot be imported" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
def test_who_asks_for_it_is_told(folder: Path) -> None:
    done = textmech(folder, "run", "ball.yaml", "--engine", "failing")
    assert done.returncode == 2
    assert "--engine: failing: failing (failing_engine:Engine) cannot be imported" in done.stderr
    (folder / "mine.yaml").write_text("pymunk: {iterations: 20}\nabsent: {step: 1.0e-3}\n")
    done = textmech(folder, "run", "ball.yaml", "--engine", "pymunk", "--settings", "mine.yaml")
    assert done.returncode == 2
    assert "mine.yaml:2:1: absent: absent (nowhere:Engine) cannot be imported" in done.stderr


@pytest.mark.slow
def test_a_name_nobody_has_is_hinted_at(folder: Path) -> None:
    for word, hint in (("mojoco.tuned", "mujoco.tuned"), ("mujoco.tunned", "mujoco.tuned")):
        done = textmech(folder, "run", "ball.yaml", "--engine", word)
        assert done.returncode == 2
        assert f"did you mean '{hint}'?" in done.stderr
    text = CASE.replace("samples: 6\n", "samples: 6\nreach: {failng: {ball.y: 1.0e-3}}\n")
    (folder / "ball.yaml").write_text(text)
    done = textmech(folder, "check", "ball.yaml")
    assert "reach.failng: unknown engine 'failng'; did you mean 'failing'?" in done.stderr


@pytest.mark.slow
def test_only_what_is_asked_for_is_imported(folder: Path) -> None:
    asked = (
        "import sys\n"
        "from pathlib import Path\n"
        "from textmech.reports.batch.selection import choose_cases, choose_engines\n"
        "choose_cases(['ball.yaml'])\n"
        "print('before:', *({'mujoco', 'pymunk', 'failing_engine'} & set(sys.modules)))\n"
        "print([e.setting for e in choose_engines(['pymunk'], [])])\n"
        "print('after:', *({'mujoco', 'pymunk', 'failing_engine'} & set(sys.modules)))\n"
    )
    done = python(folder, "-c", asked)
    assert done.stdout == "before:\n['shipped', 'tuned']\nafter: pymunk\n", done.stderr


BROKEN = {
    "it leaves": ("import sys; sys.exit(3)\n", "SystemExit: 3"),
    "it offers nothing": ("class Engine: pass\n", "its `offers` should be a tuple"),
    "it offers letters": ("class Engine:\n    offers = 'shipped'\n", "its `offers` should be"),
    "it cannot be made": (
        "class Engine:\n    offers = ('shipped',)\n"
        "    def __init__(self, *_): raise RuntimeError('no licence')\n",
        "RuntimeError: no licence",
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("what", BROKEN)
def test_no_broken_engine_stops_the_others(folder: Path, what: str) -> None:
    text, said = BROKEN[what]
    (folder / "path" / "failing_engine.py").write_text(text, encoding="utf-8")
    done = textmech(folder, "run", "ball.yaml")
    assert done.returncode == 0, done.stderr
    assert all(re.search(rf"in {name} \S+ tuned", done.stdout) for name in ("mujoco", "pymunk"))
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    asked = textmech(folder, "run", "ball.yaml", "--engine", "failing")
    assert asked.returncode == 2
    assert said in asked.stderr


@pytest.mark.slow
@pytest.mark.parametrize("taken", ["book", "reference", "my.engine"])
def test_a_name_that_no_case_can_write_is_no_engine(folder: Path, taken: str) -> None:
    info = folder / "path" / "failing-1.0.dist-info" / "entry_points.txt"
    info.write_text(f"[textmech.engines]\n{taken} = failing_engine:Engine\n")
    done = textmech(folder, "run", "ball.yaml")
    assert done.returncode == 0, done.stderr
    assert "failing" not in done.stderr
