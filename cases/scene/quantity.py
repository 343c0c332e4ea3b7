"""The table of quantities that can be observed, with units and kinds.

A quantity is written `part.field`: `crank.angle`, `crank.end.x`, `hinge.force`, `energy.total`.
At an event it is written behind the event's name: `lands.crank.angle`, `lands.crank.omega.after`.
"""

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from ..fields.event import Event
from ..fields.kind import Fields, Kind
from . import Scene, cached_by_scene

_ENERGY: Fields = {
    "kinetic": ("J", "energy"),
    "potential": ("J", "energy"),
    "total": ("J", "energy"),
}
_MOMENTUM: Fields = {
    "x": ("kg m/s", "momentum"),
    "y": ("kg m/s", "momentum"),
    "angular": ("kg m²/s", "momentum"),  # about the origin
}
_SPATIAL_MOMENTUM: Fields = {
    **dict.fromkeys("xyz", ("kg m/s", "momentum")),
    **{f"angular_{axis}": ("kg m²/s", "momentum") for axis in "xyz"},  # about the origin
}
_EVENT: Fields = {
    "time": ("s", "event"),
    "count": ("1", "event"),  # how often it happens
}
EVENT_FIELDS = tuple(_EVENT)
Side = Literal["", "before", "after"]
NOT_AT_EVENTS = ("attitude", "work")  # turns have no curve, and sums are over samples
SIDES: tuple[Side, ...] = ("", "before", "after")


@dataclass(frozen=True)
class Quantity:
    """One observable: `part` is `crank`, `crank.end`, `hinge`, `energy`."""

    name: str  # as it is written: `crank.end.x`
    part: str  # whose it is
    field: str  # what of it
    unit: str  # SI
    kind: Kind  # what it is told by: a place, a velocity, a force, …


@cached_by_scene
def table(scene: Scene) -> MappingProxyType[str, Quantity]:
    """Every quantity of the scene by name, in the scene's order."""
    parts: dict[str, Fields] = {}
    for element in scene.elements():
        parts |= element.quantities()
    for more in (scene.coordinates(), scene.driven(), scene.working()):
        for part, fields in more.items():
            parts[part] = {**parts.get(part, {}), **fields}
    momentum = _MOMENTUM if scene.frame.dimension == 2 else _SPATIAL_MOMENTUM
    return MappingProxyType(_named(parts | {"energy": _ENERGY, "momentum": momentum}))


def event_quantities(events: Iterable[str]) -> dict[str, Quantity]:
    """The quantities that can be bounded of each named event, by name."""
    return _named(dict.fromkeys(events, _EVENT))


@dataclass(frozen=True)
class AtEvent:
    """A quantity right at an event: just before or after it, if it jumps there."""

    event: str
    quantity: str
    side: Side


def at_event(name: str, events: Container[str]) -> AtEvent | None:
    """Reads `takes_off.jumper.vx` or `strikes.wheel.omega.after`; None of anything else."""
    event, _, rest = name.partition(".")
    if event not in events or rest in EVENT_FIELDS:
        return None
    quantity, _, last = rest.rpartition(".")
    return AtEvent(event, quantity, last) if last in SIDES[1:] else AtEvent(event, rest, "")


def needed_by_events(events: Mapping[str, Event], bounded: Iterable[str]) -> list[str]:
    """The quantities of the events, and those with bounds at an event."""
    names = [event.quantity for event in events.values()]
    return names + [at.quantity for name in bounded if (at := at_event(name, events))]


def at_events(events: Iterable[str], known: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Every quantity at every event, by name."""
    return {
        quantity.name: quantity
        for event in events
        for base in known.values()
        if base.field not in NOT_AT_EVENTS
        for quantity in _sides(event, base)
    }


def _sides(event: str, base: Quantity) -> Iterator[Quantity]:
    for side in SIDES:
        field = ".".join((base.name, side)) if side else base.name
        yield Quantity(f"{event}.{field}", event, field, base.unit, base.kind)


def _named(parts: Mapping[str, Fields]) -> dict[str, Quantity]:
    return {
        f"{part}.{field}": Quantity(f"{part}.{field}", part, field, unit, kind)
        for part, fields in parts.items()
        for field, (unit, kind) in fields.items()
    }
