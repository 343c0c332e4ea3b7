"""Certifies the reference's own error: every answer that shares no algebra is compared.

The laws are asked at states, and their bounds are those of rounding. Two motions are also as far
apart as the motion is sensitive: what that may be is a share of what the case asks (`errors`), and
one answer may be `LOOSER` times as far from the others as two integrators of one system are, and
farther up to the next power of ten.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np

from ...cases.case import Case
from ...cases.trajectory import Trajectory
from ..integrators.implicit import Radau
from ..integrators.march import Method, Slope
from ..integrators.now import doing
from ..integrators.radau import radau_table
from ..mechanism.modes.mechanism import Mechanism
from ..motion.bodies import Answer
from ..motion.follow import TOLERANCE, Change, Followed, either, follow
from ..start.assembly import size_of
from ..system import Array, Mode, System, instant
from .agreement import Check, difference, times_apart, worst
from .errors import errors
from .event_time_error import time_bound
from .file_checks import as_the_file_says
from .laws import laws
from .one_sided_checks import one_sided_checks
from .reaction_check import reaction_checks
from .reading import size
from .work_error import work_errors

OWN_ERROR = 1e-12  # of the motion's size: what a motion is known to that is not sensitive
ROUNDING = 2.2e-16  # a step: a motion of many steps cannot be known better
SWITCHED = 1e-11  # of the motion's size: an event is known to 1e-12 s, and what follows with it
GENERATED = 1e-9  # hand-written against generated motion
NOISE = 1e-9  # of the size: places that are nearer to the origin are no motion, but its rounding
OWN_EVENTS = 1.0  # instants, against known functions
OTHER_EVENTS = 100.0  # instants, against another motion
LOOSER = 100  # times what two integrators differ by: two samples of one error may differ so much
COARSER = 1e-13  # tolerance of the second answer where there is only one stiff integrator
UNROLLED = 0.5  # rad: a turn lost is 6.3; the integral over the march's steps is 0.01 off at most
STAGES = 7  # Radau IIA of order 13: five stages need twice the time at this tolerance
CORNER_GAP = 1e-9  # of two samples: a corner nearer to one is none between them
QUARTERS = (0.0, 0.25, 0.5, 0.75)  # of a sample: longer steps, of order 13, lose up to two digits


def certify(
    case: Case,
    written: Answer,
    built: Answer,
    generated: Mechanism,
    motion: Trajectory,
    marched: Trajectory,
) -> tuple[Check, ...]:
    """The results of every check that applies to the case.

    written: the answer, and `motion` its bodies; built: the generated mechanism's, and `marched`
    its bodies at every step. They are one where there is no hand-written system.
    """
    times, system, followed = case.times, written.system, written.followed
    places = [states[:, case.scene.frame.place] for states in marched.states.values()]
    far = worst(np.abs(each).max() for each in places)
    far = far if far > NOISE * size_of(case) else 0.0  # what turns on the origin goes nowhere
    compared = partial(difference, inner=case.scene.inner(), far=far)
    stiff = any(system.modes[mode].stiff for mode in followed.phases)
    finer = finely(times, system.corners, whole=stiff)
    name, closer = _second_solution(system, finer, stiff=stiff)
    asked = np.searchsorted(finer, times)
    second = replace(closer, y=closer.y[asked], phase=closer.phase[asked])
    others = {name: replace(written, followed=second).trajectory(times)}
    apart = compared(motion, others[name])
    checks, runs = [], {f"{name}: events": second}
    if system is not generated:
        others["generated"], runs["generated events"] = built.trajectory(times), built.followed
        off = compared(motion, others["generated"])
        checks.append(Check("generated motion", off, max(GENERATED, _bound(apart)), measured=True))
        checks += reaction_checks(written, built, generated, times)
    own, known = max(_own_error(followed), _bound(apart)), apart
    if (closed := _closed_form(system, times)) is not None:
        others["closed form"] = written.trajectory(times, closed)
        off = compared(motion, others["closed form"])
        checks.append(Check("closed form", off, own, measured=True))
    drifted = apart * float(times[-1] - times[0])  # s: as large a part of the time
    ends = any(map(_rests, followed.changes))
    alone = max(system.blurred if ends else 0.0, time_bound(system, followed))
    later = max(_bound(drifted), 2 * alone)  # either way, two answers
    checks += _events(system, followed, runs, later, float(times[-1]))
    doing("the laws at every sample", float(times[0]), float(times[-1]))
    if written.turns.angles:
        checks.append(Check("turns by their rates", written.turns.unrolled(), UNROLLED))
    checks += laws(written, generated, times, marched, known)
    checks += _drift(system, followed, own)
    checks += as_the_file_says(case, written, generated, motion, own)
    large = size(case.scene.frame, motion, size_of(case), case.duration)
    checks += one_sided_checks(case, written, motion, marched, large, own)
    if len(system.modes) > 1 or any(system.guards(mode) for mode in followed.phases):
        checks.append(Check("modes possible", _impossible(system, followed), 0.0))
    if generated.beside is not None:  # no bound but the case's: another motion of as good a start
        doing("the motion of another start")
        other = follow(generated.beside, times)
        runs["another start"] = other
        others["another start"] = replace(
            built, system=generated.beside, followed=other
        ).trajectory(times)
    late = worst([drifted, alone, *(_events_apart(followed, other) for other in runs.values())])
    worked = partial(work_errors, case, motion, written)
    return (*checks, *errors(case, motion, others, late, worked))


def _rests(change: Change) -> bool:
    """Whether the change is a stop that lasts, and no reversal of the slip."""
    part, _, word = (change.name or "").rpartition(" ")
    goes_on = any(state.startswith(f"{part} slides") for state in change.mode_after.split(", "))
    return word == "stops" and not goes_on


def _bound(error: float) -> float:
    """Bound on the difference of another answer: the next power of ten above LOOSER · error."""
    return 10.0 ** math.ceil(math.log10(LOOSER * error)) if 0.0 < error < math.inf else 0.0


def _own_error(followed: Followed) -> float:
    """Relative error of a motion that is not sensitive to its start."""
    return SWITCHED if followed.changes else max(OWN_ERROR, ROUNDING * followed.steps)


def finely(times: Array, corners: Iterable[float], *, whole: bool) -> Array:
    """The samples, refined by the corners and by times between all of them.

    whole: whether an interval without a corner stays whole.
    """
    least = CORNER_GAP * float(times[1] - times[0])
    edges = times
    for corner in corners:
        if times[0] < corner < times[-1] and np.min(np.abs(edges - corner)) > least:
            edges = np.union1d(edges, corner)
    sampled = np.isin(edges, times)
    wholes = sampled[1:] & sampled[:-1] & whole
    gaps = [
        a + (b - a) * np.array([0.0] if stays else QUARTERS)
        for (a, b), stays in zip(pairwise(edges), wholes, strict=True)
    ]
    return np.append(np.concatenate(gaps), times[-1])


def _second_solution(system: System, times: Array, *, stiff: bool) -> tuple[str, Followed]:
    """The motion by another integrator, or where it is stiff, by another tolerance."""
    name = "another tolerance" if stiff else "implicit integrator"
    return name, follow(system, times, by=_other_method)


def _other_method(mode: Mode, f: Slope, n: int) -> Method:
    if mode.stiff:
        return either(mode, f, n, tolerance=COARSER)
    return Radau(f, TOLERANCE, radau_table(STAGES))


def _events_apart(first: Followed, second: Followed) -> float:
    """The largest difference [s] of the times at which modes change; infinite if counts differ."""
    return times_apart([c.time for c in first.changes], [c.time for c in second.changes])


def _events(
    system: System, followed: Followed, runs: Mapping[str, Followed], late: float, until: float
) -> Iterator[Check]:
    """The times at which modes change, in every other answer and by known functions.

    late: what a motion as sensitive as this one may have events apart by [s].
    """
    close = instant(until)
    for name, other in runs.items():
        if followed.changes or other.changes:
            error, bound = _events_apart(followed, other), max(OTHER_EVENTS * close, late)
            yield Check(name, error, bound, measured=True)
    events = system.closed_events(until)
    if events is not None and (events or followed.events):
        bound = max(OWN_EVENTS * close, late)
        yield Check("closed events", _distance_to_known(followed, events), bound, measured=True)


def _distance_to_known(followed: Followed, events: list[tuple[str, float]]) -> float:
    """The largest distance [s] from the events by known functions, by name and order."""
    names = {name for name, _ in events} | {event.name for event in followed.changes if event.name}
    return worst(
        times_apart(
            [event.time for event in followed.events if event.name == name],
            [t for known, t in events if known == name],
        )
        for name in names
    )


def _closed_form(system: System, times: Array) -> Array | None:
    """y (N, 2n) by known functions, or None."""
    rows = [system.closed_form(t) for t in times.tolist()]
    if any(row is None for row in rows):
        return None
    return np.array([np.concatenate(row) for row in rows if row is not None])


def _drift(system: System, followed: Followed, bound: float) -> Iterator[Check]:
    """The residual of (2.14) at the march's steps, if it has rows, over the largest coordinate."""
    steps = [(t, followed.phases[k], y) for t, k, y in followed.march]
    residuals = [system.modes[mode].f(t, system.modes[mode].parted(y)[0]) for t, mode, y in steps]
    if any(len(residual) for residual in residuals):
        places = np.concatenate([system.modes[mode].parted(y)[0] for _, mode, y in steps])
        size = worst(np.abs(places)) or 1.0
        largest = worst(worst(np.abs(residual)) for residual in residuals)
        yield Check("constraint drift", largest / size, bound, measured=True)


def _impossible(system: System, followed: Followed) -> int:
    """At how many steps the mode contradicts friction, contact or the direction of sliding.

    Where a mode ends it is at its bound: what begins there is asked.
    """
    march = followed.march
    ends = [a[1] != b[1] for a, b in pairwise(march)]
    rows = [
        (t, followed.phases[k], y)
        for (t, k, y), last in zip(march, [*ends, False], strict=True)
        if not last
    ]
    states = [(mode, t, *system.modes[mode].parted(y)) for t, mode, y in rows]
    return sum(system.possible(*state) is not None for state in states)
