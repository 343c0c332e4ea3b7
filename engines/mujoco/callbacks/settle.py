"""The start at which MuJoCo's soft floor carries what lies on it.

Put exactly on the floor, a disk is not in contact: it falls free for a step, and the settling
that follows is an error of first order, and wrong forces. So every point that touches is started
as deep as keeps its height from accelerating, which is the textbook's contact; and what sticks
creeps from the start as fast as MuJoCo's friction needs to hold it.
"""

from collections.abc import Callable

import mujoco
import numpy as np

from ....cases.scene import Contact, Pair, Scene
from ....cases.trajectory import Array
from ...engine import Start
from ..model.contact import lies, meet
from ..model.planes import touching
from .floor import Floor
from .point_forces import point_force_callbacks
from .signal import signals

_DEEPEST = 1.0  # m, of a point; a disk could be as deep as its radius
_SETTLED = 1e-12  # of a depth: points that share a load have found it
_ALL_AT_ONCE = (1, 4)  # sweeps before which Newton may try: he knows not what carries
_SWEEPS = 100  # at most: each takes a third or more of the error, as two ends of one bar do
_STICKS = 10  # steps of the slip's growth: friction is damped by about 1/h, and holds or does not
_MOST = 1000  # steps to a zero: where friction gives way the slip jumps, and each only halves
_STILL = 1e-9  # m/s: what slips less is meant to stick
_ROUNDING = 1e-15  # of a creep: so little does not change it, and looks as if friction gave way


def settle(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, start: Start
) -> dict[str, float]:
    """Depth [m] of each contact that is closed, by name; afterwards the data starts there."""
    contacts = [c for c in touching(scene).values() if lies(scene, c, start)]
    pairs = [pair for pair in scene.pairs.values() if meet(scene, pair, start)]
    both: list[Contact | Pair] = [*contacts, *pairs]
    if not both:
        return {}
    with signals(scene, point_force_callbacks(scene, model)):
        floor = Floor(scene, model, data, contacts, pairs)
        for sweep in range(_SWEEPS):  # Gauss and Seidel
            if len(both) > 2 and sweep in _ALL_AT_ONCE and together(floor):
                break
            before = floor.depths.copy()
            for i, contact in enumerate(both):
                _sink(floor, i, scene.bodies[contact.body].radius or _DEEPEST)
                if contact.friction and not model.opt.noslip_iterations:
                    _creep(floor, i)
            if np.max(np.abs(floor.depths - before)) <= _SETTLED * np.max(floor.depths):
                break
    mujoco.mj_resetDataKeyframe(model, data, 0)  # the run must not inherit a warm start
    floor.place()
    return dict(zip([c.name for c in both], floor.depths.tolist(), strict=True))


def _sink(floor: Floor, i: int, deepest: float) -> None:
    """To where the point neither falls nor rises. Depth 0 is no contact; the least above it is."""
    from scipy.optimize import brentq

    def rise(depth: float) -> float:
        floor.depths[i] = depth
        return floor.acceleration(i)[1]

    shallow = deep = 4e-16 * max(abs(floor.heights[i]), 1.0)
    while rise(deep) < 0 and deep < deepest:
        deep *= 10
    carried = rise(shallow) < 0 < rise(deep)  # else it is lifted off, or pressed through the floor
    floor.depths[i] = brentq(rise, shallow, deep, xtol=shallow) if carried else 0.0


def _creep(floor: Floor, i: int) -> None:
    """As fast as makes friction hold a point that sticks; what friction cannot hold slides off."""
    before = floor.creeps[i]

    def slips(creep: float) -> float:
        floor.creeps[i] = creep
        return floor.acceleration(i)[0]

    floor.creeps[i] = 0.0
    if abs(floor.slips[i]) > _STILL or not floor.depths[i]:
        return
    now, h = slips(before), float(floor.model.opt.timestep)
    found = abs(now) * h <= _ROUNDING * abs(before)  # a zero no nearer than that: it is here
    floor.creeps[i] = before if found else _zero(slips, before, now, h)


def _zero(slips: Callable[[float], float], before: float, now: float, h: float) -> float:
    """The creep [m/s] at which the slip does not grow; 0 where friction cannot hold it."""
    from scipy.optimize import brentq

    reach = now * h
    while slips(before + reach) * now > 0:
        reach *= 2
        if abs(reach) > _STICKS * abs(now) * h:
            return 0.0
    xtol = 4e-16 * abs(reach)
    return float(brentq(slips, before, before + reach, xtol=xtol, maxiter=_MOST))


# Newton's method for all depths and creeps of a start at once, from where they nearly are.
#
# One after the other they settle as slowly as contacts share their load: blocks on blocks took a
# thousand evaluations of MuJoCo, and this takes fifty.


_TURNS = 12  # at most: each takes three digits or more, as the differences do
_NUDGE = 1e-4  # of a depth or a creep: MuJoCo's forces are nearly linear in both
_KNOWN = 1e-7  # of the largest slope: below it is what differences leave of none
_CONVERGED = 1e-10  # of the largest depth and creep: a place is a double, of which a depth is 1e-6


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
        if np.all(np.abs(step) <= _CONVERGED * sizes):
            left(x)
            return True
    floor.depths[:], floor.creeps[:] = before
    return False


def _largest(values: Array) -> float:
    return float(np.max(np.abs(values), initial=0.0))
