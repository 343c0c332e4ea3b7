"""Errors of work: sums over samples against the integral of the power inside the march's steps.

Samples may miss what acts for a short time, or be in step with it, and so may the steps of an
integrator where a drive prescribes the motion, which then feels no force. So the motion is taken
again through the nodes of Gauss and Kronrod in each step, and halved while their two sums differ.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...cases.case import Case
from ...cases.scene.observe import observe, power
from ...cases.trajectory import Array, Trajectory
from ..integrators.budget import motion as begins
from ..integrators.march import IntegrationError, march
from ..motion.bodies import Answer
from ..motion.follow import Kept, between, either
from ..motion.stuck import Stuck, slope
from .errors import least

# Fifteen nodes in (−1, 1) and seven, every second of them: exact up to t²³ and t¹³, so that a step
# of the march's order needs no halving. What the sums differ by is more than the error of the
# former. QUADPACK's numbers; a test integrates powers of t by them.
_NODES = (
    *(0.991455371120812640, 0.949107912342758525, 0.864864423359769073, 0.741531185599394440),
    *(0.586087235467691130, 0.405845151377397167, 0.207784955007898468),
)
NODES = np.array([*(-x for x in _NODES), 0.0, *reversed(_NODES)])
_FIFTEEN = (
    *(0.022935322010529225, 0.063092092629978553, 0.104790010322250184, 0.140653259715525919),
    *(0.169004726639267903, 0.190350578064785410, 0.204432940075298892),
)
FIFTEEN = np.array([*_FIFTEEN, 0.209482141084727828, *reversed(_FIFTEEN)])
_SEVEN = (0.129484966168869693, 0.279705391489276668, 0.381830050505118945)
SEVEN = np.array([*_SEVEN, 0.417959183673469388, *reversed(_SEVEN)])

FINE = 1e-12  # of all that is done or taken: of a peak that no node meets its feet are more
NOBODY = 1e-10  # of the smallest tolerance: what no bar would see, a part
ROUNDING = 1e-14  # of it: what states, powers and their sum are rounded by
LEAST = 1e-13  # of the motion: a shorter part is left as it is
JOINED = 4  # steps of eighth order: what the rule does not integrate to the end is halved
MOST = 2_000  # parts: ten seconds of work
TICKS = 1000  # ulp of time: what ends sooner has no room for nodes, and no work


@dataclass(frozen=True)
class _Part:
    """A part of a step of the march: its phase, and where the motion is when it begins."""

    phase: int
    begin: float
    end: float
    y: Array

    @property
    def nodes(self) -> Array:
        """The times [s] of its nodes."""
        return (self.begin + self.end) / 2 + (self.end - self.begin) / 2 * NODES


def _states(answer: Answer, parts: Sequence[_Part]) -> Iterator[Kept]:
    """Yields the states at the nodes of the parts, integrated from where a row of them begins."""
    system, phases, corners = answer.system, answer.followed.phases, {*answer.system.corners}
    rows: list[list[_Part]] = []
    for part in parts:
        last = rows[-1][-1] if rows else None
        if last and (last.phase, last.end) == (part.phase, part.begin) and last.end not in corners:
            rows[-1].append(part)
        else:
            rows.append([part])
    for row in rows:
        first, mode = row[0], system.modes[phases[row[0].phase]]
        f = between(first.begin, row[-1].end)(slope(mode))  # at its end a law may jump
        times = np.concatenate([[first.begin], *(part.nodes for part in row)])
        wanted = {*times.tolist()}
        try:
            for step in march(either(mode, f, len(first.y)), times, first.y):
                if step.t_next in wanted:
                    yield step.t_next, first.phase, step.y_next
        except IntegrationError as error:
            raise Stuck(str(error), mode, error.time, first.y) from error


def work_errors(
    case: Case, motion: Trajectory, answer: Answer, names: Sequence[str]
) -> dict[str, float]:
    """By name, how far [J] each sum of `motion` is from the integral, at any sample."""
    owners = [name.rpartition(".")[0] for name in names]
    parts = _parts(answer, motion.times)
    ends, works = [np.zeros(1)], [np.zeros((1, len(names)))]
    # Work that is none, as of a push at a pin, is all rounding: it is halved for no bar's sake.
    floor = NOBODY * np.array([least(case, name) or 0.0 for name in names])
    quadrature, total, count = np.zeros(len(names)), np.zeros(len(names)), 0
    while parts:
        begins(parts[0].begin, parts[-1].end)
        rows = [*_states(answer, parts)]
        at_nodes = answer.along(rows)
        powers = np.stack([power(case.scene, at_nodes, owner) for owner in owners])
        powers = powers.reshape(len(names), -1, len(NODES))
        halves = np.array([(part.end - part.begin) / 2 for part in parts])
        closer, off = halves * (powers @ FIFTEEN), halves * (powers[..., 1::2] @ SEVEN)
        off = np.abs(closer - off)
        if not count:
            total, count = np.sum(halves * (np.abs(powers) @ FIFTEEN), axis=1), len(parts)
        bound = np.maximum(FINE * total, floor)[:, None]
        wide = np.any(off > bound, axis=0) & (halves > LEAST * case.duration)
        if count + 2 * int(np.sum(wide)) > MOST:
            wide[:] = False
        ends.append(np.array([part.end for part in parts])[~wide])
        works.append(closer[:, ~wide].T)
        quadrature += np.sum(off[:, ~wide], axis=1)
        middles = rows[len(NODES) // 2 :: len(NODES)]
        parts = [
            half
            for part, (t, _, y), is_wide in zip(parts, middles, wide.tolist(), strict=True)
            if is_wide
            for half in (replace(part, end=t), replace(part, begin=t, y=y))
        ]
        count += len(parts)
    end, work = np.concatenate(ends), np.concatenate(works)
    order = np.argsort(end, kind="stable")
    sums = np.cumsum(work[order], axis=0)
    at = np.isin(motion.times, end)  # not all of them, where a part has many steps
    sums = sums[np.searchsorted(end[order], motion.times[at], side="right") - 1]
    errors = quadrature + ROUNDING * total
    return {
        name: float(errors[i] + np.max(np.abs(sums[:, i] - observe(case.scene, motion, name)[at])))
        for i, name in enumerate(names)
    }


def _parts(answer: Answer, times: Array) -> list[_Part]:
    """The march in parts of some steps each, of more where there are very many.

    None goes on over a corner or a sample; where these are very many, over some of them.
    """
    march = answer.followed.march
    ends = {*answer.system.corners, *times[:: 1 + 2 * len(times) // MOST].tolist()}
    many, parts, joined = max(JOINED, 1 + 2 * len(march) // MOST), list[_Part](), 0
    for (t, phase, y), (after, other, _) in pairwise(march):
        if phase != other or after - t < TICKS * math.ulp(after):
            continue
        last = parts[-1] if parts else None
        if last and joined < many and (last.phase, last.end) == (phase, t) and t not in ends:
            parts[-1], joined = replace(last, end=after), joined + 1
        else:
            parts.append(_Part(phase, t, after, y))
            joined = 1
    return parts
