"""Collects the parts of an engine: its adapter, and all that this brings with it, wherever it lies.

Its adapter is the package, or the module with what lies beside it, from which the engine was made.
With it count the modules that its code imports, wherever in it, as Python finds them now, be it in
front of what is installed; the distributions of these and of the plug-in, and what they require;
the files that the adapter's code names; and the variables of the environment that stand in any of
this code, with the files that they name.
"""

import os
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

from .... import engines
from ....engines.engine import Engine
from .digest import CODE, COMPILED, Contents, Place, Stat
from .store import Store

OURS, BASIS = "textmech", ("numpy", "scipy")  # whose digests are in every key
MANY = 1000  # files beside a module that is alone in its folder: more are nobody's adapter
LONGEST = 200  # letters of a file's name in code
INSTALLED = ("site-packages", "dist-packages")
AT_START = ("sitecustomize", "usercustomize")  # Python runs them before all else
WINDOWS = {"MUJOCO_GL", "glfw"}
"""With what engines show pictures. None of our runs does, and only the command forbids it: what it
has computed would be computed again by pytest."""
_QUOTED = re.compile(rb"[\"']([^\"'\n\\]+)[\"']")
_REQUIRED = re.compile(r"[\w.-]+")
_FIELD = {
    name: re.compile(rf"^{name}: *(.+)$", re.MULTILINE)
    for name in ("Name", "Version", "Requires-Dist")
}  # `metadata` reads the whole description too


@dataclass
class Parts:
    """found: its places with what the disk said of them when they were read."""

    memo: Store
    found: dict[Place, tuple[Stat, ...]] = field(default_factory=dict)
    words: set[str] = field(default_factory=set)
    variables: set[str] = field(default_factory=set)
    _names: set[str] = field(default_factory=set)
    _asked: list[Distribution] = field(default_factory=list)
    _distributions: set[str] = field(default_factory=set)

    @staticmethod
    def of(engine: Engine, memo: Store) -> "Parts":
        """Everything. Raises OSError and TypeError where that cannot be said."""
        parts = Parts(memo)
        home = home_of(type(engine))
        parts._place(home, beside=True)
        for name in () if _is_ours(home) else _loaded(type(engine).__module__.partition(".")[0]):
            parts._module(name)
        if (provided := engines.distribution(engine.name)) is not None:
            parts._names |= {_module_of(top) for top in _tops(provided)}
            parts._asked.append(provided)
        for name in AT_START:
            parts._module(name)
        held = _reached(parts._names)
        for found in parts._asked:
            parts._distribution(found, held)
        prefix = f"{engine.name.upper()}_"
        named = {name for name in os.environ if name in parts.variables or name.startswith(prefix)}
        for name in sorted(named - WINDOWS):
            parts.words.add(f"{name}={os.environ[name]}")
            with suppress(OSError, ValueError):
                if (file := Path(os.environ[name])).is_file():
                    parts._contents(Place(file))
        return parts

    def word(self) -> str:
        """One word for all parts together: their own words, sorted."""
        return "\0".join(sorted(self.words))

    def hold(self) -> bool:
        """Whether all of it is what it was."""
        with suppress(OSError):
            return all(place.stats() == stats for place, stats in self.found.items())
        return False

    def newer(self, than: float) -> bool:
        """Whether anything has changed after that time [s]."""
        return any(max(s[2], s[3]) > than * 1e9 for stats in self.found.values() for s in stats)

    def _contents(self, place: Place) -> Contents:
        self.found[place] = stats = place.stats()
        told = place.contents(stats, self.memo)
        self.words.add(f"{place.path.name} {told.digest}")
        self.variables |= set(told.variables)
        return told

    def _place(self, path: Path, *, beside: bool = False) -> None:
        """A folder of code or a module, with what it imports; beside: and what lies there."""
        if any(place.path == path for place in self.found):
            return
        told = self._contents(Place(path, code=True))
        if beside:
            for file in _beside(path):
                self._contents(Place(file))
        for name in told.imports:
            self._module(name)

    def _module(self, name: str) -> None:
        """Adds a module: an installed one with what it requires, others with all they import."""
        if name in self._names or name in sys.stdlib_module_names or name in (OURS, *BASIS):
            return
        self._names.add(name)
        with suppress(PackageNotFoundError, ValueError):
            self._asked.append(distribution(name))
            for path in located(name):
                self._contents(Place(path, code=True, tests=False))
            return
        for path in located(name):
            self._place(path)

    def _distribution(self, found: Distribution, held: set[str]) -> None:
        """Its files where they lie, its modules where they are loaded from, what it requires.

        held: by the engine's code. What others have loaded into the process is none of it: pytest
        has more there than the command.
        """
        told = (found.read_text("METADATA") or found.read_text("PKG-INFO") or "").partition("\n\n")[
            0
        ]
        name, version = (_FIELD[field].findall(told) for field in ("Name", "Version"))
        known = name[0].lower().replace("_", "-") if name else str(id(found))
        if known in self._distributions or known in (OURS, *BASIS):
            return
        self._distributions.add(known)
        self.words.add(f"{known} {version}")
        for top in sorted(_tops(found)):
            if top.endswith(".libs"):
                self._contents(Place(Path(str(found.locate_file(top)))))
            elif _module_of(top) in held:
                for path in located(_module_of(top)):
                    self._contents(Place(path, code=True, tests=False))
        for needed in _FIELD["Requires-Dist"].findall(told):
            if "extra ==" not in needed and (match := _REQUIRED.match(needed)):
                with suppress(PackageNotFoundError):
                    self._distribution(distribution(match[0]), held)


