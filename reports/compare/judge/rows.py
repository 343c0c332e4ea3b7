"""The rows of the tables, of whatever is judged: a case in an engine, or a user's model."""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from ....cases.theme import themes
from ...tables.row import Comparison, Rungs, StepError
from ..trial.ladder import Ladder
from ..trial.trial import Trial
from .convergence import Convergence
from .metric import Error, floor, round_to_floor


@dataclass(frozen=True)
class Subject:
    """The subject of a row: a case, an engine in a setting, and how that realises the case."""

    case: str
    theme: str
    source: str
    engine: str
    version: str
    setting: str
    realised: str

    def row(self, quantity: str, unit: str, verdict: str, **values: Any) -> Comparison:
        """Returns a row of tolerance.csv; columns that are not named stay empty."""
        numbers = dict.fromkeys(("step", "error", "when", "rms", "final", "allowed", "ratio"))
        columns = {**numbers, "protocol": "", "because": "", **values}
        return Comparison(**asdict(self), quantity=quantity, unit=unit, verdict=verdict, **columns)

    def rungs(self, ladder: str, quantity: str, unit: str, says: Convergence) -> Rungs:
        """Returns a row of convergence.csv: what the errors by step say."""
        return Rungs(
            self.case, self.engine, self.version, self.setting, self.realised, ladder, quantity,
            unit, says.order, says.order_low, says.order_high, says.limit, says.uncertainty,
            says.usable_step, says.verdict,
        )  # fmt: skip

    def steps(
        self,
        ladder: str,
        quantity: str,
        unit: str,
        says: Convergence,
        rounded: Callable[[float], float],
    ) -> list[StepError]:
        """Returns rows of steps.csv: the error at each step of a ladder, the smallest first."""
        head = self.case, self.engine, self.setting, self.realised, ladder, quantity, unit
        return [StepError(*head, h, rounded(error)) for h, error in sorted(says.errors.items())]


def measured(error: Error, least: float, allowed: float | None, when: float | None) -> Any:
    """Returns the columns of an error, in digits above `least`; `when` [s] it is the largest."""
    largest = round_to_floor(error.largest, least)
    return {
        "error": largest,
        "when": when if largest else None,
        "rms": round_to_floor(error.rms, least),
        "final": round_to_floor(error.final, least),
        "ratio": None if allowed is None else largest / allowed,
    }


def subject(trial: Trial) -> Subject:
    """Returns what the rows of a trial are about."""
    case, engine = trial.case, trial.engine
    about = " ".join(themes(case)), str(case.origin)
    return Subject(case.name, *about, engine.name, engine.version, engine.setting, trial.realised)


def row(trial: Trial, name: str, word: str, **values: Any) -> Comparison:
    """A row of tolerance.csv for the quantity `name` with the verdict `word`."""
    if name != "audit":
        values["allowed"] = trial.allowed(name)
    return subject(trial).row(name, trial.quantity(name).unit, word, **values)


def judged(
    trial: Trial, name: str, verdict: tuple[str, str], error: Error, when: float | None
) -> Comparison:
    """A row of what was measured at the judged step; `when` [s] the error is largest."""
    word, because = verdict
    numbers = measured(error, floor(trial, name, trial.step), trial.allowed(name), when)
    ran = {"protocol": trial.protocol, "step": trial.step, "because": because}
    return row(trial, name, word, **ran, **numbers)


def rungs(trial: Trial, ladder: Ladder, name: str, convergence: Convergence) -> Rungs:
    """A row of convergence.csv: what the errors by step say."""
    return subject(trial).rungs(ladder.name, name, trial.quantity(name).unit, convergence)


def steps(trial: Trial, ladder: Ladder, name: str, convergence: Convergence) -> list[StepError]:
    """Rows of steps.csv: the error at each step of a ladder, the smallest step first."""
    least = floor(trial, name, min(convergence.errors))
    unit = trial.quantity(name).unit
    return subject(trial).steps(
        ladder.name, name, unit, convergence, lambda error: round_to_floor(error, least)
    )
