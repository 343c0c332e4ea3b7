"""Checks contacts, pairs, ropes and stops against the file, from states and forces alone.

The mechanism has rows, guards and impacts for all of it; here nothing but the nouns of the file is
asked, which read a gap and a slip from the states of the bodies. What they tell of a blow is how
fast each gap closes before it and opens after it, and on a body that no joint holds its impulse.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ...cases.case import Case
from ...cases.scene import Anchor, Contact, Joint, Limit, Scene
from ...cases.scene.motion import Motion
from ...cases.scene.observe import motion_of
from ...cases.scene.pair import Pair
from ...cases.trajectory import OMEGA, VX, Array, Trajectory
from ..motion.bodies import Answer, accelerations
from ..motion.follow import Change
from ..motion.zeno import to_limit
from ..system import instant
from .agreement import Check, worst
from .reading import Size

FORCES = 1e-9  # of the largest of a side: friction's is a product, and what is more is no rounding
BLOWS = 1e-9  # of the motion's speed: rates are those of states that the events end, to 1e-12
ROUNDING = 1e-12  # of it: events end states to that, and a blow is held to no less than BLOWS
SLOW = 1e-8  # of the motion's speed: a slip that is less sticks but for rounding
NEAR = 1e-10  # of the motion's size: what is nearer touches, for whoever asks
APART = 1e-8  # of it: what is further off does not touch, and strikes nothing
LEAST = 1e-6  # of what would stop the heaviest body in the duration: less force is rounding's


@dataclass(frozen=True)
class Side:
    """Something that holds on one side: `gap` is (N,) what it keeps from falling below zero.

    push: the reaction that does. back: the part of the rate that it throws back. rate: (N,) how
    fast the gap grows. bodies: on which it acts.
    """

    name: str
    push: str
    unit: str  # of the gap: m or rad
    back: float
    gap: Callable[[Motion], Array]
    rate: Callable[[Motion], Array]
    bodies: tuple[str, ...]
    contact: Contact | Pair | None = None
    line: tuple[Anchor, ...] = ()  # the ends of a rope

    def touchable(self, motion: Motion) -> NDArray[np.bool_]:
        """(N,) Whether it can be touched: not beside a face, nor where a foot swings through."""
        if isinstance(self.contact, Pair) and self.contact.face:
            return ~self.contact.beyond(motion)
        through = isinstance(self.contact, Contact) and self.contact.ahead_of is not None
        return np.full(len(motion.trajectory.times), not through)


def sides(scene: Scene) -> Iterator[Side]:
    """Yields each contact that may open, pair, rope, and stop of a joint."""
    for c in (*scene.touching.values(), *scene.pairs.values()):
        if c.switches:
            bodies = _bodies(c)
            push, gap, rate = f"{c.name}.normal", partial(_gap, c), partial(_gap_rate, c)
            yield Side(c.name, push, "m", c.restitution, gap, rate, bodies, contact=c)
    for limit in scene.limits():
        line = limit.refers()  # of a rope; a stop has a joint
        ends = tuple(at.body for at in line if at.body in scene.bodies)
        for k, side in enumerate(limit.sides):
            unit = "m" if line else "rad"
            name = f"{limit.name}.{side}"
            gap, rate = partial(_limit_gap, limit, k), partial(_limit_rate, limit, side)
            yield Side(name, name, unit, limit.back, gap, rate, ends, line=line)


def _bodies(contact: Contact | Pair) -> tuple[str, ...]:
    """Names of the bodies that a contact touches."""
    return (contact.body, contact.touched) if isinstance(contact, Pair) else (contact.body,)


def _gap(contact: Contact | Pair, motion: Motion) -> Array:
    return contact.observe(motion, "gap")


def _gap_rate(contact: Contact | Pair, motion: Motion) -> Array:
    if isinstance(contact, Pair):
        return contact.slip_and_gap_rate(motion)[1]
    (x, y), (_, _, vx, vy) = contact.plane.normal, motion.point(contact.at).T
    return x * vx + y * vy


def _limit_gap(limit: Limit, k: int, motion: Motion) -> Array:
    return list(limit.gaps(motion))[k]


def _limit_rate(limit: Limit, side: str, motion: Motion) -> Array:
    return limit.sides[side][0] * limit.rate(motion)


def one_sided_checks(
    case: Case, answer: Answer, motion: Trajectory, marched: Trajectory, size: Size, own: float
) -> Iterator[Check]:
    """Checks gaps at every step, forces at the samples, and blows; own: the motion's own error."""
    scene, changes = case.scene, answer.followed.changes
    every, seen = [*sides(scene)], motion_of(scene, motion)
    heaviest = max(body.mass for body in scene.bodies.values())
    least = LEAST * heaviest * size.speed / case.duration
    rubbing = [*_rubbing(scene, every, motion, least)]
    rubbed = [worst(group.errors(seen, size)) / group.largest for group in rubbing]
    for change in changes if rubbing else ():
        before = _motion_before(scene, answer, change)
        rubbed += [group.error_at(before, change, size) for group in rubbing]
    if rubbed:
        yield Check("friction is the file's", worst(rubbed), FORCES)
    if free := [*_free_body_errors(case.scene, answer, motion)]:
        yield Check("contacts move free bodies by (2.22)", worst(free), FORCES)
    if ends := [*_at_their_length(scene, answer, size)]:
        yield Check("springs act from their length on", worst(ends), BLOWS)
    if not every:
        return
    steps = motion_of(scene, marched)
    passed = [
        worst(np.maximum(0.0, -side.gap(steps))[side.touchable(steps)]) / size.of(side.unit)
        for side in every
    ]
    yield Check("nothing passes what holds it", worst(passed), own, measured=True)
    if known := [side for side in every if side.push in motion.reactions]:
        pressing = worst(_pressing(known, seen, size))
        yield Check("what presses touches", pressing, own, measured=True)
    blows = [_Blow.of(scene, answer, first, last, size) for first, last in _at_once(case, changes)]
    if errors := [error for blow in blows for error in blow.errors(every)]:
        yield Check("blows are the file's", worst(errors), BLOWS)


