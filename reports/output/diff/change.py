"""One difference between two report folders, of whatever file."""

from dataclasses import dataclass

WORSE, BETTER, CHANGED = "regression", "better", "changed"
LOST, NEW = "lost", "new"
KINDS = (WORSE, BETTER, CHANGED, LOST, NEW)


@dataclass(frozen=True)
class Seen:
    """The content of a row in one of the folders: a verdict or other words, and a number."""

    words: str
    number: float | None = None


@dataclass(frozen=True)
class Place:
    """Case, column and subject of a change; empty where it has none.

    So `four_bar`, `mujoco.tuned (law)`, `crank.angle`.
    """

    case: str
    column: str
    what: str


@dataclass(frozen=True)
class Change:
    """A row that differs, or that only one of the folders has (then the other is None)."""

    kind: str
    file: str
    place: Place
    was: Seen | None
    now: Seen | None
    unit: str = ""
    allowed: float | None = None
    times: float | None = None  # the new error over the old one
    label: str = ""  # what its number is, where it is no error
    note: str = ""
