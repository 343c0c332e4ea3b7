"""A stored result is whole or not there, and there are never too many."""

import os
import sys
import tempfile
from pathlib import Path
from subprocess import PIPE, Popen

import pytest

from textmech.reports.cache import store
from textmech.reports.cache.store import Store

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


HELD = """\
import sys
from textmech.reports.cache.store import passing
with passing() as kept:
    print(kept.folder, flush=True)
    sys.stdin.read()
"""


def test_what_a_killed_run_left_goes_with_the_next(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(store, "NEW", -1.0)
    with Popen([sys.executable, "-c", HELD], stdin=PIPE, stdout=PIPE, text=True) as other:
        assert other.stdout
        folder = Path(other.stdout.readline().strip())
        with store.passing() as kept:
            assert folder.is_dir()  # held by a run
        assert not kept.folder.exists()
        other.kill()
        other.wait()
    assert folder.is_dir()
    with store.passing() as kept:
        assert not folder.exists()
        assert kept.folder.is_dir()
