"""A trial's rows: audit, ladders, and a verdict for every observed quantity."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ....engines import SETTINGS
from ....engines.engine import Refusal
from ...tables.row import (
    AGREES,
    ANOTHER,
    CRASHED,
    DIVERGED,
    FAILS,
    FALLS,
    REFUSED,
    UNSETTLED,
    Comparison,
    Instant,
    Rungs,
    StepError,
)
from ..trial.audit import EQUAL, audit
from ..trial.ladder import Ladder
from ..trial.phases import Begun, Phases
from ..trial.run import Climbed, Samples
from ..trial.simulate import Runs, fairly, simulate
from ..trial.table_text import why
from ..trial.trial import Trial, judged_names
from . import instants, metric
from .cause import cause
from .convergence import Convergence, study
from .error_instant import away_from_instants, moment
from .instants import Study
from .metric import floor, round_to_floor
from .rows import judged, row, rungs, steps
from .verdict import verdict

Studied = Mapping[tuple[Ladder, str], Convergence]
"""What a ladder says of a quantity, by both."""
NOTHING = Convergence(UNSETTLED, {}, None)
"""What no step says."""
AWAY = 4  # of a ladder's largest steps: how far from an event a sample tells an order


@dataclass(frozen=True)
class Outcome:
    """The result of one trial: its rows, and the engine's samples at the judged step.

    wanted: the reference's, where the engine's own step misses the case's samples.
    """

    rows: list[Comparison]
    rungs: list[Rungs] = field(default_factory=list)
    steps: list[StepError] = field(default_factory=list)
    samples: Samples = field(default_factory=dict)
    instants: list[Instant] = field(default_factory=list)
    moments: dict[str, str] = field(default_factory=dict)  # of what is off at an instant, in words
    wanted: Samples = field(default_factory=dict)


def compare(trial: Trial, runs: Runs | None = None) -> Outcome:
    """Judges every observed quantity of the runs; without them it runs the engine."""
    if isinstance(trial.way, Refusal):
        names, because = judged_names(trial.case), trial.way.because
        return Outcome([row(trial, name, REFUSED, because=because) for name in names])
    rows = [_audit(trial)]
    rows += [row(trial, name, REFUSED, because=why) for name, why in trial.withheld.items()]
    motion, events = trial.motion, trial.instants
    runs = runs or simulate(trial)
    if runs.judged is None:
        return Outcome(rows + _diverged(trial, (*motion, *events), runs.lost))
    phases = Phases(trial)
    later = phases.at(trial.step, trial.plan.kept)
    if lost := [run for run in later if isinstance(run, str)]:
        why = f"begun a part of a step later: {lost[0]}"
        return Outcome(rows + _diverged(trial, (*motion, *events), why))
    begun = [Begun(trial, fairly(trial, runs.judged, trial.step))]
    begun += [run for run in later if not isinstance(run, str)]
    trial = replace(trial, starts=len(begun))
    sure = partial(_over_phases, trial=trial, runs=runs, phases=phases)
    studies = [
        sure((ladder, name, _study(trial, ladder, runs, name)))
        for ladder, climbed in runs.ladders.items()
        if climbed
        for name in motion
    ]
    studied = {(ladder, name): convergence for ladder, name, convergence in studies}
    moments: dict[str, str] = {}
    rows += [_judged(trial, name, runs, _worst(begun, name), studied, moments) for name in motion]
    event_rows, of_events = instants.judge(trial, events, runs, begun, sure)
    studies += of_events
    moments |= {name: words for name in events if (words := instants.spread(trial, name))}
    listed = instants.listed(trial, runs.judged)
    wanted = {name: trial.wanted(name) for name in motion} if trial.sampled else {}
    return Outcome(
        rows + event_rows,
        [rungs(trial, *study) for study in studies],
        [step for study in studies for step in steps(trial, *study)],
        runs.judged,
        listed,
        moments,
        wanted,
    )


def answered(trial: Trial, climb: Climbed) -> Outcome:
    """Judges every quantity of a claim about states."""
    rows = [_audit(trial)]
    rows += [row(trial, name, REFUSED, because=why) for name, why in trial.withheld.items()]
    if isinstance(climb, str):
        return Outcome(rows + _diverged(trial, trial.motion, climb))
    read = {name: trial.read(name, samples) for name, samples in climb.items()}
    return Outcome(rows + [_of_states(trial, name, read) for name in read], samples=read)


def _of_states(trial: Trial, name: str, samples: Samples) -> Comparison:
    """The quantity's row, judged by its largest difference over all states: it knows no step."""
    error = metric.error(samples[name], trial.wanted(name))
    least, allowed = floor(trial, name, trial.case.duration), trial.allowed(name)
    largest = round_to_floor(error.largest, least)
    why = f"largest in state {error.at + 1}" if samples[name].size == trial.case.samples else ""
    word, because = verdict(trial, name, error.largest, Convergence(UNSETTLED, {}, None), why)
    return row(
        trial,
        name,
        word,
        error=largest,
        rms=round_to_floor(error.rms, least),
        ratio=None if allowed is None else largest / allowed,
        because=because,
    )


def crashed(trial: Trial, because: str) -> Outcome:
    """Rows of a run whose process died; with a user's own numbers that is a finding."""
    word, why = (
        (FAILS, f"crashed: {because}") if trial.engine.setting in SETTINGS else (CRASHED, because)
    )
    return Outcome([row(trial, name, word, because=why) for name in judged_names(trial.case)])


