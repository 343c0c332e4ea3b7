"""Rows filled with what a trial knows by itself."""

from collections.abc import Mapping
from typing import Any

from ..row import Comparison, Rungs
from ..trial.ladder import Ladder
from ..trial.trial import Trial
from .convergence import Convergence


def row(trial: Trial, name: str, word: str, **values: Any) -> Comparison:
    """A row of tolerance.csv for the quantity `name` with the verdict `word`."""
    columns: dict[str, Any] = dict.fromkeys(("step", "largest", "rms", "final", "ratio"))
    columns |= {"protocol": "", "because": "", "allowed": None} | values
    if name != "audit":
        columns["allowed"] = trial.allowed(name)
    return Comparison(
        case=trial.case.name,
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


def rungs(
    trial: Trial, ladder: Ladder, name: str, errors: Mapping[float, float], found: Convergence
) -> Rungs:
    """A row of convergence.csv: the errors by step, smallest first, and what they say."""
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
