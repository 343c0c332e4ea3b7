"""States of contacts and joints with dry friction: open, slide either way, stick.

| element       | state    | what holds                      | what ends it, falling to zero      |
| contact, pair | open     | nothing                         | gap: lands                         |
| contact, pair | slides ± | y = R, λ_t = ∓μ λ_n             | λ_n: opens; slip: stops            |
| contact, pair | sticks   | y = R, no slip                  | λ_n: opens; μ_s λ_n ± λ_t: slips   |
| slide, pin    | slides ± | a force ∓F along it, or moment  | slip: stops                        |
| slide, pin    | sticks   | no slip                         | F_s ± F_a: slips                   |
| pivot         | open     | nothing                         | gap: lands                         |
| pivot         | sticks   | y = 0, no slip                  | λ_n: opens                         |
| slowed, α < 1 | as slide | no force when it sticks         | slip: stops; ±F_a: slips           |
| ideal, smooth | its only | it rolls; the smooth law (2.95) | nothing                            |

Pairs of bodies, ropes, stops and springs that only press or pull are in `unilateral`. A mode of a
scene names the state of each element: `touch slides +, rail sticks, leg slack`.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from ....cases.scene import DryFriction, Scene
from ...coverage import Numbered
from ...laws.friction import Dry, stiction, stribeck
from ..constraints.constraint import Constraint, Numbers, row
from ..constraints.contact import Braking, Coulomb, at_rest, foot, normal, tangent
from ..kinematics.kinematics import Layout

CLOSED = 1e-9  # of the scene's size, or of 1 rad: a gap as small is none
AHEAD = 1e-3  # of the scene's size: feet that are nearer are passing each other
State = Literal["open", "slides +", "slides -", "sticks", "slides", "acts", "slack"]
REST: tuple[State, ...] = ("sticks", "slides +", "slides -")  # at slip 0: first, as in (2.89)


def sign(state: State) -> int:
    """The sign of the slip: 0 unless it slides."""
    return {"slides +": 1, "slides -": -1}.get(state, 0)


def sliding(direction: float) -> State:
    """The state that slides this way."""
    return "slides +" if direction > 0 else "slides -"


def dry(friction: DryFriction) -> Dry:
    """A joint's friction with the book's letters: F₋ against sliding backward, F₊ forward."""
    kinetic, static = friction.kinetic, friction.static
    return Dry(kinetic.backward, kinetic.forward, static.backward, static.forward)


@dataclass(frozen=True, kw_only=True)
class Element(Numbered):
    """Something that has states; by itself, one that is never left.

    slip: the row along which it slips. normal: the row that a contact gives up when it opens.
    """

    name: str
    slip: Constraint | None = None
    normal: Constraint | None = None
    only: State | None = None  # its one state
    frictionless: bool = False  # nothing to stick by: then it slides, whichever way
    rest: tuple[State, ...] = REST  # what it may do at slip 0
    other: Constraint | None = None  # the row of the foot that it has to be ahead of to strike
    kinetic: float = 0.0  # coefficient of a contact that slides
    static: float = 0.0  # of one that sticks
    restitution: float = 0.0
    plane: str = ""  # that a contact is with
    two: bool = False  # whether it is of two bodies, and not with the ground

    endings: tuple[str, str] = ("opens", "lands")  # when its normal force falls to zero, or its gap

    @property
    def push(self) -> str:
        """The reaction of its normal row, which only pushes."""
        return f"{self.name}.normal"

    @property
    def pulls(self) -> str:
        """The meaning of a normal force below zero, in words."""
        return f"the {self.plane} would have to pull at {self.name}"

    def amiss(self, depth: float, speed: float) -> str:
        """Words for a start so deep [m] in the plane, or else with this speed [m/s] into it."""
        if depth:
            # The plane of a side goes on behind its end; a rim has none.
            side = self.two and not self.plane.startswith("rim")
            other = ", or beyond its end" if side else ""
            return f"{self.name} starts {depth * 1e3:.3g} mm in the {self.plane}{other}"
        return f"{self.name} starts into the {self.plane}, with {speed:.3g} m/s"

    def near(self, size: float) -> float:
        """The gap [m, of a turn rad] that is none, in a scene of that size [m]."""
        turns = self.normal is not None and self.normal.angular[0]
        return CLOSED * (1.0 if turns else size)

    @property
    def parts(self) -> list[Constraint]:
        """The constraints that hold in some of its states, and not for good."""
        return [part for part in (self.normal, self.slip) if part is not None]

    @property
    def slips(self) -> bool:
        """Whether it may; a pivot is assumed not to."""
        return "slides +" in self.rest

    @property
    def yields(self) -> bool:
        """Whether friction is less as soon as it slips."""
        return False

    @property
    def tangent(self) -> Constraint:
        """The row along which it slips, of what can."""
        assert self.slip is not None
        return self.slip

    @property
    def body(self) -> str:
        """The one that slips."""
        return self.tangent.ends[-1].body

    @property
    def together(self) -> tuple[str, str]:
        """The body and the plane on which all its points have one slip."""
        return self.body, self.plane

    def behind(self, t: float, q: Numbers, size: float) -> float:
        """How far [m] it is from being well ahead of the other foot, where it passes the floor."""
        if self.other is None:
            return 0.0
        ahead = self.tangent.places(t, q)[0] - self.other.places(t, q)[0]
        return float(max(0.0, AHEAD * size - ahead))

    def constraints(self, state: State) -> list[Constraint]:
        """The constraints of the state."""
        return []

    def coulomb(self, state: State) -> list[Coulomb]:
        """Friction in proportion to a normal force."""
        return []

    def idle(self, state: State) -> tuple[str, ...]:
        """The forces of the scene that do nothing in the state."""
        return ()

    def slowing(self, speed: float) -> float:
        """The value that falls through zero as a slip [m/s] does, and has a slope there."""
        return speed

    def braking(self, state: State) -> list[Braking]:
        """Friction forces of their own."""
        return []

    def margins(self, forces: Mapping[str, float]) -> tuple[float, float]:
        """Force [N] that is left until it breaks loose to + and to −: negative where it does."""
        return math.inf, math.inf


@dataclass(frozen=True, kw_only=True)
class Rolling(Element):
    """A disk that only rolls; its rows always hold, and stand among those of the joints."""

    only: State | None = "sticks"


@dataclass(frozen=True, kw_only=True)
class Smoothed(Element):
    """A joint with the smooth law of dry friction (2.95), which never sticks."""

    friction: DryFriction
    only: State | None = "slides"


@dataclass(frozen=True, kw_only=True)
class Touching(Element):
    """A contact that opens, slides and sticks."""

    @property
    def yields(self) -> bool:
        return self.static > self.kinetic

    def constraints(self, state: State) -> list[Constraint]:
        """Nothing, the floor, or the floor and no slip."""
        assert self.normal is not None
        return {"open": [], "sticks": [self.normal, self.tangent]}.get(state, [self.normal])

    def coulomb(self, state: State) -> list[Coulomb]:
        """(2.87) F = −μ F_N sign(v)."""
        s = sign(state)
        assert self.normal is not None
        return [Coulomb(self.normal, self.tangent, -self.kinetic * s)] if s else []

    def margins(self, forces: Mapping[str, float]) -> tuple[float, float]:
        """(2.89) μ_s F_N ± F_fr [N]: negative where it breaks loose to + and to −."""
        bound = self.static * forces[f"{self.name}.normal"]
        tangent = forces[f"{self.name}.tangent"]
        return bound + tangent, bound - tangent


@dataclass(frozen=True, kw_only=True)
class Sliding(Element):
    """A slide or a pin with exact dry friction."""

    friction: DryFriction

    @property
    def yields(self) -> bool:
        law = dry(self.friction)
        return law.Fs_minus > law.F_minus or law.Fs_plus > law.F_plus

    def constraints(self, state: State) -> list[Constraint]:
        """Nothing, or no slip."""
        return [self.tangent] if state == "sticks" else []

    def braking(self, state: State) -> list[Braking]:
        """(2.89) −F₊ forward, F₋ backward; (2.90) by the slip."""
        if not (s := sign(state)):
            return []
        law = dry(self.friction)
        if (falls := self.friction.stribeck) is None:
            force = stiction(law, float(s), 0.0)
            return [Braking(self.tangent, lambda t, q, v: force)]
        F, F_s = (law.F_plus, law.Fs_plus) if s > 0 else (law.F_minus, law.Fs_minus)

        def by_slip(t: float, q: Any, v: Any) -> float:
            f, g, _ = row(self.tangent, t, q, v)
            return -s * stribeck(F, F_s, falls.speed, float(f @ v) - g)

        return [Braking(self.tangent, by_slip)]

    def margins(self, forces: Mapping[str, float]) -> tuple[float, float]:
        """(2.89) F_s₊ − F_a and F_s₋ + F_a, F_a = −F_fr: negative where it breaks loose."""
        F_a = -forces[f"{self.name}.friction"]
        return self.friction.static.forward - F_a, self.friction.static.backward + F_a


def elements(scene: Scene, where: Layout) -> Iterator[Element]:
    """Yields each element that has states, in the order of the scene."""
    for contact in scene.touching.values():
        if contact.ideal == "rolling":
            yield Rolling(name=contact.name, slip=tangent(contact, where))
        else:
            yield Touching(
                name=contact.name,
                normal=normal(contact, where),
                slip=tangent(contact, where),
                static=contact.static,
                kinetic=contact.kinetic,
                restitution=contact.restitution,
                frictionless=contact.static == 0.0 and contact.ideal is None,
                plane=contact.plane.name,
                rest=REST if contact.ideal is None else ("sticks",),
                other=foot(contact, where) if contact.ahead_of else None,
            )
    for joint in scene.joints.values():
        if (friction := joint.dry_friction) is None:
            continue
        along = at_rest(joint, where)
        if friction.smooth is not None:
            yield Smoothed(name=joint.name, slip=along, friction=friction)
        else:
            loose = friction.static.forward == friction.static.backward == 0.0
            yield Sliding(name=joint.name, slip=along, friction=friction, frictionless=loose)
