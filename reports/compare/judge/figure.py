"""A plain number: one that a person asks for, and on which no verdict hangs."""

from dataclasses import dataclass

ROUNDING = 1e-12  # in any unit: nobody asks for less


@dataclass(frozen=True)
class Plain:
    """A number with its name, as `creep of touch`; wanted: the textbook's, where it is not 0."""

    what: str
    value: float
    unit: str
    wanted: float = 0.0

    def __str__(self) -> str:
        if not self.unit:
            return f"{self.what}: {_said(self.value)} (textbook {_said(self.wanted)})"
        if self.unit.startswith("m") and abs(self.value) < 0.1:
            return f"{self.what}: {_said(1e3 * self.value)} m{self.unit}"
        return f"{self.what}: {_said(self.value)} {self.unit}"


def _said(value: float) -> str:
    return f"{value:.3g}" if abs(value) > ROUNDING else "0"
