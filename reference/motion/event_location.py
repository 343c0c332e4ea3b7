"""Where in a step a guard falls through zero.

No interpolation: the state within a step is that of a shorter one, and the root-finder repeats it
until it ends on the zero.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import cache

import numpy as np

from ..system import TOGETHER, Array

ROOT = 1e-3  # of that: what the root-finder is asked for, to keep the promise
INSIDE = (0.25, 0.5, 0.75)  # of a step: a guard turns no faster than the motion, at most once
SOON = tuple(2.0**-k for k in range(16, 2, -1))  # of a step: what begins at zero may fall at once
TOUCH = 1e-10  # of its values around: what falls no deeper has touched zero, and not fallen
TURN = 1e-6  # of its bracket: a dip's bottom known so well is known to 1e-12 of the dip's size
HALVINGS = 40  # of a step, in search of the rise of a guard that begins at zero: to 1e-12 of it

# A guard is clear of zero by as much as it changes in the step, seen at the quarters, or by a tenth
# of that, seen at the eighths: between these a parabola is lower by 2 % at most.
LOOKS = (((0.0, *INSIDE, 1.0), 1.0), (tuple(k / 8 for k in range(9)), 0.1))

Slope = Callable[[float, Array], Array]
"""t, y → ẏ."""
Fall = Callable[[float, Array], float]
"""t, y → g of a guard."""
Within = Callable[[float], Array]
"""h → y after a step of that length."""
Rounding = Callable[[Fall, Array], Iterable[float]]
"""A guard and y at a step's end → what rounding makes of the guard at each point of the step."""


def clear(guards: Sequence[Fall], f: Slope, t: float, h: float, y0: Array, y1: Array) -> bool:
    """Whether all guards stay clear of zero in the step from y0 at t to y1 at t + h.

    The states inside are those of the cubic through both ends and their slopes, which is 1e-4 of
    what a guard changes off (measured): enough to say that nothing is near. What is near has its
    states computed.
    """
    try:
        with np.errstate(all="ignore"):  # beyond a pole the cubic may be anywhere
            return _clear(guards, f, t, h, y0, y1)
    except (ArithmeticError, ValueError):
        return False


def _clear(guards: Sequence[Fall], f: Slope, t: float, h: float, y0: Array, y1: Array) -> bool:
    k0, k1, near = h * f(t, y0), h * f(t + h, y1), guards
    for points, margin in LOOKS:
        rows = []
        for s in points:
            y = y0 + s * ((y1 - y0) * s * (3 - 2 * s) + (1 - s) * (k0 * (1 - s) - k1 * s))
            rows.append([guard(t + s * h, y) for guard in near])
        both = zip(near, zip(*rows, strict=True), strict=True)
        near = [guard for guard, values in both if not _far(values, margin)]
        if not near:
            return True
    return False


def _far(values: Sequence[float], margin: float) -> bool:
    low, high = min(values), max(values)
    return low > margin * (high - low)  # not of NaN


def first(
    guards: Sequence[Fall],
    t: float,
    points: list[float],
    states: Sequence[Array],
    state: Within,
    *,
    begins: bool,
    spent: int | None,
    rounding: Rounding | None = None,
    nothing: Sequence[float] = (),
    soon: int = 0,
    together: float = TOGETHER,
) -> tuple[tuple[int, float] | None, list[tuple[int, float]]]:
    """Which guard falls first in the step from t, and how far into it; and which touch zero before.

    points: 0, some times inside the step, and its length; states: y at each of them. begins: the
    mode does, with this step. spent: the guard that ended it just before. rounding: what is no more
    than that is zero, and a guard that is zero begins. nothing: for each guard, of what size it is
    none all along. soon: so many of the points are right after the begin, where only guards are
    looked at of which it is known what is nothing. together [s]: of two that fall so close the
    first in the list is told.
    """
    earliest, touched = None, list[tuple[int, float]]()
    # All guards at one state: they ask for the same forces.
    asked = zip(points, states, strict=True)
    rows = [[guard(t + at, y) for guard in guards] for at, y in asked]
    for i, guard in enumerate(guards):

        def g(at: float, guard: Fall = guard) -> float:
            return guard(t + at, state(at))

        values, none = [row[i] for row in rows], nothing[i] if nothing else 0.0
        if nothing and max(map(abs, values)) <= none:
            continue
        if rounding is not None:
            pairs = zip(values, rounding(guard, states[-1]), strict=True)
            values = [value if abs(value) > room else 0.0 for value, room in pairs]
        fresh = begins or (rounding is not None and values[0] == 0.0)
        looked = points
        if soon and none:
            values[: soon + 1] = [x if abs(x) > none else 0.0 for x in values[: soon + 1]]
        elif soon:
            looked, values = [0.0, *points[soon + 1 :]], [values[0], *values[soon + 1 :]]
        at, touch = crossing(g, looked, values, begins=fresh, spent=i == spent, together=together)
        if at is not None and (earliest is None or at < earliest[1] - together):
            earliest = i, at
        if touch is not None:
            touched.append((i, touch))
    return earliest, [each for each in touched if earliest is None or each[1] < earliest[1]]


