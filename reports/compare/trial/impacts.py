"""Samples beside impacts, compared with the motions before and behind them, each continued.

An engine sees an impact at the end of a step, or of the next. Beside it the reference is behind it
already and the engine is not, or the other way round, and neither is wrong.
"""

from collections.abc import Iterator

import numpy as np

from ....cases.scene.observe import observe
from ....cases.trajectory import Array, Trajectory
from .trial import Trial

BESIDE = 2  # steps: an engine sees an impact at the end of a step, and some act on it in the next
LEAST = 3  # samples of a force that must be left beside none, for those beside one to be left out
ROWS = np.array([1e-3, 1.0, 2.0])  # spacings off an impact: a parabola, as free flight is one
ROOM = 2.5  # spacings, within which nothing else may switch


def beside(trial: Trial, step: float) -> dict[int, list[float]]:
    """Returns the samples beside impacts by number, with the times [s] of those impacts."""
    times, blows = trial.case.times, trial.reference.blows
    near = np.abs(times[:, None] - blows[None, :]) <= BESIDE * step
    return {int(k): blows[near[k]].tolist() for k in np.flatnonzero(near.any(axis=1))}


def fair(trial: Trial, name: str, samples: Array, step: float) -> Array:
    """Returns samples (N,) with those beside impacts as far off as they are from either side.

    One that is between the motions before and behind the impact, both continued to its time, is
    the reference's. Forces are: there they are impulses over a step.
    """
    near = beside(trial, step)
    if not near or samples.ndim > 1 or name.endswith(".work"):
        return samples
    wanted, fairly = trial.wanted(name), samples.copy()
    if trial.quantity(name).kind in ("force", "acceleration"):
        if trial.case.samples - len(near) >= LEAST:
            fairly[[*near]] = wanted[[*near]]
        return fairly
    sides = _sides(trial, name, step, near)
    for k, values in sides.items():
        low, high = min(wanted[k], *values), max(wanted[k], *values)
        fairly[k] = wanted[k] + samples[k] - np.clip(samples[k], low, high)
    return fairly


def _sides(
    trial: Trial, name: str, step: float, near: dict[int, list[float]]
) -> dict[int, list[float]]:
    """By sample the values of the quantity before and behind its impacts, continued to its time."""
    motion = _around(trial, step, near)
    rows = observe(trial.case.scene, motion, name)
    values: dict[int, list[float]] = {k: [] for k in near}
    for k, blows in near.items():
        for blow in blows:
            for times in _spaced(trial, blow, step):
                at = np.searchsorted(motion.times, times)
                parabola = np.polynomial.Polynomial.fit(times, rows[at], len(ROWS) - 1)
                values[k].append(float(parabola(trial.case.times[k])))
    return values


def _around(trial: Trial, step: float, near: dict[int, list[float]]) -> Trajectory:
    """The reference at rows around these impacts."""
    blows = tuple(sorted({blow for each in near.values() for blow in each}))
    kept = trial.timing.around
    if (step, blows) not in kept:
        rows = [times for blow in blows for times in _spaced(trial, blow, step)]
        kept[step, blows] = trial.timing.motion(np.unique(np.concatenate(rows)))
    return kept[step, blows]


def _spaced(trial: Trial, blow: float, step: float) -> Iterator[Array]:
    """Yields three times [s] before an impact and three behind it, where nothing else switches."""
    others = [s for s in trial.reference.switches.tolist() if s != blow]
    before = blow - max((s for s in others if s < blow), default=0.0)
    behind = min((s for s in others if s > blow), default=float(trial.case.times[-1])) - blow
    yield np.sort(blow - min(step, before / ROOM) * ROWS)
    yield blow + min(step, behind / ROOM) * ROWS
