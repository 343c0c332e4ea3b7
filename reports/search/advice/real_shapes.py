"""Contacts with the shapes that a user has: on which recipes are searched, and measured beside.

Our points, planes and pairs are no user's: a recipe for a contact is searched on boxes and balls
wherever the scene is such a body, and started there as its user starts it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ....cases.case import Case
from ....engines.engine import Engine, Plain, Shape, Start
from ...runs.task_results import Results
from ...runs.tasks import Pair
from ..causes.candidate import Candidate
from ..causes.parallel_search import Asking, Known, Search, together
from .criterion import Bar

Beside = Mapping[Candidate, Sequence[tuple[str, float, str]]]
"""By candidate, for each other shape its words, the worst error over its tolerance, and whose."""


def shapes(engine: Engine, case: Case, start: Start) -> Sequence[Shape]:
    """A user's own models of the case's scene; none where only our own model stands for it."""
    return engine.shapes(case.scene, start) if isinstance(engine, Plain) else ()


def ours_alone(engine: Engine, case: Case) -> str:
    """How our model builds contacts, of a scene that has no other; empty: nothing touches."""
    return engine.own_contacts(case.scene) if isinstance(engine, Plain) else ""


def worst_on_shapes(
    asked: Mapping[str, tuple[Sequence[Shape], Pair, list[Candidate], Mapping[str, float]]],
    results: Results,
) -> dict[str, dict[Candidate, float]]:
    """By key and candidate the worst error over its tolerance on shapes that it has to hold on.

    Only of keys that have others than the first.
    """
    others = {
        key: (pair, [shape for shape in known[1:] if shape.held], candidates, scale)
        for key, (known, pair, candidates, scale) in asked.items()
    }
    found = measured_beside({key: one for key, one in others.items() if one[1]}, results)
    return {
        key: {candidate: max(worst for _, worst, _ in rows) for candidate, rows in beside.items()}
        for key, beside in found.items()
    }


def measured_beside(
    asked: Mapping[str, tuple[Pair, Sequence[Shape], list[Candidate], Mapping[str, float]]],
    results: Results,
) -> dict[str, Beside]:
    """By key what the candidates do on other shapes.

    asked: by key the pair, those shapes, the candidates, and the scale of its bar.
    """
    searches: dict[str, Search[list[tuple[float, str]]]] = {}
    for key, (pair, others, candidates, scale) in asked.items():
        for shape in others:
            known, other = Known(), replace(pair, shapes=shape.options)
            searches[f"{key} {shape.words}"] = Search(
                other, known, _worst(known, candidates, scale)
            )
    found = together("other shapes", searches, results) if searches else {}
    return {
        key: {
            candidate: [(shape.words, *found[f"{key} {shape.words}"][i]) for shape in others]
            for i, candidate in enumerate(candidates)
        }
        for key, (_, others, candidates, _) in asked.items()
    }


def _worst(
    known: Known, candidates: list[Candidate], scale: Mapping[str, float]
) -> Asking[list[tuple[float, str]]]:
    yield candidates
    return [Bar(known, 1.0, scale).worst(candidate) for candidate in candidates]
