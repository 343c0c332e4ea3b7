"""Whatever an engine's package does while it is imported and made: it is told, nobody dies."""

import os
import re
import signal
import subprocess
import sys
import time
import warnings
from collections.abc import Iterator
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest
from given import command
from given.forked import TOLD, forked, runs

from textmech import engines
from textmech.engines import probe
from textmech.reports.runs.selection import choose_engines

SOUND = """\
from dataclasses import dataclass
import os, signal, sys, time

class Panic(BaseException):
    pass

@dataclass(frozen=True)
class Engine:
    setting: str
    options: object = None
    name: str = "strange"
    version: str = "1.0"
    own_step: object = 1e-3
    offers = ("shipped",)

"""

IMPORTING = {
    "raise Panic('no')": "Panic: no",
    "sys.exit(0)": "SystemExit: 0",
    "raise KeyboardInterrupt": "KeyboardInterrupt",
    "os._exit(0)": "its process ended (exit code 0)",
    "os._exit(7)": "its process ended (exit code 7)",
    "os.abort()": "its process ended (SIGABRT)",
    "os.kill(os.getpid(), signal.SIGKILL)": "its process ended (SIGKILL)",
    "time.sleep(3600)": "it takes longer than 0.5 s",
    "raise OSError('half \\ud800 a letter')": r"OSError: half \ud800 a letter",
    "raise OSError('x' * 1_000_000)": "OSError: xxx",
    "Engine.__init__ = lambda *_: os._exit(5)": "its process ended (exit code 5)",
    "Engine.__init__ = lambda *_: sys.exit(5)": "SystemExit: 5",
    "Engine.__reduce__ = lambda self: 1 / 0": "ZeroDivisionError",
    "Engine.__getattribute__ = lambda *_: os._exit(6)": "its process ended (exit code 6)",
    "Engine = None": "its `offers` should be a tuple",
    "Engine.offers = 'shipped'": "its `offers` should be a tuple",
    "Engine.offers = (3,)": "its `offers` should be a tuple",
    "Engine.offers = ('best',)": "its `offers` should be a tuple",
}
MADE = {
    "version: object = 3": "its version should be a short text, is 3",
    "version: object = None": "its version should be a short text, is None",
    "version: str = 'v' * 1000": "its version should be a short text, is 'vvv",
    "version: str = 'a\\nb'": "its version should be a short text",
    "version: str = ''": "its version should be a short text",
    "version: str = '=cmd|x'": "its version begins with '=', as a formula of a spreadsheet does",
    "name: str = '../x'": "its name should be 'strange', is '../x'",
    "name: object = None": "its name should be 'strange', is None",
    "own_step: object = 0.0": "its own_step should be a time",
    "own_step: object = 'fast'": "its own_step should be a time",
    "own_step: object = float('nan')": "its own_step should be a time",
    "own_step: object = True": "its own_step should be a time",
}


@pytest.fixture
def strange(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The file of an engine that is found by its entry point."""
    point = EntryPoint("strange", "strange_engine:Engine", engines.GROUP)
    found = {**engines._found(), "strange": point}
    monkeypatch.setattr(engines, "_found", lambda: found)
    monkeypatch.syspath_prepend(tmp_path)
    engines._maker.cache_clear()
    yield tmp_path / "strange_engine.py"
    engines._maker.cache_clear()
    sys.modules.pop("strange_engine", None)


def why() -> str:
    """Why it is left out, of a run that asks for all engines; the others are there."""
    with pytest.warns(UserWarning, match="strange") as told:
        found = choose_engines([], [])
    assert {engine.name for engine in found} == {"mujoco", "pymunk"}
    # A worker of xdist has a thread, at which a fork warns from Python 3.12 on.
    (said,) = {str(warning.message) for warning in told if warning.category is UserWarning}
    assert len(said) < 500
    assert said.isprintable()
    return said


@pytest.mark.slow
@pytest.mark.parametrize("does", IMPORTING)
def test_what_it_does_at_import_is_told(
    does: str, strange: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if "sleep" in does:
        monkeypatch.setattr(probe, "SECONDS", 0.5)
    strange.write_text(f"{SOUND}\n{does}\n", encoding="utf-8")
    assert IMPORTING[does] in why()


@pytest.mark.parametrize("is_", MADE)
def test_what_it_says_of_itself_is_looked_at(is_: str, strange: Path) -> None:
    word = is_.partition(":")[0]
    lines = [is_ if line.strip().startswith(f"{word}:") else line.strip("\n")
             for line in SOUND.splitlines()]  # fmt: skip
    text = "\n".join(f"    {line}" if line is is_ else line for line in lines)
    strange.write_text(text, encoding="utf-8")
    assert MADE[is_] in why()


@pytest.mark.mutant("an interruption during an import is an engine that is broken")
def test_an_interruption_that_an_import_hides_is_one() -> None:
    def imports() -> None:
        try:
            raise KeyboardInterrupt
        except KeyboardInterrupt as error:
            raise ImportError("initialization failed") from error

    with pytest.raises(KeyboardInterrupt):
        probe.guarded(imports)
    assert isinstance(probe.guarded(lambda: 1 / 0)[1], ZeroDivisionError)

    def its_own_cause() -> None:
        error = ValueError("round")
        raise error from error

    assert isinstance(probe.guarded(its_own_cause)[1], ValueError)  # and nobody looks for ever


@pytest.mark.mutant("what an engine starts when it is tried outlives that")
@pytest.mark.skipif(not TOLD, reason="nothing tells what runs")
def test_what_it_starts_ends_with_the_trial() -> None:
    def forks() -> int:
        left = os.fork()
        if left == 0:
            time.sleep(60)
            os._exit(0)
        return left

    left, why = probe.apart(forks, most=10.0)
    assert not why
    until = time.monotonic() + 10
    while runs(left) and time.monotonic() < until:
        time.sleep(0.01)
    assert not runs(left)


def test_what_it_prints_is_not_in_the_output(
    strange: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    prints = "print('a banner'); os.write(1, b'and from C\\n')"
    strange.write_text(f"{SOUND}\n{prints}\n", encoding="utf-8")
    engine = engines.make("strange", "shipped")
    said = capfd.readouterr()
    assert engine.version == "1.0"
    assert said.out == ""
    assert "a banner" in said.err
    assert "and from C" in said.err


@pytest.mark.mutant("an engine's import takes away how a run is ended")
def test_what_an_import_changes_of_the_process_is_undone(tmp_path: Path) -> None:
    before = Path.cwd(), sys.getrecursionlimit(), signal.getsignal(signal.SIGINT)
    with probe.restored():
        os.chdir(tmp_path)
        sys.setrecursionlimit(before[1] + 1)
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    assert (Path.cwd(), sys.getrecursionlimit(), signal.getsignal(signal.SIGINT)) == before


# Engines of other packages: found, imported when they are asked for, and not in the way.


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
        "from textmech.reports.runs.selection import choose_cases, choose_engines\n"
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