def _tops(found: Distribution) -> set[str]:
    """The first parts of its files' names: packages, modules, what is linked beside them."""
    listed = found.read_text("RECORD")  # `files` makes a path of each, of thousands
    names = listed.splitlines() if listed else map(str, found.files or ())
    tops = {name.partition(",")[0].partition("/")[0] for name in names}
    return {top for top in tops if top not in ("", "..", COMPILED) and not top.endswith("-info")}


def _module_of(top: str) -> str:
    return top.partition(".")[0]


def home_of(kind: type) -> Path:
    """The folder of an engine's package, or its one file. Raises TypeError where it has none."""
    names = kind.__module__.split(".")
    own = 3 if names[0] == OURS else 1  # textmech.engines.<name>; theirs from the top
    for known in (".".join(names[:own]), kind.__module__):
        file = getattr(sys.modules.get(known), "__file__", None)
        if file is not None:
            return Path(file).parent if Path(file).name == "__init__.py" else Path(file)
    raise TypeError(f"{kind.__module__} has no file")


def _loaded(package: str) -> set[str]:
    """The modules by their first names that the package's own hold, however they were imported."""
    own = [m for name, m in list(sys.modules.items()) if name.partition(".")[0] == package]
    held = [thing for module in own for thing in list(vars(module).values())]
    names = [
        t.__name__ if isinstance(t, ModuleType) else getattr(t, "__module__", "") for t in held
    ]
    return {name.partition(".")[0] for name in names if isinstance(name, str)} - {"", package}


def _reached(packages: set[str]) -> set[str]:
    """The packages, what those that are loaded hold, and what these hold in turn."""
    found, left = set[str](), packages - {"__main__"}  # a program holds what it has imported
    while left:
        found.add(name := left.pop())
        left |= _loaded(name) - found - sys.stdlib_module_names - {OURS, *BASIS} - WINDOWS
    return found


def located(name: str) -> list[Path]:
    """Where a module is: where it was loaded from, else where Python would find it now."""
    module, spec = sys.modules.get(name), None
    with suppress(ImportError, ValueError, AttributeError):
        spec = find_spec(name) if module is None else None
    folders = getattr(module, "__path__", None) or getattr(spec, "submodule_search_locations", None)
    found = [Path(folder) for folder in folders or () if Path(folder).is_dir()]
    file = getattr(module, "__file__", None) or getattr(spec, "origin", None)
    # A package's folders need not be where its code is: somebody may stand in front of it.
    if file and Path(file).is_file() and not any(Path(file).is_relative_to(f) for f in found):
        found.append(Path(file))
    return found


def _beside(home: Path) -> Iterator[Path]:
    """Files that its code names in quotes; of a module with a folder of its own, all there."""
    folder = home if home.is_dir() else home.parent
    if home.is_file() and folder.name not in INSTALLED:
        there = [Path(found.path) for found in os.scandir(folder) if found.is_file()]
        if len(there) > MANY:
            raise TypeError(f"{home.name} is one of {len(there)} files")
        yield from sorted(there)
    if _is_ours(home):
        return
    files = [home] if home.is_file() else sorted(f for f in home.rglob("*") if f.suffix in CODE)
    for file in files:
        yield from _quoted(file, {folder, folder.parent, file.parent})


def _quoted(file: Path, folders: Iterable[Path]) -> Iterator[Path]:
    """Files that are there, by the names in a file of code."""
    words = {w.decode() for w in _QUOTED.findall(file.read_bytes()) if w.isascii()}
    for word in sorted(word for word in words if len(word) <= LONGEST and set(word) & {".", "/"}):
        for folder in sorted(folders):
            with suppress(OSError, ValueError, RuntimeError):
                named = folder / Path(word).expanduser()
                if named.is_file():
                    yield named


def _is_ours(home: Path) -> bool:
    return home.is_relative_to(Path(__file__).parents[3])
