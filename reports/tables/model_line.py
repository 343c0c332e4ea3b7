"""A row of models.csv."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ModelLine:
    """A row of models.csv: a user's model, its worst quantity at its own setting, what keeps all.

    seen: of its own steps. keeps: the setting with the coarsest step that keeps every tolerance.
    cure: what does at its own step, or what costs least, where that was searched for.
    """

    case: str
    integrator: str = ""
    step: float | None = None
    quantity: str = ""
    unit: str = ""
    error: float | None = None
    when: float | None = None
    allowed: float | None = None
    ratio: float | None = None
    verdict: str = ""
    seen: str = ""
    keeps: str = ""
    keeps_step: float | None = None
    cure: str = ""
    not_compared: str = ""
    because: str = ""
