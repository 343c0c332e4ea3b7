"""What is in files decides, wherever they are loaded from, and not what a disk says of them."""

import importlib
import math
import os
import shutil
import time
from pathlib import Path
from typing import Any

import pytest
from given import scenes

from textmech.engines import make
from textmech.engines.engine import Engine
from textmech.reports.batch.cache import digest, key
from textmech.reports.batch.cache.key import Keys
from textmech.reports.batch.cache.store import Store

CASE = scenes.SHIPPED["bar_pendulum"]


def word(memo: Store, engine: Engine) -> str:
    return Keys((), "", memo).ways(CASE, engine)


def copied(alt: Path) -> Path:
    """pymunk again, in front of what is installed."""
    installed = Path(importlib.import_module("pymunk").__file__ or "").parent
    shutil.copytree(installed, alt / "pymunk")
    return alt / "pymunk" / "space.py"


@pytest.mark.slow
@pytest.mark.mutant("pymunk rebuilt under the same version")
def test_an_engine_in_front_of_the_installed_one_is_that_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    memo, pymunk = Store(tmp_path / "memo"), make("pymunk", "tuned")
    monkeypatch.setattr(key, "BEGUN", math.inf)
    installed = word(memo, pymunk)
    space = copied(tmp_path)
    module = importlib.import_module("pymunk")
    monkeypatch.setattr(module, "__path__", [str(space.parent)])
    monkeypatch.setattr(module, "__file__", str(space.with_name("__init__.py")))
    assert word(memo, pymunk) == installed  # the same content
    text = space.read_text(encoding="utf-8")
    space.write_text(
        text.replace("cpSpaceStep(self._space, dt)", "cpSpaceStep(self._space, 1.2*dt)")
    )
    assert word(memo, pymunk) != installed


@pytest.mark.mutant("what was read is remembered by size and date")
def test_what_was_read_is_remembered_until_it_changes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A change within a tick of the disk's clock is seen too: what is so new is read every time."""
    file, memo = tmp_path / "code.py", Store(tmp_path / "memo")
    file.write_text("x = 1\n", encoding="utf-8")
    found = file.stat()
    read, calls = digest.Place._read, [0]

    def counted(*words: Any) -> Any:
        calls[0] += 1
        return read(*words)

    monkeypatch.setattr(digest.Place, "_read", counted)

    def told() -> str:
        place = digest.Place(file)
        return place.contents(place.stats(), memo).digest

    first = told()
    assert (told(), calls[0]) == (first, 2)  # too new to be believed
    monkeypatch.setattr(digest, "SETTLED", 0.0)
    time.sleep(0.02)
    assert [told() for _ in range(2)] == [first, first]
    digest._remembered.cache_clear()  # as another process
    assert (told(), calls[0]) == (first, 3)
    file.write_text("x = 2\n", encoding="utf-8")
    os.utime(file, ns=(found.st_atime_ns, found.st_mtime_ns))
    time.sleep(0.02)
    assert told() != first
