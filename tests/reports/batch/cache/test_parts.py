"""Of a plug-in everything counts that decides what it computes, wherever it lies."""

import importlib
import math
import os
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.metadata import distributions
from pathlib import Path
from typing import Any

import pytest
from given import scenes

from textmech.engines import make
from textmech.reports.batch.cache import key, parts
from textmech.reports.batch.cache.key import Keys
from textmech.reports.batch.cache.store import Store
from textmech.reports.data import pins

CASE = scenes.SHIPPED["bar_pendulum"]
ENGINE = """\
import ctypes
import json
import os
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

HERE = Path(__file__).parent
HELPER = import_module("plug_" + "dynamic")
OTHER = "PLUG_FILE"


@dataclass(frozen=True)
class Plug:
    setting: str = "shipped"
    name: str = "plug"
    own_step: float = 1e-3

    @property
    def version(self):
        return (HERE / "version").read_text()

    def run(self):
        from plug_helper.deep import gain

        data = json.loads((HERE / "plug.json").read_text())
        library = ctypes.CDLL(HERE / "libplug.so")
        return gain, data, library, os.environ["plug_gain"], os.environ[OTHER]
"""
FILES = {
    "plug_engine.py": ENGINE,
    "plug_dynamic.py": "x = 1\n",
    "plug_helper/__init__.py": "from plug_third import y\n",
    "plug_helper/deep.py": "gain = 1.0\n",
    "plug_helper/table.bin": "1 2 3\n",
    "plug_third.py": "y = 1\n",
    "plug.json": "[1.0]\n",
    "libplug.so": "\0PLUG_MODE\0code\0",
    "version": "1.0",
}
ONE = ("alone", "package", "installed")


@pytest.fixture(params=ONE)
def folder(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Path]:
    """The plug-in as one module in a folder, as a package, or among what is installed."""
    folder = tmp_path / ("site-packages" if request.param == "installed" else "plugs")
    for name, text in FILES.items():
        inner = name.startswith("plug_helper") or name.endswith(("dynamic.py", "third.py"))
        package = request.param == "package" and not inner
        file = folder / ("plug_engine/" if package else "") / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    if request.param == "package":
        (folder / "plug_engine" / "plug_engine.py").rename(folder / "plug_engine" / "__init__.py")
    monkeypatch.setattr(key, "BEGUN", math.inf)
    monkeypatch.syspath_prepend(folder)
    monkeypatch.setenv("plug_gain", "1")
    yield folder
    for name in [name for name in sys.modules if name.startswith("plug_")]:
        del sys.modules[name]


@pytest.fixture
def memo(tmp_path: Path) -> Store:
    return Store(tmp_path / "memo")


def engine() -> Any:
    return importlib.import_module("plug_engine").Plug()


def word(memo: Store, one: Any = None) -> str:
    """The key of how it would run the case; of libraries that compute nothing is asked here."""
    one = engine() if one is None else one
    return Keys((), "", memo).ways(CASE, one)


def again(file: Path) -> None:
    """The same size and the same date, and another content: a build that keeps both."""
    found = file.stat()
    data = bytearray(file.read_bytes())
    data[-2] ^= 1
    file.write_bytes(bytes(data))
    os.utime(file, ns=(found.st_atime_ns, found.st_mtime_ns))
    assert file.stat().st_size == found.st_size


@pytest.mark.parametrize("name", [name for name in FILES if name != "plug_engine.py"])
def test_every_file_of_it_counts(name: str, folder: Path, memo: Store) -> None:
    """Also one of the same size and date: its size in place of its content would not do."""
    before = word(memo)
    assert word(memo) == before
    (file,) = (path for path in folder.rglob(Path(name).name) if name in str(path))
    if file.name == "__init__.py":
        file.write_text("from plug_third import y as z\n", encoding="utf-8")
    else:
        again(file)
    assert word(memo) != before


