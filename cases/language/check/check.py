"""Checks that a case fits together: links, claims, samples, parameters, system."""

from collections.abc import Iterator, Mapping
from math import ceil, inf, isfinite, isnan
from typing import Any

from ...fields.number import parameters_in
from ...mistake import Path, nearest
from ...scene import Scene
from ...scene.forces.drag import Drag
from ...scene.forces.force import of_kind
from ...scene.frame import SPACE
from ...scene.joint import Joint
from ...scene.point import GROUND
from ...scene.quantity import table
from ...scene.states import claimable
from ..grammar.file import File
from ..parse import Finding, Parsed
from .claims import claims
from .engines import Engines, engines
from .links import duplicate_names, links

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
    yield from stopping_drags(parsed, scene)
    if known is not None:
        yield from engines(parsed.file, known)
    unfit = [] if parsed.file.states is None else [*states(parsed, scene)]
    yield from unfit
    if not any(duplicate_names(parsed)) and not unfit and not parsed.lacks("states"):
        yield from claims(parsed, scene)
    if not parsed.lacks("duration") and not parsed.lacks("samples") and not parsed.lacks("step"):
        yield from sampling(parsed.file, known)
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
        texts = _texts({k: v for k, v in data.items() if k not in _NO_USE})
        used = set().union(*(parameters_in(text, file.parameters) for text in texts))
        for name in file.parameters:
            if name not in used:
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


def _texts(data: object) -> set[str]:
    """Every text that stands as a value."""
    if isinstance(data, dict):
        return set().union(*map(_texts, data.values()))
    if isinstance(data, tuple):
        return set().union(*map(_texts, data))
    return {data} if isinstance(data, str) else set()


# Friction that ends any motion in a finite time: a claim about states may have it.


