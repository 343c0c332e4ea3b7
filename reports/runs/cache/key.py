"""Makes the keys of stored results: of the case, our sources, the engine's files, the machine.

Our own sources count by their contents. The files of engines, numpy and scipy count by their
names, sizes and times: one that was built anew under the same version is another one.
"""

import os
import pickle
import platform
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, fields
from functools import cache
from hashlib import sha256
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np
import scipy

from .... import engines
from ....cases.case import Case
from ....engines.engine import Engine
from ... import BEGUN
from ...tables import pins
from .store import Store

ROOT = Path(__file__).parents[3]
OURS, LIBRARIES = "textmech", ("numpy", "scipy")
ROOMS = ("cases", "reference", "engines", "reports")
REFERENCE = ("cases", "reference")
UNTOLD = ("source", "given", "file", "path")
"""Fields of a model's case that change no number: the model itself is in the digest."""
JUDGING = (
    "engines/*.py", "reports/compare/trial", "reports/compare/judge", "reports/compare/events",
    "reports/tables/row.py", "reports/tables/pins.py", "reports/runs/tasks.py",
)  # fmt: skip
SEARCHING = ("reports/search/causes", *JUDGING)  # what a search runs, and its door
TRYING = ("reports/search/causes/candidate.py", "reports/search/causes/errors.py")
COLLECTING = ("reports/front/collecting.py",)
ROUNDING = ("NPY_", "OPENBLAS_", "OMP_", "MKL_", "BLIS_", "GLIBC_TUNABLES", "LD_", "DYLD_")
"""Variables that choose other kernels, or other libraries."""
_REQUIRED = re.compile(r"[\w.-]+")

Places = tuple[Path, ...]


