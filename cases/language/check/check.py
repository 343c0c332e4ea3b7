"""Checks that a case fits together: links, claims, samples, parameters, system."""

from collections.abc import Iterator, Mapping
from typing import Any

from ...mistake import nearest
from ...scene import Scene
from ...scene.forces.drag import Drag
from ...scene.forces.force import of
from ..parse import Finding, Parsed
from .claims import claims
from .engines import Engines, engines
from .links import links, twice
from .sampling import sampling
from .states import states

_NO_USE = ("title", "source", "parameters", "drops_out")  # where a name is not a use of it


def check(
    parsed: Parsed,
    scene: Scene,
    *,
    data: Mapping[str, Any],
    systems: Mapping[str, tuple[str, ...]] | None,
    known: Engines | None,
) -> Iterator[Finding]:
    """Every mistake between the sound parts; `data` is the whole file as it was written."""
    yield from links(parsed, scene)
    yield from slowing(parsed, scene)
    if known is not None:
        yield from engines(parsed.file, known)
    unfit = [] if parsed.file.states is None else [*states(parsed, scene)]
    yield from unfit
    if not any(twice(parsed)) and not unfit and not parsed.lacks("states"):
        yield from claims(parsed, scene)
    if not parsed.lacks("duration") and not parsed.lacks("samples") and not parsed.lacks("step"):
        yield from sampling(parsed.file)
    yield from _parameters(parsed, data, systems)


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
                place = "parameters" if file.parameters else "system"
                yield (place,), f"system {file.system!r} needs the parameter {name!r}"
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


# Friction that ends any motion in a finite time: a claim about states may have it.


def slowing(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Yields drags that would stop a motion's points anywhere; the motion itself shows the rest."""
    if parsed.file.states is not None:
        return
    for force in of(Drag, scene.forces.values()):
        path = ("scene", "forces", force.name, "exponent")
        if force.exponent == 0.0:
            yield path, "must be above 0 in a motion: with 0 it would be dry friction"
        elif force.ends and force.along is not None:
            what = (
                "must be at least 1 of an edge in a motion: with less it would stop in a finite "
                "time, along the edge or across it"
            )
            yield path, what
