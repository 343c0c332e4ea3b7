"""Makes one word of what a result depends on: case, code, engine, and the machine's rounding."""

import os
import platform
import sys
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, fields, is_dataclass
from functools import cache, partial
from hashlib import sha256
from pathlib import Path
from types import FunctionType
from typing import Any
from uuid import uuid4

import numpy as np
import scipy

from ....cases.case import Case
from ....engines.engine import Engine
from ... import BEGUN
from ...data import pins
from .digest import Place, Stat, file_stat
from .parts import BASIS, Parts, home_of, located
from .store import Store

ROOT = Path(__file__).parents[3]
REFERENCE = ("cases", "reference", "reports/batch/cache/form.py")
ROWS = tuple(
    f"reports/{name}.py"
    for name in ("data/row", "data/pins", "batch/tasks", "system/limit", "system/table_text")
)
_COMPARING = tuple(f"reports/compare/{room}" for room in ("trial", "judge", "events"))
JUDGING = ("engines/*.py", *_COMPARING, *ROWS)
SEARCHING = ("reports/batch/search", *JUDGING)  # no file of it that a search of causes does not run
TRYING = ("reports/batch/search/candidate.py", "reports/batch/search/errors.py")
COLLECTING = ("reports/collecting.py",)
ROUNDING = ("NPY_", "OPENBLAS_", "OMP_", "MKL_", "BLIS_", "GLIBC_TUNABLES", "LD_", "DYLD_")
"""Variables that choose other kernels, or other libraries."""


