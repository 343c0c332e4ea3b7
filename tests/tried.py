"""One planted mistake is tried in a copy of the tree: which test sees it, if any does.

The tests are those of the broken file's own room, the nearest first: who imports it or is named
after it, then who speaks of it, then the folder that mirrors its own, then the others of that one
of the four folders. Those marked `slow` are left out. That a test fails is believed where it does
so twice, and passes in a copy without the mistake.
"""

import contextlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from threading import Lock

import executed
import limited
import touched
from drawn import Mistake

SEEN, TIMED_OUT, SURVIVED, UNDECIDED = "seen", "timeout", "survived", "undecided"
WORK = 90.0  # CPU s for the tests of one mistake
EACH = 30.0  # CPU s of one test: it takes 1.5 s where it is sound
WALL = 1800.0  # s: who waits without working for so long waits for ever
STARTS = 60  # CPU s to import and to collect
ENGINES = [f"--textmech-engine={name}" for name in executed.ENGINES]  # of cases
NAME = "textmech"  # of the folder of a copy: as the package is called, so that it is imported


@dataclass(frozen=True)
class Outcome:
    """What became of a mistake. by: the test that saw it. run: how many tests ran."""

    said: str
    by: str
    run: int


@dataclass(frozen=True)
class Told:
    """How one session of pytest ended. test: the one that failed, or was under way."""

    code: int
    test: str
    run: int
    work: float
    stopped: bool


@dataclass
class Copy:
    """A folder with all that git knows of the tree, as it is now."""

    place: Path
    lock: Lock = field(default_factory=Lock)

    @property
    def root(self) -> Path:
        """Where the four folders are."""
        return self.place / NAME

    def fill(self, root: Path) -> "Copy":
        """Copies the tree there."""
        words = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        names = subprocess.run(words, cwd=root, capture_output=True, check=True).stdout
        for name in filter(None, names.decode().split("\0")):
            if (root / name).is_file():
                (self.root / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(root / name, self.root / name)
        return self

    def write(self, file: str, text: str, at: int) -> None:
        """With a time of its own, by which Python tells that what it has compiled is another's."""
        (self.root / file).write_text(text, encoding="utf-8")
        os.utime(self.root / file, (at, at))

    def run(self, words: Sequence[str], left: float = WORK) -> Told:
        """Pytest with these words, in its own group of processes."""
        told, cache_ = self.place / "told.json", self.place / "cache"
        told.unlink(missing_ok=True)
        shutil.rmtree(cache_, ignore_errors=True)
        beside = {
            "PYTHONPATH": f"{self.place}{os.pathsep}{self.root / 'tests'}",
            "TEXTMECH_CACHE": str(cache_), "OMP_NUM_THREADS": "1", limited.TOLD: str(told),
            limited.WORK: str(left), limited.EACH: str(EACH),
        }  # fmt: skip
        command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider"]
        child = subprocess.Popen(
            [*command, "-p", "limited", *ENGINES, *words],
            cwd=self.root, env={**os.environ, **beside}, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, start_new_session=True, preexec_fn=_bounded,
        )  # fmt: skip
        try:
            code = child.wait(WALL)
        except subprocess.TimeoutExpired:
            code = -signal.SIGXCPU
        finally:
            _end(child)
        return _told(told, code)


def _bounded() -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (STARTS, resource.getrlimit(resource.RLIMIT_CPU)[1]))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _end(child: subprocess.Popen[bytes]) -> None:
    """Whatever it has started, too."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child.pid, signal.SIGKILL)
    child.wait()


def _told(file: Path, code: int) -> Told:
    if not file.is_file():
        return Told(code, "no test starts", 0, 0.0, False)
    said = json.loads(file.read_text(encoding="utf-8"))
    test = said["failed"] or (said["at"] if code < 0 else "")
    return Told(code, test, said["run"], said["work"], said["stopped"])


def stages(file: str, root: Path) -> list[list[str]]:
    """The tests of a file's room, the nearest first, each once."""
    path = Path(file)
    every = sorted((root / "tests" / path.parts[0]).rglob("test_*.py"))
    mirrors = {root / test for test in touched.mirror(path)}
    found: dict[int, list[str]] = {}
    for test in sorted(every, key=lambda test: test not in mirrors):
        found.setdefault(_far(path, test, mirrors), []).append(str(test.relative_to(root)))
    return [found[far] for far in sorted(found)]


def quick_stages(file: str, root: Path) -> list[list[str]]:
    """What `make quick` asks of a file: the tests of its folder, of those above, and some cases."""
    path = Path(file)
    folders: dict[Path, list[str]] = {}
    for test in touched.mirror(path):
        folders.setdefault(test.parent, []).append(str(test))
    asked = [*folders.values(), touched.cases([path])]
    return [names for names in asked if names]


def _far(file: Path, test: Path, mirrors: set[Path]) -> int:
    """How unlikely it is that the test sees a mistake in the file, from 0."""
    text, module = _text(test), ".".join(file.with_suffix("").parts).removesuffix(".__init__")
    inner, _, name = module.rpartition(".")
    imports = re.search(rf"textmech\.{module}\b|from textmech\.{inner} import .*\b{name}\b", text)
    if imports or file.stem in (*test.parent.parts, test.stem.removeprefix("test_")):
        return 0
    if re.search(rf"\b{file.stem}\b", text):
        return 1
    return 2 if test in mirrors else 3


@cache
def _text(test: Path) -> str:
    return test.read_text(encoding="utf-8")


@dataclass
class Sound:
    """A copy without a mistake, and what is known to pass in it."""

    copy: Copy
    known: dict[str, bool] = field(default_factory=dict)

    def passes(self, test: str) -> bool:
        """Asked once of each test; of a file whether it can be collected."""
        with self.copy.lock:
            if test not in self.known:
                self.known[test] = self.copy.run(_alone(test)).code == 0
            return self.known[test]


def _alone(test: str) -> list[str]:
    return [test] if "::" in test else ["--collect-only", *([test] if test.endswith(".py") else [])]


def tried(mistake: Mistake, copy: Copy, sound: Sound, *, quick: bool = False) -> Outcome:
    """Plants it, asks the tests, and takes it out again. quick: only what `make quick` asks."""
    was = (copy.root / mistake.file).read_text(encoding="utf-8")
    copy.write(mistake.file, mistake.source, 10**9 + 2 * mistake.number)
    try:
        return _asked(copy, sound, (quick_stages if quick else stages)(mistake.file, copy.root))
    finally:
        copy.write(mistake.file, was, 10**9)


def _asked(copy: Copy, sound: Sound, waiting: list[list[str]]) -> Outcome:
    left, run, doubted = WORK, 0, list[str]()
    while waiting:
        without = [f"--deselect={test}" for test in doubted]
        told = copy.run(["-m", "not slow", *without, *waiting[0]], left)
        run, left = run + told.run, left - told.work
        if told.code not in (0, 5) and not told.stopped:
            if told.code == -signal.SIGXCPU:
                return Outcome(TIMED_OUT, told.test, run)
            if sound.passes(told.test) and copy.run(_alone(told.test)).code != 0:
                return Outcome(SEEN, told.test, run)
            if told.test in doubted:  # its set-up fails without it: nothing that can be told apart
                return Outcome(UNDECIDED, "", run)
            doubted.append(told.test)
        elif told.stopped or left <= 0:
            return Outcome(UNDECIDED, "", run)
        else:
            waiting.pop(0)
    return Outcome(SURVIVED, "", run)
