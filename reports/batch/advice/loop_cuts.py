"""Does a recipe hold wherever a loop is cut? The same scene with its joints in other orders.

Which joint of a loop an engine holds by a soft constraint, and which by its coordinates, hangs on
their order in some; a user's model has another one.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ....cases.scene import GROUND
from ..search.candidate import Candidate
from ..search.parallel_search import Asking, Known, Search, together
from ..task_results import Results
from ..tasks import Pair
from .criterion import Bar

MOST = 4  # other orders that are tried of a scene


def elsewhere(
    asked: Mapping[str, tuple[Pair, list[Candidate], Mapping[str, float]]], results: Results
) -> dict[str, dict[Candidate, float]]:
    """By key and candidate the worst error over its tolerance wherever the loops are cut.

    asked: by key the pair, its candidates, and the scale of its bar. Of a scene without loops
    nothing.
    """
    searches: dict[str, Search[list[float]]] = {}
    for key, (pair, candidates, scale) in asked.items():
        for number, other in enumerate(_others(pair)):
            known = Known()
            searches[f"{key} {number}"] = Search(other, known, _worst(known, candidates, scale))
    found = together("other cuts", searches, results) if searches else {}
    worst: dict[str, dict[Candidate, float]] = {}
    for key, (_, candidates, _) in asked.items():
        cut = [found[f"{key} {n}"] for n in range(MOST) if f"{key} {n}" in found]
        worst[key] = {c: max(each[i] for each in cut) for i, c in enumerate(candidates) if cut}
    return worst


def _worst(
    known: Known, candidates: list[Candidate], scale: Mapping[str, float]
) -> Asking[list[float]]:
    yield candidates
    return [Bar(known, 1.0, scale).worst(candidate)[0] for candidate in candidates]


def _others(pair: Pair) -> list[Pair]:
    """The pair with another joint the last, once for each of some, where joints close a loop."""
    scene: Any = pair.case.scene
    names = list(scene.joints)
    if not _loops(scene):
        return []
    turned = [names[k:] + names[:k] for k in range(1, len(names))][:MOST]
    scenes = [replace(scene, joints={name: scene.joints[name] for name in n}) for n in turned]
    return [replace(pair, case=replace(pair.case, scene=other)) for other in scenes]


def _loops(scene: Any) -> bool:
    """Whether some joint joins what is joined already."""
    whole = {name: {name} for name in (GROUND, *scene.bodies)}
    for joint in scene.joints.values():
        a, b = whole[joint.a.body], whole[joint.b.body]
        if a is b:
            return True
        a |= b
        whole.update(dict.fromkeys(b, a))
    return False
