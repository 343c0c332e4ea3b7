"""What a user should know of own settings, and sees in no single row."""

from collections import defaultdict
from collections.abc import Iterator, Sequence

from ...engines import SETTINGS
from ..row import Comparison
from ..selection import BOOK

Numbers = dict[str, tuple[float | None, ...]]


def without_effect(rows: Sequence[Comparison]) -> Iterator[str]:
    """A line for each own setting whose numbers are the shipped ones, all of them, in a case."""
    found: defaultdict[tuple[str, str], dict[str, Numbers]] = defaultdict(dict)
    for row in rows:
        if row.engine != BOOK and row.setting != "tuned":
            numbers = found[row.case, row.engine].setdefault(row.setting, {})
            numbers[row.quantity] = (row.step, row.error, row.rms, row.final)
    for (case, engine), settings in found.items():
        shipped = settings.get("shipped")
        for setting in settings:
            if setting not in SETTINGS and settings[setting] == shipped:
                yield f"{case}: {engine}.{setting} changes nothing: every number is shipped's"
