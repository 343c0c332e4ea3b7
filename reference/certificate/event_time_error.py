"""How well the times of events are known: no better than what falls to zero, where it is flat.

What is known to r, and falls through zero with the slope s, does so within r/s of its time; what
only just reaches zero, as at a graze, within √(2 r/s′).
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.linalg import LinAlgError

from ...cases.fields.event import Event
from ...cases.scene import Scene
from ...cases.scene.observe import observe
from ...cases.scene.passages import passing, pieces, still
from ...cases.trajectory import Trajectory
from ..integrators.dop853 import DOP853
from ..integrators.march import EPS, sizes
from ..integrators.slope import APART, DIFFERENCED, noise, scatter
from ..motion.follow import TOLERANCE, Change, Followed, Kept
from ..motion.stuck import slope
from ..system import Array, Mode, System
from .agreement import worst

# Times what is known of what falls: where it dips below zero by just that, it may be there later
# than it was found to be, by as long as it took to come down from three times that.
DIP = 3.0
# A row of ten may meet little of a rounding, so several are asked: from these of a mode's steps on,
# and before an event so closely.
LISTENED = (0.0, 0.25, 0.5, 0.75)
SPACED = (1.0, 0.61, 0.37)
FIRST = 1  # from that step on: from rest a law with a root has no smooth slope beside its rounding
LINE = range(DIFFERENCED)


def untimed(system: System, followed: Followed) -> float:
    """By how much [s] the times of a motion's events may be off, each by what its own guard leaves
    open and by what the events before it are off."""
    peak = np.max(np.abs([y for *_, y in followed.march]), axis=0)
    known, off = TOLERANCE * sizes(peak, TOLERANCE), 0.0
    phases: list[list[Kept]] = [[] for _ in followed.phases]
    for row in followed.march:
        phases[row[1]].append(row)
    added = np.zeros_like(peak)
    for change, rows in zip(followed.changes, phases, strict=False):
        added = np.hypot(added, _added(system.modes[change.mode_before], rows))
        if change.guard is not None:
            off += _untimed(system, change, change.guard, rows, known + added)
    return off


def _added(mode: Mode, rows: Sequence[Kept]) -> Array:
    """The error that the steps of a mode make of its slopes' rounding: the state does not tell it.

    A spring of a metre that moves a millimetre has the rounding of a metre in its force. Each step
    adds up its slopes with weights, and what they leave adds up by chance.
    """
    steps, f, loud = np.diff([t for t, *_ in rows]), slope(mode), 0.0 * rows[0][2]
    lasting = np.flatnonzero(steps)
    asked = {min(max(FIRST, int(part * len(lasting))), len(lasting) - 1) for part in LISTENED}
    for k in lasting[sorted(asked)] if len(lasting) else ():
        t, _, y = rows[k]
        try:
            found = noise(f, t, y, float(steps[k]), np.abs(y))
        except (ArithmeticError, ValueError, LinAlgError):  # it may not be defined so far out
            continue
        loud = loud if found is None else np.maximum(loud, found)
    return float(np.linalg.norm(DOP853.b) * np.linalg.norm(steps)) * loud


def _untimed(
    system: System, change: Change, guard: int, rows: Sequence[Kept], known: Array
) -> float:
    """How long before its event a guard was already no more than what is known of it.

    rows: the steps of its mode. known: what is known of each component of the state.
    """
    mode, t, y = system.modes[change.mode_before], change.time, change.before
    f, fall = slope(mode), system.guards(change.mode_before)[guard].g

    def g(t: float, y: Array) -> float:
        return fall(t, *mode.parted(y))

    def earlier(back: float) -> float:
        middle = y - back / 2 * f(t, y)
        return g(t - back, y - back * f(t - back / 2, middle))

    begin, _, first = rows[0]
    try:
        room = sum(abs(g(t, y + each) - g(t, y)) for each in np.diag(known))
        room += EPS * abs(g(begin, first))  # it is the difference of two that are as large
        last = APART * (t - rows[-2][0] if len(rows) > 1 else 0.0)
        along = f(t, y)
        room += max(
            float(scatter([np.array(g(t - k * pace, y - k * pace * along)) for k in LINE]))
            for pace in (last * part for part in SPACED)
        )
        clear = [at for at, _, there in rows if g(at, there) > DIP * room]
        return _within(earlier, room, t, t - max(clear, default=begin))
    except (ArithmeticError, ValueError, LinAlgError):  # it may not be defined beyond its zero
        return t - begin


def unread(scene: Scene, record: Trajectory, event: Event, room: float) -> float:
    """By how much [s] an event may be off that no guard tells: a passage through zero, read from
    the record.

    room: what is known of its quantity.
    """
    u = event.falling(observe(scene, record, event.quantity))
    room = max(room, TOLERANCE * worst(np.abs(u)))
    small, off = still(scene, record, event.quantity), 0.0
    for _, times, values in pieces(record, u, scene.corners()):
        for t, curve in passing(times, values, small):
            if curve is not None:
                lasted = t - float(record.times[0])
                off = max(off, _within(lambda back, t=t, u=curve: u(t - back), room, t, lasted))
    return off


def _within(g: Callable[[float], float], room: float, t: float, most: float) -> float:
    """How long before its zero at t a function was already as small as that, to a factor of two."""
    back = math.ulp(t)
    while back < most and abs(g(back)) <= DIP * room:
        back *= 2.0
    return min(back, most)
