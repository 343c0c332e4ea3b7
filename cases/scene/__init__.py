"""The scene of Definition 2.1 as data: bodies, joints, contacts, forces and points.

Neutral: it names no engine and no method. Planar frame: x right, y up, angles
counter-clockwise, SI units. What a scene is made of can be imported from here.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import wraps
from typing import TypeVar

from ..fields.friction import Bounds, DryFriction, Smooth, Stribeck
from ..fields.kind import WORK, Fields
from ..fields.signal import Signal
from .body import Body
from .constraint import Edge
from .contact import Contact
from .forces.element import Limit
from .forces.force import (
    Couple,
    Damper,
    Drag,
    Force,
    LinearMuscle,
    Magnetic,
    Motor,
    Muscle,
    Push,
    Spring,
    Torque,
    Torsion,
    TorsionDamper,
    Viscous,
    of_kind,
)
from .frame import PLANE, Frame
from .joint import Joint, planar_joint
from .pair import Pair
from .point import CENTER, FLOOR, GROUND, Anchor, GroundPoint, Vector

__all__ = [
    "CENTER",
    "FLOOR",
    "GROUND",
    "STANDARD_GRAVITY",
    "Anchor",
    "Body",
    "Bounds",
    "Contact",
    "Damper",
    "Drag",
    "DryFriction",
    "Edge",
    "Force",
    "Frame",
    "GroundPoint",
    "Joint",
    "Limit",
    "LinearMuscle",
    "Magnetic",
    "Motor",
    "Muscle",
    "Pair",
    "Push",
    "Scene",
    "Signal",
    "Smooth",
    "Spring",
    "Stribeck",
    "Torque",
    "Torsion",
    "TorsionDamper",
    "Vector",
    "Viscous",
    "cached_by_scene",
    "planar_joint",
]

STANDARD_GRAVITY = 9.80665  # m/s², the book's value


@dataclass(frozen=True)
class Scene:
    """Bodies, joints, constraints, contacts and forces by name, in the order of the case file.

    All stand in the plane, or all in space: `scene.frame is SPACE` tells it. Beside `contacts` and
    `pairs` nothing touches, and what no joint holds is free.
    """

    gravity: Vector  # m/s², in ground axes; 0 where a scene has none
    points: Mapping[str, GroundPoint]  # of the ground, by name; they may move
    bodies: Mapping[str, Body]  # all that has mass
    joints: Mapping[str, Joint]  # each between two points of bodies or of the ground
    contacts: Mapping[str, Contact]  # with planes of the ground, as the file has them: see touching
    forces: Mapping[str, Force]  # all else that acts, of the kinds below
    constraints: Mapping[str, Edge] = field(default_factory=dict)  # blades that do not slip
    drives: Mapping[str, Signal] = field(default_factory=dict)
    """Prescribed rates [rad/s, m/s] of joints' freedoms, by the quantity: `hinge.omega`."""
    pairs: Mapping[str, Pair] = field(default_factory=dict)
    """The contacts of two bodies; `contacts` are those with planes of the ground."""

    frame: Frame = PLANE
    """PLANE or SPACE: what the columns of a body's states are."""

    def __post_init__(self) -> None:
        for section in (self.bodies, self.joints, self.constraints, self.contacts):
            for name, element in section.items():
                if element.frame is not self.frame:
                    raise ValueError(f"{name!r} is not of the scene's frame, {self.frame.name}")

    def __getstate__(self) -> dict[str, object]:
        """The fields without cached results (`cached_by_scene`), which are computed anew."""
        return {of.name: getattr(self, of.name) for of in fields(self)}

    def driven(self) -> Mapping[str, Fields]:
        """By joint, what prescribed rates exert: `hinge` → `torque`."""
        efforts: dict[str, Fields] = {}
        for quantity in self.drives:
            part, _, rate = quantity.rpartition(".")
            if part in self.joints and (freedom := self.joints[part].rates.get(rate)):
                efforts[part] = {**efforts.get(part, {}), **freedom.exerted}
        return efforts

    def working(self) -> Mapping[str, Fields]:
        """The field `work` of each part with a power: forces, and joints with prescribed rates."""
        names = [force.name for force in self.forces.values() if force.works]
        return dict.fromkeys((*names, *self.driven()), WORK)

    def coordinates(self) -> Mapping[str, Fields]:
        """By joint, what its freedoms are observed as."""
        return {name: joint.observed(self.bodies) for name, joint in self.joints.items()}

    def told_by(self, reaction: str) -> tuple[str, ...]:
        """The reactions of a producer from which one follows: in space `q1.force` from three."""
        part, _, field = reaction.rpartition(".")
        if part in self.forces:
            components = self.forces[part].given.get(field, (field,))
        elif field in WORK and part in self.joints:
            components = tuple(self.driven()[part])
        elif element := self.joints.get(part) or self.contacts.get(part):
            components = element.components(field)
        else:
            components = (field,)
        return tuple(f"{part}.{name}" for name in components)

    @property
    def touching(self) -> dict[str, Contact]:
        """One contact for every point that may touch the floor: of spokes, `feet.tip0` and on."""
        return {point.name: point for contact in self.contacts.values() for point in contact.each()}

    @property
    def pressed(self) -> tuple[str, ...]:
        """Whatever has a normal force and friction, by name: each point on a plane, each pair."""
        return (*self.touching, *self.pairs)

    def elements(self) -> Iterator[Body | Joint | Edge | Contact | Pair | Force]:
        """Yields each part that has a name, quantities and numbers."""
        linked = (self.bodies, self.joints, self.constraints)
        for section in (*linked, self.contacts, self.pairs, self.forces):
            yield from section.values()

    def springs(self) -> Iterator[Spring]:
        """The springs along a line."""
        return of_kind(Spring, self.forces.values())

    def one_sided(self) -> Iterator[Spring]:
        """The springs that only press or only pull."""
        return (spring for spring in self.springs() if spring.only)

    def limits(self) -> Iterator[Limit]:
        """The forces that hold on one side: ropes and stops."""
        return of_kind(Limit, self.forces.values())

    def dampers(self) -> Iterator[Damper]:
        """The dampers along a line."""
        return of_kind(Damper, self.forces.values())

    def signals(self) -> Iterator[Push | Torque | Couple | Motor]:
        """The forces and torques that are given in time."""
        kinds = (Push, Torque, Couple, Motor)
        return (f for kind in kinds for f in of_kind(kind, self.forces.values()))

    def inner(self) -> dict[str, Force]:
        """The forces with an inner state, by the quantity that it is."""
        return {f"{f.name}.{f.inner}": f for f in self.forces.values() if f.inner}

    def laws(self) -> Iterator[Signal]:
        """Yields each law in time, of forces and of what is prescribed."""
        yield from (force.signal for force in self.signals())
        yield from (law for edge in self.constraints.values() if (law := edge.speed) is not None)
        yield from self.drives.values()
        yield from (law for point in self.points.values() if (law := point.moves) is not None)

    def later(self, by: float) -> "Scene":
        """Returns the scene with all its laws in time from the time `by` [s] on."""
        moved = {f.name: replace(f, signal=f.signal.later(by)) for f in self.signals()}
        blades = {
            name: edge if edge.speed is None else replace(edge, speed=edge.speed.later(by))
            for name, edge in self.constraints.items()
        }
        drives = {quantity: law.later(by) for quantity, law in self.drives.items()}
        return replace(self, forces={**self.forces, **moved}, constraints=blades, drives=drives)

    def corners(self) -> list[float]:
        """When [s] one of the laws in time jumps or bends."""
        return [time for law in self.laws() for time in law.corners]

    def ends(self, force: Force) -> tuple[Anchor, ...]:
        """The points on which a force acts, or those of the joint about which it does."""
        return force.refers() if force.about is None else self.joints[force.about].refers()


Made = TypeVar("Made")


def cached_by_scene(make: Callable[[Scene], Made]) -> Callable[[Scene], Made]:
    """Decorate a function of a scene so that each scene keeps its result.

    The answer is handed out as it is: whoever asks does not change it.
    """
    name = f"{make.__module__}.{make.__qualname__}"

    @wraps(make)
    def cached(scene: Scene) -> Made:
        cache = vars(scene)  # as functools.cached_property does
        if name not in cache:
            cache[name] = make(scene)
        return cache[name]

    return cached
