"""Any scene as a System, in maximal coordinates: its modes and what ends them.

A scene in which nothing switches, as none in space does, has one mode and no guards.
"""

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from ....cases.scene import Scene
from ....cases.scene.forces.drag import Drag
from ....cases.scene.forces.force import of_kind
from ...system import MOVING, TOGETHER, Array, Guard, System
from ..constraints.constraint import Constraint, tracked
from ..constraints.leeway import Leeway
from ..forces.action import blurred
from .element import REST, Element, State, sign
from .impact_transition import landed
from .mode import Multibody
from .mode_selection import (
    STILL,
    After,
    Options,
    Undetermined,
    closed,
    opening,
    painleve,
    settled,
    staying,
    yielding,
)
from .modes import Modes, rate
from .shared_friction import alike_contacts
from .spatial_mode import SpatialMultibody
from .unilateral import HAPPENS, OTHER, OneSided

ROUNDS = 8 * 2.2e-16  # of the scene's size and places: by 64 a wheel's last rocks were lost
STEEP = 2.0  # how deep a foot may be for each metre that it is behind
PIECES = 16  # of the shortest period of a force: a guard at rest sees nothing else of time


class BadStart(Exception):
    """A contact that starts where no contact can."""


class Mechanism(System):
    """A system that is made from a scene. base: what holds in all of its modes.

    beside: the same at another start that is as good, where that is far off; else None.
    """

    base: Multibody
    beside: "Mechanism | None" = None

    def leeway(self, mode: str, t: float, q: Array, v: Array) -> Leeway | None:
        """The forces that the laws allow in a mode here; None where there is one of each."""
        raise NotImplementedError

    def driven_point(self, name: str, t: float) -> tuple[float, ...]:
        """The place and the velocity of a point of the ground that moves, in the frame's axes."""
        return self.base.driven_point(name, t)

    def powers(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """The power [W] at any rates of each force that follows a law in time, by its name."""
        forces = self.base.forces(t, q, v)
        return {force.name: float(forces[force.name] @ v) for force in self.base.scene.signals()}


class SpatialMechanism(Mechanism):
    """The scene as its one mode, which is its `base` too."""

    def __init__(self, scene: Scene, start: tuple[Array, Array]) -> None:
        self.base = self._only = SpatialMultibody(scene, start)
        self.modes = {MOVING: self.base}
        self.corners = scene.corners()

    def start(self) -> After:
        """The assembled start."""
        return MOVING, *self.base.start()

    def leeway(self, mode: str, t: float, q: Array, v: Array) -> Leeway | None:
        """The forces that rows, and floors that only push, leave open."""
        return self._only.leeway(t, q, v)


class PlanarMechanism(Mechanism):
    """The scene as modes and guards.

    size [m]: what its gaps are small against. located [s]: how well events are.
    """

    def __init__(
        self,
        scene: Scene,
        start: tuple[Array, Array],
        size: float,
        located: float = TOGETHER,
    ) -> None:
        self.size = size
        self.modes = self.built = Modes(scene, start, located)
        self.base, self.elements = self.built.base, self.built.elements
        self.corners = self.built.corners
        sines = [f.signal for f in scene.signals() if f.signal.law == "sine"]
        fastest = max((abs(s.angular_frequency) for s in sines), default=0.0)
        self.longest = math.tau / fastest / PIECES if fastest else None
        self.blurred = blurred(scene, float(np.max(np.abs(start[1]), initial=0.0)) or 1.0)

    def start(self) -> After:
        """The assembled start, and what contacts and slides do there.

        Raises BadStart for a contact inside the floor or on its way into it.
        """
        q, v = self.base.start()
        if all(e.only for e in self.elements):  # nothing to choose, and nothing to bring to rest
            return self.built.name(tuple(e.only for e in self.elements if e.only)), q, v
        choices = [self._at_start(e, q, v) for e in self.elements]
        return settled(self.built, choices, 0.0, q, v)

    def _at_start(self, element: Element, q: Array, v: Array) -> Options:
        if element.only:
            return (element.only,)
        if isinstance(element, OneSided):
            return (element.began(q, v, element.near(self.size)),)
        still = self.built.still(0.0, q, v, part=STILL)
        if element.normal is not None:
            gap, near = element.normal.f(0.0, q.tolist())[0], element.near(self.size)
            if gap > near:
                return ("open",)
            passes = element.behind(0.0, q.tolist(), self.size) > 0.0
            if passes and (gap < -near or rate(element.normal, 0.0, q, v) < -still):
                return ("open",)
            if gap < -near:
                raise BadStart(element.amiss(-gap, 0.0))
            rising = rate(element.normal, 0.0, q, v)
            if rising < -still:
                raise BadStart(element.amiss(0.0, -rising))
            if rising > still:
                return ("open",)
            if element.slip is None:
                return closed(element, 0.0)
        slip = rate(element.tangent, 0.0, q, v)
        if abs(slip) > still and not element.slips:
            raise BadStart(f"{element.name} starts with a slip of {slip:.3g} m/s, and only pivots")
        return closed(element, slip if abs(slip) > still else 0.0)

    def guards(self, mode: str) -> Sequence[Guard]:
        """Opening, landing, stopping, slipping, and what springs do, in this order."""
        states = self.built.states[mode]
        guards = [g for i, s in enumerate(states) for g in self._guards(mode, i, s)]
        guards += halting(self.built, mode, self.size)
        order = {
            "opens": 0,
            "lands": 1,
            "stops": 2,
            "slips": 3,
            "slackens": 4,
            "tightens": 4,
            "None": 5,
        }
        order |= {"leaves": 0, "strikes": 1}
        return sorted(guards, key=lambda guard: order[str(guard.event).split()[-1]])

    def _guards(self, mode: str, i: int, state: State) -> Iterator[Guard]:
        e = self.elements[i]
        if e.only:
            return
        if isinstance(e, OneSided):
            ends = lambda t, q, v: e.ends(state, t, q)  # noqa: E731
            then, name = self._next(mode, i, (OTHER[state],)), f"{e.name} {HAPPENS[state]}"
            yield Guard(name, ends, then, rounds=self._rounds)  # a rope may hold its length
            return
        if (normal := e.normal) is not None:
            if state == "open":
                gap = self._clearance(e, normal)
                rest = self._comes_to_rest(mode, i)
                lands, name = self._lands(mode, i), f"{e.name} {e.endings[1]}"
                yield Guard(name, gap, lands, rest, vain=True, jumps=True, rounds=self._rounds)
                return
            push = lambda t, q, v: self.built.forces(mode, t, q, v)[e.push]  # noqa: E731
            yield Guard(f"{e.name} {e.endings[0]}", push, self._opens(mode, i))
        if e.frictionless or not e.slips:
            return
        if s := sign(state):
            slip = lambda t, q, v: e.slowing(s * rate(e.tangent, t, q, v))  # noqa: E731
            yield Guard(f"{e.name} stops", slip, self._next(mode, i, REST), jumps=e.yields)
            return
        for k, way in enumerate(("slides +", "slides -")):
            margin, slides = self._margin(mode, e, k), self._next(mode, i, (way,))
            yield Guard(f"{e.name} slips", margin, slides, jumps=e.yields)

    def _clearance(self, e: Element, normal: Constraint) -> Callable[[float, Array, Array], float]:
        """Its height; more, where it passes through the floor, which is never steeper than 2."""

        def clear(t: float, q: Array, v: Array) -> float:
            numbers = q.tolist()
            return normal.f(t, numbers)[0] + STEEP * e.behind(t, numbers, self.size)

        return clear

    def _rounds(self, q: Array) -> float:
        """[m] What rounding of places and angles makes of a gap."""
        return ROUNDS * (self.size + float(np.max(np.abs(q))))

    def _margin(self, mode: str, e: Element, k: int) -> Callable[[float, Array, Array], float]:
        return lambda t, q, v: e.margins(self.built.forces(mode, t, q, v))[k]

    def _next(self, mode: str, i: int, choice: Options) -> Callable[[float, Array, Array], After]:
        """The next mode if element i has this choice; at rest it first comes to rest exactly."""

        def then(t: float, q: Array, v: Array) -> After:
            choices = staying(self.built, mode)
            for k in alike_contacts(self.elements, self.built.states[mode], i):
                choices[k] = (*choice, *opening(self.elements[k])) if choice == REST else choice
            if choice == REST:
                self._stops_too(mode, choices, t, q, v)
            if self.built.loose(mode):
                choices = yielding(self.built, mode, choices, t, q, v)
            return settled(self.built, choices, t, q, v)

        return then

    def _stops_too(self, mode: str, choices: list[Options], t: float, q: Array, v: Array) -> None:
        """Lets what stops at the same instant rest as well, as both ends of a ladder do."""
        still = self.built.still(t, q, v, part=STILL)
        for k, (e, state) in enumerate(zip(self.elements, self.built.states[mode], strict=True)):
            rubs = sign(state) and e.slips and not e.frictionless and not e.only
            if rubs and abs(rate(e.tangent, t, q, v)) <= still:
                choices[k] = (*e.rest, *opening(e))

    def _opens(self, mode: str, i: int) -> Callable[[float, Array, Array], After]:
        """The contact opens, if it then rises: a force that jumps instead has no next mode."""

        def then(t: float, q: Array, v: Array) -> After:
            choices, e = staying(self.built, mode), self.elements[i]
            choices[i] = ("open",)
            after = settled(self.built, choices, t, q, v)
            assert e.normal is not None
            rises = self.built.change(e.normal, after[0], t, q, v)
            if rises < -self.built.small(t, q, v):
                raise painleve(
                    self.elements, e.name, f"neither staying nor leaving the {e.plane}", t
                )
            return after

        return then

    def leeway(self, mode: str, t: float, q: Array, v: Array) -> Leeway | None:
        """The forces that friction and the rows of a mode leave open."""
        return self.built.leeway(mode, t, q, v)

    def beyond(self, mode: str, t: float, q: Array, v: Array) -> After:
        """The mode and state under another force: what rubs, and what touches, may change."""
        if all(e.only for e in self.elements):
            return mode, q, v
        return settled(self.built, staying(self.built, mode), t, q, v)

    def _lands(self, mode: str, i: int) -> Callable[[float, Array, Array], After]:
        """The impact law, and what each contact and slide may do after it."""
        return lambda t, q, v: landed(self.built, mode, i, t, q, v, size=self.size)

    def _comes_to_rest(self, mode: str, i: int) -> Callable[[float, Array, Array], After | None]:
        """The impact law without a rebound; None where no motion keeps the laws then."""

        def then(t: float, q: Array, v: Array) -> After | None:
            try:
                return landed(self.built, mode, i, t, q, v, size=self.size, rests=True)
            except Undetermined:
                return None

        return then

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.87), (2.89) F_N ≥ 0, |F_fr| ≤ μ_s F_N where it sticks, v as it slides, gap ≥ 0."""
        forces = self.built.forces(mode, t, q, v)
        # At an event a force or rate is at its bound, as well as events are located.
        force = 1e-9 * (max(map(abs, forces.values()), default=0.0) or 1.0)
        force = max(force, self.built.small(t, q, v) * float(np.max(self.built.M)))
        slow = self.built.still(t, q, v, part=1e-9)
        for e, state in zip(self.elements, self.built.states[mode], strict=True):
            near = e.near(self.size)
            if isinstance(e, OneSided) and e.ends(state, t, q) < -near:
                return f"{e.name} is {state} on the wrong side of its rest length"
            if e.normal is not None:
                if state == "open":
                    height = e.normal.f(t, q.tolist())[0]
                    if not e.behind(t, q.tolist(), self.size) and height < -near:
                        return f"{e.name} is in the {e.plane}"
                    continue
                if forces[e.push] < -force:
                    return e.pulls
            if state == "sticks" and min(e.margins(forces)) < -force:
                return f"{e.name} would have to slip"
            if (s := sign(state)) and not e.frictionless and s * rate(e.tangent, t, q, v) < -slow:
                return f"{e.name} slides the other way"
        return None


# Friction of a point by a power below 1 of its speed (2.86), which could end its motion.
#
# d |v|^α is not small beside the speed that is left: alone it takes that in a finite time, and
# then nothing tells where the point goes on, if anything pushes it. Under its weight a ball never
# stops.


SLOW = 1e-6  # of the speed at the start, or of one that forces give within the scene's size
OTHERS = 2.0  # times what the friction does: then it goes through rest, and does not stay


def halting(modes: Modes, mode: str, size: float) -> Iterator[Guard]:
    """Yields guards where drags stop their points: a message, as no law sets such a point off."""
    for force in of_kind(Drag, modes.scene.forces.values()):
        if force.exponent < 1.0 and force.coefficient:
            slow, point = SLOW * _speed(modes, size), tracked(force.at, modes.base.where)
            yield Guard(
                None, _excess_speed(point, slow), _stops(modes, mode, force, point, slow), vain=True
            )


def _speed(modes: Modes, size: float) -> float:
    q, v = modes.start
    fastest = float(np.max(np.abs(v), initial=0.0))
    return fastest or float(np.sqrt(size * modes.base.terms(0.0, q, v)[0])) or 1.0


def _excess_speed(point: Constraint, slow: float) -> Callable[[float, Array, Array], float]:
    """A guard: how much faster the point is than `slow` [m/s]."""

    def faster(t: float, q: Array, v: Array) -> float:
        f, g, _ = point.alone.rows(t, q, v)
        return float(np.hypot(*(f @ v - g))) - slow

    return faster


def _stops(
    modes: Modes, mode: str, force: Drag, point: Constraint, slow: float
) -> Callable[[float, Array, Array], After]:
    """A function for the guard: the same mode, where others move the point through its rest.

    It raises Undetermined where they do not.
    """

    def then(t: float, q: Array, v: Array) -> After:
        f, _, gamma = point.alone.rows(t, q, v)
        a_P = np.hypot(*(f @ modes[mode].accelerations(t, q, v) - gamma))
        body = modes.scene.bodies[force.at.body]
        if a_P < OTHERS * force.coefficient * slow**force.exponent * body.mobility(force.at.point):
            what = (
                f"stops {force.at} at t = {t:.4g} s, and with an exponent below 1 it does so in a "
                "finite time: shorten the duration, or give an exponent of at least 1; along a "
                "slide a `viscous` may stop"
            )
            raise Undetermined(force.name, what, t)
        return mode, q, v

    return then
