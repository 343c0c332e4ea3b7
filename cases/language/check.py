"""What a case claims against what its scene has: quantities, samples, parameters, system."""

from collections.abc import Iterator, Mapping
from typing import Any

from cases.language.links import links, twice
from cases.language.number import Amount, NumberMistake, fitting
from cases.language.parse import Finding, Parsed
from cases.language.sampling import sampling
from cases.quantity import Quantity, nearest, table
from cases.scene import Scene

_NO_USE = ("title", "source", "parameters", "drops_out")  # where a name is not a use of it


def check(
    parsed: Parsed,
    scene: Scene,
    *,
    data: Mapping[str, Any],
    systems: Mapping[str, tuple[str, ...]] | None,
) -> Iterator[Finding]:
    """Every mistake between the sound parts; `data` is the whole file as it was written."""
    yield from links(parsed, scene)
    if not any(twice(scene)):
        yield from _bounds(parsed, table(scene))
    if not parsed.lacks("duration") and not parsed.lacks("samples") and not parsed.lacks("step"):
        yield from sampling(parsed.file)
    yield from _parameters(parsed, data, systems)


def _bounds(parsed: Parsed, known: Mapping[str, Quantity]) -> Iterator[Finding]:
    file = parsed.file
    if ("allow",) in parsed.broken:
        return
    for name, bound in file.allow.items():
        yield from _quantity(parsed, known, ("allow", name), bound)
    for way, reached in file.reach.items():
        for name, bound in reached.items():
            path = ("reach", way, name)
            yield from _allowed(parsed, known, path, bound)
            allow = file.allow.get(name)
            if allow is not None and bound.value > allow.value:
                yield path, f"{bound.value:g} is above its `allow`, {allow.value:g}"
    for setting, declared in file.deviates.items():
        for name, deviation in declared.items():
            path = ("deviates", setting, name)
            allow = file.allow.get(name)
            for size in (deviation.limit, *(deviation.by or ())):
                if size is None:
                    continue
                yield from _allowed(parsed, known, path, size)
                if allow is not None and size.value <= allow.value:
                    yield path, f"{size.value:g} is not above its `allow`, {allow.value:g}"


def _quantity(
    parsed: Parsed, known: Mapping[str, Quantity], path: tuple[str, ...], bound: Amount | None
) -> Iterator[Finding]:
    name = path[-1]
    if name not in known:
        if not parsed.hides(name.split(".")[0]):
            yield path, f"unknown quantity {name!r}{nearest(name, known)}"
    elif bound is not None:
        try:
            fitting(bound, known[name].unit)
        except NumberMistake as mistake:
            yield path, str(mistake)


def _allowed(
    parsed: Parsed, known: Mapping[str, Quantity], path: tuple[str, ...], bound: Amount
) -> Iterator[Finding]:
    name = path[-1]
    if name in parsed.file.allow or ("allow", name) in parsed.broken:
        yield from _quantity(parsed, known, path, bound)
    elif not parsed.hides(name.split(".")[0]):
        yield path, f"{name!r} is not in `allow`{nearest(name, parsed.file.allow)}"


def _parameters(
    parsed: Parsed, data: Mapping[str, Any], systems: Mapping[str, tuple[str, ...]] | None
) -> Iterator[Finding]:
    file = parsed.file
    if ("parameters",) in parsed.broken:
        return
    given = [*file.parameters, *(str(p[1]) for p in parsed.broken if p[0] == "parameters")]
    for i, name in enumerate(file.drops_out):
        if name not in given:
            yield ("drops_out", i), f"unknown parameter {name!r}{nearest(name, given)}"
    if file.system is None:
        used = _words({k: v for k, v in data.items() if k not in _NO_USE})
        for name in file.parameters:
            if name not in used and f"-{name}" not in used:
                yield ("parameters", name), "no one uses this parameter"
    elif systems is not None and file.system not in systems:
        yield ("system",), f"unknown system {file.system!r}{nearest(file.system, systems)}"
    elif systems is not None:
        needed = systems[file.system]
        for name in needed:
            if name not in given:
                yield ("parameters",), f"system {file.system!r} needs the parameter {name!r}"
        for name in file.parameters:
            if name not in needed:
                what = f"system {file.system!r} has no parameter {name!r}{nearest(name, needed)}"
                yield ("parameters", name), what


def _words(data: object) -> set[str]:
    """Every text that stands as a value."""
    if isinstance(data, dict):
        return set().union(*map(_words, data.values()))
    if isinstance(data, tuple):
        return set().union(*map(_words, data))
    return {data} if isinstance(data, str) else set()
