"""Runs whose errors are planted, for searches: what is to be found among them is known."""

from collections.abc import Callable, Mapping
from math import inf
from typing import Any, TypeVar

from textmech.reports.search.advice import recipe
from textmech.reports.search.advice.candidates import Candidates
from textmech.reports.search.causes.candidate import Candidate
from textmech.reports.search.causes.search import Missing, Runs

T = TypeVar("T")
Error = Callable[[Mapping[str, Any], float], float | tuple[float, float]]
"""Of options and a step; or of all samples, and of those away from instants. inf: it diverges."""


def runs(known: Mapping[Candidate, Mapping[str, float]] | None = None) -> Runs:
    """The runs of no pair, of which these errors are known."""
    made = Runs(None)  # type: ignore[arg-type]
    for candidate, errors in (known or {}).items():
        made.add(candidate, {name: (x, x) for name, x in errors.items()})
    return made


def answered(search: Callable[[], T], error: Error) -> T:
    """The result of a search, with each run that it asks for made as planted, of a quantity x."""
    while True:
        try:
            return search()
        except Missing as missing:
            for asked, candidate in missing.runs:
                x = error(candidate.options, candidate.step)
                whole = x if isinstance(x, tuple) else (x, x)
                asked.add(candidate, {} if whole[0] == inf else {"x": whole})


def recipe_search(
    known: Mapping[Candidate, Mapping[str, float]],
    margin: float,
    scale: Mapping[str, float] | None = None,
    *,
    candidates: Candidates | None = None,
    module: Any = recipe,
) -> recipe.Search:
    """A search for recipes, of which each second costs as many steps as it takes."""
    listed = candidates or Candidates([], [], 0.0, {})
    return module.Search(runs(known), listed, lambda c: 1 / c.step, margin, scale or {})
