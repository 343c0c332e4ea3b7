"""The bar that a recipe has to keep: every quantity within its tolerance, with a margin."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf

from ..causes.candidate import Candidate
from ..causes.errors import of
from ..causes.parallel_search import Known


def digits(error: float) -> float:
    """In digits that no rounding decides."""
    return float(f"{error:.3g}")


@dataclass(frozen=True)
class Bar:
    """margin: how often the worst error has to fit into what is allowed.

    known: all runs; scale: by quantity what its error over the case's own tolerance is multiplied
    by, where another tolerance is asked for. elsewhere: the worst where a loop is cut otherwise, as
    far as that was asked; there no margin has to be left.
    """

    known: Known
    margin: float
    scale: Mapping[str, float] = field(default_factory=dict[str, float])
    elsewhere: dict[Candidate, float] = field(default_factory=dict[Candidate, float])

    def worst(self, candidate: Candidate) -> tuple[float, str]:
        """The largest error over what is allowed, and whose; inf where the run came to nothing.

        Whatever any run has told must be told: a setting may lose a quantity.
        """
        names = dict.fromkeys(name for errors in self.known.values() for name in errors)
        errors = self.known[candidate]
        found = [(of(errors, name) * self.scale.get(name, 1.0), name) for name in names]
        return max(found, default=(inf, ""), key=lambda one: one[0])

    def leave_out(self, elsewhere: Mapping[Candidate, float]) -> None:
        """Records the errors elsewhere; what is like a candidate that fails there fails with it.

        Two are alike if at one step the worst error here is the same, of the same quantity. Options
        that change nothing here change nothing there: each would be asked after the other.
        """
        self.elsewhere.update(elsewhere)
        here = {candidate: self._here(candidate) for candidate in self.known}
        lost = {here[c]: x for c, x in self.elsewhere.items() if c in here and not x <= 1.0}
        alike = {c: lost[here[c]] for c in here.keys() - self.elsewhere if here[c] in lost}
        self.elsewhere.update(alike)

    def _here(self, candidate: Candidate) -> tuple[float, float, str]:
        worst, quantity = self.worst(candidate)
        return candidate.step, digits(worst), quantity

    def holds(self, candidate: Candidate) -> bool:
        """At this step alone."""
        here = self.worst(candidate)[0] <= 1 / self.margin
        return here and self.elsewhere.get(candidate, 0.0) <= 1.0