@dataclass(frozen=True)
class Keys:
    """The keys of results of the code as it was when the run began.

    salt: a word that nobody else has, where code is newer than the process, which has loaded other.
    libraries: the state of those that compute; None where no result outlives the run.
    """

    salt: str = ""
    libraries: str | None = None
    _states: dict[Places, "State"] = field(default_factory=dict, compare=False)
    _words: dict[int, tuple[object, str]] = field(default_factory=dict, compare=False)
    _sources: dict[tuple[str, ...], str] = field(default_factory=dict, compare=False)

    @staticmethod
    def now(store: Store | None) -> "Keys":
        """store: where results last, or None where they go with the run."""
        ours = tuple(path for room in ROOMS for path in sources(room))
        state = State.of(ours)
        salt = uuid4().hex if state.newest > BEGUN else ""
        return Keys(salt, libraries() if store else None, {ours: state})

    def hold(self) -> bool:
        """Whether our sources and the engines are what they were: else results are of a mixture."""
        with suppress(OSError):
            return all(State.of(places) == state for places, state in self._states.items())
        return False

    def solution(self, case: Case) -> str:
        """The key of a case's reference."""
        of = self._case(case), self._code(REFERENCE)
        return _word("solution", self.salt, *of, machine(), self.libraries or "")

    def ways(self, case: Case, engine: Engine) -> str:
        """The key of the ways in which an engine would run the case."""
        return _word("ways", self.solution(case), self._engine(engine), self._code(JUDGING))

    def collected(self, case: Case, engine: Engine) -> str:
        """The key of which ways pytest collects."""
        return _word("collected", self.ways(case, engine), self._code(COLLECTING))

    def outcome(self, ways: str, realised: str) -> str:
        """The key of what the engine gave in one of the ways under the key `ways`."""
        return _word("outcome", ways, realised)

    def rung(self, outcome: str, ladder: str, step: float) -> str:
        """The key of one run behind the outcome with the key `outcome`."""
        return _word("rung", outcome, ladder, repr(step))

    def tried(self, case: Case, engine: Engine, options: str, step: float) -> str:
        """The key of one simulation with other options of the engine."""
        ways = self.ways(case, engine)
        return _word("tried", ways, options, repr(step), self._code(TRYING))

    def search(self, case: Case, engine: Engine) -> str:
        """The key of a search for what cures the engine's rows: the same on every machine.

        Without the reference's code, which the rows' own errors tell of. Empty where it cannot be
        said: of somebody else's engine, or of code that is newer than the process.
        """
        adapter = own_adapter(engine)
        if self.salt or not adapter:
            return ""
        code = self._code((*SEARCHING, adapter))
        return _word("search", engine.version, repr(engine), self._case(case), code)

    def model(self, task: Any, digest: str) -> str:
        """The key of what is asked of a user's model; digest: of all its numbers."""
        case, code = task.case, self._code(ROOMS)
        values = [getattr(case, f.name) for f in fields(case) if f.name not in UNTOLD]
        asked = [type(task), *(getattr(task, f.name) for f in fields(task) if f.name != "case")]
        words = repr(values), repr(asked), digest
        return _word("model", self.salt, *words, code, machine(), self.libraries or "")

    def run(self, pairs: Iterable[tuple[Case, Engine]]) -> str:
        """The key of all pairs together: two runs with this key compute the same."""
        return _word("run", *(self.ways(case, engine) for case, engine in pairs))

    def _case(self, case: Case) -> str:
        """Returns all of a case but its text: a comment changes nothing."""
        if id(case) not in self._words:  # each meets every engine
            values = [getattr(case, f.name) for f in fields(case) if f.name != "source"]
            self._words[id(case)] = case, repr(values)  # kept, so that its id stays its own
        return self._words[id(case)][1]

    def _engine(self, engine: Engine) -> str:
        """An engine's settings, version and files, and the version that the reports are of.

        A word of its own for an engine that cannot be pickled, has no files, or is newer than the
        process.
        """
        if id(engine) not in self._words:
            try:
                word = self._described(engine)
            except Exception:  # of somebody else's engine
                word = uuid4().hex
            self._words[id(engine)] = engine, word
        return self._words[id(engine)][1]

    def _described(self, engine: Engine) -> str:
        adapter = own_adapter(engine)
        options = repr(engine) if adapter else pickle.dumps(engine).hex()
        word = _word(options, engine.version, pins.version(engine.name) or "")
        code = self._code((adapter,)) if adapter else ""
        if self.libraries is None:
            return _word(word, code)
        places = tuple(sorted(places_of(engine)))
        if places not in self._states:
            self._states[places] = State.of(places)
        state = self._states[places]
        return _word(word, code, state.digest, uuid4().hex if state.newest > BEGUN else "")

    def _code(self, places: tuple[str, ...]) -> str:
        """The digest of our sources at these places, by their contents."""
        if places not in self._sources:
            paths = [path for place in places for path in sources(place)]
            words = (f"{path.name} {sha256(path.read_bytes()).hexdigest()}" for path in paths)
            self._sources[places] = _word(*words)
        return self._sources[places]


def _word(*parts: str) -> str:
    return sha256("\0".join(parts).encode()).hexdigest()


def sources(place: str) -> list[Path]:
    """Our modules in a folder, or by the pattern of a file's name, sorted."""
    path = ROOT / place
    return sorted(path.rglob("*.py") if path.is_dir() else path.parent.glob(path.name))


@dataclass(frozen=True)
class State:
    """A digest of files by name, size and time, and when the newest was changed [s]."""

    digest: str
    newest: float

    @staticmethod
    def of(places: Iterable[Path]) -> "State":
        """The state of all files in folders, and of single files. Raises OSError."""
        words, newest = list[str](), 0
        for place in places:
            for name, file in sorted(_files(str(place))):
                words.append(f"{name} {file.st_size} {file.st_mtime_ns}")
                newest = max(newest, file.st_mtime_ns, file.st_ctime_ns)
        return State(_word(*words), newest / 1e9)


