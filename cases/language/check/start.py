"""How bodies, joints and edges start, and guesses: what may be given of each, in which units."""

from collections.abc import Iterator, Mapping

from ...fields.number import Amount, NumberMistake, check_unit, shown
from ...mistake import Path, list_hint, nearest
from ...scene import GROUND, Anchor, Scene
from ...scene.body import Body
from ...scene.joint import WORDS, Joint
from ...scene.point import anchor
from ..grammar.start import Initial, Near, SpatialStart, Vector
from ..parse import Finding, Parsed
from .anchor import no_point


def starts(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound starts and guesses."""
    for key in ("initial", "near"):
        if scene.frame.dimension == 3:
            yield from _in_space(parsed, scene, key)
        else:
            yield from _check_places(parsed, scene, key, getattr(parsed.file, key))
    if scene.frame.dimension == 2:
        yield from _speeds(parsed, scene)
        yield from _polar(parsed, scene)


def _unknown_part(parsed: Parsed, scene: Scene, name: str) -> str:
    known = [*parsed.names("bodies", scene.bodies), *parsed.names("joints", scene.joints)]
    return f"unknown body or joint {name!r}{nearest(name, known)}"


def _check_places(
    parsed: Parsed, scene: Scene, key: str, places: Mapping[str, Near]
) -> Iterator[Finding]:
    for name, place in places.items():
        if name in scene.joints:
            yield from _of_planar_joint((key, name), scene, place)
            continue
        if key == "initial" and name in scene.constraints:
            continue
        if name not in scene.bodies:
            if not parsed.hides(name):
                yield (key, name), _unknown_part(parsed, scene, name)
            continue
        if place.shift is not None:
            yield (key, name, "shift"), "only a joint that slides has a `shift`"
        for point in place.places:
            if point not in scene.bodies[name].points:
                yield from no_point(parsed, scene, (key, name, point), Anchor(name, point))
        for i, point in enumerate(place.stands_on):
            path = (key, name, "on", i) if len(place.stands_on) > 1 else (key, name, "on")
            yield from no_point(parsed, scene, path, Anchor(name, point))
        for turning in ("angle", "omega"):
            if not scene.bodies[name].turns and getattr(place, turning, None) is not None:
                yield (key, name, turning), f"{name!r} is a particle and cannot turn"


# The speeds with which edges start.


def _speeds(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    for name, start in parsed.file.initial.items():
        given = sorted(start.keys)
        if name not in scene.constraints:
            if "speed" in given and name not in scene.joints:
                what = "only an edge or a joint that slides starts with a `speed`"
                yield ("initial", name, "speed"), what
            continue
        for key in given:
            if key != "speed":
                yield ("initial", name, key), f"{name!r} is an edge and starts with a `speed`"
            elif scene.constraints[name].speed is not None:
                yield ("initial", name, key), f"the speed of {name!r} is prescribed"


# Starts that give a place by its distance from a point of the ground, in some direction.


KEYS = ("from", "length", "direction")


def _polar(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound starts."""
    for name, start in parsed.file.initial.items():
        given = [key for key in KEYS if key in start.keys]
        if not given or name not in scene.bodies:
            continue
        for key in (key for key in KEYS if key not in given):
            yield ("initial", name), f"needs `{key}` beside {' and '.join(given)}"
        for key in sorted({"x", "y", *start.places} & start.keys):
            yield ("initial", name, key), "cannot stand beside `from`, which gives the place too"
        yield from _origin(parsed, scene, name, start)


def _origin(parsed: Parsed, scene: Scene, name: str, start: Initial) -> Iterator[Finding]:
    if start.from_ is None:
        return
    at, path = anchor(start.from_), ("initial", name, "from")
    if at.body != GROUND:
        yield path, f"should be a point of the ground, is {start.from_!r}"
    elif at.point not in scene.points and not parsed.hides(at.point, ("points",)):
        known = parsed.names("points", scene.points)
        yield path, f"the ground has no point {at.point!r}{nearest(at.point, known)}"


# By joints: only the coordinates that a joint has can be given, and at the start their rates.


def _of_planar_joint(path: Path, scene: Scene, place: Near) -> Iterator[Finding]:
    """Every mistake in the start of a joint."""
    key, name = path
    joint, starts = scene.joints[str(name)], key == "initial"
    known = [word for word in scene.coordinates()[joint.name] if starts or word not in joint.rates]
    by = "it starts by" if starts else "a guess says"
    for word in (*place.given, *place.places):
        if word not in known:
            yield (*path, word), _unknown(joint, word, known, by)


def _unknown(joint: Joint, key: str, known: list[str], by: str) -> str:
    what = f"{joint.name!r} is a {joint.kind}"
    if not known:
        return f"{what} and leaves nothing that could be given"
    may = f"{by} {' and '.join(known)}"
    if key in WORDS:
        return f"{what} and has no {key}; {may}"
    return f"{what}; {may}{nearest(key, known)}"


# In space: places, attitudes and rates of bodies, and coordinates of joints.


_TURNING = ("attitude", "omega")
_PLACES = dict.fromkeys("xyz", "m")
_RATES = dict.fromkeys(("vx", "vy", "vz"), "m/s")


def _in_space(parsed: Parsed, scene: Scene, key: str) -> Iterator[Finding]:
    """Every mistake in `initial`, or in `near`, which takes places only."""
    rates = key == "initial"
    written: Mapping[str, SpatialStart] = getattr(parsed.file, key)
    for name, start in written.items():
        if name in scene.bodies:
            yield from _of_body((key, name), scene.bodies[name], start, rates=rates)
        elif name in scene.joints:
            yield from _of_joint((key, name), scene.joints[name], start, rates=rates)
        elif not parsed.hides(name, ("bodies", "joints")):
            known = [*parsed.names("bodies", scene.bodies), *parsed.names("joints", scene.joints)]
            yield (key, name), f"unknown body or joint {name!r}{nearest(name, known)}"


def _of_body(path: Path, body: Body, start: SpatialStart, *, rates: bool) -> Iterator[Finding]:
    units = {**_PLACES, **(_RATES if rates else {})}
    keys = [*units, "attitude", *(["omega"] if rates else [])]
    given = [*start.entries, *([] if start.attitude is None else ["attitude"])]
    for key in (key for key in given if key in keys and key in _TURNING and not body.turns):
        yield (*path, key), f"{body.name!r} is a particle and cannot turn"
    for key, entry in start.entries.items():
        if key in units:
            yield from _number((*path, key), entry, units[key])
        elif key == "omega" and rates:
            yield from _vector((*path, key), entry, "rad/s") if body.turns else ()
        elif key in body.points:
            yield from _vector((*path, key), entry, "m")
        elif key == "angle":
            yield (*path, key), "a body in space has no angle; it has an `attitude: {axis, angle}`"
        elif isinstance(entry, tuple) and key not in ("omega", *_RATES):
            hint = nearest(key, body.points)
            yield (*path, key), f"body {body.name!r} has no point {key!r}{hint}"
        else:
            yield (*path, key), _no_key(key, [k for k in keys if k not in given])


def _of_joint(path: Path, joint: Joint, start: SpatialStart, *, rates: bool) -> Iterator[Finding]:
    ball = any(f.kind == "ball" for f in joint.freedoms)
    units = {f.name: f.unit for f in joint.named}
    if rates:
        units |= {name: f"{units[f.name]}/s" for name, f in joint.rates.items()}
    keys = [*units, *(["attitude"] if ball else []), *(["omega"] if ball and rates else [])]
    if start.attitude is not None and not ball:
        yield (*path, "attitude"), _no_key("attitude", keys, joint.kind)
    for key, entry in start.entries.items():
        if key in units:
            yield from _number((*path, key), entry, units[key])
        elif key in keys:
            yield from _vector((*path, key), entry, "rad/s")
        else:
            yield (
                (*path, key),
                _no_key(key, [k for k in keys if k not in start.entries], joint.kind),
            )


def _no_key(key: str, known: list[str], kind: str = "") -> str:
    if kind and not known:
        return f"unknown key {key!r}; of this {kind} nothing more can be given"
    close = nearest(key, known)
    return f"unknown key {key!r}{close if 'did you mean' in close else list_hint(known)}"


def _number(path: Path, entry: Amount | Vector, unit: str) -> Iterator[Finding]:
    if isinstance(entry, tuple):
        yield path, f"should be a number, is {shown(entry)}"
    else:
        yield from _fits(path, entry, unit)


def _vector(path: Path, entry: Amount | Vector, unit: str) -> Iterator[Finding]:
    if not isinstance(entry, tuple):
        yield path, f"should be a list of 3, is {entry.text or f'the number {entry.value:g}'}"
        return
    for i, amount in enumerate(entry):
        yield from _fits((*path, i), amount, unit)


def _fits(path: Path, amount: Amount, unit: str) -> Iterator[Finding]:
    try:
        check_unit(amount, unit)
    except NumberMistake as mistake:
        yield path, str(mistake)