@pytest.mark.parametrize("name", ["plug_gain", "PLUG_MODE", "PLUG_FILE", "PLUG_ELSE"])
def test_the_variables_that_it_names_count_and_no_others(
    name: str, folder: Path, memo: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = word(memo)
    monkeypatch.setenv("SOMETHING_ELSE", "2")
    assert word(memo) == before
    monkeypatch.setenv(name, "2")
    assert word(memo) != before


def test_so_does_the_file_that_a_variable_names(
    folder: Path, memo: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "elsewhere").write_text("1\n", encoding="utf-8")
    monkeypatch.setenv("PLUG_FILE", str(tmp_path / "elsewhere"))
    before = word(memo)
    again(tmp_path / "elsewhere")
    assert word(memo) != before


@pytest.mark.mutant("an engine's version that no key has")
def test_a_version_that_is_no_field_counts(folder: Path, memo: Store) -> None:
    """A plug-in may read it from anywhere, as from a file that nothing names."""
    before, kind = word(memo), type(engine())
    other = type("Plug", (kind,), {"version": property(lambda _: "2.0")})
    other.__module__, other.__qualname__ = kind.__module__, kind.__qualname__
    assert word(memo, other()) != before


@dataclass(frozen=True)
class Here:
    """An engine of this file."""

    setting: str = "shipped"
    name: str = "here"
    version: str = "1"


@pytest.mark.slow
def test_what_it_requires_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the distribution that brings it, and whatever this requires and has loaded."""
    site = tmp_path / "site-packages"
    for name, needs in (("plug-a", "plug_b"), ("plug-b", "")):
        info = site / f"{name.replace('-', '_')}-1.0.dist-info"
        info.mkdir(parents=True)
        needed = f"Requires-Dist: {needs} >=1 ; python_version > '3'\n" if needs else ""
        (info / "METADATA").write_text(f"Name: {name}\nVersion: 1.0\n{needed}\n", encoding="utf-8")
        module = name.replace("-", "_")
        (info / "RECORD").write_text(f"{module}/__init__.py,,\n{module}.libs/x,,\n", "utf-8")
        for part in (module, f"{module}.libs"):
            (site / part).mkdir()
        (site / module / "__init__.py").write_text("x = 11\n", encoding="utf-8")
        (site / f"{module}.libs" / "x").write_text("linked\n", encoding="utf-8")
    monkeypatch.syspath_prepend(site)
    importlib.import_module("plug_b")
    monkeypatch.setattr(key, "BEGUN", math.inf)
    (found,) = distributions(name="plug-a", path=[str(site)])
    monkeypatch.setattr(parts.engines, "distribution", lambda name: found)
    memo = Store(tmp_path / "memo")
    seen = [word(memo, Here())]
    changed = ("plug_a/__init__.py", "plug_b/__init__.py", "plug_a.libs/x", "plug_b.libs/x")
    for name in changed:
        again(site / name)
        seen.append(word(memo, Here()))
    assert len(set(seen)) == len(seen)


@pytest.mark.parametrize("listed", ["0.1", "7.3.1"])
def test_the_pins_count(listed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """They decide whether a row of a declared difference FAILS."""
    monkeypatch.setattr(pins, "ENVIRONMENT", tmp_path / "environment.txt")
    (tmp_path / "environment.txt").write_text("# none\n", encoding="utf-8")
    keys: Callable[[], str] = lambda: Keys((), "").ways(CASE, make("pymunk", "tuned"))  # noqa: E731
    before = keys()
    (tmp_path / "environment.txt").write_text(f"pymunk=={listed}\n", encoding="utf-8")
    assert keys() != before


def test_an_engine_that_is_newer_than_the_process_is_never_remembered(
    folder: Path, memo: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The process may have loaded what was there before."""
    monkeypatch.setattr(key, "BEGUN", 0.0)
    assert word(memo) != word(memo)


def test_an_engine_that_changes_meanwhile_is_noticed(folder: Path, memo: Store) -> None:
    keys = Keys((), "", memo)
    keys.ways(CASE, engine())
    assert keys.hold()
    (file,) = folder.rglob("plug.json")
    again(file)
    assert not keys.hold()
