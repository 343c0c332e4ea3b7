"""Where a contact lands: the impact, and what every contact and slide may do after it."""

import numpy as np

from ..system import Array
from .choosing import After, Options, Undetermined, closed, settled
from .contact import row
from .element import Element, State
from .impact import Condition, Meeting, NoImpact, impact
from .modes import Modes, rate

STILL = 1e-12  # of the largest rate: what a projection or an assembly leaves of a zero


def landed(
    modes: Modes, mode: str, i: int, t: float, q: Array, v: Array, *, rests: bool = False
) -> After:
    """The mode after contact i has struck the floor, and its state; `rests`: it stays there.

    Raises Undetermined where the impact law has no answer.
    """
    base = modes.base
    touching, met = _meetings(modes, mode, i, t, q, v, rests=rests)
    held = [Condition(f, g) for f, g in zip(base.f_a(t, q), base.g(t, q), strict=True)]
    try:
        v, states = impact(modes.M, held, met, v)
    except NoImpact as error:
        raise Undetermined(modes.elements[i].name, str(error), t) from error
    choices = [closed(e, _slip(e, t, q, v)) for e in modes.elements]
    for k, e in enumerate(modes.elements):
        if e.normal is not None and k not in touching:
            choices[k] = ("open",)
    for k, m, state in zip(touching, met, states, strict=True):
        leaves = state == "open" or m.after > 0.0
        choices[k] = ("open",) if leaves else _staying(m.element, state)
    return settled(modes, choices, t, q, v)


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