def stopping_drags(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Yields drags whose exponent would stop a motion in a finite time."""
    if parsed.file.states is not None or parsed.lacks("states"):
        return
    for force in of_kind(Drag, scene.forces.values()):
        path = ("scene", "forces", force.name, "exponent")
        if force.exponent == 0.0:
            yield path, "must be above 0 in a motion: with 0 it would be dry friction"
        elif force.ends and force.along is not None:
            what = (
                "must be at least 1 of an edge in a motion: with less it would stop in a finite "
                "time, along the edge or across it"
            )
            yield path, what


# The sample interval is a whole multiple of 4 h, so that a ladder h, 2h, 4h meets every sample.


_SEARCHED = 10_000  # counts of samples tried on each side


def sampling(file: File, known: Engines | None) -> Iterator[Finding]:
    """A mistake where some step does not divide the interval, with the nearest counts that do."""
    by_engine = file.step if isinstance(file.step, Mapping) else {None: file.step}
    by_engine = {k: h for k, h in by_engine.items() if not (k and known) or k in known}
    steps = tuple(by_engine.values())
    if any(isnan(number) for number in (file.duration, *steps)):
        return  # a mistaken number, found elsewhere
    if _divides(file.duration, file.samples, steps):
        return
    below = range(file.samples - 1, max(2, file.samples - _SEARCHED), -1)
    above = range(file.samples + 1, file.samples + _SEARCHED)
    near = [
        next((n for n in counts if _divides(file.duration, n, steps)), None)
        for counts in (below, above)
    ]
    better = " or ".join(str(n) for n in near if n is not None)
    interval = file.duration / (file.samples - 1)
    if not better and (off := _step_mistake(by_engine, interval)):
        path, smaller = off
        yield path, f"4 h should divide the sample interval {interval:.6g} s: {smaller:g} s does"
        return
    yield (
        ("samples",),
        f"the sample interval {interval:.6g} s is not a whole multiple of 4 h for every step h; "
        + (f"samples: {better} would be" if better else "no count near it is: change the duration"),
    )


def _step_mistake(steps: Mapping[str | None, float], interval: float) -> tuple[Path, float] | None:
    """Path of the first step [s] that does not divide the interval, and a smaller one that does."""
    for name, h in steps.items():
        if _divides(interval, 2, (h,)) or not 0 < h < inf:
            continue
        least = ceil(interval / (4 * h))  # 1 of a step that is longer than that
        fitting = [interval / (4 * k) for k in range(least, 4 * least)]
        even = [x for x in fitting if abs(float(f"{x:.1e}") / x - 1) < 1e-9]
        path = ("step",) if name is None else ("step", name)
        return path, (even or fitting)[0]
    return None


def _divides(duration: float, samples: int, steps: tuple[float, ...]) -> bool:
    for h in steps:
        ratio = duration / (samples - 1) / (4 * h)
        if not isfinite(ratio) or round(ratio) < 1 or abs(ratio - round(ratio)) > 1e-9 * ratio:
            return False
    return True


# Checks the scene of a claim about states: free bodies of the plane, or an open chain in space.
#
# What slows a body of the plane by its velocity may act on it: it is claimed, and moves nothing.


_NOTHING = "a claim about states is about bodies and joints alone"


def states(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake of a claim about states in its scene and its bounds."""
    spec = parsed.file.scene
    for section in ("constraints", "contacts"):
        yield from ((("scene", section, name), _NOTHING) for name in getattr(spec, section))
    for name, force in scene.forces.items():
        if not force.stated:
            also = "" if scene.frame is SPACE else ", and about `drag`"
            yield ("scene", "forces", name), _NOTHING + also
    for name, point in spec.points.items():
        if point.driven:
            yield ("scene", "points", name), f"is driven: {_NOTHING}"
    if scene.frame is SPACE:
        if scene.drives:
            yield ("scene", "drive"), _NOTHING
        yield from _particles(scene)
        yield from _chain(parsed, scene)
    else:
        what = "has no place here: states of the plane are those of free bodies; write `space: 3`"
        yield from ((("scene", "joints", name), what) for name in spec.joints)
    yield from _limits(parsed.file)
    for name in parsed.file.allow:
        if name in table(scene) and name not in claimable(scene):
            what = f"{name!r} is no claim about states: it is drawn itself, or held by a constraint"
            if name.endswith(".work"):
                what = f"{name!r} is no claim about states: work is done in time, and here is none"
            yield ("allow", name), what


def _particles(scene: Scene) -> Iterator[Finding]:
    for name, body in scene.bodies.items():
        if not body.turns:
            yield ("scene", "bodies", name), "is a particle; a claim about states takes none"


def _chain(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Mistakes where bodies do not form trees from the ground, by joints with named freedoms."""
    if any(path[0] == "scene" for path in parsed.broken):
        return  # what is missing may be what joins them
    connected = {GROUND}
    for name, joint in _joints_from_ground(scene):
        path = ("scene", "joints", name)
        if any(not freedom.name for freedom in joint.freedoms):
            yield path, f"a {joint.kind} has no coordinates to draw; write `freedoms`"
        if joint.a.body not in connected:
            what = "begins at nothing that hangs on the ground; name the part nearer to it first"
            yield (*path, joint.word), what
        elif joint.b.body in connected:
            yield path, "closes a loop: states are drawn of open chains"
        connected |= {joint.a.body, joint.b.body}
    for name in scene.bodies:
        if name not in connected:
            yield ("scene", "bodies", name), "hangs on nothing: join it to the ground by `freedoms`"


def _joints_from_ground(scene: Scene) -> Iterator[tuple[str, Joint]]:
    """The joints in order from the ground; last those that are not connected to it."""
    remaining, connected = dict(scene.joints), {GROUND}
    while remaining:
        ready = (name for name, joint in remaining.items() if joint.a.body in connected)
        name = next(ready, None) or next(iter(remaining))
        yield name, remaining[name]
        connected |= {remaining[name].a.body, remaining[name].b.body}
        del remaining[name]


def _limits(file: File) -> Iterator[Finding]:
    for setting, declared in file.deviates.items():
        for name, deviation in declared.items():
            if deviation.limit is not None:
                what = "no step leads to a state, so that there is no limit; write `by`"
                yield ("deviates", setting, name, "limit"), what
    for way in file.reach:
        if way.rpartition(".")[2] in ("law", "driver", "limit"):
            yield ("reach", way), "states are asked of the engine itself; write its name alone"
