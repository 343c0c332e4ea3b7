"""What an adapter meets is said where it is declared: no field is without a meaning."""

import inspect
from dataclasses import dataclass, is_dataclass

import pytest
from given.otherwise import otherwise

from textmech.cases import scene
from textmech.cases.language.grammar.joint import KINDS
from textmech.cases.scene.forces.element import Force
from textmech.cases.scene.joint import FREEDOMS
from textmech.reports.show import nouns

ALL = [kind for kinds in nouns.PARTS.values() for kind in kinds]


@dataclass(frozen=True)
class Silent:
    """A noun of which one field says nothing.

    told: what the docstring says of it.
    """

    told: float
    bare: float
    mass: float  # of all of it, kg
    angle: float
    """Between both [rad]."""


@pytest.mark.slow
def test_every_field_has_a_meaning() -> None:
    bare = [(k.__name__, name) for k in ALL for name, *_, said in nouns.described(k) if not said]
    assert not bare


@pytest.mark.mutant("a field of a noun says nothing")
def test_a_field_that_says_nothing_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Silent, "__module__", "textmech.silent")
    monkeypatch.setattr(inspect, "getsource", lambda kind: SOURCE)
    found = {name: told for name, *told in nouns.described(Silent)}
    nouns._source.cache_clear()
    assert found == {
        "told": ["float", "", "what the docstring says of it."],
        "bare": ["float", "", ""],
        "mass": ["float", "kg", "of all of it, kg"],
        "angle": ["float", "rad", "Between both [rad]."],
    }


SOURCE = inspect.getsource(Silent)


def test_every_noun_of_a_scene_is_there() -> None:
    """But for what is no field of it: a frame, and what all forces, or all limits, share."""
    exported = {getattr(scene, name) for name in scene.__all__}
    shared = {scene.Frame, Force, scene.Limit}
    assert not {kind for kind in exported if is_dataclass(kind)} - set(ALL) - shared


@pytest.mark.slow
@pytest.mark.parametrize(
    "said",
    [
        "| `pin` | turn |",
        "| `slot` | shift, turn |",
        "| `hinge` | Lets the second part turn about an axis. |",
        "| SPACE | 0 to 2: m |",
        "| `stiffness` | `float` | N m/rad | c |",
        "| `static` | `Bounds` | N or N m | what holds at rest, N or N m |",
        "All stand in the plane, or all in space: `scene.frame is SPACE`",
        "| `touching` | One contact for every point that may touch",
        "| `pairs` | `Mapping[str, Pair]` |  | The contacts of two bodies",
        "`step` [s] too if the engine takes one",
        "neither the mean over a step nor what led to it",
        "| Joint | `gap` | m | constraint drift |",
        "| Contact | `tangent` | N | on the body, along `plane.along`: x, of the floor |",
        "| the scene | `kinetic` | J |  |",
        r"| `radius` | `float \| None` | m | of a disk or what else is round",
    ],
)
def test_what_an_author_asks_for_is_there(said: str) -> None:
    assert said in nouns.nouns()


def test_every_kind_of_joint_is_there() -> None:
    text = nouns.nouns()
    assert not [kind for kind in (*FREEDOMS, *KINDS[3]) if f"| `{kind}` |" not in text]


@pytest.mark.mutant("the page of nouns leaves out what a base class declares")
def test_what_a_base_declares_is_there() -> None:
    blind = otherwise(nouns, "reversed(kind.__mro__[:-1])", "(kind,)")
    assert [name for name, *_ in nouns.described(scene.Spring)][:3] == ["name", "a", "b"]
    assert blind.described(scene.Spring)[0][0] == "stiffness"
