"""Rows filled with what a trial knows by itself."""

from typing import Any

from ....cases.theme import themes
from ...tables.row import Comparison, Rungs, StepError
from ..trial.ladder import Ladder
from ..trial.trial import Trial
from .convergence import Convergence
from .metric import Error, floor, round_to_floor


def row(trial: Trial, name: str, word: str, **values: Any) -> Comparison:
    """A row of tolerance.csv for the quantity `name` with the verdict `word`."""
    columns: dict[str, Any] = dict.fromkeys(("step", "error", "when", "rms", "final", "ratio"))
    columns |= {"protocol": "", "because": "", "allowed": None} | values
    if name != "audit":
        columns["allowed"] = trial.allowed(name)
    return Comparison(
        case=trial.case.name,
        theme=" ".join(themes(trial.case)),
        source=str(trial.case.origin),
        engine=trial.engine.name,
        version=trial.engine.version,
        setting=trial.engine.setting,
        realised=trial.realised,
        quantity=name,
        unit=trial.quantity(name).unit,
        verdict=word,
        **columns,
    )


def judged(
    trial: Trial, name: str, verdict: tuple[str, str], error: Error, when: float | None
) -> Comparison:
    """A row of what was measured at the judged step; `when` [s] the error is largest."""
    word, because = verdict
    least, allowed = floor(trial, name, trial.step), trial.allowed(name)
    largest = round_to_floor(error.largest, least)
    return row(
        trial,
        name,
        word,
        protocol=trial.protocol,
        step=trial.step,
        error=largest,
        when=when if largest else None,
        rms=round_to_floor(error.rms, least),
        final=round_to_floor(error.final, least),
        ratio=None if allowed is None else largest / allowed,
        because=because,
    )


def rungs(trial: Trial, ladder: Ladder, name: str, convergence: Convergence) -> Rungs:
    """A row of convergence.csv: what the errors by step say."""
    return Rungs(
        case=trial.case.name,
        engine=trial.engine.name,
        version=trial.engine.version,
        setting=trial.engine.setting,
        realised=trial.realised,
        ladder=ladder.name,
        quantity=name,
        unit=trial.quantity(name).unit,
        order=convergence.order,
        order_low=convergence.order_low,
        order_high=convergence.order_high,
        limit=convergence.limit,
        uncertainty=convergence.uncertainty,
        usable_step=convergence.usable_step,
        verdict=convergence.verdict,
    )


def steps(trial: Trial, ladder: Ladder, name: str, convergence: Convergence) -> list[StepError]:
    """Rows of steps.csv: the error at each step of a ladder, the smallest step first."""
    least = floor(trial, name, min(convergence.errors))
    return [
        StepError(
            case=trial.case.name,
            engine=trial.engine.name,
            setting=trial.engine.setting,
            realised=trial.realised,
            ladder=ladder.name,
            quantity=name,
            unit=trial.quantity(name).unit,
            step=h,
            error=round_to_floor(error, least),
        )
        for h, error in sorted(convergence.errors.items())
    ]
