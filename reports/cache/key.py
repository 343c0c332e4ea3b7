"""What a result depends on, as one word: the case, the code, the engine, the machine's rounding."""

import os
import platform
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from functools import cache, partial
from hashlib import sha256
from pathlib import Path
from types import FunctionType
from typing import Any
from uuid import uuid4

import numpy as np
import scipy

from ...cases.case import Case
from ...engines.engine import Engine
from .. import BEGUN

ROOT = Path(__file__).parents[2]
REFERENCE = ("cases", "reference")
ROWS = ("reports/row.py", "reports/unit.py")
JUDGING = ("engines/*.py", "reports/trial", "reports/judge", "reports/events", *ROWS)
TRYING = ("reports/search/candidate.py", "reports/search/errors.py")
ROUNDING = ("NPY_", "OPENBLAS_", "OMP_", "MKL_", "BLIS_")  # variables that choose other kernels


@dataclass(frozen=True)
class Keys:
    """The keys of results of the code as it was when the run began."""

    files: tuple[tuple[Path, int, int], ...]  # each file of code, when it was changed, its size
    salt: str  # of code that is newer than the process: nobody else has this word
    _described: dict[int, tuple[object, str]] = field(default_factory=dict, compare=False)

    @staticmethod
    def now() -> "Keys":
        files = tuple(_seen())
        newer = any(changed > BEGUN * 1e9 for _, changed, _ in files)
        return Keys(files, uuid4().hex if newer else "")

    def hold(self) -> bool:
        """Whether the code is still what it was: else a result may be of a mixture.

        Asked for every result. A new file alone changes none: something known must import it.
        """
        return all(_is(*file) for file in self.files)

    def solution(self, case: Case) -> str:
        """Of a case's reference."""
        return _word(
            "solution", self.salt, self._once(case, _case), self._code(REFERENCE), machine()
        )

    def ways(self, case: Case, engine: Engine) -> str:
        """Of how an engine would run it."""
        told = self._once(engine, _engine)
        return _word("ways", self.solution(case), told, self._code(JUDGING))

    def _once(self, thing: Any, describe: Callable[[Any], str]) -> str:
        """A case meets every engine, and an engine every case: each is described once in a run."""
        if id(thing) not in self._described:
            self._described[id(thing)] = (
                thing,
                describe(thing),
            )  # kept, so that its id stays its own
        return self._described[id(thing)][1]

    def _code(self, places: tuple[str, ...]) -> str:
        return _code(places, self.files)

    def outcome(self, ways: str, realised: str) -> str:
        """Of what it gave in one of the ways under that key."""
        return _word("outcome", ways, realised)

    def rung(self, outcome: str, ladder: str, step: float) -> str:
        """Of one run behind that outcome."""
        return _word("rung", outcome, ladder, repr(step))

    def tried(self, case: Case, engine: Engine, options: str, step: float) -> str:
        """Of one simulation with other options of the engine."""
        ways = self.ways(case, engine)
        return _word("tried", ways, options, repr(step), self._code(TRYING))

    def run(self, pairs: Iterable[tuple[Case, Engine]]) -> str:
        """Of all together: two runs with this key compute the same."""
        return _word("run", *(self.ways(case, engine) for case, engine in pairs))


def _word(*parts: str) -> str:
    return sha256("\0".join(parts).encode()).hexdigest()


def _case(case: Case) -> str:
    """All of it but its text: a comment changes nothing."""
    return described({f.name: getattr(case, f.name) for f in fields(case) if f.name != "source"})


def _engine(engine: Engine) -> str:
    """Its settings, its version and its adapter's code."""
    try:
        return described(engine) + engine.version + _hashed(_modules(_home(type(engine))))
    except TypeError:  # something that cannot be told from another of its kind
        return uuid4().hex


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


def _home(kind: type) -> Path:
    """The folder of an engine's package, or its one file."""
    names = kind.__module__.split(".")
    own = 3 if names[0] == "textmech" else 1  # textmech.engines.<name>; theirs from the top
    for known in (".".join(names[:own]), kind.__module__):
        file = getattr(sys.modules.get(known), "__file__", None)
        if file is not None:
            return Path(file).parent if Path(file).name == "__init__.py" else Path(file)
    raise TypeError(f"{kind.__module__} has no file")


def _modules(place: Path) -> Iterable[Path]:
    if place.is_dir():
        return sorted(place.rglob("*.py"))
    return [place] if place.is_file() else sorted(place.parent.glob(place.name))


@cache
def _code(places: tuple[str, ...], seen: tuple[tuple[Path, int, int], ...]) -> str:
    """Of code that was seen so: read once in a run."""
    return _hashed(path for place in places for path in _modules(ROOT / place))


def _hashed(paths: Iterable[Path]) -> str:
    return _word(*(f"{path.name} {_text(path, path.stat().st_mtime_ns)}" for path in paths))


@cache
def _text(path: Path, changed: int) -> str:
    return sha256(path.read_bytes()).hexdigest()


def _is(path: Path, changed: int, size: int) -> bool:
    """Whether the file is what was seen."""
    try:
        stat = path.stat()
    except OSError:
        return False
    return (stat.st_mtime_ns, stat.st_size) == (changed, size)


def _seen() -> Iterable[tuple[Path, int, int]]:
    for room in ("cases", "reference", "engines", "reports"):
        for path in _modules(ROOT / room):
            stat = path.stat()
            yield path, stat.st_mtime_ns, stat.st_size


@cache
def machine() -> str:
    """What decides the last digits: interpreter, libraries, the processor's vector units."""
    found = np.show_config(mode="dicts") or {}
    variables = {k: v for k, v in os.environ.items() if k.startswith(ROUNDING)}
    return described(
        (
            sys.version,
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
