"""Finds the mode after a contact closes: the impact, and the states all elements take after it.

A mode names the state of each contact, slide and pin (`element`). The impact law gives the
velocities after the blow; from these follow the states each element may take, and of those the
combination is chosen with which all forces and accelerations agree (`mode_selection`).
"""

import math
from dataclasses import replace

import numpy as np

from ...system import Array
from ..constraints.constraint import Constraint, row
from .blow import ROUNDING, Condition, Meeting
from .element import Element, State
from .impact import NoImpact, Several, impact
from .mode_selection import STILL, After, Options, Undetermined, closed, settled, staying
from .modes import Modes, rate
from .one_instant import undivided

ANY = 1e9  # coefficient that lets nothing slip; an infinite one times a zero impulse would be nan


def landed(
    modes: Modes,
    mode: str,
    i: int,
    t: float,
    q: Array,
    v: Array,
    *,
    size: float = 0.0,
    rests: bool = False,
) -> After:
    """Returns the mode after contact i has struck the floor or another body, with its q and v.

    rests: it does not rebound, as in the limit of ever lower bounces. size [m]: of the scene; what
    is open by a gap that is none strikes at the same instant, if it closes.

    Raises Undetermined where the impact law has no answer.
    """
    if rests and not modes.elements[i].slips:
        return _at_rest(modes, mode, i, t, q, v)
    # touching: the numbers of the closed contacts, and i; met: their rows, in the same order.
    touching, met = _meetings(modes, mode, i, t, q, v, rests=rests, size=size)
    still = modes.still(t, q, v, part=STILL)
    if strikes := any(m.strikes and m.normal.rate(v) < -still for m in met):
        v, states = _after_blow(modes, mode, i, touching, met, t, q, v, size, rests=rests)
        flies = math.inf if rests else still  # what the last blow throws up, falls back at once
        options = [_next(m, state, v, still, flies) for m, state in zip(met, states, strict=True)]
    else:  # nothing approaches: it rests but for rounding, or rises from a gap that rounding made
        options = [closed(m.element, _snap(m.tangent.rate(v), still)) for m in met]
    choices: list[Options] = [
        closed(e, _snap(rate(e.slip, t, q, v), still)) if e.slip is not None else (state,)
        for e, state in zip(modes.elements, modes.states[mode], strict=True)
    ]
    for k, e in enumerate(modes.elements):
        if e.normal is not None:
            choices[k] = options[touching.index(k)] if k in touching else ("open",)
    after = settled(modes, choices, t, q, v)
    return (mode, q, v) if after[0] == mode and not strikes else after  # no blow: q, v as given


def _after_blow(
    modes: Modes,
    mode: str,
    i: int,
    touching: list[int],
    met: list[Meeting],
    t: float,
    q: Array,
    v: Array,
    size: float,
    *,
    rests: bool,
) -> tuple[Array, tuple[State, ...]]:
    """Returns q̇⁺ (n,), and the state of each of the contacts in the blow. Raises Undetermined.

    What it strikes at the same instant joins those that touch.
    """
    base = modes.base
    held = [Condition(f, g) for f, g in zip(base.f_a(t, q), base.g(t, q), strict=True)]
    if passes := passed_on(modes, mode, i, met, held, t, q, v, size):
        _join(modes, mode, i, touching, met, t, q, v, size, rests=rests)
        after = undivided(modes.M, held, met, v, plastic=rests)
        if after is None or not all(m.element.slips for m in met):
            raise passes
        open_all: tuple[State, ...] = tuple("open" for _ in met)
        return after, open_all
    try:
        taken, states = impact(modes.M, held, met, v)
    except Several as error:
        raise Undetermined(modes.elements[i].name, f"at t = {t:.4g} s {error}", t) from error
    except NoImpact as error:
        what = _friction_advice(modes, held, met, v, t) or f"at t = {t:.4g} s {error}"
        raise Undetermined(modes.elements[i].name, what, t) from error
    return taken.v, states


def _at_rest(modes: Modes, mode: str, i: int, t: float, q: Array, v: Array) -> After:
    """Returns the limit of a rocking that dies away: all pivots in it stay on the floor."""
    choices = staying(modes, mode)
    for k, e in enumerate(modes.elements):
        if k == i or (not e.slips and modes.states[mode][k] != "open"):
            choices[k] = e.rest
    return settled(modes, choices, t, q, v)


def _friction_advice(
    modes: Modes, held: list[Condition], met: list[Meeting], v: Array, t: float
) -> str | None:
    """Says with what friction a pivot would not slip in the impact; None if more is missing."""
    if any(m.element.slips for m in met):
        return None
    holds = [replace(m, element=replace(m.element, kinetic=ANY)) for m in met]
    try:
        held_fast, _ = impact(modes.M, held, holds, v)
    except NoImpact:
        return None
    if held_fast.grip is None or held_fast.grip > ANY:
        return None
    needs = f"to pivot it needs friction {held_fast.grip:.3g}"
    return f"the impact at t = {t:.4g} s would slip: {needs}"


def _next(m: Meeting, state: State, v: Array, still: float, flies: float) -> Options:
    """Returns the states a contact may take after the one it had in the blow.

    still [m/s]: slip that is zero but for rounding. flies [m/s]: what rises no faster may stay.
    """
    # m.after is above g where the restitution makes it rebound.
    if m.after > m.normal.g or (state == "open" and m.normal.rate(v) > flies):
        return ("open",)
    if state == "open":  # it bore no impulse: that it bears no force either is tried first
        stays = closed(m.element, _snap(m.tangent.rate(v), still))
        return ("open", *(state for state in stays if state != "open"))
    if m.element.frictionless or state == "sticks":
        return closed(m.element, 0.0)
    return (state, "open")