def crossing(
    g: Callable[[float], float],
    points: list[float],
    values: list[float],
    *,
    begins: bool,
    spent: bool,
    together: float = TOGETHER,
) -> tuple[float | None, float | None]:
    """Where g first falls through zero, or else where it touches it, of what is known at points."""
    rise = next((i for i, value in enumerate(values) if value > 0.0), None)
    if rise is None:
        if begins and values[-1] < values[0]:
            return _onset(g, points[-1], spent, together), None
        top = _bracket(g, points, values, -1.0)
        return None if top is None else _root(g, *top, together), None
    if begins and not spent and rise:
        low = min(values[:rise])
        if low < values[0] - TOUCH * max(map(abs, values)):  # and it comes back in the same step
            return _onset(g, points[values.index(low)], spent, together), None
    fall = next((i for i in range(rise, len(values)) if values[i] <= 0.0), None)
    if fall is not None:
        left, at = points[fall - 1], points[fall]
        if begins and fall == 1:
            left = _last_rise(g, values[0], at)
    elif (bottom := _bracket(g, points[rise:], values[rise:], 1.0)) is not None:
        left, at = bottom
    else:
        return None, None
    if _touches(g, points, values, at):
        rises = begins and values[0] == min(values)  # from the zero with which its mode begins
        return None, None if rises else at
    if fall is None and g(at) > 0.0:
        return None, None  # it falls behind the step
    return _root(g, left, at, together), None


def _touches(
    g: Callable[[float], float], points: list[float], values: list[float], at: float
) -> bool:
    """Whether g, not positive at that point, falls no further, there or as long a step beyond.

    A speed that comes to zero and rises again is negative there by rounding, or not: whether it
    fell would be chance, and the motion is the same. What falls at the point turns, if it does not
    go on, before the first place that is looked at.
    """
    from scipy.optimize import minimize_scalar

    deep, step = TOUCH * max(map(abs, values)), points[-1]
    if min(g(at), *values) < -deep:
        return False
    if any(g(at + part * step) < -deep for part in (*INSIDE, 1.0)):
        return False
    part = INSIDE[0] * step
    turn = minimize_scalar(
        g, bounds=(at, at + part), method="bounded", options={"xatol": TURN * part}
    )
    return bool(turn.fun >= -deep)


def _onset(g: Callable[[float], float], h: float, spent: bool, together: float) -> float | None:
    """The zero after a rise too short for the points to see; without one, the very beginning."""
    for k in range(1, HALVINGS):
        if g(h / 2**k) > 0.0:
            return _root(g, h / 2**k, h / 2 ** (k - 1), together)
    return None if spent else 0.0


def _last_rise(g: Callable[[float], float], begin: float, fallen: float) -> float:
    """The last of ever shorter times at which g is more than it begins with; 0 without one.

    What begins with a zero that rounding has made positive, rises and falls at once, as a rope just
    let go between two blows, would else fall where nothing but its rounding does.
    """
    return next((at for k in range(1, HALVINGS) if g(at := fallen / 2**k) > begin), 0.0)


def _bracket(
    g: Callable[[float], float], points: list[float], values: list[float], sign: float
) -> tuple[float, float] | None:
    """A dip to zero (sign 1) or a hump above it (−1) between the points: a bracket of its fall.

    It is looked for where the values come as near to zero as they differ from each other; not in
    what is zero throughout, as the force between bodies that fly on together.
    """
    from scipy.optimize import minimize_scalar

    sizes = [sign * value for value in values]
    low = int(np.argmin(sizes))
    if len(points) < 2 or not any(values) or sizes[low] > max(sizes) - sizes[low]:
        return None
    left, right = points[max(low - 1, 0)], points[min(low + 1, len(points) - 1)]
    turn = minimize_scalar(
        lambda at: sign * g(at),
        bounds=(left, right),
        method="bounded",
        options={"xatol": TURN * (right - left)},
    )
    if sign > 0.0:
        return (left, float(turn.x)) if turn.fun <= TOUCH * max(sizes) else None
    return (float(turn.x), right) if turn.fun < 0.0 else None


def _root(
    values: Callable[[float], float], left: float, right: float, together: float = TOGETHER
) -> float:
    """Just beyond the zero between a positive value and one that is not: g has fallen there."""
    from scipy.optimize import brentq

    g = cache(values)  # an implicit step repeated differs by rounding
    if g(right) > 0.0:  # so that the zero is here
        return right
    if not g(left) > 0.0:  # or there
        return left
    beyond = ROOT * together
    root = float(brentq(g, left, right, xtol=beyond, rtol=4 * np.finfo(float).eps))
    while root < right and g(root) > 0.0:
        root, beyond = min(root + beyond, right), 2 * beyond
    return root
