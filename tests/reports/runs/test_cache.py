"""Stored results: whatever one depends on changes its key, and an entry is whole or not there."""

import importlib
import math
import os
import pickle
import pwd
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, fields, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.command.tree import FILES, imported, module
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.engines import make
from textmech.reports.runs.cache import key, store
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import Store
from textmech.reports.tables import pins

CASE = scenes.SHIPPED["rolling_wheel.pushed"]
ENGINE = make("pymunk", "tuned")
OTHER = {
    "name": "other", "title": "other", "system": None, "duration": 9.0, "samples": 9, "step": 9.0,
    "rests": True, "drops_out": ("x",),
}  # fmt: skip
SAME = ("source",)  # its text: only for messages


@pytest.fixture(autouse=True)
def nothing_is_newer(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a test writes would be newer than its process, and no key that of another."""
    monkeypatch.setattr(key, "BEGUN", math.inf)


@pytest.fixture
def code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the code that a test may change."""
    for room in key.ROOMS:
        shutil.copytree(key.ROOT / room, tmp_path / room)
    monkeypatch.setattr(key, "ROOT", tmp_path)
    return tmp_path


def changed(file: Path) -> None:
    """Adds a comment to a file of code."""
    with file.open("a", encoding="utf-8") as text:
        text.write("# changed\n")


def words(case: Case = CASE, engine: Any = ENGINE) -> tuple[str, str]:
    """The keys of the reference and of an outcome."""
    keys = Keys(libraries="")
    return keys.solution(case), keys.outcome(keys.ways(case, engine), "native")


@pytest.mark.parametrize("field", [f.name for f in fields(Case) if f.name not in SAME])
def test_every_field_of_a_case_counts(field: str) -> None:
    other = replace(CASE, **{field: OTHER.get(field, {"other": 1.0})})
    assert not set(words(other)) & set(words())


def test_its_text_does_not() -> None:
    assert words(replace(CASE, source=replace(CASE.source, file="b", lines=("#",)))) == words()


def test_a_number_counts_to_the_last_bit() -> None:
    near = {**CASE.parameters, "m": float(np.nextafter(CASE.parameters["m"], 9))}
    assert words(replace(CASE, parameters=near))[0] != words()[0]


@pytest.mark.parametrize(
    "engine",
    [make("pymunk", "shipped"), make("pymunk", "own", {"iterations": 30}),
     make("pymunk", "own", {"iterations": 31}), make("mujoco", "tuned"),
     replace(ENGINE, version="0.0")],  # pyright: ignore[reportArgumentType, reportCallIssue]
    ids=["shipped", "30", "31", "mujoco", "version"],
)  # fmt: skip
def test_engine_setting_options_and_version_count(engine: Any) -> None:
    keys = [words(engine=e) for e in (engine, ENGINE, make("pymunk", "own", {}))]
    assert len({outcome for _, outcome in keys}) == 3
    assert len({solution for solution, _ in keys}) == 1


def test_the_way_the_ladder_and_the_step_count() -> None:
    keys = Keys()
    assert keys.outcome("w", "law") != keys.outcome("w", "native")
    rungs = [("following", 1e-3), ("held", 1e-3), ("held", 1e-3 * (1 + 2**-52))]
    assert len({keys.rung("o", *rung) for rung in rungs}) == 3
    tried = [("{}", 1e-3), ('{"iterations": 30}', 1e-3), ("{}", 1e-3 * (1 + 2**-52))]
    assert len({keys.tried(CASE, ENGINE, *one) for one in tried}) == 3


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "reference", "outcome"),
    [
        ("cases/scene/observe.py", True, True),
        ("reference/motion/follow.py", True, True),
        ("engines/engine.py", False, True),
        ("engines/pymunk/callbacks/friction.py", False, True),
        ("engines/mujoco/adapter/run.py", False, False),
        ("reports/compare/judge/verdict.py", False, True),
        ("reports/runs/tasks.py", False, True),
        ("reports/tables/write.py", False, False),
    ],
)
def test_the_code_that_makes_it_counts_and_no_other(
    file: str, reference: bool, outcome: bool, code: Path
) -> None:
    before = words()
    changed(code / file)
    after = words()
    assert (before[0] != after[0], before[1] != after[1]) == (reference, outcome)