@dataclass(frozen=True)
class Keys:
    """The keys of results of the code as it was when the run began."""

    files: tuple[tuple[Path, Stat], ...]  # each file of code, and what the disk says of it
    salt: str  # of code that is newer than the process: nobody else has this word
    memo: Store | None = None  # of digests; None: no result outlives the run, nor needs them
    libraries: str = ""  # what is in those that compute
    _described: dict[int, tuple[object, str]] = field(default_factory=dict, compare=False)
    _parts: dict[tuple[type, str], Parts] = field(default_factory=dict, compare=False)
    _read: dict[tuple[str, ...], str] = field(default_factory=dict, compare=False)

    @staticmethod
    def now(memo: Store | None) -> "Keys":
        """memo: where results last, or None where they go with the run."""
        files = tuple(_seen())
        newer = any(max(stat[2], stat[3]) > BEGUN * 1e9 for _, stat in files)
        return Keys(files, uuid4().hex if newer else "", memo, basis(memo) if memo else "")

    def hold(self) -> bool:
        """Whether the code is still what it was: else a result may be of a mixture.

        Asked for every result. A new file alone changes none: something known must import it.
        """
        seen = all(_is(*file) for file in self.files)
        return seen and all(parts.hold() for parts in self._parts.values())

    def solution(self, case: Case) -> str:
        """The key of a case's reference."""
        of = self._once(case, _case), self._code(REFERENCE)
        return _word("solution", self.salt, *of, machine(), self.libraries)

    def ways(self, case: Case, engine: Engine) -> str:
        """The key of the ways in which an engine would run the case."""
        of = self._once(engine, self._engine)
        return _word("ways", self.solution(case), of, self._code(JUDGING))

    def collected(self, case: Case, engine: Engine) -> str:
        """The key of which ways pytest collects."""
        return _word("collected", self.ways(case, engine), self._code(COLLECTING))

    def _once(self, thing: Any, describe: Callable[[Any], str]) -> str:
        """A case meets every engine, and an engine every case: each is described once in a run."""
        if id(thing) not in self._described:
            self._described[id(thing)] = (
                thing,
                describe(thing),
            )  # kept, so that its id stays its own
        return self._described[id(thing)][1]

    def _engine(self, engine: Engine) -> str:
        """Its settings, its version, all files of it and its adapter, and what judges its version.

        A word of its own for what cannot be told from another of its kind, or is newer than the
        process, which may have loaded what was there before.
        """
        try:
            word = _word(described(engine), engine.version, pins.version(engine.name) or "")
            if self.memo is None:
                return word
            kind = type(engine), engine.name
            if kind not in self._parts:
                self._parts[kind] = Parts.of(engine, self.memo)
            parts = self._parts[kind]
            return _word(word, parts.word(), uuid4().hex if parts.newer(BEGUN) else "")
        except (TypeError, OSError):
            return uuid4().hex

    def _code(self, places: tuple[str, ...]) -> str:
        """One word for the code of these places: read once in a run."""
        if places not in self._read:
            paths = [path for place in places for path in _modules(ROOT / place)]
            told = (f"{path.name} {sha256(path.read_bytes()).hexdigest()}" for path in paths)
            self._read[places] = _word(*told)
        return self._read[places]

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

        Without the reference's code, which the rows' own errors tell of. Nothing where that cannot
        be said: of an engine that cannot be described, or of code that is newer than the process.
        """
        if self.salt:
            return ""
        try:
            adapter = home_of(type(engine)).relative_to(ROOT)
            of = described(engine), self._once(case, _case)
        except (TypeError, ValueError):  # somebody else's
            return ""
        return _word("search", engine.version, *of, self._code((*SEARCHING, str(adapter))))

    def run(self, pairs: Iterable[tuple[Case, Engine]]) -> str:
        """The key of all pairs together: two runs with this key compute the same."""
        return _word("run", *(self.ways(case, engine) for case, engine in pairs))


def _word(*parts: str) -> str:
    return sha256("\0".join(parts).encode()).hexdigest()


def _case(case: Case) -> str:
    """Describes the case by all but its text: a comment changes nothing."""
    return described({f.name: getattr(case, f.name) for f in fields(case) if f.name != "source"})


def described(value: Any) -> str:
    """Equal for equal values, and for no others. Raises TypeError where that cannot be said."""
    kind = type(value)
    name = f"{kind.__module__}.{kind.__qualname__}"
    match value:
        case None | bool() | int() | float() | str() | bytes():
            return f"{kind.__name__} {value!r}"
        case list() | tuple():
            return f"{name}[{', '.join(map(described, value))}]"
        case set() | frozenset():
            return f"{name}[{', '.join(sorted(map(described, value)))}]"
        case Mapping():
            items = (f"{described(k)}: {described(v)}" for k, v in value.items())
            return f"map[{', '.join(items)}]"
        case np.ndarray():
            return f"{value.dtype}{value.shape}{sha256(value.tobytes()).hexdigest()}"
        case FunctionType() if "<" not in value.__qualname__:
            return f"{value.__module__}.{value.__qualname__}"
        case partial():
            return f"partial{described((value.func, value.args, value.keywords))}"
        case type():
            return f"{value.__module__}.{value.__qualname__}"
        case _ if is_dataclass(value):
            return name + described({f.name: getattr(value, f.name) for f in fields(value)})
    raise TypeError(f"{name} cannot be described")


def _modules(place: Path) -> Iterable[Path]:
    if place.is_dir():
        return sorted(place.rglob("*.py"))
    return [place] if place.is_file() else sorted(place.parent.glob(place.name))


def _is(path: Path, stat: Stat) -> bool:
    """Whether the file is what was seen."""
    with suppress(OSError):
        return file_stat("", path.stat()) == stat
    return False


def _seen() -> Iterable[tuple[Path, Stat]]:
    for room in ("cases", "reference", "engines", "reports"):
        for path in _modules(ROOT / room):
            yield path, file_stat("", path.stat())


def basis(memo: Store) -> str:
    """The contents of the libraries that compute, tests left out; memo: what is known of them.

    A word that nobody else has where they are newer than the process, which has loaded others.
    """
    folders = [folder for name in BASIS for folder in located(name)]
    libraries = [folder.with_name(f"{folder.name}.libs") for folder in folders]
    places = [Place(path, tests=False) for path in [*folders, *libraries] if path.exists()]
    stats = [place.stats() for place in places]
    if any(max(file[2], file[3]) > BEGUN * 1e9 for files in stats for file in files):
        return uuid4().hex
    return _word(*(p.contents(files, memo).digest for p, files in zip(places, stats, strict=True)))


@cache
def machine() -> str:
    """Describes what decides the last digits: interpreter, libraries, the processor's vector units.

    Not how many cores it has: nothing here multiplies matrices so large that a library would share
    them out, and rows of one and of many were always the same.
    """
    found = np.show_config(mode="dicts") or {}
    variables = {k: v for k, v in os.environ.items() if k.startswith(ROUNDING)}
    return described(
        (
            sys.version,
            sys.flags.optimize,  # without assertions code is other code
            platform.system(),
            platform.machine(),
            platform.libc_ver(),
            np.__version__,
            scipy.__version__,
            found.get("SIMD Extensions", {}),
            _processor(),
            dict(sorted(variables.items())),
        )
    )


def _processor() -> str:
    """Its model and features, where the system tells them."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return platform.processor()
    wanted = ("model name", "flags", "Features", "CPU part")
    first = text.partition("\n\n")[0].splitlines()
    return "\n".join(line for line in first if line.startswith(wanted))
