"""Which equations, examples, exercises and figures of the chapter are covered, by which cases."""

from collections.abc import Mapping, Sequence

import pandas as pd

from ..cases.case import Case

EQUATIONS = 98  # (2.1) to (2.98)
EXAMPLES, EXERCISES, FIGURES = 4, 6, 31


def coverage(cases: Sequence[Case], executed: Mapping[str, set[str]]) -> pd.DataFrame:
    """One row for every item of the chapter; an empty `cases` says that it is not covered yet.

    An equation is covered by the cases that execute it; the rest by the cases that name it.
    """
    rows = []
    for number in range(1, EQUATIONS + 1):
        label = f"2.{number}"
        rows.append(("equation", label, [c.name for c in cases if label in executed[c.name]]))
    for kind, count in (("example", EXAMPLES), ("exercise", EXERCISES), ("figure", FIGURES)):
        for number in range(1, count + 1):
            label = f"2.{number}"
            rows.append((kind, label, [c.name for c in cases if getattr(c.origin, kind) == label]))
    # In brackets, or whoever reads the table takes 2.10 for the number 2.1.
    return pd.DataFrame(
        [(kind, f"({number})", " ".join(sorted(names))) for kind, number, names in rows],
        columns=["kind", "number", "cases"],
    )
