"""The grammar's models → the nouns of the project."""

from collections.abc import Mapping
from math import cos, sin
from typing import Any

from ..case import Case, Deviation, Event, Origin, Placement
from ..mistake import Source
from ..scene import STANDARD_GRAVITY, Scene, Vector
from .grammar.file import File, Near

_COORDINATES = ("x", "y", "angle", "vx", "vy", "omega")


def resolve_scene(file: File) -> Scene:
    """The scene, with its references as they stand (check/links.py checks them)."""
    s = file.scene
    return Scene(
        gravity=_gravity(s.gravity, s.incline),
        points=s.points,
        bodies=_named(s.bodies),
        joints=_named(s.joints),
        contacts=_named(s.contacts),
        forces=_named(s.forces),
    )


def _named(elements: Mapping[str, Any]) -> dict[str, Any]:
    return {name: element.named(name) for name, element in elements.items()}


def resolve_case(name: str, file: File, scene: Scene, source: Source, *, long: bool) -> Case:
    """The case of a file without mistakes."""
    book = file.source
    return Case(
        name=name,
        title=file.title,
        origin=Origin(book.equations, book.example, book.exercise, book.figure, book.section),
        system=file.system,
        parameters={name: amount.value for name, amount in file.parameters.items()},
        drops_out=file.drops_out,
        scene=scene,
        initial=_placements(file.initial),
        near=_placements(file.near),
        duration=file.duration,
        samples=file.samples,
        step=file.step,
        allow={q: None if amount is None else amount.value for q, amount in file.allow.items()},
        reach={
            way: {q: amount.value for q, amount in bounds.items()}
            for way, bounds in file.reach.items()
        },
        deviates={
            setting: {
                q: Deviation(
                    d.because,
                    limit=None if d.limit is None else d.limit.value,
                    by=None if d.by is None else (d.by[0].value, d.by[1].value),
                )
                for q, d in known.items()
            }
            for setting, known in file.deviates.items()
        },
        rests=file.rests,
        stays=file.stays,
        events={
            event: Event(quantity, rule)  # type: ignore[arg-type]  # the grammar's word
            for event, rules in file.events.items()
            for quantity, rule in rules.items()
        },
        source=source,
        long=long,
    )


def _gravity(gravity: str | None, incline: float | None) -> Vector:
    if gravity == "none":
        return (0.0, 0.0)
    if incline is None:
        return (0.0, -STANDARD_GRAVITY)
    return (STANDARD_GRAVITY * sin(incline), -STANDARD_GRAVITY * cos(incline))


def _placements(places: Mapping[str, Near]) -> dict[str, Placement]:
    return {
        body: Placement(
            given={c: v for c in _COORDINATES if (v := getattr(place, c, None)) is not None},
            points=dict(place.places),
        )
        for body, place in places.items()
    }
