"""Impacts at one instant: rigid bodies do not say how a blow is divided between them.

Three balls that touch: Newton's law of each pair is met by many motions, and which of them real
balls take is decided by how they give way. A gap, however small, puts one after the other.
"""

import numpy as np

from ...system import Array
from .blow import ROUNDING, Condition, Meeting
from .element import Element, State
from .impact import NoImpact, impact
from .mode_selection import Undetermined
from .modes import Modes, rate


class OneInstant(Undetermined):
    """A blow that passes through several contacts at once."""


def check_alone(
    modes: Modes,
    mode: str,
    i: int,
    met: list[Meeting],
    held: list[Condition],
    t: float,
    q: Array,
    v: Array,
    near: float,
) -> None:
    """Raises OneInstant if what strikes in contact i passes its blow on in the same instant.

    near [m]: a gap that is none.
    """
    first, small = modes.elements[i], ROUNDING * float(np.max(np.abs(v)))
    others = [
        e
        for e, state in zip(modes.elements, modes.states[mode], strict=True)
        if _shares(first, e, state)
        if state != "open" or strikes_too(e, t, q, v, near)
    ]
    if not others:
        return
    try:
        alone, _ = impact(modes.M, held, [m for m in met if m.strikes], v)
    except NoImpact:
        return  # with all that touch it is tried again, and told
    for e in others:
        assert e.normal is not None
        before, now = rate(e.normal, t, q, v), rate(e.normal, t, q, alone.v)
        if now < -small and abs(now - before) > small:
            what = (
                f"{first.name} and {e.name} strike at one instant, t = {t:.4g} s: rigid bodies do "
                "not say how the blow is divided; leave a gap, so that one strikes after the other"
            )
            raise OneInstant(first.name, what, t)


def _shares(first: Element, e: Element, state: State) -> bool:
    """Whether it matters in which order they strike: not, where all stay together afterwards.

    What only rests on a plane without bouncing is held by it. Two that strike planes at once, as
    both corners of what falls flat, are one blow where neither bounces.
    """
    if e is first or e.normal is None or not (first.two or e.two or state == "open"):
        return False
    return e.restitution > 0.0 or ((e.two or state == "open") and first.restitution > 0.0)


def strikes_too(e: Element, t: float, q: Array, v: Array, near: float) -> bool:
    """Whether an open contact closes at this instant as well; near [m]: a gap that is none."""
    assert e.normal is not None
    small = ROUNDING * float(np.max(np.abs(v)))
    return e.normal.f(t, q.tolist())[0] <= near and rate(e.normal, t, q, v) < -small
