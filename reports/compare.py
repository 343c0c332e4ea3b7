"""A trial's rows: audit, ladders, and a verdict for every observed quantity."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from reports import metric
from reports.audit import EQUAL, audit
from reports.convergence import Convergence, study
from reports.ladder import Ladder
from reports.row import AGREES, CRASHED, DIVERGED, FAILS, Comparison, Rungs
from reports.simulate import Runs, Samples, simulate
from reports.trial import Trial
from reports.verdict import verdict


@dataclass(frozen=True)
class Outcome:
    """What one trial gave: its rows, and the engine's samples at the judged step."""

    rows: list[Comparison]
    rungs: list[Rungs] = field(default_factory=list)
    samples: Samples = field(default_factory=dict)


def compare(trial: Trial) -> Outcome:
    """Runs the engine and judges every observed quantity."""
    case, engine = trial.case, trial.engine
    refusal = engine.refuses(case.scene)
    if refusal:
        return Outcome([_row(trial, name, f"refused: {refusal}") for name in case.allow])
    withheld = {name: engine.withholds(case.scene, name) for name in case.allow}
    rows = [_audit(trial)]
    rows += [_row(trial, name, f"refused: {why}") for name, why in withheld.items() if why]
    names = tuple(name for name, why in withheld.items() if not why)
    runs = simulate(trial, names)
    if runs.judged is None:
        return Outcome(rows + _diverged(trial, names, runs.lost))
    studies = _studies(trial, runs, names)
    held = {name: found for (_, name), found in studies.items()}  # the held ladder is the last
    rows += [_judged(trial, name, runs.judged, held[name]) for name in names]
    rungs = [_rungs(trial, ladder, runs, name, found) for (ladder, name), found in studies.items()]
    return Outcome(rows, rungs, runs.judged)


def crashed(trial: Trial, because: str) -> Outcome:
    """Rows of a run whose process died; with a user's own numbers that is a finding."""
    word, why = (
        (CRASHED, because) if trial.engine.setting == "own" else (FAILS, f"crashed: {because}")
    )
    return Outcome([_row(trial, name, word, because=why) for name in trial.case.allow])


def _diverged(trial: Trial, names: Iterable[str], because: str) -> list[Comparison]:
    word = DIVERGED
    if trial.engine.setting == "tuned":
        word, because = FAILS, f"{DIVERGED}: {because}"
    return [_row(trial, name, word, because=because) for name in names]


def _row(trial: Trial, name: str, word: str, **values: Any) -> Comparison:
    case, engine = trial.case, trial.engine
    columns: dict[str, Any] = dict.fromkeys(("step", "largest", "rms", "final", "ratio"))
    columns |= {"protocol": "", "because": "", "allowed": case.allow.get(name)} | values
    return Comparison(
        case=case.name,
        source=str(case.origin),
        engine=engine.name,
        version=engine.version,
        setting=engine.setting,
        realised=trial.realised,
        quantity=name,
        unit=trial.quantity(name).unit,
        verdict=word,
        **columns,
    )


def _audit(trial: Trial) -> Comparison:
    worst, because = audit(trial)
    return _row(
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
    allowed = trial.case.allow[name]
    return _row(
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
            {h: samples[name] for h, samples in rungs.items()},
            trial.wanted(name),
            exponents=trial.engine.exponents(
                case.scene, trial.realised, held=ladder.name == "held"
            ),
            allow=case.allow[name] or float("inf"),
            floor=metric.floor(trial.size(name), case.duration / min(rungs)),
        )
        for ladder, rungs in runs.ladders.items()
        if rungs
        for name in names
    }


def _rungs(trial: Trial, ladder: Ladder, runs: Runs, name: str, found: Convergence) -> Rungs:
    errors = {
        h: metric.error(samples[name], trial.wanted(name)).largest
        for h, samples in sorted(runs.ladders[ladder].items())
    }
    return Rungs(
        case=trial.case.name,
        engine=trial.engine.name,
        version=trial.engine.version,
        setting=trial.engine.setting,
        realised=trial.realised,
        ladder=ladder.name,
        quantity=name,
        unit=trial.quantity(name).unit,
        steps=" ".join(f"{h:.3g}" for h in errors),
        errors=" ".join(f"{e:.2e}" for e in errors.values()),
        order=found.order,
        order_low=found.order_low,
        order_high=found.order_high,
        limit=found.limit,
        uncertainty=found.uncertainty,
        usable_step=found.usable_step,
        verdict=found.verdict,
    )
