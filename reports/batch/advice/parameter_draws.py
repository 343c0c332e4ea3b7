"""Does a recipe hold for other numbers? The same case with its parameters drawn anew, and again."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ....cases.case import Case
from ....cases.language.document import read
from ....cases.load import load
from ....cases.mistake import CaseError
from ....cases.trajectory import Trajectory
from ....reference.solve import Solution
from ...system.temporary_folder import temporary_folder
from ..search.candidate import Candidate
from ..search.errors import Run, errors
from ..search.solving import solved
from ..task_results import Results
from ..tasks import Pair
from .criterion import Bar

DRAWS = 6
APART = 0.1  # of each parameter: how far a draw may be from it


@dataclass(frozen=True)
class Held:
    """In how many draws the case's tolerances were kept, and of how many that were the same case.

    none: how many draws were no case, as a loop that does not close. other: how many went through
    other phases. Neither tells anything of a recipe.
    """

    held: int
    tried: int
    none: int = 0
    other: int = 0

    def __str__(self) -> str:
        no_case = "had no reference (as a loop that does not close)"
        another = "passed other phases (more or fewer impacts, stops or slips)"
        left_out = [f"{n} {what}" for n, what in ((self.none, no_case), (self.other, another)) if n]
        told = f"holds in {self.held} of {self.tried} draws of its parameters ± {APART:.0%}"
        return "; ".join([told, *left_out])


def tried_in_draws(
    pair: Pair, candidate: Candidate, scale: Mapping[str, float], results: Results
) -> Held:
    """The candidate in every draw, each before a reference of its own; without any margin."""
    cases = [case for seed in range(DRAWS) if (case := drawn(pair.case, seed)) is not None]
    keys = [results.keys.solution(case) for case in cases]
    references = results.of("draws", solved, dict(zip(keys, cases, strict=True)))
    moved = [
        (case, key, found)
        for case, key in zip(cases, keys, strict=True)
        if isinstance(found := references[key], Solution) and found.holds
    ]
    phases = _phases(pair.reference())
    same = [
        replace(pair, case=case, key=key)
        for case, key, found in moved
        if _phases(found.trajectory) == phases
    ]
    runs = {pair.key: Run(pair, candidate) for pair in same}
    found = results.anew("draws", errors, runs) if runs else {}
    kept = [Bar({candidate: one}, 1.0, scale).holds(candidate) for one in found.values()]
    return Held(sum(kept), len(kept), DRAWS - len(moved), len(moved) - len(same))


def _phases(reference: Trajectory) -> int:
    """How often it switches."""
    return len(reference.switches)


def drawn(case: Case, seed: int) -> Case | None:
    """The case with every parameter up to a tenth larger or smaller; None where that is none.

    Those with a unit of their own stay: angles, most often, which shut a loop or make it slide.
    """
    file = Path(case.source.file)
    data = _varied(read(file).data, np.random.default_rng(seed))
    with temporary_folder("textmech-draw-") as folder:
        copy = folder / file.name
        copy.write_text(json.dumps(data), encoding="utf-8")  # JSON is YAML
        try:
            cases: Sequence[Case] = load(copy, long=case.long)
        except CaseError:
            return None
    found = next(other for other in cases if other.name == case.name)
    return replace(found, duration=case.duration, samples=case.samples)


def _varied(data: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The file's data with the parameters drawn anew, its own and those of each variant."""
    told = dict(data)
    if isinstance(parameters := told.get("parameters"), Mapping):
        told["parameters"] = {
            name: value * (1 + APART * rng.uniform(-1, 1))
            if isinstance(value, int | float) and not isinstance(value, bool)
            else value
            for name, value in parameters.items()
        }
    if isinstance(variants := told.get("variants"), Mapping):
        told["variants"] = {name: _varied(of or {}, rng) for name, of in variants.items()}
    return told
