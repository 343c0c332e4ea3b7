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
    values = list(dict.fromkeys(_shown(closure, i, q) for q in ways))
    return messages.several(closure.case, len(ways), closure.where.names[i], values)


def _shown(closure: Closure, column: int, q: Array) -> str:
    if closure.turning[column]:
        return f"{q[column] * DEGREES:.4g} deg"
    return f"{q[column]:.4g} m"


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