def _at_their_length(scene: Scene, answer: Answer, size: Size) -> Iterator[float]:
    """Yields the distances of one-sided springs from their rest length where they switch."""
    springs = {spring.name: spring for spring in scene.one_sided()}
    for change in answer.followed.changes:
        name, _, word = (change.name or "").rpartition(" ")
        if name in springs and word in ("tightens", "slackens"):
            before = _motion_at(scene, answer, change.mode_before, change.time, change.before)
            length, _ = before.line(springs[name].a, springs[name].b)
            yield abs(float(length[0]) - springs[name].rest_length) / size.m


def _pressing(known: list[Side], seen: Motion, size: Size) -> Iterator[float]:
    """Yields the relative gap of each side while it presses, and the pull [N] of one that pulls."""
    for side in known:
        force = seen.reaction(side.push)
        largest = worst(np.abs(force)) or 1.0
        yield worst(np.abs(side.gap(seen))[force > FORCES * largest]) / size.of(side.unit)
        yield 0.0 if np.min(force) >= -FORCES * largest else worst(np.abs(force))


# Where a contact acts on a body and in which directions, by how the body then accelerates.


def _free_body_errors(scene: Scene, answer: Answer, motion: Trajectory) -> Iterator[float]:
    """Yields errors of m r̈ = ΣF and J φ̈ = ΣM of bodies that nothing holds but what they touch.

    Bodies on which a force acts that follows a velocity are left out: its power is not linear.
    """
    held = {at.body for joint in scene.joints.values() for at in joint.refers()}
    held |= {edge.at.body for edge in scene.constraints.values()}
    touching: list[Contact | Pair] = [*scene.touching.values(), *scene.pairs.values()]
    for c in touching:
        if any(name not in motion.reactions for name in _forces(c)):
            held |= {*_bodies(c)}
    bodies = {body for c in touching for body in _bodies(c)}
    seen = motion_of(scene, motion)
    if scene.inner() or not (free := sorted(bodies - held)):
        return
    acts = {body: _acting(scene, seen, body) for body in free}
    moved = (
        _accelerations(answer, motion) if any(each is not None for each in acts.values()) else {}
    )
    for name, acting in acts.items():
        body = scene.bodies[name]
        if acting is None:
            continue
        parts = [acting, *(_touch(c, seen, name) for c in touching if name in _bodies(c))]
        force, turn = sum(part[:, :2] for part in parts), sum(part[:, 2] for part in parts)
        change = np.stack([body.mass * moved[f"{name}.{field}"] for field in ("ax", "ay")], axis=1)
        largest = max(worst(np.abs(part[:, :2]).ravel()) for part in parts)
        largest = max(largest, worst(np.abs(change).ravel())) or 1.0
        yield worst(np.abs(force - change).ravel()) / largest
        if body.turns:
            couple = body.moment * moved[f"{name}.alpha"]
            most = max(worst(part[:, 3]) for part in parts)  # it may be nothing of it
            yield worst(np.abs(turn - couple)) / (max(most, worst(np.abs(couple))) or 1.0)


