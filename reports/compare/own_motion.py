"""The motion of a user's model where no constraint acts: its limit against a reference of our own.

The reference is of the textbook's equations, by integrators of our own: two programs that share the
numbers of the compiled model and its controls, and no line of what they make of them.
"""

from dataclasses import replace

import numpy as np

from ...cases.tree import MOTION
from ...engines.own_model.limit import Limit
from ...engines.own_model.model import OwnModel, joint_moves
from ...reference.formalisms.tree_motion import TreeMotion, tree_motion
from .own_equations import ROUNDING, Part
from .own_steps import DISTURBED, disturbed

AGAINST = "rad or m from the reference by our own equations"
AT_ONCE = 1e-6  # s: what acts so soon acts from the start
MOST, BASE = 100_000, 20
"""Accelerations of an answer: MOST / (BASE + n) of n velocities, as each costs the more: 2 s."""


def motion(own: OwnModel, limit: Limit) -> Part:
    """Returns how far a limit is from our own reference, as far as no constraint acts in it.

    It holds where they differ by no more than both state, and than what rounding does to a motion:
    the parts of the equations may differ by ROUNDING, so as much as that at the start may be.
    """
    because = _beyond(own, limit)
    part = Part(MOTION, None, because=because)
    count = int(np.searchsorted(limit.times, limit.acts[0]))
    if count < 2 or own.tree.unread:
        return part
    free = replace(limit, times=limit.times[:count], y=limit.y[:count], q=limit.q[:count])
    start, most = own.start(), MOST // (BASE + own.tree.n)
    exact = tree_motion(own.tree, start.qpos, start.qvel, free.times, own.controls, most)
    if len(exact.times) < 2:
        part.because = "not compared: a reference by our own equations takes too long"
        return part
    return _compared(part, own, free, exact)


def _beyond(own: OwnModel, limit: Limit) -> str:
    """Returns why the reference ends before the limit, in words; or nothing."""
    when, what = limit.acts
    if own.tree.unread:
        return f"not compared: {' and '.join(own.tree.unread)} are not read as a whole"
    if when > limit.times[-1]:
        return ""
    since = "the start" if when < AT_ONCE else f"{when:.3g} s"
    if when < limit.times[1]:
        return f"not compared: {what} acts from {since} on"
    return f"not compared from {since} on: {what} acts"


def _compared(part: Part, own: OwnModel, limit: Limit, exact: TreeMotion) -> Part:
    count = len(exact.times)
    if count < len(limit.times):
        part.because = f"not compared from {exact.times[-1]:.3g} s on: it takes too long"
    q = limit.q[:count]
    off = np.abs(joint_moves(own.model, exact.q, q))
    other = disturbed(own, replace(limit, times=exact.times))[:, : own.model.nq]
    grown = np.abs(joint_moves(own.model, q, other)).max(axis=1) * (ROUNDING / DISTURBED)
    bound = limit.errors[:count] + exact.errors + np.maximum.accumulate(grown)
    far = off.max(axis=1)
    over = np.flatnonzero(~(far <= bound))
    at = int(over[0] if len(over) else np.argmax(far))
    part.off, part.bound = float(far[at]), float(bound[at])
    part.joint = f"{own.tree.named(int(np.argmax(off[at])))} at {exact.times[at]:.3g} s"
    part.against, part.span = AGAINST, float(exact.times[-1])
    return part
