"""Contacts with the shapes that a user has: on which recipes are searched, and measured beside.

Our points, planes and pairs are no user's: a recipe for a contact is searched on boxes and balls
wherever the scene is such a body, and started there as its user starts it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ....cases.case import Case
from ....engines.engine import Engine, Plain, Start
from ....engines.knobs import Value
from ..search.candidate import Candidate
from ..search.parallel_search import Asking, Known, Search, together
from ..task_results import Results
from ..tasks import Pair
from .criterion import Bar

Beside = Mapping[Candidate, Sequence[tuple[str, float, str]]]
"""By candidate, for each other shape its words, the worst error over its tolerance, and whose."""


def shapes(engine: Engine, case: Case, start: Start) -> Sequence[Value]:
    """What stands for the case's scene in a user's model; none where only our own model does."""
    return engine.shapes(case.scene, start) if isinstance(engine, Plain) else ()


def ours_alone(engine: Engine, case: Case) -> str:
    """How our model builds contacts, of a scene that has no other; empty: nothing touches."""
    return engine.own_contacts(case.scene) if isinstance(engine, Plain) else ""


def measured_beside(
    asked: Mapping[str, tuple[Pair, Sequence[Value], list[Candidate], Mapping[str, float]]],
    results: Results,
) -> dict[str, Beside]:
    """By key what the candidates do on the other shapes.

    asked: by key the pair, its shapes, the candidates, and the scale of its bar.
    """
    searches: dict[str, Search[list[tuple[float, str]]]] = {}
    for key, (pair, known_shapes, candidates, scale) in asked.items():
        for shape in known_shapes[1:]:
            known, other = Known(), replace(pair, shapes=shape.options)
            searches[f"{key} {shape.words}"] = Search(
                other, known, _worst(known, candidates, scale)
            )
    found = together("other shapes", searches, results) if searches else {}
    return {
        key: {
            candidate: [
                (shape.words, *found[f"{key} {shape.words}"][i]) for shape in known_shapes[1:]
            ]
            for i, candidate in enumerate(candidates)
        }
        for key, (_, known_shapes, candidates, _) in asked.items()
    }


def _worst(
    known: Known, candidates: list[Candidate], scale: Mapping[str, float]
) -> Asking[list[tuple[float, str]]]:
    yield candidates
    return [Bar(known, 1.0, scale).worst(candidate) for candidate in candidates]