def _meetings(
    modes: Modes,
    mode: str,
    i: int,
    t: float,
    q: Array,
    v: Array,
    *,
    rests: bool,
    size: float,
) -> tuple[list[int], list[Meeting]]:
    """Returns the numbers of the contacts that are closed or strike, and each one's Meeting."""
    touching, met, first = list[int](), list[Meeting](), modes.elements[i]
    for k, (e, state) in enumerate(zip(modes.elements, modes.states[mode], strict=True)):
        if e.normal is None:
            continue
        # A pivot has its own end of all blows, `_at_rest`; what bounces has to strike alone.
        alike = e.slips == first.slips and not (e.restitution or first.restitution or rests)
        too = state == "open" and alike and strikes_too(e, t, q, v, size)
        if k == i or state != "open" or too:
            normal, tangent = _condition(e.normal, t, q, v), _condition(e.slip, t, q, v)
            back = e.restitution * normal.rate(v) if k == i and not rests else 0.0
            after = normal.g - back  # Newton: the approach times the restitution, reversed
            touching.append(k)
            met.append(Meeting(e, normal, tangent, after, k == i or too))
    return touching, met


def _condition(part: Constraint | None, t: float, q: Array, v: Array) -> Condition:
    """Returns f_a and g of a row; zeros where there is none, as of a rope, which has no slip."""
    return Condition(np.zeros(len(v)), 0.0) if part is None else Condition(*row(part, t, q, v)[:2])


def _snap(slip: float, still: float) -> float:
    """Returns the slip [m/s], exactly zero where it is no more than rounding."""
    return slip if abs(slip) > still else 0.0


# Impacts at one instant: rigid bodies do not say how a blow is divided between them.
#
# Three balls that touch: Newton's law of each pair is met by many motions, and which of them real
# balls take is decided by how they give way. A gap, however small, puts one after the other. Where
# all ways lead to one velocity it does not matter (`one_instant`).


class OneInstant(Undetermined):
    """A blow that passes through several contacts at once."""


def passed_on(
    modes: Modes,
    mode: str,
    i: int,
    met: list[Meeting],
    held: list[Condition],
    t: float,
    q: Array,
    v: Array,
    size: float,
) -> OneInstant | None:
    """Why what strikes in contact i does not strike alone: it passes its blow on; or None."""
    first, small = modes.elements[i], ROUNDING * float(np.max(np.abs(v)))
    others = [modes.elements[k] for k in _sharing(modes, mode, i, t, q, v, size)]
    if not others:
        return None
    try:
        alone, _ = impact(modes.M, held, [m for m in met if m.strikes], v)
    except NoImpact:
        return None  # with all that touch it is tried again, and told
    for e in others:
        assert e.normal is not None
        before, now = rate(e.normal, t, q, v), rate(e.normal, t, q, alone.v)
        if now < -small and abs(now - before) > small:
            both = f"{first.name} and {e.name} strike at one instant, t = {t:.4g} s"
            if before >= -small:
                both = f"{first.name} strikes at t = {t:.4g} s what {e.name} touches and passes on"
            what = (
                f"{both}: rigid bodies do not say how the blow is divided, and it differs by the "
                "order; leave a gap, so that one strikes after the other"
            )
            return OneInstant(first.name, what, t)
    return None


def _sharing(
    modes: Modes, mode: str, i: int, t: float, q: Array, v: Array, size: float
) -> list[int]:
    """The numbers of the others that touch and may take a part of the blow of contact i."""
    pairs = zip(modes.elements, modes.states[mode], strict=True)
    return [
        k
        for k, (e, state) in enumerate(pairs)
        if _shares(modes.elements[i], e, state)
        if state != "open" or _touches(e, t, q, v, size)
    ]


def _join(
    modes: Modes,
    mode: str,
    i: int,
    touching: list[int],
    met: list[Meeting],
    t: float,
    q: Array,
    v: Array,
    size: float,
    *,
    rests: bool,
) -> None:
    """Adds what shares the blow to those that touch, as what strikes or may be struck by it."""
    for k in _sharing(modes, mode, i, t, q, v, size):
        e = modes.elements[k]
        normal, tangent = _condition(e.normal, t, q, v), _condition(e.slip, t, q, v)
        back = 0.0 if rests else e.restitution * min(0.0, normal.rate(v))
        after = normal.g - back
        meeting = Meeting(e, normal, tangent, after, True)
        if k in touching:
            met[touching.index(k)] = meeting
        else:
            touching.append(k)
            met.append(meeting)


def _shares(first: Element, e: Element, state: State) -> bool:
    """Whether it matters in which order they strike: not, where all stay together afterwards.

    What only rests on a plane without bouncing is held by it. Two that strike planes at once, as
    both corners of what falls flat, are one blow where neither bounces.
    """
    if e is first or e.normal is None or not (first.two or e.two or state == "open"):
        return False
    return e.restitution > 0.0 or ((e.two or state == "open") and first.restitution > 0.0)


def strikes_too(e: Element, t: float, q: Array, v: Array, size: float) -> bool:
    """Whether an open contact closes at this instant as well, in a scene of that size [m]."""
    assert e.normal is not None
    small = ROUNDING * float(np.max(np.abs(v)))
    return _touches(e, t, q, v, size) and rate(e.normal, t, q, v) < -small


def _touches(e: Element, t: float, q: Array, v: Array, size: float) -> bool:
    """Whether its gap is none and does not open: without a force rounding may call it open."""
    assert e.normal is not None
    small = ROUNDING * float(np.max(np.abs(v)))
    return e.normal.f(t, q.tolist())[0] <= e.near(size) and rate(e.normal, t, q, v) <= small
