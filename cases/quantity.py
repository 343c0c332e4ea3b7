"""The one table of quantities that can be observed, with units and kinds.

A quantity is written `part.field`: `crank.angle`, `crank.end.x`, `hinge.force`, `energy.total`.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Literal

from .scene import Scene

Kind = Literal["coordinate", "velocity", "force", "energy", "momentum", "residual", "event"]

_POINT: dict[str, tuple[str, Kind]] = {
    "x": ("m", "coordinate"),
    "y": ("m", "coordinate"),
    "vx": ("m/s", "velocity"),
    "vy": ("m/s", "velocity"),
    "speed": ("m/s", "velocity"),
}
_TURNING: dict[str, tuple[str, Kind]] = {
    "angle": ("rad", "coordinate"),
    "omega": ("rad/s", "velocity"),
}
_JOINT: dict[str, tuple[str, Kind]] = {
    "fx": ("N", "force"),  # what the first part exerts on the second, in ground axes
    "fy": ("N", "force"),
    "force": ("N", "force"),  # its magnitude
    "gap": ("m", "residual"),  # constraint drift
}
_LOCKED: dict[str, tuple[str, Kind]] = {"torque": ("N m", "force")}  # a slide or weld holds angles
_RUBBING: dict[str, tuple[str, Kind]] = {
    "friction": ("N", "force"),  # on the second part, along the slide
    "slip": ("m/s", "residual"),  # of the second part along the slide; zero while it sticks
}
_CONTACT: dict[str, tuple[str, Kind]] = {
    "normal": ("N", "force"),
    "tangent": ("N", "force"),
    "slip": ("m/s", "residual"),  # of the point that touches
    "gap": ("m", "residual"),  # its height
    "drift": ("m", "residual"),  # its x (of a disk x + R angle) against the start: (2.18)
}
_LINE: dict[str, tuple[str, Kind]] = {
    "length": ("m", "coordinate"),
    "force": ("N", "force"),  # tension: positive when it pulls its ends together
}
_ENERGY: dict[str, tuple[str, Kind]] = {
    "kinetic": ("J", "energy"),
    "potential": ("J", "energy"),
    "total": ("J", "energy"),
}
_MOMENTUM: dict[str, tuple[str, Kind]] = {
    "x": ("kg m/s", "momentum"),
    "y": ("kg m/s", "momentum"),
    "angular": ("kg m²/s", "momentum"),  # about the origin
}
_EVENT: dict[str, tuple[str, Kind]] = {
    "time": ("s", "event"),
    "count": ("1", "event"),  # how often it happens
}
EVENT_FIELDS = tuple(_EVENT)
RESERVED = ("energy", "momentum", "ground")


@dataclass(frozen=True)
class Quantity:
    """One observable: `part` is `crank`, `crank.end`, `hinge`, `energy`."""

    name: str
    part: str
    field: str
    unit: str
    kind: Kind


def table(scene: Scene) -> dict[str, Quantity]:
    """Every quantity of the scene by name, in the scene's order."""
    parts: dict[str, dict[str, tuple[str, Kind]]] = {}
    for body in scene.bodies.values():
        parts[body.name] = _POINT | (_TURNING if body.turns else {})
        parts |= {f"{body.name}.{point}": _POINT for point in body.points}
    for joint in scene.joints.values():
        locked = {} if joint.kind == "pin" else _LOCKED
        parts[joint.name] = _JOINT | locked | (_RUBBING if joint.dry_friction else {})
    parts |= dict.fromkeys(scene.contacts, _CONTACT)
    for line in (*scene.springs(), *scene.dampers()):
        parts[line.name] = _LINE
    return _named(parts | {"energy": _ENERGY, "momentum": _MOMENTUM})


def event_quantities(events: Iterable[str]) -> dict[str, Quantity]:
    """What can be bounded of each named event."""
    return _named(dict.fromkeys(events, _EVENT))


def _named(parts: Mapping[str, Mapping[str, tuple[str, Kind]]]) -> dict[str, Quantity]:
    return {
        f"{part}.{field}": Quantity(f"{part}.{field}", part, field, unit, kind)
        for part, fields in parts.items()
        for field, (unit, kind) in fields.items()
    }


def nearest(word: str, words: Iterable[str]) -> str:
    """A hint: `; did you mean 'crank.angle'?`, or what there is, or nothing."""
    known = list(words)
    close = get_close_matches(word, known, n=1, cutoff=0.6)
    if close:
        return f"; did you mean {close[0]!r}?"
    return f"; known: {', '.join(known)}" if 0 < len(known) <= 12 else ""
