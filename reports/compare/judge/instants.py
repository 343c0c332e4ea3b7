"""The events of a trial: rows for their times and counts, and the list of all instants."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import zip_longest

import numpy as np

from ....cases.case import Case
from ....cases.scene.quantity import at_event
from ....cases.trajectory import Array, Trajectory
from ...tables.row import REFUSED, UNSETTLED, Comparison, Instant
from ..events.times import reference_events
from ..trial.ladder import Ladder
from ..trial.phases import Begun
from ..trial.run import Samples
from ..trial.simulate import Runs
from ..trial.trial import Trial
from . import metric
from .cause import cause
from .convergence import Convergence, instants
from .metric import floor
from .rows import judged, row
from .verdict import verdict

Study = tuple[Ladder, str, Convergence]
"""What a ladder says of a quantity."""
NEVER = "engine: the event never happens in its motion"
TOO_SHORT = (
    "adapter: none is found, and with a step of {:.3g} s that is sure of nothing: it comes too "
    "soon, or what it ends or begins lasts too few steps"
)
LATER = "say so by `tube`, as `tube: 2 ms` at the top of the file: it is then read so much later"


def judge(
    trial: Trial,
    names: tuple[str, ...],
    runs: Runs,
    begun: Sequence[Begun],
    sure: Callable[[Study], Study],
) -> tuple[list[Comparison], list[Study]]:
    """Rows of `event.time`, `event.count` and states at events, and what ladders say of them.

    begun: the judged run, and those begun later within a step; the worst is told. sure: makes of a
    study of one start that of all of them.
    """
    samples = begun[0].samples
    rows: list[Comparison] = []
    studies: list[Study] = []
    for name in names:
        event, field = trial.quantity(name).part, trial.quantity(name).field
        if (f"{event}.time" if field == "count" else name) not in samples:
            why = "adapter: its quantity is not kept for every step"
            rows.append(row(trial, name, REFUSED, because=why))
        elif field == "count":
            worst = max(begun, key=lambda run: _miscounted(*run, event))
            rows.append(_count(trial, event, worst))
        else:
            worst = max(begun, key=lambda run: _largest(*run, name))
            climbs = [sure(study) for study in _ladder_errors(trial, name, runs)]
            rows.append(_row(trial, name, worst, runs, climbs))
            studies += climbs
    return rows, studies


def _miscounted(trial: Trial, samples: Samples, event: str) -> float:
    """Returns by how many the counts differ; what such steps cannot tell is worse than none."""
    off = trial.timing.miscounted(event, len(samples[f"{event}.time"]), trial.step)
    return 0.5 if off is None else off


def _largest(trial: Trial, samples: Samples, name: str) -> float:
    """Returns the largest error of the events that both have."""
    event = trial.quantity(name).part
    partners = trial.timing.partners(event, samples[f"{event}.time"])
    if not len(partners):
        return 0.0
    values = samples[name][: len(partners)]
    return metric.error(values, trial.wanted(name)[partners]).largest


def _count(trial: Trial, event: str, worst: Begun) -> Comparison:
    """Whether the event happens as often as in the reference; refused where steps cannot tell."""
    name, timing = f"{event}.count", worst.trial.timing
    times = worst.samples[f"{event}.time"]
    most = len(timing.events[event])
    least = most if len(times) == most else len(timing.surely(event, trial.step))
    off = timing.miscounted(event, len(times), trial.step)
    short = f" (of which {least} last long enough for this step)" if least < most else ""
    why = f"reference {most}{short}, engine {len(times)}"
    if off is None:
        return row(trial, name, REFUSED, because=f"adapter: {why}: a smaller step tells more")
    reached = verdict(trial, name, off, instants({trial.step: off}, 0.0), why)
    return judged(trial, name, reached, metric.Error(off, off, off, 0), None)


def _row(trial: Trial, name: str, worst: Begun, runs: Runs, climbs: Sequence[Study]) -> Comparison:
    """Returns the row of an event's times or states, of as many as both have, in their order."""
    event, samples, timing = trial.quantity(name).part, worst.samples, worst.trial.timing
    values = samples[name]
    times, partners = timing.events[event], timing.partners(event, samples[f"{event}.time"])
    both = len(partners)
    if not both:
        resolved = not len(times) or len(timing.surely(event, trial.step))
        why = NEVER if resolved else TOO_SHORT.format(trial.step)
        return row(trial, name, REFUSED, because=why)
    error = metric.error(values[:both], worst.trial.wanted(name)[partners])
    held = climbs[-1][2] if climbs else Convergence(UNSETTLED, {}, None)
    why = cause(held, runs.finer, trial.plan.simplified, trial.quantity(name).unit)
    sure = _first(trial, name, list(runs.ladders.values())[-1]) if climbs else both
    if error.at >= sure:
        why = f"number {error.at + 1}, of which the largest step cannot be sure; before it: {why}"
    words = "; ".join(filter(None, (why, spread(trial, name))))
    reached = verdict(trial, name, error.largest, held, words)
    return judged(trial, name, reached, error, float(times[partners[error.at]]))