MODULES = {module(file): file for file in FILES}
PACKAGES = {name for name, file in MODULES.items() if file.name == "__init__.py"}
COMPUTING = (
    "reports.runs.tasks",
    "reports.compare.trial.run",
    "reports.search.causes.errors",
)
CARRYING = (
    *("runs.processes.termination", "tables.lock", "runs.processes.temporary_folder"),
    "runs.cache.store",
)
"""What they import too, and what changes no result: where results lie."""
HANDING = ("runs.task_results", "runs.processes.pool", "runs.cache.key", *CARRYING)
"""What a search imports too: who computes what it asks for, and whether it is known already."""
SEARCH, DOOR = "reports.search.causes.causes", "reports.search.causes.explained"
"""Where a search is, and through what a run asks for it."""


@pytest.mark.slow
def test_all_code_counts_that_computes() -> None:
    """As far as imports lead from it, in reports and in what engines share."""
    assert uncounted(COMPUTING, (*key.REFERENCE, *key.JUDGING, *key.TRYING), CARRYING) == set()


@pytest.mark.slow
@pytest.mark.mutant("a key of causes without a file that a search for them imports")
@pytest.mark.mutant("a key of causes with a file that only who advises imports")
def test_a_search_counts_what_it_imports_and_no_other_search() -> None:
    """What the reference is made of is left out: the rows' own errors tell of it."""

    def missed(places: tuple[str, ...]) -> set[str]:
        return uncounted([SEARCH], (*key.REFERENCE, *places), HANDING)

    assert missed(key.SEARCHING) == set()
    fewer = tuple(place for place in key.SEARCHING if place != "reports/tables/pins.py")
    assert missed(fewer) == {"reports.tables.pins"}
    assert needless([SEARCH], ["reports/search/causes"]) == {DOOR}
    assert "reports.search.advice.advise" in needless(
        [SEARCH], ["reports/search/causes", "reports/search/advice"]
    )


def reached(names: Iterable[str]) -> set[str]:
    """Modules of ours to which imports lead from these, and these."""
    needed, new = set[str](), {*names}
    while new:
        needed |= new
        new = {other for name in new for other in imported(MODULES[name])} & {*MODULES} - needed
    return needed


def counted(places: Iterable[str]) -> set[str]:
    """The modules of which a key with these places is made; packages, which hold no code, too."""
    paths = {path for place in places for path in key.sources(place)}
    return {name for name, path in MODULES.items() if path in paths} | PACKAGES


def uncounted(names: Iterable[str], places: Iterable[str], besides: Iterable[str]) -> set[str]:
    """What is reached from these modules and is at none of the places."""
    return reached(names) - counted(places) - {f"reports.{name}" for name in besides}


def needless(names: Iterable[str], places: Iterable[str]) -> set[str]:
    """What is at the places and is not reached from these modules."""
    return counted(places) - PACKAGES - reached(names)


@pytest.mark.slow
@pytest.mark.mutant("{file}: what a search of causes stands on is another set of files")
@pytest.mark.parametrize(
    ("file", "stands"),
    [
        ("engines/pymunk/callbacks/force.py", True),
        ("engines/engine.py", True),
        ("reports/search/causes/cures.py", True),
        ("reports/compare/judge/metric.py", True),
        ("engines/mujoco/adapter/run.py", False),
        ("reference/laws/friction.py", False),  # of a reference the rows' own errors tell
        ("reports/search/advice/advise.py", False),
        ("reports/tables/write.py", False),
    ],
)
def test_a_search_stands_on_the_adapter_and_the_search(file: str, stands: bool, code: Path) -> None:
    before = Keys().search(CASE, ENGINE)
    changed(code / file)
    assert (Keys().search(CASE, ENGINE) != before) == stands
    assert before


