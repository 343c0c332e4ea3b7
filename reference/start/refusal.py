"""Why a start in the plane is refused, in words that name the part and the number."""

import numpy as np

from ...cases.mistake import CaseError
from ..system import Array
from . import messages
from .closure import Closure
from .messages import DEGREES


def cannot_close(closure: Closure, q: Array) -> CaseError:
    """No positions satisfy the constraints; q is the best that was found."""
    residual = closure.equations(q)[0]
    owners = [(c.part, angular) for c in closure.places for angular in c.angular]
    worst = int(np.argmax(np.abs(residual)))
    part, turns = owners[worst]
    if len(closure.free):
        why = "the mechanism cannot be assembled from what is given"
    else:
        why = "the initial state violates a constraint"
    gap = abs(float(residual[worst]))
    return messages.stays_open(closure.case, why, part, gap, closure.size, turns=turns)


def several_ways(closure: Closure, ways: list[Array]) -> CaseError:
    """Names the coordinate in which the ways differ most, with its values."""
    differ = np.abs(ways[0] - ways[1])
    differ = np.where(closure.turning, np.abs(np.sin(differ / 2)), differ / closure.size)
    turning = closure.turning & (differ > np.max(differ) / 10)  # angles are easier to guess
    i = int(np.argmax(np.where(turning, differ, 0.0) if np.any(turning) else differ))
    shown_each = (shown(q[i], turns=bool(closure.turning[i])) for q in ways)
    values = list(dict.fromkeys(shown_each))
    return messages.several(closure.case, len(ways), closure.where.names[i], values)


def shown(value: float, *, turns: bool) -> str:
    """A coordinate as a file has it."""
    return f"{value * DEGREES:.4g} deg" if turns else f"{value:.4g} m"


def another_turn(closure: Closure, joint: str, off: float) -> CaseError:
    """A joint's angle that is whole turns from that of its bodies; off [rad]: how far."""
    given = closure.case.initial[joint].given["angle"]
    what = (
        f"is {given:.6g} rad, but the bodies start {given + off:.6g} rad apart, which is another "
        "turn: angles count their turns, so give both on the same one"
    )
    return CaseError([closure.case.mistake(("initial", joint, "angle"), what)])


def open_ended(
    closure: Closure, loose: list[str], rank: int, *, among: int | None = None
) -> CaseError:
    """Coordinates or rates that follow from nothing; `among` so many unknowns."""
    count = (len(closure.free) if among is None else among) - rank
    return messages.missing(closure.case, count, loose)


def dependent(closure: Closure, part: str) -> CaseError:
    """A constraint that repeats what others hold."""
    scene = closure.case.scene
    kind = next(s for s in ("joints", "constraints", "contacts") if part in getattr(scene, s))
    return messages.dependent(closure.case, kind, part)


def without_length(closure: Closure, name: str) -> CaseError:
    """A rod whose points start at one place."""
    what = "has no length: its two points start at the same place, and it would have no direction"
    return CaseError([closure.case.mistake(("scene", "joints", name), what)])
