"""Where a contact lands: the impact, and what every contact and slide may do after it."""

import math
from dataclasses import replace

import numpy as np

from ...system import Array
from ..constraints.constraint import Constraint
from ..constraints.contact import row
from .blow import Condition, Meeting
from .element import State
from .impact import NoImpact, Several, impact
from .mode_selection import After, Options, Undetermined, closed, settled, staying
from .modes import Modes, rate
from .simultaneous_impacts import check_alone

ANY = 1e9  # friction that lets nothing slip; an infinite one times no impulse would be no number
STILL = 1e-12  # of the largest rate: what a projection or an assembly leaves of a zero


def landed(
    modes: Modes,
    mode: str,
    i: int,
    t: float,
    q: Array,
    v: Array,
    *,
    near: float = 0.0,
    rests: bool = False,
) -> After:
    """The mode after contact i has struck the floor, and its state; `rests`: it stays there.

    near [m]: what strikes in a contact with no larger gap strikes at the same instant.

    Raises Undetermined where the impact law has no answer.
    """
    if rests and not modes.elements[i].slips:
        return _at_rest(modes, mode, i, t, q, v)
    touching, met = _meetings(modes, mode, i, t, q, v, rests=rests)
    still = modes.still(t, q, v, part=STILL)
    if strikes := any(m.strikes and m.normal.rate(v) < -still for m in met):
        v, states = _struck(modes, mode, i, met, t, q, v, near)
        flies = math.inf if rests else still  # what the last blow throws up, falls back at once
        found = [_after(m, state, v, still, flies) for m, state in zip(met, states, strict=True)]
    else:  # at rest by rounding, or on its way up in a flight that is none, it strikes nothing
        found = [closed(m.element, _clear(m.tangent.rate(v), still)) for m in met]
    choices: list[Options] = [
        closed(e, _clear(rate(e.slip, t, q, v), still)) if e.slip is not None else (state,)
        for e, state in zip(modes.elements, modes.states[mode], strict=True)
    ]
    for k, e in enumerate(modes.elements):
        if e.normal is not None:
            choices[k] = found[touching.index(k)] if k in touching else ("open",)
    after = settled(modes, choices, t, q, v)
    return (mode, q, v) if after[0] == mode and not strikes else after  # then nothing has happened


def _struck(
    modes: Modes, mode: str, i: int, met: list[Meeting], t: float, q: Array, v: Array, near: float
) -> tuple[Array, tuple[State, ...]]:
    """q̇⁺ (n,), and what each of the contacts does in the blow. Raises Undetermined."""
    base = modes.base
    held = [Condition(f, g) for f, g in zip(base.f_a(t, q), base.g(t, q), strict=True)]
    check_alone(modes, mode, i, met, held, t, q, v, near)
    try:
        return impact(modes.M, held, met, v)
    except Several as error:
        raise Undetermined(modes.elements[i].name, f"at t = {t:.4g} s {error}", t) from error
    except NoImpact as error:
        what = _needed(modes, held, met, v, t) or str(error)
        raise Undetermined(modes.elements[i].name, what, t) from error


def _at_rest(modes: Modes, mode: str, i: int, t: float, q: Array, v: Array) -> After:
    """The limit of a rocking that dies away: all pivots that take part in it stay on the floor."""
    choices = staying(modes, mode)
    for k, e in enumerate(modes.elements):
        if k == i or (not e.slips and modes.states[mode][k] != "open"):
            choices[k] = e.rest
    return settled(modes, choices, t, q, v)


def _needed(
    modes: Modes, held: list[Condition], met: list[Meeting], v: Array, t: float
) -> str | None:
    """With what friction a pivot would not slip in the impact, if that is what is missing."""
    if any(m.element.slips for m in met):
        return None
    holds = [replace(m, element=replace(m.element, kinetic=ANY)) for m in met]
    try:
        after, _ = impact(modes.M, held, holds, v)
    except NoImpact:
        return None
    impulse = modes.M * (after - v)
    places = [xy for xy, _ in modes.base.where.columns.values()]
    along, up = (sum(impulse[xy + i] for xy in places) for i in (0, 1))
    return f"the impact at t = {t:.4g} s would slip: to pivot it needs {abs(along) / up:.3g}"


def _after(m: Meeting, state: State, v: Array, still: float, flies: float) -> Options:
    """States that a contact may take after this one in the blow; what rises no faster may stay."""
    if m.after > m.normal.g or (state == "open" and m.normal.rate(v) > flies):
        return ("open",)
    if state == "open":  # it has taken no part, and is first asked to take none now
        stays = closed(m.element, _clear(m.tangent.rate(v), still))
        return ("open", *(state for state in stays if state != "open"))
    if m.element.frictionless or state == "sticks":
        return closed(m.element, 0.0)
    return (state, "open")


def _meetings(
    modes: Modes, mode: str, i: int, t: float, q: Array, v: Array, *, rests: bool
) -> tuple[list[int], list[Meeting]]:
    """The contacts that are closed or strike, and their rows."""
    touching, met = [], []
    for k, (e, state) in enumerate(zip(modes.elements, modes.states[mode], strict=True)):
        if e.normal is not None and (k == i or state != "open"):
            normal, tangent = _condition(e.normal, t, q, v), _condition(e.slip, t, q, v)
            back = e.restitution * normal.rate(v) if k == i and not rests else 0.0
            after = normal.g - back
            touching.append(k)
            met.append(Meeting(e, normal, tangent, after, k == i))
    return touching, met


def _condition(part: Constraint | None, t: float, q: Array, v: Array) -> Condition:
    """The condition of a row; where there is none, as a rope slips along nothing, zeros."""
    return Condition(np.zeros(len(v)), 0.0) if part is None else Condition(*row(part, t, q, v)[:2])


def _clear(slip: float, still: float) -> float:
    """Zero, if it is rounding."""
    return slip if abs(slip) > still else 0.0