def spread(trial: Trial, name: str) -> str:
    """Tells what else may be wrong with a state just after an event, and what cures it."""
    at = at_event(name, trial.case.events)
    if at is None or at.side != "after" or trial.case.tube:
        return ""
    return f"if an impact lasts some steps here, {LATER}"


def _ladder_errors(trial: Trial, name: str, runs: Runs) -> Iterator[Study]:
    """Yields each ladder's convergence of the errors by step, inf where the count differs.

    They compare the events that the largest step of all can tell, or else the first.
    """
    for ladder, climbed in runs.ladders.items():
        first = _first(trial, name, climbed)
        errors = {h: off(trial, name, run, h, first) for h, run in sorted(climbed.items())}
        if errors and len(trial.wanted(name)):
            yield ladder, name, instants(errors, trial.allowed(name) or np.inf)


def off(trial: Trial, name: str, samples: Samples, step: float, first: int = 0) -> float:
    """Returns the largest error of the first events, inf where they happen more or less often.

    Of those, where their number is not given, that steps [s] of this size have to tell.
    """
    wanted, event, timing = trial.wanted(name), trial.quantity(name).part, trial.timing
    values, first = samples[name], first or max(1, len(timing.surely(event, step)))
    sure = len(timing.surely(event, step)) if len(values) < len(wanted) else 0
    least = max(first, sure)
    if not least <= len(values) <= len(wanted):
        return np.inf
    partners = timing.partners(event, samples[f"{event}.time"])[:first]
    return metric.error(values[:first], wanted[partners]).largest


def _first(trial: Trial, name: str, climbed: Mapping[float, Samples]) -> int:
    """Returns how many events are compared on a ladder."""
    event, most = trial.quantity(name).part, len(trial.wanted(name))
    whole = all(len(samples[name]) == most for samples in climbed.values())
    if whole and not trial.case.events[event].crosses:
        return max(1, most)
    return max(1, min((len(trial.timing.surely(event, h)) for h in climbed), default=1))


def listed(trial: Trial, samples: Samples) -> list[Instant]:
    """Every event of the engine at the judged step."""
    return [
        Instant(
            case=trial.case.name,
            engine=trial.engine.name,
            version=trial.engine.version,
            setting=trial.engine.setting,
            realised=trial.realised,
            event=event,
            k=k,
            time=_rounded(trial, event, t),
            difference=None if wanted is None else _rounded(trial, event, t - wanted),
        )
        for event, times in trial.timing.events.items()
        for engine_times in [samples.get(f"{event}.time", np.zeros(0))]
        for k, (t, wanted) in enumerate(_paired(trial, event, engine_times, times), start=1)
    ]


def _paired(
    trial: Trial, event: str, engine_times: Array, times: Array
) -> Iterator[tuple[float, float | None]]:
    """Each of the engine's times [s] with that of the reference, where it has a partner."""
    wanted = times[trial.timing.partners(event, engine_times)].tolist()
    return zip_longest(engine_times.tolist(), wanted)


def _rounded(trial: Trial, event: str, number: float) -> float:
    return metric.round_to_floor(number, floor(trial, f"{event}.time", trial.step))


def of_reference(case: Case, reference: Trajectory) -> list[Instant]:
    """Every event of the reference."""
    if reference.record is None:
        return []
    return [
        Instant(case.name, "reference", "", "", "", name, k, t, None)
        for name, event in case.events.items()
        for k, t in enumerate(
            reference_events(case.scene, reference.record, event).tolist(), start=1
        )
    ]