@pytest.mark.parametrize(
    "change",
    [
        lambda patch: patch.setenv("OPENBLAS_CORETYPE", "Another"),
        lambda patch: patch.setattr(np, "__version__", "0"),
        lambda patch: patch.setattr("sys.version", "0"),
        lambda patch: patch.setattr(key, "_processor", lambda: "another"),
        lambda patch: patch.setattr("platform.machine", lambda: "another"),
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


# The files of engines, by name, size and time.


@dataclass(frozen=True)
class Place:
    """A folder that stands for what is installed."""

    folder: Path

    def touch(self, name: str) -> None:
        """Builds the file anew, with the same size."""
        file = self.folder / name
        found = file.stat()
        file.write_bytes(file.read_bytes()[::-1])
        os.utime(file, ns=(found.st_atime_ns, found.st_mtime_ns + 1_000_000))


@pytest.mark.mutant("pymunk rebuilt under the same version")
@pytest.mark.parametrize("name", ["space.py", "version"])
def test_an_engine_that_is_rebuilt_under_its_version_is_another(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Wherever it is loaded from, in front of what is installed."""
    spec = importlib.import_module("pymunk").__spec__
    assert spec is not None
    folder = Path(spec.origin or "").parent
    copy = Place(shutil.copytree(folder, tmp_path / "pymunk", copy_function=shutil.copyfile))
    monkeypatch.setattr(spec, "submodule_search_locations", [str(copy.folder)])
    monkeypatch.setattr(spec, "origin", str(copy.folder / "__init__.py"))
    (copy.folder / "version").touch()
    before = words()
    assert words() == before
    copy.touch(name)
    assert words()[1] != before[1]
    assert words()[0] == before[0]
    names_alone = otherwise(key, "{file.st_size} {file.st_mtime_ns}", "")
    monkeypatch.setattr(key, "State", names_alone.State)
    again = words()
    copy.touch(name)
    assert words() == again  # by names alone the two builds are one


PLUG = """\
from dataclasses import dataclass

@dataclass(frozen=True)
class Plug:
    gain: float = 1.0
    setting: str = "shipped"
    name: str = "plug"
    own_step: float = 1e-3

    @property
    def version(self):
        return "1.0"
"""


@pytest.fixture
def plug(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Place]:
    """A plug-in's package beside what it requires, each with its distribution."""
    site = tmp_path / "site-packages"
    for name, needs in (("plug-engine", "plug_core >=1 ; python_version > '3'"), ("plug-core", "")):
        top = name.replace("-", "_")
        (site / top).mkdir(parents=True)
        (site / top / "__init__.py").write_text(PLUG, encoding="utf-8")
        (site / f"{top}.libs").mkdir()
        (site / f"{top}.libs" / "x").write_text("linked", encoding="utf-8")
        info = site / f"{top}-1.0.dist-info"
        info.mkdir()
        required = f"Requires-Dist: {needs}\n" if needs else ""
        (info / "METADATA").write_text(f"Name: {name}\nVersion: 1.0\n{required}", "utf-8")
        (info / "RECORD").write_text(f"{top}/__init__.py,,\n{top}.libs/x,,\n", "utf-8")
    (site / "plug_engine" / "inner").mkdir()
    (site / "plug_engine" / "inner" / "table.bin").write_text("1 2 3", encoding="utf-8")
    monkeypatch.syspath_prepend(site)
    found = key.distribution("plug-engine")
    monkeypatch.setattr(key.engines, "distribution", lambda name: found)
    yield Place(site)
    sys.modules.pop("plug_engine", None)


def made(gain: float = 1.0) -> Any:
    return importlib.import_module("plug_engine").Plug(gain)


@pytest.mark.parametrize(
    "name",
    ["plug_engine/__init__.py", "plug_engine/inner/table.bin", "plug_engine.libs/x",
     "plug_core/__init__.py", "plug_core.libs/x"],
)  # fmt: skip
def test_every_file_of_a_plug_in_and_of_what_it_requires_counts(name: str, plug: Place) -> None:
    before = words(engine=made())
    assert words(engine=made()) == before
    assert words(engine=made(2.0))[1] != before[1]
    plug.touch(name)
    assert words(engine=made())[1] != before[1]


@pytest.mark.mutant("an engine's version that no key has")
def test_a_version_that_is_no_field_counts(plug: Place) -> None:
    """A plug-in may read it from anywhere, as from a file that nothing names."""
    before = words(engine=made())
    kind: Any = type(made())
    kind.version = property(lambda self: "2.0")
    assert words(engine=made())[1] != before[1]


def test_what_cannot_be_told_apart_is_never_found_again(plug: Place) -> None:
    """As an engine that cannot be pickled."""
    engines = [made(lambda: 1) for _ in range(2)]  # type: ignore[arg-type]
    assert words(engine=engines[0])[1] != words(engine=engines[1])[1]


def test_what_is_newer_than_the_process_is_never_found_again(
    plug: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The process may have loaded what was there before."""
    monkeypatch.setattr(key, "BEGUN", 0.0)
    assert words(engine=made())[1] != words(engine=made())[1]
    assert Keys.now(None).salt != Keys.now(None).salt != ""
    assert Keys.now(None).search(CASE, ENGINE) == ""


def test_code_or_an_engine_that_changes_meanwhile_is_noticed(code: Path, plug: Place) -> None:
    keys = Keys.now(Store(code / "store"))
    keys.ways(CASE, made())
    assert keys.hold()
    plug.touch("plug_core/__init__.py")
    assert not keys.hold()
    keys = Keys.now(None)
    assert keys.hold()
    (code / "cases" / "scene" / "observe.py").unlink()
    assert not keys.hold()


def test_the_pins_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """They decide whether a row of a declared difference FAILS."""
    monkeypatch.setattr(pins, "ENVIRONMENT", tmp_path / "environment.txt")
    (tmp_path / "environment.txt").write_text("# none\n", encoding="utf-8")
    before = words()
    (tmp_path / "environment.txt").write_text("pymunk==0.1\n", encoding="utf-8")
    assert words()[1] != before[1]


OF_A_PROCESS = """\
import {imports}
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.engines import make
from textmech.reports.runs.cache.key import Keys
case = next(c for c in load(shipped()["rolling_wheel"]) if c.name == "rolling_wheel.pushed")
print(Keys(libraries="").ways(case, make("{engine}", "tuned")))
"""


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "pymunk"])
def test_whatever_a_process_has_imported_it_has_the_same_keys(engine: str) -> None:
    """As pytest, which has loaded more than the command."""
    found = set[str]()
    for imports in ("os", "mujoco, pymunk, cffi, glfw, pandas"):
        text = OF_A_PROCESS.format(imports=imports, engine=engine)
        words = [sys.executable, "-c", text]
        found.add(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    assert len(found) == 1


def test_the_libraries_that_compute_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    place = Place(tmp_path)
    (tmp_path / "a.so").write_text("ab", encoding="utf-8")
    monkeypatch.setattr(key, "_places", lambda installed: [tmp_path])
    keys = Keys.now(Store(tmp_path))
    place.touch("a.so")
    assert Keys.now(Store(tmp_path)).solution(CASE) != keys.solution(CASE)


# Where results lie.

KEY, OTHER_KEY = "ab" + "0" * 62, "cd" + "0" * 62


@pytest.fixture
def kept(tmp_path: Path) -> Store:
    kept = Store(tmp_path / "cache")
    kept.put(KEY, [1.5, "two"])
    return kept


@pytest.mark.slow
def test_what_is_put_comes_back_to_the_last_bit(kept: Store) -> None:
    solution = scenes.solved("rolling_wheel.pushed")
    kept.put(OTHER_KEY, solution)
    found = kept.get(OTHER_KEY)
    assert pickle.dumps(found) == pickle.dumps(pickle.loads(pickle.dumps(solution)))
    assert kept.get(KEY) == [1.5, "two"]


def test_a_cut_or_changed_entry_is_none(kept: Store) -> None:
    whole = (kept.folder / KEY).read_bytes()
    for place in range(len(whole)):
        wrong = bytearray(whole)
        wrong[place] ^= 1
        for data in (whole[:place], bytes(wrong)):
            (kept.folder / KEY).write_bytes(data)
            assert kept.get(KEY) is None


@pytest.mark.mutant("an entry under another's key")
def test_an_entry_that_was_put_in_anothers_place_is_none(kept: Store) -> None:
    kept.put(OTHER_KEY, [2.5, "other"])
    (kept.folder / KEY).write_bytes((kept.folder / OTHER_KEY).read_bytes())
    assert kept.get(KEY) is None
    assert kept.get(OTHER_KEY) == [2.5, "other"]


def test_an_interruption_leaves_nothing(kept: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    def strike(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", strike)
    with pytest.raises(KeyboardInterrupt):
        kept.put(OTHER_KEY, [])
    assert [*kept.folder.iterdir()] == [kept.folder / KEY]


def test_a_disk_that_takes_nothing_is_no_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    kept = Store(tmp_path / "file" / "cache")
    kept.put(KEY, [])
    assert kept.get(KEY) is None
    monkeypatch.setenv(store.FOLDER, str(tmp_path / "file" / "cache"))
    assert store.usable() is None


def test_the_least_recently_used_goes_first_and_no_file_of_others(kept: Store) -> None:
    kept.put(OTHER_KEY, [1.5, "two"])
    (kept.folder / "notes.txt").write_text("theirs")
    os.utime(kept.folder / KEY, (1, 1))
    os.utime(kept.folder / OTHER_KEY, (2, 2))
    assert kept.get(KEY)  # used now
    kept.trim(limit=(kept.folder / KEY).stat().st_size)
    assert kept.get(KEY)
    assert kept.get(OTHER_KEY) is None
    kept.trim(limit=0)
    assert [path.name for path in kept.folder.iterdir()] == ["notes.txt"]


@pytest.mark.mutant("a lock that cannot be had ends the run")
def test_a_lock_that_cannot_be_had_is_none(kept: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a network file system."""
    opened = os.open

    def refusing(path: Any, *words: Any, **more: Any) -> int:
        if str(path) == str(kept.folder / OTHER_KEY):
            raise PermissionError(13, "Permission denied")
        return opened(path, *words, **more)

    monkeypatch.setattr(os, "open", refusing)
    with kept.alone(OTHER_KEY, pytest.fail):
        kept.put(KEY, [2])
    assert kept.get(KEY) == [2]


def test_it_lies_in_the_users_own_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The same from every folder: workers have another current one."""
    monkeypatch.delenv(store.FOLDER, raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert store.by_default() == tmp_path / "textmech"
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(store.FOLDER, "mine")
    assert store.by_default() == tmp_path / "mine"
    usable = store.usable()
    assert usable == Store(tmp_path / "mine" / "results")
    assert (tmp_path / "mine" / "results").stat().st_mode & 0o777 == 0o700


@pytest.mark.mutant("pickles are read from a folder that others may write to")
def test_a_folder_that_others_may_write_to_is_not_read(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv(store.FOLDER, str(tmp_path))
    assert store.usable()
    (tmp_path / "results").chmod(0o770)
    assert store.usable() is None
    with monkeypatch.context() as planted:
        planted.setattr(store, "_is_private", lambda place: True)
        assert store.usable()
    (tmp_path / "results").rename(tmp_path / "elsewhere")
    (tmp_path / "elsewhere").chmod(0o700)
    (tmp_path / "results").symlink_to(tmp_path / "elsewhere")
    assert store.usable() is None
    monkeypatch.setattr(os, "geteuid", lambda: -1)
    assert store.usable() is None


def test_who_names_it_needs_no_home(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def homeless(user: int) -> None:
        raise KeyError(f"getpwuid(): uid not found: {user}")

    monkeypatch.setattr(pwd, "getpwuid", homeless)
    for name in ("HOME", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(store.FOLDER, str(tmp_path / "mine"))
    assert store.by_default() == tmp_path / "mine"
    monkeypatch.delenv(store.FOLDER)
    assert store.usable() is None
    assert not [*tmp_path.iterdir()]  # no folder called ~
