"""Which equations, examples, exercises and figures of the chapter are covered, and by what."""

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd
from ruamel.yaml import YAML

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake

EQUATIONS = 98  # (2.1) to (2.98)
EXAMPLES, EXERCISES, FIGURES = 4, 6, 32
OTHERWISE = Path(__file__).parents[1] / "otherwise.yaml"


def coverage(cases: Sequence[Case], executed: Mapping[str, set[str]]) -> pd.DataFrame:
    """One row for every item of the chapter: its cases, or what else covers it, or why nothing is.

    An equation is covered by the cases that execute it; the rest by the cases that name it. Both
    columns are empty of what is not covered yet.
    """
    rows = []
    for number in range(1, EQUATIONS + 1):
        label = f"2.{number}"
        rows.append(("equation", label, [c.name for c in cases if label in executed[c.name]]))
    for kind, count in (("example", EXAMPLES), ("exercise", EXERCISES), ("figure", FIGURES)):
        for number in range(1, count + 1):
            label = f"2.{number}"
            named = [c.name for c in cases if label in c.origin.places(kind)]
            rows.append((kind, label, named))
    said = otherwise()
    # In brackets, or whoever reads the table takes 2.10 for the number 2.1.
    return pd.DataFrame(
        [
            (kind, f"({number})", " ".join(sorted(names)), said.get((kind, number), ""))
            for kind, number, names in rows
        ],
        columns=["kind", "number", "cases", "otherwise"],
    )


def countable() -> None:
    """Checks that equations can be noted. Raises CaseError under `python -OO`.

    A function says by its docstring which equations it is, and that takes them away: every
    equation would seem to be covered by nothing.
    """
    if sys.flags.optimize > 1:
        what = "takes the docstrings away, in which the equations stand: -O alone keeps them"
        raise CaseError([Mistake("python -OO", 0, 0, "", what)])


def otherwise() -> dict[tuple[str, str], str]:
    """By kind and number, the test that states it, or why there is nothing to compute."""
    listed = YAML(typ="safe").load(OTHERWISE.read_text(encoding="utf-8"))
    return {
        (kind, number): what for kind, items in listed.items() for number, what in items.items()
    }
