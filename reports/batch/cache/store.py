"""Where results lie: one file each, whole or not there, and the least used go first."""

import errno
import os
import re
import stat
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from platformdirs import user_cache_path

from ...data.file_content import content
from ...system import temporary_folder as folder
from ...system.lock import locked
from .fits import fits
from .form import packed, unpacked

LIMIT = 500_000_000  # bytes, some ten full runs with different code
FOLDER = "TEXTMECH_CACHE"  # the variable that names another folder
MAKING = ".making-"
PASSING = "textmech-run-"
DIGEST = sha256().digest_size
_OURS = re.compile(r"[0-9a-f]{64}|\.making-[a-z0-9_]{8}")
_SHELF = re.compile(r"[0-9a-f]{2}")


def by_default() -> Path:
    """The user's own: never the project's. The same from wherever a process looks.

    Raises RuntimeError where the user has no home.
    """
    if named := os.environ.get(FOLDER):
        return Path(named).absolute()
    place = user_cache_path("textmech", appauthor=False)
    if not place.is_absolute():
        raise RuntimeError("no home")
    return place


def usable() -> "Store | None":
    """The user's store, or None where it cannot be written to."""
    with suppress(OSError, RuntimeError):  # no home
        place = by_default()
        place.mkdir(parents=True, exist_ok=True, mode=0o700)
        if os.access(place, os.W_OK):
            return Store(place)
    return None


@contextmanager
def passing() -> Iterator["Store"]:
    """A store for one run, of which nothing stays; what killed runs left behind goes too."""
    with folder.passing(PASSING) as made:
        yield Store(made)


@dataclass(frozen=True)
class Store:
    """A folder of results by their keys. It may be shared by any number of processes."""

    folder: Path

    def get(self, key: str, kind: Any = Any) -> Any | None:
        """The result, or None where there is none, or none that is whole and what was asked for.

        kind: what it has to be, as an annotation says it.
        """
        try:
            self._shelf(key)
            data = content(self._path(key), LIMIT, links=False, touched=True)
            if _digest(key, data[DIGEST:]) != data[:DIGEST]:
                return None
            found = unpacked(data[DIGEST:])
            return found if fits(found, kind) else None
        except Exception:  # of bytes that anyone may have written: computed again, it is right
            return None

    def put(self, key: str, value: Any) -> None:
        """Keeps it, if the disk takes it: who keeps nothing computes again."""
        path = self._path(key)
        with suppress(OSError, TypeError):  # of a value that has no form
            data = packed(value)
            self._shelf(key, made=True)
            handle, made = tempfile.mkstemp(prefix=MAKING, dir=path.parent)
            try:
                with os.fdopen(handle, "wb") as file:
                    file.write(_digest(key, data) + data)
                os.replace(made, path)
            except BaseException:
                Path(made).unlink(missing_ok=True)
                raise

    def drop(self, keys: Iterable[str]) -> None:
        """Forgets what is in other results by now."""
        for key in keys:
            with suppress(OSError):
                self._shelf(key)
                self._path(key).unlink()

    @contextmanager
    def alone(self, key: str, waiting: Callable[[], None]) -> Iterator[None]:
        """Waits for another process that computes the same, and then finds its results."""
        path = None
        with suppress(OSError):
            path = self._shelf(key, made=True) / key
        with locked(path, waiting) if path else nullcontext():
            yield

    def trim(self, limit: int = LIMIT) -> None:
        """Deletes the least recently used beyond the limit [bytes], and what was never finished."""
        found: list[tuple[float, int, Path]] = []
        with suppress(OSError):  # another process trims too
            for shelf in list(os.scandir(self.folder)):
                if _SHELF.fullmatch(shelf.name) and shelf.is_dir(follow_symlinks=False):
                    found += _files(shelf.path)
        total = 0
        for _, size, path in sorted(found, reverse=True):
            total += size
            if total > limit:
                with suppress(OSError):
                    path.unlink()

    def _shelf(self, key: str, *, made: bool = False) -> Path:
        """The entry's folder, which is one. Raises OSError: behind a link lies another's.

        made: where there is none.
        """
        shelf = self._path(key).parent
        if made:
            shelf.mkdir(parents=True, exist_ok=True, mode=0o700)
        if not stat.S_ISDIR(shelf.lstat().st_mode):
            raise NotADirectoryError(errno.ENOTDIR, "is no folder", str(shelf))
        return shelf

    def _path(self, key: str) -> Path:
        return self.folder / key[:2] / key


def _digest(key: str, data: bytes) -> bytes:
    """The digest of key and data: what was computed for one key is never taken for another's."""
    return sha256(key.encode() + b"\0" + data).digest()


def _files(shelf: str) -> Iterator[tuple[float, int, Path]]:
    """(when used, size, path) of what we wrote there, and of nothing else that may lie there."""
    with suppress(OSError):
        for file in list(os.scandir(shelf)):
            if _OURS.fullmatch(file.name) and file.is_file(follow_symlinks=False):
                found = file.stat(follow_symlinks=False)
                yield found.st_mtime, found.st_size, Path(file.path)
