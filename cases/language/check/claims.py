"""Bounds and events against the quantities that the scene has."""

from collections.abc import Iterator, Mapping

from ...fields.kind import WORK
from ...fields.number import Amount, NumberMistake, check_unit
from ...mistake import Path, nearest
from ...scene import Scene
from ...scene.joint import WORDS
from ...scene.quantity import EVENT_FIELDS, Quantity, at_event, at_events, event_quantities, table
from ...scene.states import claimable
from ..parse import Finding, Parsed


def claims(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Mistakes in `events`, `allow`, `reach` and `deviates`."""
    known = table(scene) if parsed.file.states is None else claimable(scene)
    yield from _events(parsed, scene, known)
    events = parsed.file.events
    yield from _bounds(parsed, known | event_quantities(events) | at_events(events, known))


def _events(parsed: Parsed, scene: Scene, known: Mapping[str, Quantity]) -> Iterator[Finding]:
    for event, rules in parsed.file.events.items():
        for name, rule in rules.items():
            path = ("events", event, name)
            if name not in known:
                yield from _unknown(parsed, known, path, name)
            elif not _marks_event(scene, known[name]):
                what = "its zero marks no event; take a place, a velocity, a slip or a force"
                yield path, what
            else:
                yield from _check_unit(path, rule.to, known[name])


def _marks_event(scene: Scene, quantity: Quantity) -> bool:
    """Whether something happens at its zero: of an energy that is arbitrary, drift is numerical."""
    drift = quantity.field == "drift" or (quantity.field == "gap" and quantity.part in scene.joints)
    drift |= quantity.field == "slip" and quantity.part in scene.constraints
    turns = quantity.field == "attitude"
    return quantity.kind not in ("energy", "momentum", "acceleration") and not drift and not turns


def _bounds(parsed: Parsed, known: Mapping[str, Quantity]) -> Iterator[Finding]:
    file = parsed.file
    if ("allow",) in parsed.broken:
        return
    for name, bound in file.allow.items():
        yield from _quantity(parsed, known, ("allow", name), name, bound)
    for i, name in enumerate(file.stays):
        if name not in file.allow:
            yield from _check_allowed(parsed, known, ("stays", i), name)
        elif name in known and known[name].kind not in ("coordinate", "velocity"):
            yield ("stays", i), f"{name!r} is no place and no velocity, and may stay as it is"
    for way, reached in file.reach.items():
        for name, bound in reached.items():
            path = ("reach", way, name)
            yield from _check_allowed(parsed, known, path, name, bound)
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
                yield from _check_allowed(parsed, known, path, name, size)
                if allow is not None and size.value <= allow.value:
                    yield path, f"{size.value:g} is not above its `allow`, {allow.value:g}"


def _quantity(
    parsed: Parsed,
    known: Mapping[str, Quantity],
    path: Path,
    name: str,
    bound: Amount | None,
) -> Iterator[Finding]:
    if name not in known:
        yield from _unknown(parsed, known, path, name)
    elif bound is not None:
        yield from _check_unit(path, bound, known[name])


def _check_unit(path: Path, given: Amount, quantity: Quantity) -> Iterator[Finding]:
    try:
        check_unit(given, quantity.unit)
    except NumberMistake as mistake:
        yield path, str(mistake)


def _check_allowed(
    parsed: Parsed,
    known: Mapping[str, Quantity],
    path: Path,
    name: str,
    bound: Amount | None = None,
) -> Iterator[Finding]:
    if name in parsed.file.allow or ("allow", name) in parsed.broken:
        yield from _quantity(parsed, known, path, name, bound)
    elif not _may_exist(parsed, name):
        yield path, f"{name!r} is not in `allow`{nearest(name, parsed.file.allow)}"


def _unknown(
    parsed: Parsed, known: Mapping[str, Quantity], path: Path, name: str
) -> Iterator[Finding]:
    part, _, field = name.rpartition(".")
    if _may_exist(parsed, name):
        return
    if field in EVENT_FIELDS and path[0] != "events":
        events = parsed.file.events
        hint = nearest(part, events) if events else "; the case has no `events`"
        yield path, f"{part!r} is no event{hint}"
    elif (at := at_event(name, parsed.file.events)) and at.quantity in EVENT_FIELDS:
        yield path, f"'{at.event}.{at.quantity}' has no before and no after"
    elif field in ("friction", "slip") and f"{part}.fx" in known:  # a joint without it
        yield path, f"{part!r} has no `dry_friction`, so no {name!r}"
    elif _needs_drive(known, part, field) or (field in WORK and part in parsed.file.scene.joints):
        yield path, f"no `drive` prescribes the rate, so no {name!r}"
    elif field in WORDS and f"{part}.gap" in known and part in parsed.file.scene.joints:
        yield path, _no_freedom(known, part, field)
    elif field == "angle" and f"{part}.attitude" in known:
        yield path, f"a body in space has no angle; its quantity is '{part}.attitude'"
    elif alike := [f"{part}.{x}" for x in ALIKE.get(field, ()) if f"{part}.{x}" in known]:
        yield path, f"unknown quantity {name!r}; did you mean {alike[0]!r}?"
    elif field in FORCES and part in parsed.file.scene.bodies:
        names = ", ".join(f"'{force}'" for force in _forces(parsed, part, known))
        yield (
            path,
            f"a body has no {field}; forces belong to joints and what acts: {names or 'none'}",
        )
    else:
        yield path, f"unknown quantity {name!r}{nearest(name, known)}"


FORCES = ("force", "tension", "reaction", "fx", "fy", "fz", "load")
ALIKE = {
    **dict.fromkeys(("theta", "phi", "rotation", "orientation", "yaw"), ("angle", "attitude")),
    **dict.fromkeys(("theta_dot", "angular_velocity", "rate", "w"), ("omega",)),
    **dict.fromkeys(("angular_acceleration", "omega_dot"), ("alpha",)),
    **dict.fromkeys(("position", "displacement"), ("shift", "x")),
    **dict.fromkeys(("velocity", "v"), ("speed", "vx")),
    **dict.fromkeys(("acceleration", "a"), ("ax",)),
    **dict.fromkeys(("tension", "reaction", "load"), ("force",)),
    **dict.fromkeys(("penetration", "depth", "distance"), ("gap", "length")),
    "normal_force": ("normal",),
    **dict.fromkeys(("tangential", "friction_force"), ("tangent", "friction")),
}
"""For each word that others use for a quantity: its names here, of which the first found counts."""


def _forces(parsed: Parsed, body: str, known: Mapping[str, Quantity]) -> Iterator[str]:
    """The forces on a body that can be observed, by what exerts them."""
    scene = parsed.file.scene
    for section in (scene.joints, scene.constraints, scene.forces):
        for name, element in section.items():
            on_body = any(at.body == body for at in element.named(name).refers())
            if on_body and (force := f"{name}.force") in known:
                yield force


def _no_freedom(known: Mapping[str, Quantity], part: str, field: str) -> str:
    """Why a joint has no coordinate of this name, in words."""
    coordinates = [f"'{part}.{name}'" for name in WORDS if f"{part}.{name}" in known]
    has = f"it has {' and '.join(coordinates)}" if coordinates else "it leaves nothing that has one"
    return f"{part!r} has no {field}: {has}"


def _may_exist(parsed: Parsed, name: str) -> bool:
    """Whether the part or event that the quantity is of may be there, but is unsound."""
    part, field = name.split(".")[0], name.split(".")[-1]
    event = at_event(name, parsed.file.events)
    unsound = field in EVENT_FIELDS and ("events",) in parsed.broken
    undriven = any(path[:2] == ("scene", "drive") for path in parsed.broken)
    return (
        parsed.hides(part)
        or (event is not None and parsed.hides(event.quantity.split(".")[0]))
        or ("events", part) in parsed.broken
        or unsound
        or (field.endswith(("force", "torque")) and undriven)
    )


def _needs_drive(known: Mapping[str, Quantity], part: str, field: str) -> bool:
    """Whether a joint would have this quantity if its freedom were driven."""
    coordinate, _, effort = field.rpartition("_")
    coordinate = coordinate or "angle"
    joint = f"{part}.gap" in known and f"{part}.{coordinate}" in known
    return joint and effort in ("force", "torque")
