"""A stored result is whole or not there, and there are never too many."""

import os
import pwd
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from given.trees import digest

from textmech.reports.batch.cache import store
from textmech.reports.batch.cache.store import Store

KEY, OTHER = "ab" + "0" * 62, "cd" + "0" * 62


@pytest.fixture
def kept(tmp_path: Path) -> Store:
    kept = Store(tmp_path / "cache")
    kept.put(KEY, [1.5, "two"])
    return kept


def file(kept: Store, key: str = KEY) -> Path:
    return kept.folder / key[:2] / key


def test_what_is_put_is_found(kept: Store) -> None:
    assert kept.get(KEY) == [1.5, "two"]
    assert kept.get(OTHER) is None


def test_a_cut_entry_is_none(kept: Store) -> None:
    whole = file(kept).read_bytes()
    for length in range(0, len(whole), 7):
        file(kept).write_bytes(whole[:length])
        assert kept.get(KEY) is None


def test_a_changed_entry_is_none(kept: Store) -> None:
    whole = file(kept).read_bytes()
    for place in range(0, len(whole), 7):
        wrong = bytearray(whole)
        wrong[place] ^= 1
        file(kept).write_bytes(bytes(wrong))
        assert kept.get(KEY) is None


def test_an_interruption_leaves_nothing(kept: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    def strike(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", strike)
    with pytest.raises(KeyboardInterrupt):
        kept.put(OTHER, [])
    assert [path for path in kept.folder.rglob("*") if path.is_file()] == [file(kept)]


def test_a_disk_that_takes_nothing_is_no_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    kept = Store(tmp_path / "file" / "cache")
    kept.put(KEY, [])
    assert kept.get(KEY) is None


def test_the_least_recently_used_goes_first(kept: Store) -> None:
    kept.put(OTHER, [1.5, "two"])
    os.utime(file(kept), (1, 1))
    os.utime(file(kept, OTHER), (2, 2))
    assert kept.get(KEY)  # used now
    size = file(kept).stat().st_size
    kept.trim(limit=size)
    assert kept.get(KEY)
    assert kept.get(OTHER) is None


def test_it_lies_in_the_users_own_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv(store.FOLDER, raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert store.by_default() == tmp_path / "textmech"
    monkeypatch.setenv(store.FOLDER, str(tmp_path / "mine"))
    assert store.by_default() == tmp_path / "mine"


def test_where_none_can_be_kept_there_is_none(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv(store.FOLDER, str(tmp_path / "file" / "cache"))
    assert store.usable() is None


def fifo(path: Path) -> None:
    os.mkfifo(path)


def led(to: str) -> Callable[[Path], None]:
    return lambda path: path.symlink_to(to)


@pytest.mark.parametrize(
    "make", [fifo, Path.mkdir, led("/dev/zero"), led("/proc/kmsg"), led("."), led("nowhere")]
)
def test_what_is_no_file_is_no_entry(make: Callable[[Path], None], kept: Store) -> None:
    """Nor is it waited for, and it is replaced by what is computed, or in nobody's way."""
    file(kept).unlink()
    make(file(kept))
    assert kept.get(KEY) is None
    with kept.alone(KEY, pytest.fail):
        kept.put(KEY, [1])
    kept.drop([KEY])
    kept.trim(limit=0)
    assert kept.get(KEY) is None


def test_an_endless_entry_is_not_read(kept: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store, "LIMIT", file(kept).stat().st_size - 1)
    assert kept.get(KEY) is None


@pytest.mark.mutant("an entry under another's key")
def test_an_entry_that_was_put_in_anothers_place_is_none(kept: Store) -> None:
    kept.put(OTHER, [2.5, "other"])
    file(kept).write_bytes(file(kept, OTHER).read_bytes())
    assert kept.get(KEY) is None
    assert kept.get(OTHER) == [2.5, "other"]


def test_a_folder_that_leads_elsewhere_is_no_shelf(kept: Store, tmp_path: Path) -> None:
    """Nothing is read from there, kept or deleted there, however full the store is."""
    elsewhere = tmp_path / "elsewhere"
    file(kept).parent.rename(elsewhere)
    (kept.folder / KEY[:2]).symlink_to(elsewhere)
    before = digest(elsewhere)
    kept.put(KEY, [2])
    assert kept.get(KEY) is None
    with kept.alone(KEY[:2] + "1" * 62, pytest.fail):
        kept.drop([KEY])
    kept.trim(limit=0)
    assert digest(elsewhere) == before


def test_of_what_else_lies_there_nothing_goes(kept: Store) -> None:
    """A store may have been put into a folder of somebody's, with folders of two letters."""
    for name in ("ab/notes.txt", "ab/" + "0" * 63, "de/thesis.tex", "ui/main.py", "c.txt"):
        (kept.folder / name).parent.mkdir(exist_ok=True)
        (kept.folder / name).write_text("theirs")
    kept.trim(limit=0)
    left = {str(path.relative_to(kept.folder)) for path in kept.folder.rglob("*.*")}
    assert left == {"ab/notes.txt", "de/thesis.tex", "ui/main.py", "c.txt"}
    assert (kept.folder / "ab" / ("0" * 63)).exists()
    assert not file(kept).exists()


@pytest.mark.mutant("a lock that cannot be had ends the run")
def test_a_lock_that_cannot_be_had_is_none(kept: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two users share a cache: the file is the other's."""
    opened = os.open

    def refusing(path: Any, *words: Any, **more: Any) -> int:
        if str(path) == str(file(kept, OTHER)):
            raise PermissionError(13, "Permission denied")
        return opened(path, *words, **more)

    monkeypatch.setattr(os, "open", refusing)
    with kept.alone(OTHER, pytest.fail):
        kept.put(KEY, [2])
    assert kept.get(KEY) == [2]


def test_an_entry_of_another_user_is_used(kept: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """That it was used now, only its owner can note."""

    def refused(*_: Any, **__: Any) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(os, "utime", refused)
    monkeypatch.setattr(os, "supports_fd", {refused})
    assert kept.get(KEY) == [1.5, "two"]


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


def test_it_is_the_same_from_every_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Workers have another current one."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(store.FOLDER, "mine")
    assert store.by_default() == tmp_path / "mine"
