"""Where results lie: one file each, whole or not there, and the least used go first."""

import os
import shutil
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..lock import abandoned, locked
from .form import packed, unpacked

LIMIT = 500_000_000  # bytes, some ten full runs with different code
FOLDER = "TEXTMECH_CACHE"  # the variable that names another folder
MAKING = ".making-"
PASSING = "textmech-run-"
NEW = 60.0  # s: a folder may be made, and not yet held
DIGEST = sha256().digest_size


def by_default() -> Path:
    """The user's own: never the project's."""
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(os.environ.get(FOLDER) or Path(base) / "textmech")


def usable() -> "Store | None":
    """The user's store, or None where it cannot be written to."""
    with suppress(OSError, RuntimeError):  # no home
        folder = by_default()
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        if os.access(folder, os.W_OK):
            return Store(folder)
    return None


@contextmanager
def passing() -> Iterator["Store"]:
    """A store for one run, of which nothing stays; what killed runs left behind goes too."""
    _sweep(Path(tempfile.gettempdir()))
    with tempfile.TemporaryDirectory(prefix=PASSING) as made:
        folder = Path(made)
        with locked(folder):
            yield Store(folder)


def _sweep(among: Path) -> None:
    for folder in among.glob(f"{PASSING}*"):
        with suppress(OSError):  # another's, or gone
            old = time.time() - folder.stat().st_mtime > NEW
            if old and abandoned(folder):
                shutil.rmtree(folder, ignore_errors=True)


@dataclass(frozen=True)
class Store:
    """A folder of results by their keys. It may be shared by any number of processes."""

    folder: Path

    def get(self, key: str) -> Any | None:
        """The result, or None where there is none, or none that is whole."""
        path = self._path(key)
        try:
            data = path.read_bytes()
            if sha256(data[DIGEST:]).digest() != data[:DIGEST]:
                raise ValueError("cut or changed")
            os.utime(path)  # used now
            return unpacked(data[DIGEST:])
        except (OSError, ValueError, KeyError, TypeError):
            return None

    def put(self, key: str, value: Any) -> None:
        """Keeps it, if the disk takes it: who keeps nothing computes again."""
        path = self._path(key)
        with suppress(OSError, TypeError):  # of a value that has no form
            data = packed(value)
            path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            handle, made = tempfile.mkstemp(prefix=MAKING, dir=path.parent)
            try:
                with os.fdopen(handle, "wb") as file:
                    file.write(sha256(data).digest() + data)
                os.replace(made, path)
            except BaseException:
                Path(made).unlink(missing_ok=True)
                raise

    def drop(self, keys: Iterable[str]) -> None:
        """Forgets what is in other results by now."""
        for key in keys:
            with suppress(OSError):
                self._path(key).unlink()

    @contextmanager
    def alone(self, key: str, waiting: Callable[[], None]) -> Iterator[None]:
        """Waits for another process that computes the same, and then finds its results."""
        path = self._path(key)
        with suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        with locked(path, waiting) if path.parent.is_dir() else nullcontext():
            yield

    def trim(self, limit: int = LIMIT) -> None:
        """Deletes the least recently used beyond the limit [bytes], and what was never finished."""
        found: list[tuple[float, int, Path]] = []
        for path in self.folder.glob("??/*"):
            with suppress(OSError):  # another process trims too
                stat = path.stat()
                found.append((stat.st_mtime, stat.st_size, path))
        total = 0
        for _, size, path in sorted(found, reverse=True):
            total += size
            if total > limit:
                with suppress(OSError):
                    path.unlink()

    def _path(self, key: str) -> Path:
        return self.folder / key[:2] / key
