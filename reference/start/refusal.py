"""Why a start is refused, in words that name the part and the number."""

import math

import numpy as np

from ...cases.mistake import CaseError
from ..system import Array
from .closure import Closure

DEGREES = 180 / math.pi


def _initial(closure: Closure, what: str) -> CaseError:
    return CaseError([closure.case.mistake(("initial",), what)])


def cannot_close(closure: Closure, q: Array) -> CaseError:
    """No positions satisfy the constraints; q is the best that was found."""
    residual = closure.equations(q)[0]
    owners = [(c.part, angular) for c in closure.places for angular in c.angular]
    worst = int(np.argmax(np.abs(residual)))
    name, is_angle = owners[worst]
    gap = abs(float(residual[worst]))
    size = f"{gap * DEGREES:.3g} deg" if is_angle else f"{gap * closure.size:.3g} m"
    if len(closure.free):
        why = "the mechanism cannot be assembled from what is given"
    else:
        why = "the initial state violates a constraint"
    return _initial(closure, f"{why}: {name} stays open by {size}")


def several_ways(closure: Closure, ways: list[Array]) -> CaseError:
    """Names the coordinate in which the ways differ most, with its values."""
    differ = np.abs(ways[0] - ways[1])
    differ = np.where(closure.turning, np.abs(np.sin(differ / 2)), differ / closure.size)
    turning = closure.turning & (differ > np.max(differ) / 10)  # angles are easier to guess
    i = int(np.argmax(np.where(turning, differ, 0.0) if np.any(turning) else differ))
    body, field = closure.where.names[i].split(".")
    values = list(dict.fromkeys(_shown(closure, i, q) for q in ways))
    return _initial(
        closure,
        f"the mechanism can be assembled in {len(ways)} ways: {body}.{field} = "
        f"{' or '.join(values)}; say which by `near`, for instance "
        f"near: {{{body}: {{{field}: {values[0]}}}}}",
    )


def _shown(closure: Closure, column: int, q: Array) -> str:
    if closure.turning[column]:
        return f"{q[column] * DEGREES:.4g} deg"
    return f"{q[column]:.4g} m"


def open_ended(
    closure: Closure, loose: list[str], rank: int, *, among: int | None = None
) -> CaseError:
    """Coordinates or rates that follow from nothing; `among` so many unknowns."""
    missing = (len(closure.free) if among is None else among) - rank
    return _initial(
        closure,
        f"{missing} more needed: {', '.join(loose)} {'is' if len(loose) == 1 else 'are'} "
        "not determined by what is given and the constraints",
    )


def dead_centre(closure: Closure, loose: list[str]) -> CaseError:
    """Two ways to assemble fall together: the constraints hold, but hardly determine anything."""
    return _initial(
        closure,
        f"the mechanism stands at a dead centre, where what is given hardly determines "
        f"{', '.join(loose)}; give one of these instead",
    )


def dependent(closure: Closure, part: str) -> CaseError:
    """A constraint that repeats what others hold."""
    scene = closure.case.scene
    kind = next(s for s in ("joints", "constraints", "contacts") if part in getattr(scene, s))
    return CaseError(
        [
            closure.case.mistake(
                ("scene", kind, part),
                "the constraints are not independent: what this one holds is held by the others "
                "already, for good or in this position, so its reaction has no single value; "
                "leave it out, replace it by one that holds less, or start elsewhere",
            )
        ]
    )


def rates_violate(closure: Closure, part: str) -> CaseError:
    """The given rates contradict each other."""
    return _initial(closure, f"the rates violate {part}: no motion satisfies all that is given")
