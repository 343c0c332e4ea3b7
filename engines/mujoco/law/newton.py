"""All depths and creeps of a start at once, by Newton's method from where they nearly are.

One after the other they settle as slowly as contacts share their load: blocks on blocks took a
thousand evaluations of MuJoCo, and this takes fifty.
"""

import numpy as np

from ....cases.trajectory import Array
from .floor import Floor

_TURNS = 12  # at most: each takes three digits or more, as the differences do
_NUDGE = 1e-4  # of a depth or a creep: MuJoCo's forces are nearly linear in both
_KNOWN = 1e-7  # of the largest slope: below it is what differences leave of none
_SETTLED = 1e-10  # of the largest depth and creep: a place is a double, of which a depth is 1e-6


def together(floor: Floor) -> bool:
    """Settles what carries and what creeps already; False, and nothing changed, if it cannot."""
    before = floor.depths.copy(), floor.creeps.copy()
    deep, creeps = floor.depths > 0, floor.creeps != 0
    which = np.concatenate([creeps, deep])

    def left(x: Array) -> Array:
        floor.creeps[creeps], floor.depths[deep] = np.split(x, [np.count_nonzero(creeps)])
        return floor.accelerations().ravel()[which]

    x = np.concatenate([floor.creeps[creeps], floor.depths[deep]])
    sizes = np.concatenate(
        [
            np.full(np.count_nonzero(mask), _largest(values))
            for mask, values in ((creeps, floor.creeps), (deep, floor.depths))
        ]
    )
    for _ in range(_TURNS if np.any(deep) else 0):
        now = left(x)
        slopes = [(left(x + nudge) - now) / _NUDGE for nudge in _NUDGE * np.diag(sizes)]
        # Two corners of one block slip alike: of their creeps only a sum is known.
        step = sizes * np.linalg.lstsq(np.transpose(slopes), -now, rcond=_KNOWN)[0]
        x = x + step
        if np.any(x[np.count_nonzero(creeps) :] <= 0) or not np.isfinite(x).all():
            break
        if np.all(np.abs(step) <= _SETTLED * sizes):
            left(x)
            return True
    floor.depths[:], floor.creeps[:] = before
    return False


def _largest(values: Array) -> float:
    return float(np.max(np.abs(values), initial=0.0))
