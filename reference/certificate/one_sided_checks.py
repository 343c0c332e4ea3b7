"""Checks contacts, pairs, ropes and stops against the file, from states and forces alone.

The mechanism has rows, guards and impacts for all of it; here nothing but the nouns of the file is
asked, which read a gap and a slip from the states of the bodies. What they tell of a blow is how
fast each gap closes before it and opens after it, and on a body that no joint holds its impulse.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...cases.case import Case
from ...cases.scene import Contact, Joint, Limit, Scene
from ...cases.scene.forces.limit import Rope
from ...cases.scene.motion import Motion
from ...cases.scene.observe import motion_of
from ...cases.scene.pair import Pair
from ...cases.trajectory import ANGLE, OMEGA, VX, Array, Trajectory
from ..motion.bodies import Answer
from ..motion.follow import Change
from ..system import instant
from .agreement import Check, worst
from .reading import Size

FORCES = 1e-9  # of the largest of a side: friction's is a product, and what is more is no rounding
BLOWS = 1e-9  # of the motion's speed: four places of a body tell how fast a gap closes to 1e-12
NEAR = 1e-8  # of the motion's size: what is nearer touches
STEP = 1e-3  # of the motion's size: how far bodies are moved for that


@dataclass(frozen=True)
class Side:
    """Something that holds on one side: `gap` is (N,) what it keeps from falling below zero.

    push: the reaction that does. back: the part of the rate that it throws back. on: where it is
    at all, (N,) of bool. bodies: on which it acts. friction: of what may slip.
    """

    name: str
    push: str
    unit: str  # of the gap: m or rad
    back: float
    gap: Callable[[Motion], Array]
    bodies: tuple[str, ...]
    contact: Contact | Pair | None = None
    rope: Rope | None = None

    def on(self, motion: Motion) -> NDArray[np.bool_]:
        """(N,) whether it could be touched: not beside a face, nor where a foot swings through."""
        if isinstance(self.contact, Pair) and self.contact.face:
            return ~self.contact.beyond(motion)
        through = isinstance(self.contact, Contact) and self.contact.ahead_of is not None
        return np.full(len(motion.trajectory.times), not through)


def sides(scene: Scene) -> Iterator[Side]:
    """Yields each contact that may open, pair, rope, and stop of a joint."""
    for one in (*scene.touching.values(), *scene.pairs.values()):
        if one.switches:
            bodies = tuple(at.body for at in one.refers()[: 2 if isinstance(one, Pair) else 1])
            gap = lambda motion, one=one: one.observe(motion, "gap")  # noqa: E731
            push = f"{one.name}.normal"
            yield Side(one.name, push, "m", one.restitution, gap, bodies, contact=one)
    for limit in scene.limits():
        rope = limit if isinstance(limit, Rope) else None
        ends = tuple(at.body for at in limit.refers() if at.body in scene.bodies)
        for k, side in enumerate(limit.sides):
            unit = "m" if rope else "rad"
            name = f"{limit.name}.{side}"
            yield Side(name, name, unit, limit.back, _gap(limit, k), ends, rope=rope)


def _gap(limit: Limit, k: int) -> Callable[[Motion], Array]:
    return lambda motion: list(limit.gaps(motion))[k]


def one_sided_checks(
    case: Case, answer: Answer, motion: Trajectory, marched: Trajectory, size: Size, own: float
) -> Iterator[Check]:
    """Gaps at every step, forces at the samples, and blows; own: what the motion is known to."""
    scene, changes = case.scene, answer.followed.changes
    every, seen = [*sides(scene)], motion_of(scene, motion)
    rubbing = [*_rubbing(scene, every, motion)]
    rubbed = [worst(one.off(seen, size)) / one.largest for one in rubbing]
    for change in changes if rubbing else ():
        before, told = _before(scene, answer, change), set(change.mode_after.split(", "))
        rubbed += [one.at(before, change, told, size) / one.largest for one in rubbing]
    if rubbed:
        yield Check("friction is the file's", worst(rubbed), FORCES)
    if not every:
        return
    steps = motion_of(scene, marched)
    passed = [
        worst(np.maximum(0.0, -side.gap(steps))[side.on(steps)]) / size.of(side.unit)
        for side in every
    ]
    yield Check("nothing passes what holds it", worst(passed), own)
    if known := [side for side in every if side.push in motion.reactions]:
        yield Check("what presses touches", worst(_pressing(known, seen, size)), own)
    blows = [_Blow.of(scene, answer, first, last, size) for first, last in _at_once(case, changes)]
    if told := [each for blow in blows for each in blow.off(every)]:
        yield Check("blows are the file's", worst(told), BLOWS)


def _pressing(known: list[Side], seen: Motion, size: Size) -> Iterator[float]:
    """Yields how far each that presses is from what it presses on; how much it pulls, as a part."""
    for side in known:
        force = seen.reaction(side.push)
        largest = worst(np.abs(force)) or 1.0
        yield worst(np.abs(side.gap(seen))[force > FORCES * largest]) / size.of(side.unit)
        yield 0.0 if np.min(force) >= -FORCES * largest else worst(np.abs(force))


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
        first, slips = self.parts[0], [one.observe(seen, "slip") for one in self.parts]
        if isinstance(first, Joint):
            law, slip = first.dry_friction, slips[0]
            assert law is not None
            moving = np.where(slip > 0.0, -law.kinetic.forward, law.kinetic.backward)
            rest = np.full(len(slip), -law.static.forward), np.full(len(slip), law.static.backward)
            return slip, seen.reaction(f"{first.name}.friction"), *rest, moving
        normals, tangents = (
            np.array([seen.reaction(f"{one.name}.{field}") for one in self.parts])
            for field in ("normal", "tangent")
        )
        static, kinetic = (
            np.array([getattr(one, of) for one in self.parts]) @ normals
            for of in ("static", "kinetic")
        )
        # Of what is open the slip is none of friction's.
        slip = np.take_along_axis(np.array(slips), np.argmax(normals, axis=0)[None], axis=0)[0]
        return slip, np.sum(tangents, axis=0), -static, static, -np.sign(slip) * kinetic

    def off(self, seen: Motion, size: Size) -> Array:
        """(N,) how far friction is from what it is in motion, or beyond its bounds at rest."""
        slip, force, low, high, moving = self.bounds(seen)
        fast = size.rate if isinstance(self.parts[0], Joint) and self.parts[0].turns else size.speed
        at_rest = np.abs(force - np.clip(force, low, high))
        return np.where(np.abs(slip) > NEAR * fast, np.abs(force - moving), at_rest)

    def at(self, before: Motion, change: Change, told: set[str], size: Size) -> float:
        """Returns that where a mode ends, or how far what breaks loose there was from its bound."""
        if any(not {*_forces(one)} <= before.trajectory.reactions.keys() for one in self.parts):
            return 0.0
        off = worst(self.off(before, size))
        names = {one.name for one in self.parts}
        sticks = {f"{name} sticks" for name in names} & {*change.mode_before.split(", ")}
        slides = {f"{name} slides {way}" for name in names for way in "+-"} & told
        if sticks and slides and change.guard is not None:
            _, force, low, high, _ = self.bounds(before)
            off = max(off, float(np.minimum(force - low, high - force)[0]))
        return off


def _forces(one: Contact | Pair | Joint) -> list[str]:
    fields = ["friction"] if isinstance(one, Joint) else ["normal", "tangent"]
    return [f"{one.name}.{field}" for field in fields]


def _rubbing(scene: Scene, every: list[Side], motion: Trajectory) -> Iterator[_Rubbing]:
    """Yields the contacts and joints that rub by (2.89) with forces that are known."""
    groups: dict[tuple[str, str], list[Contact | Pair | Joint]] = {}
    for side in every:
        one = side.contact
        if one is not None and not (isinstance(one, Contact) and one.ideal):
            groups.setdefault((one.body, one.on), []).append(one)
    for joint in scene.joints.values():
        law = joint.dry_friction
        if law is not None and not law.smooth and not law.stribeck:
            groups[joint.name, ""] = [joint]
    for parts in groups.values():
        names = [name for one in parts for name in _forces(one)]
        if {*names} <= motion.reactions.keys():
            largest = worst(np.abs(np.concatenate([motion.reactions[name] for name in names])))
            yield _Rubbing(tuple(parts), largest or 1.0)


def _before(scene: Scene, answer: Answer, change: Change) -> Motion:
    """The bodies and their forces just before a change."""
    mode = answer.system.modes[change.mode_before]
    at = mode.parted(change.before)
    states = {n: np.array([p], float) for n, p in mode.poses(change.time, *at).items()}
    told = {n: np.array([f]) for n, f in mode.reactions(change.time, *at).items()}
    return motion_of(scene, Trajectory(np.array([change.time]), states, told))


# Blows: what a change of the mode does to the velocities.


def _at_once(case: Case, changes: Sequence[Change]) -> Iterator[tuple[Change, Change]]:
    """Yields the first and the last of each instant: what a blow closes is struck by the next."""
    first = 0
    for k, change in enumerate(changes):
        if k + 1 == len(changes) or changes[k + 1].time > change.time + instant(case.duration):
            yield changes[first], change
            first = k + 1


@dataclass(frozen=True)
class _Blow:
    """All changes of one instant, with the states of the bodies just before and just after it."""

    scene: Scene
    time: float
    before: dict[str, Array]
    after: dict[str, Array]
    size: Size
    ends: bool  # a pile of blows, whose last throws nothing back

    @staticmethod
    def of(scene: Scene, answer: Answer, first: Change, last: Change, size: Size) -> "_Blow":
        modes, t = answer.system.modes, last.time
        before, after = (
            {name: np.array(pose, float) for name, pose in modes[mode].poses(t, *at).items()}
            for mode, at in (
                (first.mode_before, modes[first.mode_before].parted(first.before)),
                (last.mode_after, modes[last.mode_after].parted(last.after)),
            )
        )
        piles = answer.followed.endless
        ends = any(abs(float(pile[-1]) - t) <= 1e-6 * max(1.0, t) for pile in piles if len(pile))
        return _Blow(scene, t, before, after, size, ends)

    def off(self, every: list[Side]) -> Iterator[float]:
        """How far each side that touches is from what the file says of the blow."""
        if all(np.array_equal(rows, self.after[name]) for name, rows in self.before.items()):
            return
        here = self._moved(self.before)
        near = [
            side
            for side in every
            if abs(side.gap(here)[2]) <= NEAR * self.size.of(side.unit) and side.on(here)[2]
        ]
        both = self.before, self.after
        rates = {side.name: tuple(self._rate(side, states) for states in both) for side in near}
        struck = [side for side in near if rates[side.name][0] < -BLOWS * self._speed(side)]
        for side in near:
            u, after = rates[side.name]
            wanted = -side.back * u if side in struck else 0.0
            least = 0.0 if self.ends or len(struck) > 1 else wanted
            most = wanted if struck == [side] else np.inf
            yield max(0.0, least - after, after - most) / self._speed(side)
        if len(near) == 1 == len(struck):
            yield from self._impulse(near[0])

    def _speed(self, side: Side) -> float:
        return self.size.speed if side.unit == "m" else self.size.rate

    def _moved(self, states: dict[str, Array]) -> Motion:
        """Five places: where the bodies are, and two before and behind on their way."""
        h = STEP * min(self.size.m / self.size.speed, 1.0 / self.size.rate)
        times = h * np.arange(-2.0, 3.0)
        rows = {name: _along(state, times) for name, state in states.items()}
        return motion_of(self.scene, Trajectory(self.time + times, rows, {}))

    def _rate(self, side: Side, states: dict[str, Array]) -> float:
        """How fast the gap grows, to the fourth order."""
        moved = self._moved(states)
        h = float(moved.trajectory.times[3] - moved.trajectory.times[2])
        return float(np.array([1.0, -8.0, 0.0, 8.0, -1.0]) @ side.gap(moved)) / (12.0 * h)

    def _impulse(self, side: Side) -> Iterator[float]:
        """Yields errors of the impulse that one side alone gives to bodies that nothing holds."""
        scene = self.scene
        held = {at.body for joint in scene.joints.values() for at in joint.refers()}
        held |= {edge.at.body for edge in scene.constraints.values()}
        if held & {*side.bodies} or not side.bodies:
            return
        here = self._moved(self.before)
        place, normal = _where(side, here)
        along = np.array([normal[1], -normal[0]])  # it has the normal to its left
        for sign, name in zip((1.0, -1.0), side.bodies, strict=False):
            body, jump = scene.bodies[name], self.after[name] - self.before[name]
            push = body.mass * jump[VX : VX + 2]
            size = body.mass * self.size.speed
            if body.turns:
                x, y = place - self.before[name][:2]
                turn = x * push[1] - y * push[0]
                arm = max(self.size.m, 1e-300)
                yield abs(body.moment * jump[OMEGA] - turn) / (size * arm)
            pressed, rubbed = sign * float(push @ normal), sign * float(push @ along)
            yield max(0.0, -pressed) / size
            if side.contact is None:
                yield abs(rubbed) / size
                continue
            slip = float(side.contact.observe(self._moved(self.after), "slip")[2])
            bound = side.contact.kinetic * pressed
            if abs(slip) > NEAR * self.size.speed:
                yield abs(rubbed + np.sign(slip) * bound) / size
            elif not (isinstance(side.contact, Contact) and side.contact.ideal):
                yield max(0.0, abs(rubbed) - bound) / size


def _where(side: Side, here: Motion) -> tuple[Array, Array]:
    """Where it touches, and the normal to the first of its bodies."""
    if (rope := side.rope) is not None:
        first, second = (here.point(at)[2, :2] for at in (rope.a, rope.b))
        if side.bodies[0] != rope.a.body:
            first, second = second, first
        return first, (second - first) / np.linalg.norm(second - first)
    one = side.contact
    assert one is not None
    if isinstance(one, Pair):
        return one.place(here)[2], one.normal_and_gap(here)[0][2]
    normal = np.array(one.plane.normal)
    radius = here.bodies[one.body].radius or 0.0
    return here.point(one.at)[2, :2] - radius * normal, normal


def _along(state: Array, times: Array) -> Array:
    """(N, 6) states that go on from one with its velocities; in space nothing is struck."""
    rows = np.tile(state, (len(times), 1))
    rows[:, : ANGLE + 1] += times[:, None] * state[VX:]
    return rows
