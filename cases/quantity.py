"""The table of quantities that can be observed, with units and kinds.

A quantity is written `part.field`: `crank.angle`, `crank.end.x`, `hinge.force`, `energy.total`.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from .kind import Fields, Kind
from .scene import Scene

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
    parts: dict[str, Fields] = {}
    for element in scene.elements():
        parts |= element.quantities()
    for joint, exerted in scene.driven().items():
        parts[joint] = {**parts[joint], **exerted}
    momentum = _MOMENTUM if scene.frame.dimension == 2 else _SPATIAL_MOMENTUM
    return _named(parts | {"energy": _ENERGY, "momentum": momentum})


def event_quantities(events: Iterable[str]) -> dict[str, Quantity]:
    """What can be bounded of each named event."""
    return _named(dict.fromkeys(events, _EVENT))


def _named(parts: Mapping[str, Fields]) -> dict[str, Quantity]:
    return {
        f"{part}.{field}": Quantity(f"{part}.{field}", part, field, unit, kind)
        for part, fields in parts.items()
        for field, (unit, kind) in fields.items()
    }