def _acting(scene: Scene, seen: Motion, name: str) -> Array | None:
    """(N, 4) as `_touch` of all but contacts, by the power that they have of unit velocities of
    that body alone; None where one follows its velocity."""
    body, states = scene.bodies[name], seen.trajectory.states
    loads = np.zeros((len(seen.trajectory.times), 4))
    loads[:, :2] = body.mass * np.array(scene.gravity)
    for force in scene.forces.values():
        if name not in {at.body for at in force.refers()}:
            continue
        if not force.works or isinstance(force, Limit):
            return None
        for k in range(3):
            ways = []
            for sign in (1.0, -1.0):
                slow = {each: rows.copy() for each, rows in states.items()}
                for rows in slow.values():
                    rows[:, VX : OMEGA + 1] = 0.0
                slow[name][:, VX + k] = sign
                ways.append(
                    force.power(motion_of(scene, Trajectory(seen.trajectory.times, slow, {})))
                )
            if not np.array_equal(ways[0], -ways[1]):
                return None
            loads[:, k] += ways[0]
    loads[:, 3] = np.abs(loads[:, 2])
    return loads


def _touch(contact: Contact | Pair, seen: Motion, name: str) -> Array:
    """(N, 4) force [N] and moment [N m] of a contact on one of the bodies that it touches, and
    the moment that it would have across its arm."""
    normal, tangent = (seen.reaction(force)[:, None] for force in _forces(contact))
    if isinstance(contact, Pair):
        place, n = contact.place(seen), contact.normal_and_gap(seen)[0]
    else:
        n = np.array([contact.plane.normal])
        place = seen.point(contact.at)[:, :2] - (seen.bodies[contact.body].radius or 0.0) * n
    sign = 1.0 if name == contact.body else -1.0
    along = np.stack([n[:, 1], -n[:, 0]], axis=1)  # it has the normal to its left
    force = sign * (normal * n + tangent * along)
    x, y = (place - seen.trajectory.states[name][:, :2]).T
    moment, most = x * force[:, 1] - y * force[:, 0], np.hypot(x, y) * np.hypot(*force.T)
    return np.column_stack([force, moment, most])


def _accelerations(answer: Answer, motion: Trajectory) -> dict[str, Array]:
    """Accelerations (N,) of each body at the samples by quantity, each in the sample's mode."""
    followed, rows = answer.followed, list[dict[str, float]]()
    for t, phase, y in zip(motion.times.tolist(), followed.phase.tolist(), followed.y, strict=True):
        mode = answer.system.modes[followed.phases[phase]]
        rows.append(accelerations(mode, followed.still(t, phase), *mode.parted(y)))
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


# Friction, at the samples and where a mode ends.