def _files(place: str) -> Iterator[tuple[str, os.stat_result]]:
    if os.path.isfile(place):
        yield os.path.basename(place), os.stat(place)
    for folder, folders, names in os.walk(place):
        folders[:] = [name for name in folders if name != "__pycache__"]
        for name in names:
            path = os.path.join(folder, name)
            with suppress(FileNotFoundError):  # a link that leads nowhere
                yield path, os.stat(path)


def libraries() -> str:
    """The state of those that compute; a word of its own where they are newer than the process."""
    places = [place for name in LIBRARIES for place in _places(distribution(name))]
    state = State.of(sorted({*places}))
    return uuid4().hex if state.newest > BEGUN else state.digest


def own_adapter(engine: Engine) -> str:
    """The folder of ours that the engine's code lies in; empty for somebody else's."""
    names = type(engine).__module__.split(".")
    return "/".join(names[1:3]) if names[0] == OURS else ""


def places_of(engine: Engine) -> set[Path]:
    """The files and folders of an engine: of its distribution, and of what a plug-in requires.

    Raises ValueError where its code lies in no file.
    """
    if own_adapter(engine):
        with suppress(PackageNotFoundError):  # the book is none
            return {*_places(distribution(engine.name))}
        return set()
    places = {*_located(type(engine).__module__.partition(".")[0])}
    if not places:
        raise ValueError(f"{type(engine).__module__} is in no file")
    provided = engines.distribution(engine.name)
    if provided is not None and provided.name != OURS:
        for each in _with_required(provided):
            places |= {*_places(each)}
    return places


def _with_required(first: Distribution) -> list[Distribution]:
    """A distribution, and the installed ones that it requires, and these in turn."""
    distributions, names = [first], {first.name, OURS, *LIBRARIES}
    for each in distributions:  # grows meanwhile
        for requirement in each.requires or ():
            match = _REQUIRED.match(requirement)
            if match and "extra ==" not in requirement and match[0] not in names:
                names.add(match[0])
                with suppress(PackageNotFoundError):
                    distributions.append(distribution(match[0]))
    return distributions


def _places(installed: Distribution) -> Iterator[Path]:
    """Where a distribution's modules are loaded from, and the libraries linked beside them."""
    record = (installed.read_text("RECORD") or "").splitlines()
    tops = {line.partition(",")[0].partition("/")[0] for line in record}
    for top in sorted(tops | {*(installed.read_text("top_level.txt") or "").split()}):
        if top.endswith(".libs"):
            yield Path(str(installed.locate_file(top)))
        elif not top.endswith("-info"):
            yield from _located(top.partition(".")[0])


def _located(name: str) -> list[Path]:
    """The folders and the file of a module, as it was loaded, else as Python would find it."""
    spec = None
    with suppress(ImportError, ValueError):
        spec = find_spec(name) if name.isidentifier() else None
    if spec is None:
        return []
    folders = [Path(folder) for folder in spec.submodule_search_locations or ()]
    file = Path(spec.origin) if spec.origin and os.path.isfile(spec.origin) else None
    return [*folders, file] if file and file.parent not in folders else folders


@cache
def machine() -> str:
    """Describes what decides the last digits: interpreter, libraries, the processor's vector units.

    Not how many cores it has: nothing here multiplies matrices so large that a library would share
    them out, and rows of one and of many were always the same.
    """
    built = np.show_config(mode="dicts") or {}
    variables = {k: v for k, v in os.environ.items() if k.startswith(ROUNDING)}
    return repr(
        (
            sys.version,
            sys.flags.optimize,  # without assertions code is other code
            platform.system(),
            platform.machine(),
            platform.libc_ver(),
            np.__version__,
            scipy.__version__,
            built.get("SIMD Extensions", {}),
            _processor(),
            sorted(variables.items()),
        )
    )


def _processor() -> str:
    """Returns the processor's model and features, where the system tells them."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return platform.processor()
    wanted = ("model name", "flags", "Features", "CPU part")
    first = text.partition("\n\n")[0].splitlines()
    return "\n".join(line for line in first if line.startswith(wanted))
