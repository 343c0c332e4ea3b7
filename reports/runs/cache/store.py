"""Where results lie: a pickle each in the user's own folder, whole or not there."""

import os
import pickle
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

from ...tables.lock import locked
from ..processes.temporary_folder import temporary_folder

LIMIT = 500_000_000  # bytes, some ten full runs with different code
FOLDER = "TEXTMECH_CACHE"  # the variable that names another folder
RESULTS = "results"  # the folder's own part: nobody else may read or write it
MAKING = ".making-"
DIGEST = sha256().digest_size
_OURS = re.compile(r"[0-9a-f]{64}|\.making-[a-z0-9_]{8}")


def by_default() -> Path:
    """Returns the user's own folder, never the project's: the same for every process.

    Raises RuntimeError where the user has no home.
    """
    if named := os.environ.get(FOLDER):
        return Path(named).absolute()
    place = user_cache_path("textmech", appauthor=False)
    if not place.is_absolute():
        raise RuntimeError("no home")
    return place


def usable() -> "Store | None":
    """The user's store, or None where it cannot be written to, or others can write to it."""
    with suppress(OSError, RuntimeError):  # no home
        place = by_default() / RESULTS
        place.mkdir(parents=True, exist_ok=True, mode=0o700)
        if os.access(place, os.W_OK) and _is_private(place):
            return Store(place)
    return None


def _is_private(place: Path) -> bool:
    """Whether the folder is the user's alone: a pickle runs whatever code its writer wants."""
    status = place.lstat()
    if not hasattr(os, "geteuid"):
        return stat.S_ISDIR(status.st_mode)
    shared = stat.S_IMODE(status.st_mode) & 0o077
    return stat.S_ISDIR(status.st_mode) and status.st_uid == os.geteuid() and not shared


@contextmanager
def temporary_store() -> Iterator["Store"]:
    """A store for one run, which goes with it."""
    with temporary_folder("textmech-run-") as made:
        yield Store(made)


@dataclass(frozen=True)
class Store:
    """A folder of results by their keys. It may be shared by any number of processes."""

    folder: Path

    def get(self, key: str) -> Any | None:
        """The result, or None where there is none, or none that is whole."""
        path = self.folder / key
        try:
            data = path.read_bytes()
            if _digest(key, data[DIGEST:]) != data[:DIGEST]:
                return None
            os.utime(path)  # what is used stays longest
            return pickle.loads(data[DIGEST:])
        except Exception:  # it is computed again
            return None

    def put(self, key: str, value: Any) -> None:
        """Stores a result, if the disk takes it; else it is computed again."""
        with suppress(OSError):
            data = pickle.dumps(value)
            self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            handle, made = tempfile.mkstemp(prefix=MAKING, dir=self.folder)
            try:
                with os.fdopen(handle, "wb") as file:
                    file.write(_digest(key, data) + data)
                os.replace(made, self.folder / key)
            except BaseException:
                Path(made).unlink(missing_ok=True)
                raise

    def drop(self, keys: Iterable[str]) -> None:
        """Deletes results that others contain by now."""
        for key in keys:
            with suppress(OSError):
                (self.folder / key).unlink()

    @contextmanager
    def alone(self, key: str, waiting: Callable[[], None]) -> Iterator[None]:
        """Waits for another process that computes the same, whose results are then found."""
        path = None
        with suppress(OSError):
            self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            path = self.folder / key
        with locked(path, waiting) if path else nullcontext():
            yield

    def trim(self, limit: int = LIMIT) -> None:
        """Deletes the least recently used beyond the limit [bytes], and what was never finished."""
        entries: list[tuple[float, int, str]] = []
        with suppress(OSError):  # another process trims too
            for file in os.scandir(self.folder):
                if _OURS.fullmatch(file.name) and file.is_file(follow_symlinks=False):
                    status = file.stat(follow_symlinks=False)
                    entries.append((status.st_mtime, status.st_size, file.path))
        total = 0
        for _, size, path in sorted(entries, reverse=True):
            total += size
            if total > limit:
                with suppress(OSError):
                    os.unlink(path)


def _digest(key: str, data: bytes) -> bytes:
    """The digest of key and data: what was computed for one key is never taken for another's."""
    return sha256(key.encode() + b"\0" + data).digest()
