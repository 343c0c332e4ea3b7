"""The ways in which contacts may go on that linear programmes do not rule out.

Forces λ give accelerations a, M a = Q + Jᵀ λ.  While it is open what each contact does it is asked
for no more than all its ways have in common: it only pushes, within the cone of its friction, and
what is closed does not approach.  Where no λ and a keep that, none of these ways is possible.  Else
the contact is asked next whose law they break most, one way after the other.

What rests may only rest, however many contacts there are: no contact gives power, a·Jᵀλ ≤ 0, so
that a·M a ≤ a·Q, and where no a has a·Q > 0 nothing begins to move.  By Farkas's lemma that is so,
whatever the friction, where forces without any would hold it: a stack, a wall, a heap in a trough.
Where friction has to help, forces that hold it do not yet say that it rests: a disk between two
walls may be wedged, and as well fall.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...integrators.budget import tries
from ...system import Array
from ..constraints.constraint import row
from .element import Element, State, sign
from .loose import unit
from .modes import Modes
from .shared_friction import undecided, ways

FEW = 2  # elements: up to 4² ways are asked one by one sooner than by programmes
BEGINS = 1e-8  # of Q·M⁻¹Q: less is no a·Q, as a linear programme knows it; a is below 1e-4 of M⁻¹Q
INFEASIBLE = 2  # HiGHS: nothing keeps all laws, where a bound is kept to 1e-7

Options = tuple[State, ...]
"""States that one element may take, the likeliest first."""


def possible_ways(
    modes: Modes,
    likeliest: tuple[str, Array, Array],
    choices: Sequence[Options],
    t: float,
    *,
    rests: bool,
) -> Iterator[tuple[State, ...]]:
    """Yields states of all elements together, the likeliest first, with all that are possible.

    likeliest: the mode of the first of the choices, q and v. rests: whether it holds all at rest;
    then only those in which something begins to move.
    """
    free = undecided(modes.elements, choices)
    if len(free) <= FEW or any(e.only == "slides" for e in modes.elements):
        yield from tries(ways(modes.elements, choices), free)
        return
    laws = _Laws(modes, choices, t, *likeliest)
    stack, decided = [tuple(choices)], list[tuple[State, ...]]()

    def partly_decided() -> Iterator[tuple[Options, ...]]:
        while stack:
            yield stack.pop()

    for options in tries(partly_decided(), free):
        if (forces := laws.kept(options, rests=rests)) is None:
            continue
        if (k := laws.most_broken(options, forces)) is None:
            decided.append(tuple(states[0] for states in options))
        else:
            stack += _divided(modes.elements, options, k)
    likely = lambda states: [c.index(s) for c, s in zip(choices, states, strict=True)]  # noqa: E731
    yield from sorted(decided, key=likely)


def _divided(
    elements: Sequence[Element], options: Sequence[Options], k: int
) -> Iterator[tuple[Options, ...]]:
    """Yields the options with element k open or closed, or, where it is closed, in each state.

    What a body has closed on a plane does alike.
    """
    if "open" in options[k]:
        closed: Options = tuple(state for state in options[k] if state != "open")
        parts: list[Options] = [("open",), closed]
    else:
        parts = [(state,) for state in options[k]]
    for part in parts:
        divided = [*options]
        divided[k] = part
        for i, e in enumerate(elements if "open" not in options[k] else ()):
            if i != k and e.together == elements[k].together:
                divided[i] = tuple(state for state in options[i] if state in (*part, "open"))
        if all(divided):
            yield tuple(divided)


@dataclass(frozen=True)
class _Friction:
    """Rows of dry friction: margins until it slips to + and to −, zero where it slips so."""

    margins: tuple[Array, Array]
    slides: tuple[Array, Array]


class _Laws:
    """The laws of what the elements do as rows of a linear programme, of 1 and λ.

    a and λ are counted in M^½, of the size of Q, and rows of J have the size 1. rates: how fast
    what each row holds begins to move (r, 1 + r). gives: a·Q (1 + r,).
    """

    def __init__(
        self, modes: Modes, choices: Sequence[Options], t: float, mode: str, q: Array, v: Array
    ) -> None:
        root, (f, _, gamma) = np.sqrt(modes.M), modes.base.rows(t, q, v)
        applied = modes[mode].applied(t, q, v) / root
        size = modes.usual(t, q, v) * float(np.max(root)) or 1.0
        rows, gammas, self.joints = [*f], [*gamma], len(f)
        self.choices = choices
        self.at: dict[int, tuple[int | None, int | None]] = {}
        """By the number of each element that has one: its normal and its tangent row."""
        for k, (e, options) in enumerate(zip(modes.elements, choices, strict=True)):
            rubs = not e.frictionless and (e.normal is not None or len(options) > 1)
            places = list[int | None]()
            away = e.only or options == ("open",)
            for part in () if away else (e.normal, e.slip if rubs else None):
                places.append(None if part is None else len(rows))
                if part is not None:
                    f_a, _, gamma_a = row(part, t, q, v)
                    rows.append(f_a)
                    gammas.append(gamma_a)
            if any(place is not None for place in places):
                self.at[k] = places[0], places[1]
        scaled, sizes = unit(np.array(rows).reshape(-1, len(root)) / root)
        own = scaled @ applied / size
        self.rates = np.column_stack([own - np.array(gammas) / sizes / size, scaled @ scaled.T])
        self.gives = np.append(float(applied @ applied) / size**2, own)
        self.one, *self.forces = np.eye(1 + len(rows))
        self.friction = {
            k: self._friction(modes.elements[k], normal, tangent, sizes, size, (t, q, v))
            for k, (normal, tangent) in self.at.items()
            if tangent is not None and modes.elements[k].slips
        }

    def _friction(
        self, e: Element, normal: int | None, tangent: int, sizes: Array, size: float, state: Any
    ) -> _Friction:
        """Returns the friction by (2.89): by a normal force, or as a slide gives it."""
        if normal is not None:
            unit_force = self.forces[normal] * sizes[tangent] / sizes[normal]
            static, kinetic = [e.static, e.static], [e.kinetic, e.kinetic]
        else:
            unit_force = self.one * sizes[tangent] / size
            static = [*e.margins({f"{e.name}.friction": 0.0})]
            brakes = [e.braking(way) for way in ("slides +", "slides -")]
            kinetic = [abs(sum(brake.force(*state) for brake in each)) for each in brakes]
        own = self.forces[tangent]
        (to, fro), (forth, back) = ([x * unit_force for x in each] for each in (static, kinetic))
        return _Friction((to + own, fro - own), (forth + own, back - own))

    def kept(self, options: Sequence[Options], *, rests: bool) -> Array | None:
        """Returns 1 and λ that keep all that the options have in common; None where none do.

        rests: only motions count, and λ is what does most to begin one.
        """
        zero, least, cost = [*self.rates[: self.joints]], list[Array](), 0.0 * self.one
        for k, (normal, tangent) in self.at.items():
            closed: list[State] = [state for state in options[k] if state != "open"]
            opens = len(closed) < len(options[k])
            if normal is not None:
                cost = cost + self.forces[normal]
                least.append(self.forces[normal])
                (least if opens else zero).append(self.rates[normal])
            if not closed:
                zero += [self.forces[at] for at in (normal, tangent) if at is not None]
            elif tangent is not None:
                ways, kept = self._along(k, tangent, closed, opens=opens)
                zero, least = zero + ways, least + kept
        if rests:
            least.append(self.gives[0] * self.one - self.gives)  # else there may be no end
            cost = -self.gives
        forces = _programme(cost, zero, least)
        return None if forces is None or (rests and self.gives @ forces < BEGINS) else forces

    def _along(
        self, k: int, tangent: int, closed: Sequence[State], *, opens: bool
    ) -> tuple[list[Array], list[Array]]:
        """Returns what is zero and what is not negative of friction and slip of what is closed."""
        rate, friction = self.rates[tangent], self.friction.get(k)
        stays = [] if opens or [*closed] != ["sticks"] else [rate]
        if friction is None:
            return stays, []
        if len(closed) > 1 or not (s := sign(closed[0])):
            return stays, [*friction.margins]
        begins = [s * rate] if "sticks" in self.choices[k] and not opens else []
        return [friction.slides[s < 0]], begins

    def most_broken(self, options: Sequence[Options], forces: Array) -> int | None:
        """Returns the element whose law is broken most, of those not yet decided; or None.

        By its power: of what presses and opens, and what slips and is not braked as it should be.
        """
        powers: dict[int, float] = {}
        for k, states in enumerate(options):
            if len(states) > 1:
                powers[k] = 0.0
                normal, tangent = self.at.get(k, (None, None))
                if normal is not None:
                    powers[k] = float(abs(self.rates[normal] @ forces * forces[1 + normal]))
                if tangent is not None:
                    rate, missing = float(self.rates[tangent] @ forces), forces[1 + tangent]
                    if k in self.friction:
                        missing = self.friction[k].slides[rate < 0.0] @ forces
                    powers[k] = max(powers[k], abs(rate * float(missing)))
        return max(powers, key=powers.__getitem__, default=None)


def _programme(cost: Array, zero: Sequence[Array], least: Sequence[Array]) -> Array | None:
    """1 and the λ of least cost, where some rows are zero and others not negative."""
    from scipy.optimize import linprog

    equal, above = (np.array(rows).reshape(-1, len(cost)) for rows in (zero, least))
    programme: Any = linprog
    answer = programme(
        cost[1:],
        A_ub=-above[:, 1:], b_ub=above[:, 0], A_eq=equal[:, 1:], b_eq=-equal[:, 0],
        bounds=(None, None),
    )  # fmt: skip
    if answer.status == INFEASIBLE:
        return None
    if answer.x is None:
        raise ArithmeticError(f"a linear programme has no answer: {answer.message}")
    return np.append(1.0, answer.x)
