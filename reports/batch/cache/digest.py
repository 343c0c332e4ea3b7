"""Files by what is in them: of a folder or a file one word, and what its code names.

Content decides, and no version, size or date. Reading a hundred megabytes takes half a second, so
what was read is remembered under what the disk says of every file: its size, both its times to the
nanosecond, and its number. The time of the last change of a file's node cannot be set by a program,
as its date can; it is believed once it is older than any clock of a disk is coarse. What could
still deceive it: a clock that was put back, to the nanosecond, or a disk that keeps no such time.
"""

import hashlib
import os
import re
import stat
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from .store import Store

SETTLED = 3.0  # s: file systems count in ticks of up to 2 s
COMPILED = "__pycache__"
TESTS = "tests"
CODE, LIBRARIES = (".py", ".pyi", ".pyx"), (".so", ".pyd", ".dll", ".dylib")
_IMPORT = re.compile(rb"(?:^|[;:])[ \t]*(?:import[ \t]+([\w., \t]+)|from[ \t]+(\w+))", re.MULTILINE)
_NAMED = re.compile(rb"(?:import_module|__import__)\s*\(\s*[\"'](\w+)")
_ENVIRON = re.compile(rb"(?:environb?[\w.]*\s*[\[(]|getenv\s*\()\s*b?[\"']([^\"'\n]+)[\"']")
_CAPITALS = re.compile(rb"[\"']([A-Z][A-Z0-9_]{2,60})[\"']")
_IN_LIBRARY = re.compile(rb"\0([A-Z][A-Z0-9_]{3,60})(?=\0)")
_FORMAT = "1"  # of what is remembered

Stat = tuple[str, int, int, int, int, int]
"""Of a file: its name in the folder, size, when written and when changed [ns], number, disk."""


def file_stat(name: str, found: os.stat_result) -> Stat:
    """The `Stat` of a file, one tuple: name, size, both times [ns], number and disk."""
    times = found.st_mtime_ns, found.st_ctime_ns
    return name, found.st_size, *times, found.st_ino, found.st_dev


@dataclass(frozen=True)
class Contents:
    """digest: of names and contents. imports: the modules that its code imports, by their first
    names. variables: what may be an environment's variable in it."""

    digest: str
    imports: tuple[str, ...]
    variables: tuple[str, ...]


@dataclass(frozen=True)
class Place:
    """A folder with all that is in it, or one file. code: whether what its code names is asked.

    tests: whether those of a library count, which no run loads.
    """

    path: Path
    code: bool = False
    tests: bool = True

    def stats(self) -> tuple[Stat, ...]:
        """The `Stat` of each of its files, sorted. Raises OSError."""
        return tuple(sorted(self._stats(str(self.path.resolve()), "")))

    def contents(self, stats: tuple[Stat, ...], memo: Store) -> Contents:
        """The digest of its contents, with the names in its code. Raises OSError."""
        if not _settled(stats):
            return self._read(stats)
        return _remembered(self, stats, memo)

    def _stats(self, path: str, name: str) -> Iterator[Stat]:
        found = os.stat(path)
        if stat.S_ISREG(found.st_mode):
            yield file_stat(name, found)
        elif stat.S_ISDIR(found.st_mode):
            for inner in os.scandir(path):
                if inner.name == COMPILED or (inner.name == TESTS and not self.tests):
                    continue
                if inner.is_symlink() and inner.is_dir():  # it may lead back
                    yield f"{name}/{inner.name} -> {os.readlink(inner.path)}", 0, 0, 0, 0, 0
                else:
                    yield from self._inner(inner, f"{name}/{inner.name}")

    def _inner(self, found: os.DirEntry[str], name: str) -> Iterator[Stat]:
        try:
            yield from self._stats(found.path, name)
        except FileNotFoundError:  # a link that leads nowhere
            yield f"{name} -> nowhere", 0, 0, 0, 0, 0

    def _read(self, stats: tuple[Stat, ...]) -> Contents:
        whole, imports, variables = hashlib.blake2b(digest_size=32), set[str](), set[str]()
        root = str(self.path.resolve())
        for name, *found in stats:
            data = b"" if not any(found) else Path(root + name).read_bytes()
            one = hashlib.blake2b(data, digest_size=32).digest()
            whole.update(f"{name}\0{len(data)}\0".encode(errors="surrogateescape") + one)
            if self.code:
                file = name or self.path.name
                imports |= _imports(data) if file.endswith(CODE) else set()
                variables |= _variables(file, data)
        return Contents(whole.hexdigest(), tuple(sorted(imports)), tuple(sorted(variables)))


@lru_cache(1000)
def _remembered(place: Place, stats: tuple[Stat, ...], memo: Store) -> Contents:
    words = "\0".join(map(repr, (_FORMAT, str(place.path), place.code, place.tests, *stats)))
    key = hashlib.sha256(f"digest\0{words}".encode()).hexdigest()
    kept: Mapping[str, str | tuple[str, ...]] | None = memo.get(key, _KEPT)
    if kept is not None and set(kept) == {"digest", "imports", "variables"}:
        return Contents(**kept)  # type: ignore[arg-type]
    read = place._read(stats)
    if place.stats() == stats:  # nothing was written meanwhile
        memo.put(key, vars(read))
    return read


_KEPT = Mapping[str, str | tuple[str, ...]]


def _settled(stats: tuple[Stat, ...]) -> bool:
    """Whether a later change would be seen: else the file is read every time."""
    return os.name != "nt" and max((s[3] for s in stats), default=0) < (time.time() - SETTLED) * 1e9


def _imports(code: bytes) -> set[str]:
    found = {name.decode() for name in _NAMED.findall(code)}
    for names, first in _IMPORT.findall(code):
        for name in names.split(b",") or ():
            if top := name.split(b" as ")[0].strip().partition(b".")[0]:
                found.add(top.decode(errors="replace"))
        found |= {first.decode()} if first else set()
    return found


def _variables(name: str, data: bytes) -> set[str]:
    if name.endswith(CODE):
        found = _ENVIRON.findall(data) + _CAPITALS.findall(data)
    elif name.endswith(LIBRARIES) or ".so." in name:
        found = _IN_LIBRARY.findall(data)
    else:
        return set()
    return {one.decode(errors="replace") for one in found}
