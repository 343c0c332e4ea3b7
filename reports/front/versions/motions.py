"""By how much a model's own motion moved from release to release, and which is nearest its limit.

The limit is that of the MuJoCo that is installed here, for all of them.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....cases.mistake import plain
from ....cases.model_case import ModelCase
from ....engines.mujoco.callbacks.signal import listening
from ....engines.own_model.limit import NoLimit
from ....engines.own_model.model import VERSION
from ....engines.own_model.opened import Opened, opened
from ....engines.own_model.quantities import Motion, Quantity, differences
from ...compare.judge.metric import sizes
from ...compare.own_steps import limit_and_horizon, times_of
from ...tables.short_numbers import factor
from .measure import MUJOCO, Measured

MOVED = 1e-3  # of what is allowed: what rounding grows to before the horizon is below it
AS_NEAR = 1e-2  # of the farther one: nearer than that, neither of two is nearer


@dataclass(frozen=True)
class Apart:
    """Where two motions are farthest apart, in parts of what is allowed: by how much, and when [s].

    final: by how much that quantity is at the end.
    """

    quantity: Quantity
    ratio: float
    most: float
    when: float
    final: float

    def __str__(self) -> str:
        unit = f" {self.quantity.unit}".rstrip()
        end = f"{self.final:.2g}{unit} at the end"
        return f"by up to {self.most:.2g}{unit} (at {self.when:.3g} s; {end})"


def farthest(ready: Opened, a: Motion, b: Motion) -> Apart:
    """Returns where two motions of a model are farthest apart."""
    apart_by_quantity: list[Apart] = []
    for quantity, off in differences([*ready.bars], a, b).items():
        size = np.asarray(sizes(off)).tolist()
        most = max(size)
        when = float(a.times[size.index(most)])
        apart_by_quantity.append(Apart(quantity, most / ready.bars[quantity], most, when, size[-1]))
    return max(apart_by_quantity, key=lambda apart: apart.ratio)


def motion_lines(cases: Sequence[ModelCase], measured: Sequence[Measured]) -> Iterator[str]:
    """Yields the lines of each model, with the releases in their order."""
    releases = [run for run in measured if run.release.engine == MUJOCO]
    for case in cases if releases else ():
        yield ""
        with listening():
            lines = [*_of_model(case, releases)]
        yield from map(plain, lines)


def _of_model(case: ModelCase, releases: Sequence[Measured]) -> Iterator[str]:
    ready = opened(case)
    own = ready.own
    times = times_of(case, [own.model.opt.timestep])
    if not (own.model.nv and ready.bars):
        yield f"{case.name}: nothing moves"
        return
    try:
        limit, until, _ = limit_and_horizon(ready, times)
        exact = Motion(own, limit.times, limit.y)
        judged = f"and until {until:.3g} s" if until < times[-1] else f"over {times[-1]:.3g} s"
        yield f"{case.name}: each at its own step, the limit by MuJoCo {VERSION}, {judged}"
    except NoLimit as error:
        exact, until = None, times[-1]
        yield f"{case.name}: each at its own step; no limit: {error}"
    last: tuple[str, Motion, Apart | None] | None = None
    for run in releases:
        version = run.release.version
        samples = run.motions.get(case.name, {"because": run.because or "was not run"})
        motion = _motion(ready, samples, times, until)
        if motion is None:
            yield f"  {version}: {samples.get('because', 'has other coordinates')}"
            continue
        off = farthest(ready, _until(exact, until), motion) if exact else None
        first, *more = _compared(ready, motion, off, last)
        yield f"  {version}: {first}"
        yield from (f"    {line}" for line in more)
        last = version, motion, off


def _motion(
    ready: Opened, samples: Mapping[str, Any], times: np.ndarray, until: float
) -> Motion | None:
    """Returns the samples up to a time; None where there are none of these coordinates."""
    m = ready.own.model
    if "y" not in samples or not np.array_equal(samples["times"], times):
        return None
    y = np.array(samples["y"])
    if y.shape[1] != m.nq + m.nv + m.na:
        return None
    return _until(Motion(ready.own, times, y), until)


def _until(motion: Motion, time: float) -> Motion:
    judged = motion.times <= time
    return Motion(motion.own, motion.times[judged], motion.y[judged])


def _compared(
    ready: Opened, motion: Motion, off: Apart | None, last: tuple[str, Motion, Apart | None] | None
) -> Iterator[str]:
    """Yields what moved since the release before, how far off the limit it is, which is nearer."""
    missed = f"off the limit in {_missed(off)}" if off else "runs"
    if last is None:
        yield missed
        return
    before, earlier, was_off = last
    moved = farthest(ready, earlier, motion)
    if moved.ratio <= MOVED:
        yield f"moved nothing since {before}"
        return
    yield f"since {before} {moved.quantity.name} moved {moved}"
    if off is None or was_off is None:
        return
    yield missed
    both = f"{factor(was_off.ratio)} against {factor(off.ratio)}"
    if abs(was_off.ratio - off.ratio) <= AS_NEAR * max(was_off.ratio, off.ratio):
        yield f"as near as {before}: {both}"
    else:
        yield f"{before if was_off.ratio < off.ratio else 'it'} is nearer: {both}"


def _missed(off: Apart) -> str:
    return f"{off.quantity.name} {off}, {factor(off.ratio)} of what is allowed"
