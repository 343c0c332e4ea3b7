"""From a difference and its convergence to a verdict."""

from ....cases.case import Deviation
from ....engines.engine import Engine
from ...tables import pins
from ...tables.row import AGREES, ANOTHER, BEYOND, CHANGED, DEVIATES, FAILS
from ..trial.trial import Trial
from .convergence import Convergence

STAYS = 0.25  # of a declared deviation: what it may change and be the same one
CERTAIN = 10  # uncertainties that a declared limit must stand above


def verdict(
    trial: Trial,
    quantity: str,
    largest: float,
    convergence: Convergence,
    why: str,
    tuned: Convergence | None = None,
) -> tuple[str, str]:
    """The verdict's word and its reason: a bar that is broken, and `why` there is a difference.

    convergence: on the ladder of the judged numbers. tuned: on the ladder whose numbers follow the
    step, if that is another one.
    """
    case, engine = trial.case, trial.engine
    allowed = trial.allowed(quantity)
    declared = case.deviates.get(f"{engine.name}.{engine.setting}", {}).get(quantity)
    if trial.realised != "native":
        declared = None  # what is declared is the engine's own model; a law or driver is ours
    if allowed is None:
        return FAILS, f"its tolerance is unknown; {largest:.3g} was measured: type a number"
    if declared is not None:
        return _declared(engine, declared, largest, convergence)
    if engine.setting == "tuned":
        broken = _broken(trial, quantity, largest, tuned or convergence)
        return (FAILS, f"{broken}; {why}") if broken else (AGREES, "")
    if not largest <= allowed:
        return BEYOND, why
    return AGREES, ""


def _broken(trial: Trial, quantity: str, largest: float, convergence: Convergence) -> str:
    """Names the bar of a tuned setting that is not kept, or nothing."""
    engine, native = trial.engine.name, trial.realised == "native"
    allowed = trial.allowed(quantity)
    assert allowed is not None
    key = engine if native else f"{engine}.{trial.realised}"
    reach = trial.case.reach.get(key, {}).get(quantity)
    limit = trial.case.reach.get(f"{engine}.limit", {}).get(quantity)
    if not largest <= allowed:
        return f"{largest:.3g} is above allow {allowed:.3g}"
    if reach is not None and not largest <= reach:
        return f"{largest:.3g} is above reach {reach:.3g}"
    if limit is not None and native:
        if convergence.limit is None:
            return f"no limit for h → 0 to hold against {limit:.3g}"
        if not convergence.limit <= limit:
            return f"its limit {convergence.limit:.3g} for h → 0 is above reach {limit:.3g}"
    return ""


def _declared(
    engine: Engine, declared: Deviation, largest: float, convergence: Convergence
) -> tuple[str, str]:
    if declared.by is not None:
        low, high = declared.by
        same, measured = low <= largest <= high, largest
    else:
        assert declared.limit is not None
        limit, uncertainty = convergence.limit, convergence.uncertainty
        measured = largest if limit is None else limit
        same = (
            convergence.verdict == ANOTHER
            and limit is not None
            and uncertainty is not None
            and abs(limit - declared.limit) <= STAYS * declared.limit
            and limit >= CERTAIN * uncertainty
        )
    if same:
        return DEVIATES, declared.because
    judged = pins.version(engine.name)
    if judged not in (None, engine.version):
        return CHANGED, f"since {judged}: declared otherwise, now {measured:.3g}"
    return FAILS, f"the declared deviation is gone or another: {measured:.3g} ({declared.because})"