@dataclass(frozen=True)
class _Rubbing:
    """Points of one body that slip on one thing alike, or a joint; largest: of their forces.

    Of points that stick together only the sum of their forces is one.
    """

    parts: tuple[Contact | Pair | Joint, ...]
    largest: float

    def bounds(self, seen: Motion) -> tuple[Array, Array, Array, Array, Array]:
        """(N,) each (2.89): the slip, the friction, its bounds at rest, its value in motion."""
        first, slips = self.parts[0], [part.observe(seen, "slip") for part in self.parts]
        if isinstance(first, Joint):
            law, slip = first.dry_friction, slips[0]
            assert law is not None
            moving = np.where(slip > 0.0, -law.kinetic.forward, law.kinetic.backward)
            rest = np.full(len(slip), -law.static.forward), np.full(len(slip), law.static.backward)
            return slip, seen.reaction(f"{first.name}.friction"), *rest, moving
        normals, tangents = (
            np.array([seen.reaction(f"{part.name}.{field}") for part in self.parts])
            for field in ("normal", "tangent")
        )
        static, kinetic = (
            np.array([getattr(part, coefficient) for part in self.parts]) @ normals
            for coefficient in ("static", "kinetic")
        )
        # Of what is open the slip is none of friction's.
        slip = np.take_along_axis(np.array(slips), np.argmax(normals, axis=0)[None], axis=0)[0]
        return slip, np.sum(tangents, axis=0), -static, static, -np.sign(slip) * kinetic

    def errors(self, seen: Motion, size: Size) -> Array:
        """(N,) Error of friction: from its value in motion, or beyond its bounds at rest."""
        slip, force, low, high, moving = self.bounds(seen)
        fast = size.rate if isinstance(self.parts[0], Joint) and self.parts[0].turns else size.speed
        at_rest = np.abs(force - np.clip(force, low, high))
        return np.where(np.abs(slip) > SLOW * fast, np.abs(force - moving), at_rest)

    def error_at(self, before: Motion, change: Change, size: Size) -> float:
        """Returns the error where a mode ends, and of the bound where friction breaks loose.

        Of the largest force, which may be this one: it may have stuck between two samples. Nothing
        at a corner of a law: forces are told there as they are behind it.
        """
        if change.guard is None:
            return 0.0
        if any(not {*_forces(part)} <= before.trajectory.reactions.keys() for part in self.parts):
            return 0.0
        error = worst(self.errors(before, size))
        _, force, low, high, _ = self.bounds(before)
        if change.name in {f"{part.name} slips" for part in self.parts}:
            error = max(error, float(np.minimum(force - low, high - force)[0]))
        return error / max(self.largest, worst(np.abs(force)))


def _forces(element: Contact | Pair | Joint) -> list[str]:
    fields = ["friction"] if isinstance(element, Joint) else ["normal", "tangent"]
    return [f"{element.name}.{field}" for field in fields]


def _rubbing(
    scene: Scene, every: list[Side], motion: Trajectory, least: float
) -> Iterator[_Rubbing]:
    """Yields the contacts and joints that rub by (2.89) with forces that are known."""
    groups: dict[tuple[str, str], list[Contact | Pair | Joint]] = {}
    for side in every:
        element = side.contact
        if element is not None and not (isinstance(element, Contact) and element.ideal):
            groups.setdefault((element.body, element.on), []).append(element)
    for joint in scene.joints.values():
        law = joint.dry_friction
        if law is not None and not law.smooth and not law.stribeck:
            groups[joint.name, ""] = [joint]
    for parts in groups.values():
        names = [name for element in parts for name in _forces(element)]
        if {*names} <= motion.reactions.keys():
            largest = worst(np.abs(np.concatenate([motion.reactions[name] for name in names])))
            yield _Rubbing(tuple(parts), max(largest, least) or 1.0)


def _motion_before(scene: Scene, answer: Answer, change: Change) -> Motion:
    """The bodies and their forces just before a change."""
    return _motion_at(scene, answer, change.mode_before, change.time, change.before, forces=True)


def _motion_at(
    scene: Scene, answer: Answer, name: str, t: float, y: Array, *, forces: bool = False
) -> Motion:
    """One state in a mode as a motion of one sample."""
    mode = answer.system.modes[name]
    q, v = mode.parted(y)
    states = {body: np.array([pose], float) for body, pose in mode.poses(t, q, v).items()}
    values = mode.reactions(t, q, v) if forces else {}
    reactions = {reaction: np.array([force]) for reaction, force in values.items()}
    return motion_of(scene, Trajectory(np.array([t]), states, reactions))


# Blows: what a change of the mode does to the velocities.


def _at_once(case: Case, changes: Sequence[Change]) -> Iterator[tuple[Change, Change]]:
    """Yields the first and the last of each instant: what a blow closes is struck by the next."""
    first = 0
    for k, change in enumerate(changes):
        if k + 1 == len(changes) or changes[k + 1].time > change.time + instant(case.duration):
            yield changes[first], change
            first = k + 1


def _span(pile: Array) -> tuple[float, float]:
    """From the last blow but one that was followed of a pile to well behind its limit [s]."""
    return float(pile[-2]), float(pile[-1]) + 2.0 * to_limit(pile)


