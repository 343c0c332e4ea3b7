"""Where a contact lands: the impact, and what every contact and slide may do after it."""

from dataclasses import replace

import numpy as np

from ..system import Array
from .choosing import After, Options, Undetermined, closed, settled, staying
from .contact import row
from .element import Element, State
from .impact import Condition, Meeting, NoImpact, impact
from .modes import Modes, rate
from .together import check_alone

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
    base = modes.base
    if rests and not modes.elements[i].slips:
        return _at_rest(modes, mode, i, t, q, v)
    touching, met = _meetings(modes, mode, i, t, q, v, rests=rests)
    held = [Condition(f, g) for f, g in zip(base.f_a(t, q), base.g(t, q), strict=True)]
    check_alone(modes, mode, i, met, held, t, q, v, near)
    try:
        v, states = impact(modes.M, held, met, v)
    except NoImpact as error:
        what = _needed(modes, held, met, v, t) or str(error)
        raise Undetermined(modes.elements[i].name, what, t) from error
    choices: list[Options] = [
        closed(e, _slip(e, t, q, v)) if e.slip is not None else (state,)
        for e, state in zip(modes.elements, modes.states[mode], strict=True)
    ]
    for k, e in enumerate(modes.elements):
        if e.normal is not None and k not in touching:
            choices[k] = ("open",)
    for k, m, state in zip(touching, met, states, strict=True):
        leaves = state == "open" or m.after > 0.0
        choices[k] = ("open",) if leaves else _staying(m.element, state)
    return settled(modes, choices, t, q, v)


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


def _staying(element: Element, state: State) -> Options:
    if element.frictionless or state == "sticks":
        return closed(element, 0.0)
    return (state, "open")


def _meetings(
    modes: Modes, mode: str, i: int, t: float, q: Array, v: Array, *, rests: bool
) -> tuple[list[int], list[Meeting]]:
    """The contacts that are closed or strike, and their rows."""
    touching, met = [], []
    for k, (e, state) in enumerate(zip(modes.elements, modes.states[mode], strict=True)):
        if e.normal is not None and (k == i or state != "open"):
            parts = (e.normal, e.tangent)
            normal, tangent = (Condition(*row(part, t, q, v)[:2]) for part in parts)
            after = -e.restitution * float(normal.f @ v) if k == i and not rests else 0.0
            touching.append(k)
            met.append(Meeting(e, normal, tangent, after, k == i))
    return touching, met


def _slip(e: Element, t: float, q: Array, v: Array) -> float:
    slip = rate(e.tangent, t, q, v)
    return slip if abs(slip) > STILL * float(np.max(np.abs(v))) else 0.0
