"""No answer depends on the order in which a file names its parts: the same motion, the same events.

A shipped case of each file is solved once more with all its parts in the opposite order, from which
the mechanism numbers its coordinates, its constraint rows and the elements that may change.
"""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import pytest
from given import resampled, scenes

from textmech.cases.case import Case
from textmech.cases.scene import Scene
from textmech.reference.solve import solve

PARTS = ("bodies", "joints", "contacts", "forces", "constraints", "pairs", "drives")


def backward(scene: Scene) -> Scene:
    """The same scene with every part that has several elements in the opposite order."""
    turned: dict[str, Any] = {}
    for part in (f.name for f in fields(scene)):
        elements = getattr(scene, part)
        if part in PARTS and isinstance(elements, Mapping):
            turned[part] = {name: elements[name] for name in reversed([*elements])}
    return replace(scene, **turned)


def other(case: Case) -> Case:
    """The case with its scene turned around, which the hand-written system does not read."""
    return replace(case, scene=backward(case.scene))


def several(case: Case) -> bool:
    """Whether the scene has any two elements of one kind."""
    return any(len(getattr(case.scene, part)) > 1 for part in PARTS)


NAMES = [name for name in scenes.ONE_OF_EACH_FILE if several(scenes.SHIPPED[name])]


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_other_way_around_it_moves_the_same(name: str) -> None:
    case, known = scenes.SHIPPED[name], scenes.solved(name)
    turned = other(case)
    assert list(resampled.differences(case, known, turned, solve(turned))) == []


@pytest.mark.slow
@pytest.mark.mutant("a mass goes with the place in the file and not with its body")
def test_what_goes_by_its_place_is_seen() -> None:
    case, known = scenes.SHIPPED["cradle.alike"], scenes.solved("cradle.alike")
    bodies = case.scene.bodies
    heavy = {
        name: replace(body, mass=(i + 1) * body.mass)
        for i, (name, body) in enumerate(bodies.items())
    }
    assert len(bodies) > 1
    turned = replace(case, scene=replace(case.scene, bodies=heavy))
    assert list(resampled.differences(case, known, turned, solve(turned))) != []
