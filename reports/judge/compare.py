"""A trial's rows: audit, ladders, and a verdict for every observed quantity."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from ...engines.engine import Refusal
from ..row import AGREES, CRASHED, DIVERGED, FAILS, Comparison, Instant, Rungs
from ..trial.audit import EQUAL, audit
from ..trial.ladder import Ladder
from ..trial.simulate import Runs, Samples, simulate
from ..trial.trial import Trial, judged_names
from . import instants, metric
from .convergence import Convergence, study
from .rows import row, rungs
from .verdict import verdict

AWAY = 4  # of a ladder's largest steps: how far from an event a sample tells an order


@dataclass(frozen=True)
class Outcome:
    """What one trial gave: its rows, and the engine's samples at the judged step."""

    rows: list[Comparison]
    rungs: list[Rungs] = field(default_factory=list)
    samples: Samples = field(default_factory=dict)
    instants: list[Instant] = field(default_factory=list)


def compare(trial: Trial) -> Outcome:
    """Runs the engine and judges every observed quantity."""
    names = judged_names(trial.case)
    if isinstance(trial.way, Refusal):
        return Outcome([row(trial, name, f"refused: {trial.way.because}") for name in names])
    withheld = {name: _withheld(trial, name) for name in names}
    rows = [_audit(trial)]
    rows += [row(trial, name, f"refused: {why}") for name, why in withheld.items() if why]
    motion = tuple(n for n, why in withheld.items() if not why and not _of_event(trial, n))
    events = tuple(n for n, why in withheld.items() if not why and _of_event(trial, n))
    runs = simulate(trial, motion)
    if runs.judged is None:
        return Outcome(rows + _diverged(trial, (*motion, *events), runs.lost))
    studies = _studies(trial, runs, motion)
    held = {name: found for (_, name), found in studies.items()}  # the held ladder is the last
    rows += [_judged(trial, name, runs.judged, held[name]) for name in motion]
    climbed = [_rungs(trial, ladder, runs, n, found) for (ladder, n), found in studies.items()]
    told, ladders = instants.judge(trial, events, runs, runs.judged)
    listed = instants.listed(trial, runs.judged)
    return Outcome(rows + told, climbed + ladders, runs.judged, listed)


def _of_event(trial: Trial, name: str) -> bool:
    return trial.quantity(name).kind == "event"


def _withheld(trial: Trial, name: str) -> str | None:
    """Why the engine does not tell the quantity, or that of the event."""
    if _of_event(trial, name):
        name = trial.case.events[name.rpartition(".")[0]].quantity
    return trial.plan.withheld.get(name)


def crashed(trial: Trial, because: str) -> Outcome:
    """Rows of a run whose process died; with a user's own numbers that is a finding."""
    word, why = (
        (CRASHED, because) if trial.engine.setting == "own" else (FAILS, f"crashed: {because}")
    )
    return Outcome([row(trial, name, word, because=why) for name in judged_names(trial.case)])


def _diverged(trial: Trial, names: Iterable[str], because: str) -> list[Comparison]:
    word = DIVERGED
    if trial.engine.setting == "tuned":
        word, because = FAILS, f"{DIVERGED}: {because}"
    return [row(trial, name, word, because=because) for name in names]


def _audit(trial: Trial) -> Comparison:
    worst, because = audit(trial)
    return row(
        trial,
        "audit",
        AGREES if worst <= EQUAL else FAILS,
        protocol=trial.protocol,
        largest=worst,
        allowed=EQUAL,
        ratio=worst / EQUAL,
        because=because,
    )


def _judged(trial: Trial, name: str, samples: Samples, held: Convergence) -> Comparison:
    error = metric.error(samples[name], trial.wanted(name))
    word, because = verdict(trial, name, error.largest, held)
    allowed = trial.allowed(name)
    return row(
        trial,
        name,
        word,
        protocol=trial.protocol,
        step=trial.step,
        largest=error.largest,
        rms=error.rms,
        final=error.final,
        ratio=None if allowed is None else error.largest / allowed,
        because=because,
    )


def _studies(
    trial: Trial, runs: Runs, names: tuple[str, ...]
) -> dict[tuple[Ladder, str], Convergence]:
    case = trial.case
    return {
        (ladder, name): study(
            {h: samples[name] for h, samples in climbed.items()},
            trial.wanted(name),
            exponents=ladder.plan(trial.plan).exponents,
            allow=trial.allowed(name) or float("inf"),
            floor=metric.floor(trial.size(name), case.duration / min(climbed)),
            away=trial.away(AWAY * max(climbed)),
        )
        for ladder, climbed in runs.ladders.items()
        if climbed
        for name in names
    }


def _rungs(trial: Trial, ladder: Ladder, runs: Runs, name: str, found: Convergence) -> Rungs:
    errors = {
        h: metric.error(samples[name], trial.wanted(name)).largest
        for h, samples in sorted(runs.ladders[ladder].items())
    }
    return rungs(trial, ladder, name, errors, found)
