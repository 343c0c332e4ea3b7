"""Whether an adapter is right: a planted mistake is seen at its grade, and called by its name."""

import pytest
from given.adapters.faulty import Faulty
from given.adapters.mistaken import Mistaken

from textmech import engines
from textmech.engines.engine import Claims, Engine, Paced, Tunable, lacking
from textmech.reports.compare.adapter_check import GRADES, LOST, Attempt, Mark, marked, members
from textmech.reports.runs.selection import choose_cases

BY_NAME = {grade.name: grade for grade in GRADES}


def mark(grade: str, engine: Engine) -> Mark:
    (case,) = choose_cases([BY_NAME[grade].case], known=None)
    return marked(Attempt(BY_NAME[grade], case, engine))


@pytest.mark.slow
@pytest.mark.mutant("an adapter's mistake: {mistake}")
@pytest.mark.parametrize(
    ("mistake", "grade", "said"),
    [
        ("y down", "pendulum", "y points down"),
        ("y and vy down", "pendulum", "y and vy have the opposite sign"),
        ("clockwise", "pendulum", "angle and omega are clockwise"),
        ("omega clockwise", "chain", None),
        ("degrees", "pendulum", "angle and omega are in degrees"),
        ("degrees a second", "torsion and motor", None),
        ("wound", "sliding, then rolling", "the angle is wound: whole turns are to be counted"),
        ("ends", "free chain", None),
        ("scalar last", "space: free", "quaternions are x, y, z, w: w comes first"),
        ("omega in ground axes", "space: free", "ω is in ground axes: body axes are asked for"),
        ("gravity up", "pendulum", None),
        ("no gravity", "free chain", None),
        ("pushed back", "push", None),
        ("no forces", "spring", None),
        ("inertia about an end", "pendulum", None),
        ("no friction", "sliding, then rolling", None),
        ("bounces for ever", "impact", None),
        ("forces", "pendulum", "forces have the opposite sign: what the first part exerts on the"),
        ("at rest", "loop with a slide", None),
        ("energy twice", "free chain", "energy.kinetic: it is twice what it should be"),
        ("inertia about the pin", "pendulum", "bar.inertia: it is about bar.start, not about the"),
        ("grams", "falls", "ball.mass: it is in units of a thousandth"),
    ],
)
def test_a_mistake_is_seen_and_one_of_the_readout_has_a_name(
    mistake: str, grade: str, said: str | None
) -> None:
    found = mark(grade, Mistaken(mistake, "pymunk" if mistake == "bounces for ever" else "mujoco"))
    assert found.outcome == "wrong", found
    assert len(found.likely) == (0 if said is None else 1), found
    assert said is None or found.likely[0].startswith(said)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mistake", "said"),
    [("late", "all is one step late"), ("velocities late", "velocities are half a step late")],
)
def test_what_is_late_works_and_is_told(mistake: str, said: str) -> None:
    found = mark("pendulum", Mistaken(mistake))
    assert found.outcome == "works"
    assert found.likely[0] == said


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mistake", "said"),
    [
        ("nan", "states of bar are not finite"),
        ("no forces told", "hinge.fx, hinge.fy is asked for, is not withheld, and is not given"),
        ("short record", "the record has"),
        ("lambda", "its plan cannot cross into another process"),
    ],
)
def test_what_is_no_answer_is_said(mistake: str, said: str) -> None:
    found = mark("pendulum", Mistaken(mistake))
    assert found.outcome == "wrong"
    assert found.what.startswith(said)


@pytest.mark.slow
@pytest.mark.parametrize("grade", [grade.name for grade in GRADES])
def test_without_a_mistake_all_works(grade: str) -> None:
    """But that this adapter offers no answers about states."""
    found = mark(grade, Mistaken())
    assert found.outcome == ("refused" if grade.startswith("states") else "works"), found
    assert not found.likely


@pytest.mark.slow
def test_a_shipped_engine_passes_or_refuses() -> None:
    engine = engines.make("pymunk", "tuned")
    assert mark("falls", engine).outcome == "works"
    assert mark("states", engine).what.endswith("but pymunk's kinetic_energy is m v² + J ω²")
    assert mark("space: free", engine).what.startswith("engine: pymunk moves bodies in a plane")


def test_an_answer_of_another_shape_is_said() -> None:
    found = mark("falls", Faulty(answer="13 columns", read="no number"))
    assert found.what.startswith("measure reads no number back")
    found = mark("falls", Faulty(planned="no ways"))
    assert found.what.startswith("plans is empty")


def test_members_that_are_missing_are_named() -> None:
    told = {m.grade: m for m in members(Faulty())}
    assert told["protocol"].outcome == "works"
    assert told["Tunable"].outcome == "not there"
    assert told["Tunable"].what.startswith("no steps, knobs, recipe, cost, snippet: `textmech adv")
    assert not any(m.fails for m in told.values())
    assert [p.__name__ for p in LOST] == [*told][1:]
    (first, second, *_) = members(object())  # type: ignore[arg-type]
    assert first.fails
    assert first.what == "it has no name, setting, version, own_step, plans, measure, run"
    assert second == Mark("script", "", "not there", "`textmech show` has nothing to show")


def test_nothing_is_lacking_in_an_engine_of_ours() -> None:
    for name in ("mujoco", "pymunk"):
        engine = engines.make(name, "tuned")
        assert not [p for p in (Engine, Tunable, Claims, Paced) if lacking(engine, p)]
    assert lacking(object(), Paced) == ("pace",)
    assert lacking(object(), Engine) == (
        "name", "setting", "version", "own_step", "plans", "measure", "run", "script",
    )  # fmt: skip
