"""The grammar's models → the nouns of the project."""

from collections.abc import Mapping
from dataclasses import replace
from math import cos, sin
from typing import Any

from ..case import Case, Deviation, Event, Placement
from ..mistake import Source
from ..origin import Origin
from ..scene import STANDARD_GRAVITY, Scene
from ..scene.frame import PLANE, SPACE
from ..scene.joint import Joint
from ..scene.point import CENTER, anchor
from ..scene.rotation import UPRIGHT
from .grammar.file import File
from .grammar.file import Source as Book


def resolve_scene(file: File) -> Scene:
    """The scene, with its references as they stand (check/links.py checks them)."""
    s: Any = file.scene
    in_space = s.space is not None
    bodies, planes = _by_name(s.bodies), {} if in_space else _by_name(s.planes)
    pairs = {} if in_space else {n: c for n, c in s.contacts.items() if c.pairs(bodies)}
    joints, contacts = _by_name(s.joints), {n: c for n, c in s.contacts.items() if n not in pairs}
    if in_space:
        starts = {**file.near, **file.initial}
        joints = {name: _with_start(joint, starts.get(name)) for name, joint in joints.items()}
        down, slope = (0.0, 0.0, -1.0), (1.0, 0.0, 0.0)
    else:
        down, slope = (0.0, 0.0 if s.seen else -1.0), (1.0, 0.0)
    return Scene(
        gravity=_gravity(s.gravity, s.incline, slope, down),
        points=s.points,
        bodies=bodies,
        joints=joints,
        contacts={n: contact.named(n, bodies, planes) for n, contact in contacts.items()},
        forces=_by_name(s.forces),
        constraints=_by_name(s.constraints),
        drives={rate: drive.signal for rate, drive in s.drive.items()},
        pairs={n: contact.paired(n) for n, contact in pairs.items()},
        frame=SPACE if in_space else PLANE,
    )


def _with_start(joint: Joint, start: Any) -> Joint:
    """The joint with its start angles, from which turns in space are counted."""
    given = {} if start is None else start.given
    turns = [turn.name for turn in joint.turns if turn.name in given]
    return replace(joint, begins={name: given[name] for name in turns})


def _by_name(elements: Mapping[str, Any]) -> dict[str, Any]:
    return {name: element.named(name) for name, element in elements.items()}


def _origin(book: Book) -> Origin:
    """Where the case comes from."""
    return Origin(
        book.equations, book.example, book.exercise, book.figures, book.section, book.thread
    )


def resolve_case(name: str, file: File, scene: Scene, source: Source, *, long: bool) -> Case:
    """The case of a file without mistakes."""
    states = None if file.states is None else file.states.states
    return Case(
        name=name,
        title=file.title,
        origin=_origin(file.source),
        system=file.system,
        parameters={name: amount.value for name, amount in file.parameters.items()},
        drops_out=file.drops_out,
        scene=scene,
        initial=_with_free_attitudes(_placements(file.initial, scene), scene, file.events),
        near=_placements(file.near, scene),
        duration=file.duration if states is None else states.random - 1.0,
        samples=file.samples if states is None else states.random,
        states=states,
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
            event: Event(quantity, rule.word, rule.to.value)
            for event, rules in file.events.items()
            for quantity, rule in rules.items()
        },
        source=source,
        tube=file.tube,
        long=long,
    )


def _gravity(
    given: Any, incline: float | None, slope: tuple[float, ...], down: tuple[float, ...]
) -> Any:
    """A vector of its own, or so strong, from straight down towards x by the incline."""
    if isinstance(given, tuple):
        return given
    g = STANDARD_GRAVITY if given is None else given
    along, across = g * sin(incline or 0.0), g * cos(incline or 0.0)
    return tuple(along * x + across * d + 0.0 for x, d in zip(slope, down, strict=True))


def _placements(places: Mapping[str, Any], scene: Scene) -> dict[str, Placement]:
    given = {name: place.given | _polar(place.polar, scene) for name, place in places.items()}
    return {
        name: Placement(
            given[name], dict(place.places), place.attitude, place.stands_on, place.polar
        )
        for name, place in places.items()
    }


def _with_free_attitudes(
    starts: dict[str, Placement], scene: Scene, events: Mapping[str, Mapping[str, Any]]
) -> dict[str, Placement]:
    """The starts, with attitude 0 for each disk or sphere whose attitude changes nothing."""
    in_space = scene.frame is not PLANE
    marks = [name.split(".", 1) for rules in events.values() for name in rules]
    joints = [
        joint
        for joint in scene.joints.values()
        if [joint.name, "angle"] in marks or not _turns_alike(joint, starts, scene)
    ]
    oriented = {at.body for joint in joints for at in joint.refers()}
    oriented |= {part for part, field in marks if field == "angle" or "." in field}  # of a point
    elements = (
        *scene.constraints.values(),
        *scene.forces.values(),
        *scene.contacts.values(),
        *scene.joints.values(),
    )
    oriented |= {at.body for element in elements for at in element.refers() if at.point != CENTER}
    oriented |= {element.at.body for element in scene.constraints.values()}
    directed = (force for force in scene.forces.values() if getattr(force, "along", None))
    oriented |= {at.body for force in directed for at in force.refers()}
    shape = "sphere" if in_space else "disk"  # each looks alike however it is turned
    free = (b.name for b in scene.bodies.values() if b.shape == shape and b.name not in oriented)
    placements = dict(starts)
    for name in free:
        place = starts.get(name, Placement())
        if in_space and place.attitude is None and not place.points:
            placements[name] = replace(place, attitude=UPRIGHT)
        elif not (in_space or "angle" in place.given or place.points or place.on):
            placements[name] = replace(place, given={**place.given, "angle": 0.0})
    return placements


def _turns_alike(joint: Joint, starts: Mapping[str, Placement], scene: Scene) -> bool:
    """Whether a joint holds both parts in the same way however they are turned.

    So does what holds nothing but their distance or a point, and gives and is driven by no angle.
    """
    kinds = {freedom.kind for freedom in joint.freedoms}
    given = starts.get(joint.name, Placement())
    winds = any(force.winds for force in scene.forces.values() if force.about == joint.name)
    driven = any(quantity.startswith(f"{joint.name}.") for quantity in scene.drives)
    has_start = given.attitude is not None or any(turn.name in given.given for turn in joint.turns)
    turning = {"turn"} if scene.frame is PLANE else {"ball"}
    return turning <= kinds <= {*turning, "swing"} and not (has_start or winds or driven)


def _polar(given: tuple[str, float, float] | None, scene: Scene) -> dict[str, float]:
    """x and y from polar coordinates about a point of the ground."""
    if given is None or (point := anchor(given[0]).point) not in scene.points:
        return {}  # the latter is a mistake, see check/start.py
    (x, y, *_), (_, length, direction) = scene.points[point].state(0.0), given
    return {"x": x + length * cos(direction), "y": y + length * sin(direction)}