@dataclass(frozen=True)
class _Blow:
    """All changes of one instant, with the states of the bodies just before and just after it."""

    scene: Scene
    before: Motion  # of one row, and after
    after: Motion
    size: Size
    ends: bool  # a pile of blows, whose last throws nothing back

    @staticmethod
    def of(scene: Scene, answer: Answer, first: Change, last: Change, size: Size) -> "_Blow":
        before = _motion_at(scene, answer, first.mode_before, first.time, first.before)
        after = _motion_at(scene, answer, last.mode_after, last.time, last.after)
        piles = map(_span, answer.followed.endless)
        ends = any(begin <= last.time <= end for begin, end in piles)
        return _Blow(scene, before, after, size, ends)

    def errors(self, every: list[Side]) -> Iterator[float]:
        """Yields the error of each touching side against the file's law of impact."""
        if self._jump() <= ROUNDING:
            return
        gaps = [abs(side.gap(self.before)[0]) / self.size.of(side.unit) for side in every]
        if min(gaps) > APART and not self.ends:
            yield self._jump()
        near = [
            side
            for side, gap in zip(every, gaps, strict=True)
            if gap <= NEAR and side.touchable(self.before)[0]
        ]
        both = self.before, self.after
        rates = {side.name: [float(side.rate(at)[0]) for at in both] for side in near}
        struck = [side for side in near if rates[side.name][0] < -BLOWS * self._speed(side)]
        for side in near:
            closes, opens = rates[side.name]
            rebound = -side.back * closes if side in struck else 0.0
            least = 0.0 if self.ends or len(struck) > 1 else rebound
            most = rebound if struck == [side] else np.inf
            yield max(0.0, least - opens, opens - most) / self._speed(side)
        if len(near) == 1 == len(struck):
            yield from self._impulse(near[0])

    def _jump(self) -> float:
        """The largest jump of a velocity, or of a rate, relative to the motion's."""
        before, after = self.before.trajectory.states, self.after.trajectory.states
        jumps = np.array([after[name][0] - before[name][0] for name in self.scene.bodies])
        moves, turns = np.abs(jumps[:, VX:OMEGA]).max(), np.abs(jumps[:, OMEGA]).max()
        return float(max(moves / self.size.speed, turns / self.size.rate))

    def _speed(self, side: Side) -> float:
        return self.size.speed if side.unit == "m" else self.size.rate

    def _impulse(self, side: Side) -> Iterator[float]:
        """Yields errors of the impulse that one side alone gives to bodies that nothing holds."""
        scene = self.scene
        held = {at.body for joint in scene.joints.values() for at in joint.refers()}
        held |= {edge.at.body for edge in scene.constraints.values()}
        if held & {*side.bodies} or not side.bodies:
            return
        place, normal = _where(side, self.before)
        before, after = self.before.trajectory.states, self.after.trajectory.states
        along = np.array([normal[1], -normal[0]])  # it has the normal to its left
        for sign, name in zip((1.0, -1.0), side.bodies, strict=False):
            body, jump = scene.bodies[name], after[name][0] - before[name][0]
            push = body.mass * jump[VX : VX + 2]
            size = body.mass * self.size.speed
            if body.turns:
                x, y = place - before[name][0, :2]
                turn = x * push[1] - y * push[0]
                yield abs(body.moment * jump[OMEGA] - turn) / (size * (self.size.m or 1.0))
            pressed, rubbed = sign * float(push @ normal), sign * float(push @ along)
            yield max(0.0, -pressed) / size
            if side.contact is None:
                yield abs(rubbed) / size
                continue
            slip = float(side.contact.observe(self.after, "slip")[0])
            bound = side.contact.kinetic * pressed
            if abs(slip) > SLOW * self.size.speed:
                yield abs(rubbed + np.sign(slip) * bound) / size
            elif not (isinstance(side.contact, Contact) and side.contact.ideal):
                yield max(0.0, abs(rubbed) - bound) / size


def _where(side: Side, here: Motion) -> tuple[Array, Array]:
    """The place of the contact, and its normal towards the first body."""
    if side.line:
        first, second = (here.point(at)[0, :2] for at in side.line)
        if side.bodies[0] != side.line[0].body:
            first, second = second, first
        return first, (second - first) / np.linalg.norm(second - first)
    contact = side.contact
    assert contact is not None
    if isinstance(contact, Pair):
        return contact.place(here)[0], contact.normal_and_gap(here)[0][0]
    normal = np.array(contact.plane.normal)
    radius = here.bodies[contact.body].radius or 0.0
    return here.point(contact.at)[0, :2] - radius * normal, normal
