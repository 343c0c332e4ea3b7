"""How bodies and joints in space start: what may be given of each, and in which units."""

from collections.abc import Iterator, Mapping

from ....fields.number import Amount, NumberMistake, fitting, shown
from ....mistake import Path, listed, nearest
from ....scene import Scene
from ....scene.body import Body
from ....scene.joint import Joint
from ...grammar.space.start import Start, Vector
from ...parse import Finding, Parsed
from ..drive import agrees

_TURNING = ("attitude", "omega")
_PLACES = dict.fromkeys("xyz", "m")
_RATES = dict.fromkeys(("vx", "vy", "vz"), "m/s")


def starts(parsed: Parsed, scene: Scene, key: str) -> Iterator[Finding]:
    """Every mistake in `initial`, or in `near`, which takes places only."""
    rates = key == "initial"
    written: Mapping[str, Start] = getattr(parsed.file, key)
    for name, start in written.items():
        if name in scene.bodies:
            yield from _of_body((key, name), scene.bodies[name], start, rates=rates)
        elif name in scene.joints:
            yield from _of_joint((key, name), scene.joints[name], start, rates=rates)
            yield from _against_drives((key, name), scene, start)
        elif not parsed.hides(name, ("bodies", "joints")):
            known = [*parsed.names("bodies", scene.bodies), *parsed.names("joints", scene.joints)]
            yield (key, name), f"unknown body or joint {name!r}{nearest(name, known)}"


def _of_body(path: Path, body: Body, start: Start, *, rates: bool) -> Iterator[Finding]:
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
            yield (*path, key), _unknown(key, [k for k in keys if k not in given])


def _of_joint(path: Path, joint: Joint, start: Start, *, rates: bool) -> Iterator[Finding]:
    ball = any(f.kind == "ball" for f in joint.freedoms)
    units = {f.name: f.unit for f in joint.named}
    if rates:
        units |= {name: f"{units[f.name]}/s" for name, f in joint.rates.items()}
    keys = [*units, *(["attitude"] if ball else []), *(["omega"] if ball and rates else [])]
    if start.attitude is not None and not ball:
        yield (*path, "attitude"), _unknown("attitude", keys, joint.kind)
    for key, entry in start.entries.items():
        if key in units:
            yield from _number((*path, key), entry, units[key])
        elif key in keys:
            yield from _vector((*path, key), entry, "rad/s")
        else:
            yield (
                (*path, key),
                _unknown(key, [k for k in keys if k not in start.entries], joint.kind),
            )


def _against_drives(path: Path, scene: Scene, start: Start) -> Iterator[Finding]:
    for key, given in start.given.items():
        yield from agrees((*path, key), given, scene.drives.get(f"{path[-1]}.{key}"))


def _unknown(key: str, known: list[str], kind: str = "") -> str:
    if kind and not known:
        return f"unknown key {key!r}; of this {kind} nothing more can be given"
    close = nearest(key, known)
    return f"unknown key {key!r}{close if 'did you mean' in close else listed(known)}"


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
        fitting(amount, unit)
    except NumberMistake as mistake:
        yield path, str(mistake)