def _diverged(trial: Trial, names: Iterable[str], because: str) -> list[Comparison]:
    word = DIVERGED
    if trial.engine.setting == "tuned":
        word, because = FAILS, f"{DIVERGED}: {because}"
    return [row(trial, name, word, because=because) for name in names]


def _audit(trial: Trial) -> Comparison:
    try:
        worst, because = audit(trial)
    except Exception as error:  # it costs no other row
        worst, because = math.inf, why(error)
    return row(
        trial,
        "audit",
        AGREES if worst <= EQUAL else FAILS,
        protocol=trial.protocol if trial.case.states is None else "",
        error=worst,
        allowed=EQUAL,
        ratio=worst / EQUAL,
        because=because,
    )


def _judged(
    trial: Trial, name: str, runs: Runs, worst: Begun, studied: Studied, moments: dict[str, str]
) -> Comparison:
    """The quantity's row, of the worst start; if it is off at an instant, that is noted too."""
    samples, wanted, ladders = worst.samples[name], worst.trial.wanted(name), list(runs.ladders)
    held = studied.get((ladders[-1], name), NOTHING)
    # What is promised for h → 0 is the tuned setting's, whose numbers follow the step.
    tuned = studied.get((ladders[0], name), NOTHING)
    error = metric.error(samples, wanted)
    unit = trial.quantity(name).unit
    reason = partial(cause, finer=runs.finer, simplified=trial.plan.simplified, unit=unit)
    why = reason(_telling(trial, name, error.largest, held, tuned))
    at = moment(worst.trial, samples, wanted, error)
    least = floor(trial, name, trial.step)
    if at is not None:
        rest = metric.error(samples[at.elsewhere], wanted[at.elsewhere]).largest
        why = f"{at.words}; elsewhere at most {round_to_floor(rest, least):.2g}"
        moments[name] = why
        if not rest <= (trial.allowed(name) or np.inf):
            elsewhere = away_from_instants(trial)
            others = _study(trial, ladders[-1], runs, name, elsewhere)
            following = _study(trial, ladders[0], runs, name, elsewhere)
            others = _telling(trial, name, rest, others, following)
            why = f"{why}: {reason(others)}"
    when = float(worst.trial.case.times[error.at])
    word = verdict(trial, name, error.largest, held, why, tuned)
    return judged(trial, name, word, error, when)


def _worst(begun: Sequence[Begun], name: str) -> Begun:
    """Returns the start from which the quantity is farthest off; NaN is farther than any number."""
    sizes = [metric.error(run.samples[name], run.trial.wanted(name)).largest for run in begun]
    return begun[int(np.argmax(np.nan_to_num(sizes, nan=np.inf)))]


def _over_phases(study: Study, *, trial: Trial, runs: Runs, phases: Phases) -> Study:
    """The study, usable up to the largest step at which every start within a step keeps the bound.

    Smaller steps are known to keep it from one start, and are not asked of the others.
    """
    ladder, name, convergence = study
    if not phases.moved:
        return study
    kept, climbed = ladder.plan(trial.plan).kept, runs.ladders[ladder]
    steps = [h for h in sorted(climbed) if h <= (convergence.usable_step or 0.0)]
    begun = ((h, [Begun(trial, climbed[h]), *phases.at(h, kept)]) for h in reversed(steps))
    usable = next((h for h, starts in begun if _keep(name, starts, h)), None)
    return ladder, name, replace(convergence, usable_step=usable)


def _keep(name: str, begun: Sequence[Begun | str], step: float) -> bool:
    """Whether all these runs at a step [s] keep what is allowed of the quantity."""
    for run in begun:
        if isinstance(run, str):
            return False
        trial, samples = run
        dated = trial.quantity(name).part in trial.case.events
        off = instants.off if dated else _largest_error
        if not off(trial, name, samples, step) <= (trial.allowed(name) or np.inf):
            return False
    return True


def _largest_error(trial: Trial, name: str, samples: Samples, step: float) -> float:
    return metric.error(samples[name], trial.wanted(name)).largest


def _telling(
    trial: Trial, name: str, largest: float, held: Convergence, following: Convergence
) -> Convergence:
    """Returns the held ladder, which tells errors of the step from those of the model.

    With the numbers of its coarsest step the model may be further off than the judged run is, or
    within at the very step at which that is not. That explains nothing, nor does a model that is
    off with those alone: where they follow, its error falls. So the ladder is asked in which they
    do.
    """
    worse = (held.limit or 0.0) > largest
    beyond = largest > (trial.allowed(name) or np.inf)
    better = beyond and (held.usable_step or 0.0) >= trial.step
    model = held.verdict == ANOTHER
    if not (worse or better or model):
        return held
    return following if worse or better or following.verdict == FALLS else held


def _study(
    trial: Trial,
    ladder: Ladder,
    runs: Runs,
    name: str,
    among: NDArray[np.bool_] | None = None,
) -> Convergence:
    """One quantity on one ladder; `among`: of these samples (N,) alone."""
    climbed, case = runs.ladders[ladder], trial.case
    if not climbed:
        return NOTHING
    keep = np.ones(case.samples, dtype=bool) if among is None else among
    return study(
        {h: samples[name][keep] for h, samples in climbed.items()},
        trial.wanted(name)[keep],
        exponents=ladder.plan(trial.plan).exponents,
        allow=trial.allowed(name) or float("inf"),
        floor=floor(trial, name, min(climbed)),
        away=trial.away(AWAY * max(climbed))[keep],
        behind=trial.behind[keep],
    )
