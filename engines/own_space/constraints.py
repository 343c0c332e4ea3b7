"""Constraints of a Space: each by its class, in the words of a case file.

Those that turn or hold an angle are read after the joints about which they do. In a case file a
joint's angle is that of its second part against its first, and the ground's is 0; of pymunk's
static bodies it need not be.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import Any

from pymunk.body import Body
from pymunk.constraints import (
    Constraint,
    DampedRotarySpring,
    DampedSpring,
    GearJoint,
    GrooveJoint,
    PinJoint,
    PivotJoint,
    RotaryLimitJoint,
    SimpleMotor,
    SlideJoint,
)

from .reading import Reading, Within

ALIKE = 1e-9  # of a rate: what rounding leaves of a difference
NO_TURN = "has a word only beside a PivotJoint or a GrooveJoint of the same two bodies"
SECOND = "is the second of its kind between these bodies, and has no word"


@dataclass
class Links:
    """The reading, and the joints that let two bodies turn, by these two bodies."""

    reading: Reading
    turning: dict[tuple[Body | None, Body | None], str] = field(default_factory=dict[Any, str])

    def part(self, body: Body) -> Body | None:
        """Returns the body; None for the ground."""
        return body if self.reading.moves(body) else None

    def turn(self, c: Constraint, place: str) -> tuple[str, float, float]:
        """Returns the joint about which it acts, with s and o: b.angle − a.angle = s φ + o.

        φ is the joint's angle in a case file. Refuses it where there is no such joint.
        """
        a, b = self.part(c.a), self.part(c.b)
        offset = (0.0 if b else c.b.angle) - (0.0 if a else c.a.angle)
        if (a, b) in self.turning:
            return self.turning[a, b], 1.0, offset
        if (b, a) not in self.turning:
            self.reading.refuse(place, NO_TURN)
        return self.turning.get((b, a), ""), -1.0, offset


def read_constraints(reading: Reading) -> None:
    """Reads all constraints of the Space; what has no word is refused by its place."""
    links = Links(reading)
    rest = list[tuple[Callable[..., None], Any, str, str]]()
    for k, c in enumerate(reading.space.constraints):
        place, name = f"space.constraints[{k}]: {type(c).__name__}", f"constraint{k}"
        of = next((kind for kind in type(c).__mro__ if kind in JOINTS or kind in TURNS), None)
        if of is None:
            reading.refuse(place, "has no word")
            continue
        _check_common(links, c, of, place)
        if of in JOINTS:
            JOINTS[of](links, c, name, place)
        else:
            rest.append((TURNS[of], c, name, place))
    for read, c, name, place in rest:
        joint, sense, offset = links.turn(c, place)
        if joint:
            read(reading, c, name, place, joint, sense, offset)


def _check_common(links: Links, c: Constraint, of: type, place: str) -> None:
    if c.pre_solve or c.post_solve:
        links.reading.refuse(place, "calls code of yours, which has no word")
    if c.max_force < inf and of not in BOUNDED:
        links.reading.refuse(place, f"has a max_force, {c.max_force:g}, which has no word")


def _ends(links: Links, c: Any, name: str, place: str, first: Any) -> tuple[str, str]:
    reading = links.reading
    return (
        reading.anchor(c.a, first, f"{name}_a", place),
        reading.anchor(c.b, c.anchor_b, f"{name}_b", place),
    )


def _bound_force(links: Links, c: Constraint, name: str, place: str) -> None:
    if c.max_force < inf:
        at = f"needs more than its max_force, {c.max_force:g}"
        links.reading.withins.append(Within(f"{name}.force", -inf, c.max_force, place, at))


def _pivot(links: Links, c: PivotJoint, name: str, place: str) -> None:
    links.reading.joints[name] = {"pin": _ends(links, c, name, place, c.anchor_a)}
    links.turning.setdefault((links.part(c.a), links.part(c.b)), name)
    _bound_force(links, c, name, place)


def _rod(links: Links, c: PinJoint | SlideJoint, length: float, name: str, place: str) -> None:
    pair = _ends(links, c, name, place, c.anchor_a)
    links.reading.joints[name] = {"distance": pair, "length": length}
    _bound_force(links, c, name, place)


def _pin(links: Links, c: PinJoint, name: str, place: str) -> None:
    _rod(links, c, c.distance, name, place)


def _slide(links: Links, c: SlideJoint, name: str, place: str) -> None:
    if c.min == c.max:
        _rod(links, c, c.max, name, place)
        return
    pair = _ends(links, c, name, place, c.anchor_a)
    links.reading.forces[name] = {"rope": pair, "length": c.max}
    if c.min > 0.0:
        at = "comes to its min, at which nothing in a case file holds"
        links.reading.withins.append(Within(f"{name}.length", c.min, inf, place, at))
    _bound_force(links, c, name, place)


def _groove(links: Links, c: GrooveJoint, name: str, place: str) -> None:
    along = c.groove_b - c.groove_a
    direction = along if links.part(c.a) else along.rotated(c.a.angle)
    pair = _ends(links, c, name, place, c.groove_a)
    links.reading.joints[name] = {"slot": pair, "along": tuple(direction.normalized())}
    links.turning.setdefault((links.part(c.a), links.part(c.b)), name)
    at = "comes to an end of its groove, at which nothing in a case file holds"
    links.reading.withins.append(Within(f"{name}.shift", 0.0, along.length, place, at))
    _bound_force(links, c, name, place)


def _spring(links: Links, c: DampedSpring, name: str, place: str) -> None:
    if c.force_func is not DampedSpring.spring_force:
        links.reading.refuse(place, "has a force_func of yours, which has no word")
    pair = _ends(links, c, name, place, c.anchor_a)
    if c.stiffness:
        spring = {"spring": pair, "stiffness": c.stiffness, "rest_length": c.rest_length}
        links.reading.forces[name] = spring
    if c.damping:
        links.reading.forces[f"{name}_damper"] = {"damper": pair, "damping": c.damping}


def _rotary_spring(
    r: Reading, c: DampedRotarySpring, name: str, place: str, joint: str, s: float, o: float
) -> None:
    """Read a rotary spring: pymunk's torque on b is c (a.angle − b.angle − rest_angle).

    So φ rests at −s (rest_angle + o).
    """
    if c.torque_func is not DampedRotarySpring.spring_torque:
        r.refuse(place, "has a torque_func of yours, which has no word")
    if c.stiffness:
        rest = f"{-s * (c.rest_angle + o)} rad"
        r.forces[name] = {"torsion": joint, "stiffness": c.stiffness, "rest_angle": rest}
    if c.damping:
        r.forces[f"{name}_damper"] = {"torsion_damper": joint, "damping": c.damping}


def _limit(
    r: Reading, c: RotaryLimitJoint, name: str, place: str, joint: str, s: float, o: float
) -> None:
    low, high = sorted((s * (c.min - o), s * (c.max - o)))
    ends = {"low": low, "high": high}
    r.forces[name] = {"stops": joint} | {k: f"{x} rad" for k, x in ends.items() if abs(x) < inf}


def _motor(
    r: Reading, c: SimpleMotor, name: str, place: str, joint: str, s: float, o: float
) -> None:
    """Read a motor: its rate is of a against b; bounded and at rest it is friction."""
    rate, now = -s * c.rate, s * (c.b.angular_velocity - c.a.angular_velocity)
    if f"{joint}.omega" in r.drive or "dry_friction" in r.joints[joint]:
        r.refuse(place, SECOND)
    if c.max_force < inf and not c.rate:
        if "pin" in r.joints[joint]:
            r.joints[joint]["dry_friction"] = {"kinetic": c.max_force}
        else:
            r.refuse(place, "rubs in a groove, which has no word: in a PivotJoint it does")
        return
    if abs(rate - now) > ALIKE * abs(rate):
        r.refuse(place, f"asks for a rate of {rate:g}, which is {now:g} at the start: start at it")
    r.drive[f"{joint}.omega"] = rate
    if c.max_force < inf:
        at = f"needs more than its max_force, {c.max_force:g}"
        r.withins.append(Within(f"{joint}.torque", -c.max_force, c.max_force, place, at))


def _gear(r: Reading, c: GearJoint, name: str, place: str, joint: str, s: float, o: float) -> None:
    """Read a gear: with the ratio 1 it makes a weld of a pin, and a slide of a slot."""
    if c.ratio != 1.0:
        r.refuse(place, f"has the ratio {c.ratio:g}, and only 1 has a word")
    words = r.joints[joint]
    if "angle" in words:
        r.refuse(place, SECOND)
    if "pin" in words:
        words["weld"] = words.pop("pin")
    elif "slot" in words:
        words["slide"] = words.pop("slot")
    words["angle"] = f"{s * (c.phase - o)} rad"


JOINTS: dict[type, Callable[..., None]] = {
    PivotJoint: _pivot,
    PinJoint: _pin,
    SlideJoint: _slide,
    GrooveJoint: _groove,
    DampedSpring: _spring,
}
TURNS: dict[type, Callable[..., None]] = {
    DampedRotarySpring: _rotary_spring,
    RotaryLimitJoint: _limit,
    SimpleMotor: _motor,
    GearJoint: _gear,
}
BOUNDED = (PivotJoint, PinJoint, SlideJoint, GrooveJoint, SimpleMotor)
"""The joints of which it is seen whether the motion needs more than their max_force."""
