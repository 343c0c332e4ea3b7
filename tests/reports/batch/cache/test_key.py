"""Whatever a result depends on changes its key, and what it does not depend on does not."""

import math
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import fields, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.tree import FILES, imported, module

from textmech.cases.case import Case
from textmech.engines import make
from textmech.reports.batch.cache import key, parts
from textmech.reports.batch.cache.key import Keys, described
from textmech.reports.batch.cache.store import Store, usable

CASE = scenes.SHIPPED["rolling_wheel.pushed"]
ENGINE = make("pymunk", "tuned")
OTHER = {
    "name": "other", "title": "other", "system": None, "duration": 9.0, "samples": 9, "step": 9.0,
    "rests": True, "drops_out": ("x",),
}  # fmt: skip
MEMO = Store(Path(os.devnull))
SAME = ("source",)  # its text: only for messages


@pytest.fixture(autouse=True)
def nothing_is_newer(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """What a test writes would be newer than its process, and no key that of another."""
    monkeypatch.setattr(key, "BEGUN", math.inf)
    monkeypatch.setitem(globals(), "MEMO", Store(tmp_path / "memo"))


@pytest.fixture
def code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the code that a test may change."""
    for room in ("cases", "reference", "engines", "reports"):
        shutil.copytree(key.ROOT / room, tmp_path / room)
    monkeypatch.setattr(key, "ROOT", tmp_path)
    return tmp_path


def words(case: Case = CASE, engine: Any = ENGINE) -> tuple[str, str]:
    """The keys of the reference and of an outcome."""
    keys = replace(Keys.now(usable() or MEMO), salt="")
    return keys.solution(case), keys.outcome(keys.ways(case, engine), "native")


@pytest.mark.slow
@pytest.mark.parametrize("field", [f.name for f in fields(Case) if f.name not in SAME])
def test_every_field_of_a_case_counts(field: str) -> None:
    other = replace(CASE, **{field: OTHER.get(field, {"other": 1.0})})
    assert not set(words(other)) & set(words())


def test_its_text_does_not() -> None:
    assert words(replace(CASE, source=replace(CASE.source, file="b", lines=("#",)))) == words()


def test_a_number_counts_to_the_last_bit() -> None:
    near = {**CASE.parameters, "m": float(np.nextafter(CASE.parameters["m"], 9))}
    assert words(replace(CASE, parameters=near))[0] != words()[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    "engine",
    [make("pymunk", "shipped"), make("pymunk", "own", {"iterations": 30}),
     make("pymunk", "own", {"iterations": 31}), make("mujoco", "tuned"),
     replace(ENGINE, version="0.0")],  # pyright: ignore[reportArgumentType, reportCallIssue]
    ids=["shipped", "30", "31", "mujoco", "version"],
)  # fmt: skip
def test_engine_setting_options_and_version_count(engine: Any, request: Any) -> None:
    found = [words(engine=e)[1] for e in (engine, ENGINE, make("pymunk", "own", {}))]
    assert len(set(found)) == 3
    assert words(engine=engine)[0] == words()[0]


def test_the_way_it_is_realised_counts() -> None:
    keys = Keys((), "")
    assert keys.outcome("w", "law") != keys.outcome("w", "native")


def test_a_rungs_ladder_and_step_count() -> None:
    keys = Keys((), "")
    rungs = [("following", 1e-3), ("held", 1e-3), ("held", 1e-3 * (1 + 2**-52))]
    assert len({keys.rung("o", *rung) for rung in rungs}) == 3


@pytest.mark.slow
def test_what_is_tried_counts_and_the_code_that_tries_it(code: Path) -> None:
    def word(options: str = "{}", step: float = 1e-3) -> str:
        return replace(Keys.now(None), salt="").tried(CASE, ENGINE, options, step)

    assert len({word(), word('{"iterations": 30}'), word(step=1e-3 * (1 + 2**-52))}) == 3
    before, row = word(), words()[1]
    for file in ("candidate.py", "errors.py"):
        with (code / "reports" / "batch" / "search" / file).open("a", encoding="utf-8") as text:
            text.write("# changed\n")
        assert word() != before
        before = word()
    assert words()[1] == row


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "reference", "outcome"),
    [
        ("cases/scene/observe.py", True, True),
        ("reference/laws/friction.py", True, True),
        ("reference/motion/follow.py", True, True),
        ("engines/engine.py", False, True),
        ("engines/pymunk/callbacks/friction.py", False, True),
        ("engines/mujoco/adapter/run.py", False, False),
        ("reports/compare/judge/verdict.py", False, True),
        ("reports/compare/trial/ladder.py", False, True),
        ("reports/compare/events/times.py", False, True),
        ("reports/data/row.py", False, True),
        ("reports/batch/tasks.py", False, True),
        ("reports/data/pins.py", False, True),
        ("reports/system/limit.py", False, True),
        ("reports/system/table_text.py", False, True),
        ("reports/batch/cache/form.py", True, True),
        ("reports/output/write.py", False, False),
    ],
)
def test_the_code_that_makes_it_counts_and_no_other(
    file: str, reference: bool, outcome: bool, code: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parts, "home_of", lambda kind: code / "engines" / "pymunk")
    before = words()
    with (code / file).open("a", encoding="utf-8") as text:
        text.write("# changed\n")
    after = words()
    assert (before[0] != after[0], before[1] != after[1]) == (reference, outcome)


MODULES = {module(file): file for file in FILES}
PACKAGES = {name for name, file in MODULES.items() if file.name == "__init__.py"}
COMPUTING = (
    "reports.batch.tasks",
    "reports.compare.trial.run",
    "reports.batch.search.errors",
    "reports.batch.search.solving",
)
CARRYING = (
    *("system.termination", "system.lock", "system.temporary_folder", "data.file_content"),
    *("batch.cache.store", "batch.cache.fits", "batch.search.solving"),
)
"""What they import too, and what changes no result: where results lie."""
HANDING = (
    *("batch.task_results", "system.pool", "system.processes"),
    *("batch.cache.key", "batch.cache.parts", "batch.cache.digest", *CARRYING),
)
"""What a search imports too: who computes what it asks for, and whether it is known already."""
SEARCH = "reports.batch.search.causes"


@pytest.mark.slow
def test_all_code_counts_that_computes() -> None:
    """As far as imports lead from it, in reports and in what engines share."""
    assert untold(COMPUTING, (*key.REFERENCE, *key.JUDGING, *key.TRYING), CARRYING) == set()


@pytest.mark.slow
@pytest.mark.mutant("a key of causes without a file that a search for them imports")
@pytest.mark.mutant("a key of causes with a file that only who advises imports")
def test_a_search_counts_what_it_imports_and_no_other_search() -> None:
    """What the reference is made of is left out: the rows' own errors tell of it."""

    def missed(places: tuple[str, ...]) -> set[str]:
        return untold([SEARCH], (*key.REFERENCE, *places), HANDING)

    assert missed(key.SEARCHING) == set()
    assert missed(tuple(p for p in key.SEARCHING if p != "reports/system/limit.py")) == {
        "reports.system.limit"
    }
    assert needless([SEARCH], ["reports/batch/search"]) == set()
    assert "reports.batch.advice.advise" in needless(
        [SEARCH], ["reports/batch/search", "reports/batch/advice"]
    )


def reached(names: Iterable[str]) -> set[str]:
    """Modules of ours to which imports lead from these, and these."""
    needed, left = set[str](), {*names}
    while left:
        needed |= left
        left = {other for name in left for other in imported(MODULES[name])} & {*MODULES} - needed
    return needed


def told(places: Iterable[str]) -> set[str]:
    """The modules of which a key with these places is made; packages, which hold no code, too."""
    paths = {path for place in places for path in key._modules(key.ROOT / place)}
    return {name for name, path in MODULES.items() if path in paths} | PACKAGES


def untold(names: Iterable[str], places: Iterable[str], besides: Iterable[str]) -> set[str]:
    """What is reached from these modules and is at none of the places."""
    return reached(names) - told(places) - {f"reports.{name}" for name in besides}


def needless(names: Iterable[str], places: Iterable[str]) -> set[str]:
    """What is at the places and is not reached from these modules."""
    return told(places) - PACKAGES - reached(names)


@pytest.mark.slow
@pytest.mark.mutant("{file}: what a search of causes stands on is another set of files")
@pytest.mark.parametrize(
    ("file", "stands"),
    [
        ("engines/pymunk/callbacks/force.py", True),
        ("engines/engine.py", True),
        ("reports/batch/search/cures.py", True),
        ("reports/compare/judge/metric.py", True),
        ("engines/mujoco/adapter/run.py", False),
        ("reference/laws/friction.py", False),  # of a reference the rows' own errors tell
        ("reports.batch.advice.advise.py", False),
        ("reports/output/write.py", False),
    ],
)
def test_a_search_stands_on_the_adapter_and_the_search(
    file: str, stands: bool, code: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(key, "home_of", lambda kind: code / "engines" / "pymunk")
    before = key.Keys.now(None).search(CASE, ENGINE)
    with (code / file).open("a", encoding="utf-8") as text:
        text.write("# changed\n")
    assert (key.Keys.now(None).search(CASE, ENGINE) != before) == stands
    assert before


def test_an_engine_is_its_package() -> None:
    assert parts.home_of(type(ENGINE)) == key.ROOT / "engines" / "pymunk"


@pytest.mark.parametrize(
    "change",
    [
        lambda patch: patch.setenv("OPENBLAS_CORETYPE", "Another"),
        lambda patch: patch.setenv("NPY_DISABLE_CPU_FEATURES", "ANOTHER"),
        lambda patch: patch.setattr(np, "__version__", "0"),
        lambda patch: patch.setattr(key.scipy, "__version__", "0"),
        lambda patch: patch.setattr("sys.version", "0"),
        lambda patch: patch.setattr(key, "_processor", lambda: "another"),
        lambda patch: patch.setattr("platform.machine", lambda: "another"),
        lambda patch: patch.setenv("LD_PRELOAD", "libother.so"),
        lambda patch: patch.setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-ANOTHER"),
        lambda patch: patch.setattr(sys, "flags", SimpleNamespace(optimize=2)),
    ],
)
def test_the_machine_counts(
    change: Callable[[pytest.MonkeyPatch], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    before = key.machine.__wrapped__()
    change(monkeypatch)
    assert key.machine.__wrapped__() != before


@pytest.mark.mutant("the machine is no part of the key")
def test_another_machine_has_other_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    before = words()
    monkeypatch.setattr(key, "machine", lambda: "another")
    assert not set(words()) & set(before)


OF_A_PROCESS = """\
import sys
from pathlib import Path
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.engines import make
from textmech.reports.batch.cache import key, parts
from textmech.reports.batch.cache.store import Store
{before}
key.BEGUN = float("inf")
(case,) = load(shipped()["bar_pendulum"])
keys = key.Keys.now(Store(Path(sys.argv[1])))
print(keys.ways(case, make("{engine}", "shipped")))
"""


def of_a_process(folder: Path, engine: str, before: str, **variables: str) -> str:
    """The key of an engine's ways in a process of its own."""
    others = {name: value for name, value in os.environ.items() if name != "MUJOCO_GL"}
    code = OF_A_PROCESS.format(before=before, engine=engine)
    return subprocess.run(
        [sys.executable, "-c", code, str(folder)],
        env=others | variables, check=True, capture_output=True, text=True,
    ).stdout  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("what shows pictures in the key: pytest computes anew what the command has")
@pytest.mark.mutant("modules in the key that others have loaded")
@pytest.mark.parametrize("engine", ["mujoco", "pymunk"])
def test_a_process_that_could_show_pictures_has_the_same_keys(engine: str, tmp_path: Path) -> None:
    """As pytest, beside a command that forbids MuJoCo's windows: with glfw come cffi and more."""
    command = of_a_process(tmp_path, engine, "import mujoco, pymunk", MUJOCO_GL="off")
    other = "import cffi, glfw, mujoco, pycparser, pymunk"
    assert of_a_process(tmp_path, engine, other) == command
    if engine == "mujoco":
        planted = f"{other}; parts.WINDOWS.clear()"
        assert of_a_process(tmp_path, engine, planted) != command
    planted = f"{other}; parts._reached = lambda names: set(sys.modules) | names"
    assert of_a_process(tmp_path, engine, planted) != command


@pytest.mark.slow
def test_code_newer_than_the_process_gives_keys_of_its_own(
    code: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where it was given an older date: what the disk says of the change counts."""
    file = code / "cases" / "scene" / "observe.py"
    assert Keys.now(None).salt == ""
    monkeypatch.setattr(key, "BEGUN", time.time())
    time.sleep(0.02)  # a tick of the disk's clock
    file.write_bytes(file.read_bytes())
    os.utime(file, (1, 1))
    assert Keys.now(None).salt != Keys.now(None).salt != ""


@pytest.mark.slow
def test_code_that_changes_meanwhile_is_noticed(code: Path) -> None:
    keys = Keys.now(None)
    assert keys.hold()
    (code / "cases" / "scene" / "observe.py").write_text("", encoding="utf-8")
    assert not keys.hold()
    keys = Keys.now(None)
    (code / "cases" / "scene" / "observe.py").unlink()
    assert not keys.hold()


@pytest.mark.mutant("arrays of two types, or other values, told to be the same")
@pytest.mark.parametrize(
    ("one", "other"),
    [(1, 1.0), (0.0, -0.0), ("1", 1), ((1, 2), [1, 2]), ({"a": 1, "b": 2}, {"b": 2, "a": 1}),
     ("a, 'b'", ("a", "b")), (np.zeros(2), np.zeros((2, 1))), (True, 1), (None, "None"),
     (np.zeros(2), np.zeros(2, np.int64)), (np.zeros(2, "<f4"), np.zeros(2, ">f4"))],
)  # fmt: skip
def test_what_differs_is_described_differently(one: object, other: object) -> None:
    assert described(one) != described(other)


def test_what_cannot_be_told_apart_is_not_described() -> None:
    for value in (lambda: 1, object()):
        with pytest.raises(TypeError):
            described(value)


@pytest.mark.mutant("a package by its folders alone, though its code is another file's")
def test_who_stands_in_front_of_a_package_is_a_part_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its `__path__` leads to the installed one: submodules are found there, the code is here."""
    front = tmp_path / "front" / "__init__.py"
    front.parent.mkdir()
    front.write_text("")
    known = sys.modules["pymunk"]
    other = SimpleNamespace(__path__=list(known.__path__), __file__=str(front))
    plain = parts.located("pymunk")
    assert len(plain) == 1
    monkeypatch.setitem(sys.modules, "pymunk", other)
    assert parts.located("pymunk") == [*plain, front]


@pytest.mark.slow
@pytest.mark.mutant("what Python runs before all else in no key")
def test_what_python_runs_first_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = words()[1]
    first = tmp_path / "sitecustomize.py"
    first.write_text("import pymunk\n")
    monkeypatch.setitem(sys.modules, "sitecustomize", SimpleNamespace(__file__=str(first)))
    assert words()[1] != before
    monkeypatch.setattr(parts, "AT_START", ())
    assert words()[1] == before
