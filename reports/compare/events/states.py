"""The value of a quantity at an event: a curve through the record's rows next to it, at its time.

The rows are of one side only, so that a jump between the sides spoils neither. Where no side is
said there is no jump, and the side before tells it: a corner of the curve, as a place has at an
impact, would spoil what goes through rows of both. After the event means the case's `tube` later,
for reference and engine alike: some engines spread an impact over many steps.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ....cases.case import Case
from ....cases.mistake import Mistake
from ....cases.scene.observe import observe
from ....cases.scene.passages import pieces, polynomial, still
from ....cases.scene.quantity import SIDES, AtEvent, at_event
from ....cases.trajectory import Array, Trajectory
from .times import below_resolution, limit_of, reference_events, tangential, unreached

ROWS = 8  # of the reference: of seventh degree, as the integrator's eighth order
STEPS = 4  # of an engine: of third degree, as the best of their integrators is of fourth order
BESIDE = 1e-6  # of a step: a row so near an event may be before it or after it
JUMP = 10  # times the largest of the next changes from row to row: no curve goes through both

Rows = NDArray[np.int64]


def reference_states(case: Case, record: Trajectory, at: AtEvent, times: Array) -> Array:
    """(K,) the quantity at the reference's events; before and after are other smooth pieces."""
    u = observe(case.scene, record, at.quantity)
    late = case.tube if at.side == "after" else 0.0
    smooth = [*pieces(record, u, case.scene.corners())]
    values = list[float]()
    for t in np.minimum(times + late, record.times[-1]).tolist():
        around = [piece for piece in smooth if piece[1][0] <= t <= piece[1][-1]]
        _, rows, there = around[-1 if at.side == "after" else 0]
        values.append(_curve(rows, there, t, ROWS))
    return np.array(values, float)


def engine_states(case: Case, record: Trajectory, at: AtEvent, times: Array) -> Array:
    """(K,) the quantity at an engine's events, from the steps beside each.

    Raises KeyError where the record does not hold the quantity.
    """
    u, steps = observe(case.scene, record, at.quantity), record.times
    near = BESIDE * float(steps[1] - steps[0])
    values = []
    for t in times.tolist():
        if at.side == "after":
            read = min(t + case.tube, float(steps[-1]))
            rows = _behind(steps, u, np.flatnonzero(steps > t + near), t)
        else:
            read, rows = t, np.flatnonzero(steps < t - near)
        values.append(_curve(steps[rows], u[rows], read, STEPS) if len(rows) else np.nan)
    return np.array(values, float)


def _behind(steps: Array, u: Array, rows: Rows, t: float) -> Rows:
    """The rows without those, within a step of the event at t, from which u still has to jump.

    An engine knows a blow at the end of the step that holds it, and a record between its steps
    half of one later still.
    """
    within = t + float(steps[1] - steps[0])
    while len(rows) > STEPS and steps[rows[0]] < within:
        first, *others = np.abs(np.diff(u[rows[: STEPS + 1]])).tolist()
        if first <= JUMP * max(others):
            break
        rows = rows[1:]
    return rows


def _curve(times: Array, u: Array, t: float, most: int) -> float:
    """At t, of the polynomial through so many of the rows, the nearest; of one time the first."""
    at, kept = np.unique(times, return_index=True)
    nearest = np.argsort(np.abs(at - t), kind="stable")[:most]
    return polynomial(at[nearest], u[kept][nearest])(t)


def mistaken(case: Case, reference: Trajectory) -> list[Mistake]:
    """The mistakes in what the case says of its events, where the reference contradicts it."""
    record = reference.record
    if record is None:
        return []
    found = (
        list(tangential(case, record)) or unreached(case, reference) or list(_jumps(case, record))
    )
    return found or list(_uncounted(case, reference))


def _uncounted(case: Case, reference: Trajectory) -> Iterator[Mistake]:
    """A mistake for every count of events that pile up, as of a ball that bounces ever lower."""
    for name in case.allow:
        event, _, field = name.rpartition(".")
        if field != "count" or event not in case.events:
            continue
        if (limit := limit_of(case, reference, case.events[event])) is not None:
            why = (
                f"happens without end before {limit:.4g} s, and the reference leaves out what "
                "is too short to see"
            )
        elif (t := below_resolution(case, reference, case.events[event])) is not None:
            why = f"happens so softly at {t:.6g} s that rounding tells how often it does from then"
        else:
            continue
        what = f"{why}: no count of it is a claim; leave it out, or shorten the duration"
        yield case.mistake(("allow", name), what)


def _jumps(case: Case, record: Trajectory) -> Iterator[Mistake]:
    """A mistake for every quantity at an event where it jumps and no side is said."""
    at_once = replace(case, tube=0.0)
    for name in case.allow:
        at = at_event(name, case.events)
        if at is None or at.side:
            continue
        times = reference_events(case.scene, record, case.events[at.event])
        before, after = (
            reference_states(at_once, record, AtEvent(at.event, at.quantity, side), times)
            for side in SIDES[1:]
        )
        apart = np.abs(after - before)
        if np.any(apart > still(case.scene, record, at.quantity)):
            most = int(np.argmax(apart))
            what = (
                f"jumps there, from {before[most]:.6g} to {after[most]:.6g}: "
                f"say {name}.before or {name}.after"
            )
            yield case.mistake(("allow", name), what)
