"""Plain data → the grammar's models, cutting out what is mistaken so that the rest is checked."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError

from ..fields.number import MISTAKEN, names
from ..mistake import Path
from .grammar.file import File, SpatialFile

Finding = tuple[Path, str]  # where, and what is wrong there

# How much is cut out around a mistake: `scene.bodies.crank`, not the scene.
_DEPTH = {"scene": 3, "parameters": 2, "initial": 2, "near": 2, "allow": 2, "reach": 3}
_DEPTH |= {"deviates": 3, "events": 2}

# Values that stand in for a key that is missing or was cut out; `Parsed.broken` says so.
_HOLLOW: dict[str, Any] = {
    "title": "-",
    "scene": {"bodies": {}},
    "initial": {},
    "duration": 1.0,
    "samples": 3,
    "allow": {"-": 1.0},
}


# Keys that a claim about states does not have, and values for those that every other file needs.
_MOVES = ("initial", "near", "events", "duration", "samples", "step", "rests", "stays", "tube")
_STILL: dict[str, Any] = {"initial": {}, "duration": 1.0, "samples": 3}

# Keys of the scene that name no part.
_ALONE = (("gravity",), ("incline",), ("seen",), ("space",), ("drive",))

# Sections beside the scene: where one stands deeper it is told so, whatever else is wrong there.
_BESIDE = ("initial", "near", "events", "allow", "reach", "deviates", "variants", "parameters")

# One set of names: they address quantities.
NAMED = ("bodies", "joints", "constraints", "contacts", "forces")


@dataclass(frozen=True)
class Parsed:
    """The sound part of a file, the mistakes of form, and the paths that are not sound."""

    file: File
    findings: tuple[Finding, ...]
    broken: frozenset[Path]

    def lacks(self, key: str) -> bool:
        """Whether this top-level key is wholly or partly unsound."""
        return any(path[0] == key for path in self.broken)

    @property
    def shaken(self) -> bool:
        """Whether whole sections of the scene are unsound: then nothing can refer to a part."""
        return any(
            path[0] == "scene" and len(path) < 3 and path[1:] not in _ALONE for path in self.broken
        )

    def hides(self, word: str, sections: tuple[str, ...] = NAMED) -> bool:
        """Whether a part of this name may be there, but is unsound."""
        return self.shaken or any(("scene", section, word) in self.broken for section in sections)

    def names(self, section: str, sound: Iterable[str]) -> list[str]:
        """The names of a section, sound or not, to hint at."""
        unsound = (p[2] for p in self.broken if p[:2] == ("scene", section) and len(p) == 3)
        return [*sound, *sorted(name for name in map(str, unsound) if name.strip())]


def parse(data: Mapping[str, Any]) -> Parsed:
    """The file's models, with as much of the file as is sound."""
    known = names(data.get("parameters"))
    model: type[File] = SpatialFile if _spatial(data) else File
    rest = _copy(data)
    findings: list[Finding] = []
    broken: set[Path] = set()
    if "states" in rest:
        findings += [
            ((key,), "stands beside `states`, where nothing moves") for key in _MOVES if key in rest
        ]
        rest = {k: v for k, v in rest.items() if k not in _MOVES} | _STILL
    while True:
        try:
            file = model.model_validate(rest, context=known)
            return Parsed(file, tuple(findings), frozenset(broken))
        except ValidationError as error:
            first = not broken
            for detail in error.errors(include_url=False):
                path = _path(detail["loc"])
                what = detail["msg"]
                if deep := _too_deep(path, data):
                    path, what = deep
                    broken.add(path[-1:])  # what it holds may be meant elsewhere
                # Of a parameter it is known already: what names it is as a wrong number is here.
                if first and detail.get("ctx", {}).get("number") and path[0] != "parameters":
                    rest, there = _without_number(rest, path)
                    if there:
                        findings.append((path, what))
                        continue
                cut = path[: _DEPTH.get(str(path[0]), 1)] if first else path[:1]
                broken.add(cut)
                _remove(rest, cut)
                if first:  # later ones only follow from what was cut out
                    findings.append((path, what))
            rest = {**{k: v for k, v in _HOLLOW.items() if (k,) in broken}, **rest}


def _spatial(data: Mapping[str, Any]) -> bool:
    """Whether the file says that its scene is in space, be it wrongly."""
    scene = data.get("scene")
    return isinstance(scene, dict) and scene.get("space", 2) != 2


def _path(loc: tuple[str | int, ...]) -> Path:
    """pydantic's location without the names it gives to the branches of a choice."""
    if loc[0] in ("scene", "initial", "near"):
        named = 2 if loc[1:2] == ("gravity",) else 3  # so many words are keys, whatever they are
        loc = (*loc[:named], *(word for word in loc[named:] if not str(word).startswith("<")))
    if loc[:2] == ("source", "figure"):
        loc = (*loc[:2], *loc[3:])
    if loc[0] == "step":
        loc = (loc[0], *loc[2:])
    return loc[:-1] if len(loc) > 1 and loc[-1] == "[key]" else loc


def _too_deep(path: Path, data: Mapping[str, Any]) -> Finding | None:
    """The path and mistake of a section in `scene` that belongs beside it, or None."""
    for k in (1, 2):  # in another section, or in one of the scene's
        if len(path) in (k + 1, k + 2) and path[k] in _BESIDE and path[k] not in data:
            return path[: k + 1], f"{path[k]!r} stands beside `scene`, at the file's margin"
    return None


def _without_number(data: Any, path: tuple[Any, ...]) -> tuple[Any, bool]:
    """The data with one number marked as mistaken, and whether there is such a number."""
    if not path:
        return MISTAKEN, data is not MISTAKEN and not isinstance(data, dict | tuple | list)
    key, *others = path
    try:
        changed, there = _without_number(data[key], (*others,))
    except (TypeError, LookupError):
        return data, False
    if not there:
        return data, False
    if isinstance(data, dict):
        return {**data, key: changed}, True
    return (*data[:key], changed, *data[key + 1 :]), True


def _copy(data: Any) -> Any:
    return {k: _copy(v) for k, v in data.items()} if isinstance(data, dict) else data


def _remove(data: Any, path: Path) -> None:
    for key in path[:-1]:
        data = data.get(key) if isinstance(data, dict) else None
    if isinstance(data, dict):
        data.pop(path[-1], None)
