"""What is the same for every engine that is installed: plans, headings, entry points."""

import ast
import pickle
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from planning import planned

from textmech import engines
from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.engines.engine import Engine, Plan, Refusal
from textmech.reports.trial.start import assembled
from textmech.reports.trial.trial import NOTHING_OF_ITS_OWN, ways

CASES = [
    case
    for path in sorted((Path(__file__).parents[2] / "cases").glob("*.yaml"))
    for case in load(path)
]
ENGINES = [
    engines.make(name, setting)
    for name in ("mujoco", "pymunk")
    for setting in engines.settings(name)
]
HOSTILE = 'a\nimport os\r--> <b/> <!-- --- \x00 \x1b[31m  \x85 \'""" end -'


def words(engine: Engine) -> str:
    return f"{engine.name}.{engine.setting}"


@pytest.mark.parametrize("engine", ENGINES, ids=words)
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_plan_crosses_into_a_process(case: Case, engine: Engine) -> None:
    for plan in ways(engine, case.scene, assembled(case)):
        assert isinstance(plan, Plan)
        other = pickle.loads(pickle.dumps(plan))
        for each in (plan, plan.held_at(2e-3)):
            assert all(choice.because for choice in each.choices(1e-3))
        assert other.choices(1e-3) == plan.choices(1e-3)
        assert other.protocol(1e-3) == plan.protocol(1e-3)
        assert (other.exponents, other.withheld) == (plan.exponents, plan.withheld)


def test_what_is_held_stays_and_what_follows_goes() -> None:
    case = next(case for case in CASES if case.name == "four_bar")
    plan = planned(engines.make("mujoco", "tuned"), case.scene, assembled(case))
    held = plan.held_at(8e-4)
    assert plan.following == plan.exponents != held.exponents == plan.held
    assert held.choices(1e-4) == plan.choices(8e-4) != plan.choices(1e-4)
    assert held.held_at(2e-4).choices(1e-4) == plan.choices(2e-4)


def test_a_refusal_stands_where_nothing_is_native() -> None:
    case = CASES[0]
    start = assembled(case)

    class Law:
        """An engine that is told everything."""

        def plans(self, scene: object, start: object) -> list[Plan]:
            return [Plan("law", (1, 2))]

    found = ways(Law(), case.scene, start)  # type: ignore[arg-type]
    assert found == (Refusal("native", NOTHING_OF_ITS_OWN), Plan("law", (1, 2)))


@pytest.mark.parametrize("setting", ["shipped", "tuned"])
def test_a_title_is_text_in_an_engines_file(setting: str) -> None:
    case = next(case for case in CASES if case.name == "four_bar")
    start = assembled(case)
    texts: dict[str, list[str]] = {}
    for name in ("mujoco", "pymunk"):
        engine = engines.make(name, setting)
        plan = planned(engine, case.scene, start)
        titles = ("", HOSTILE)
        texts[name] = [engine.script(case.scene, start, 1e-3, plan, title=t) for t in titles]
    plain, hostile = (ET.canonicalize(text) for text in texts["mujoco"])
    assert plain == hostile  # comments are left out
    plain, hostile = (ast.dump(ast.parse(text)) for text in texts["pymunk"])
    assert plain == hostile
    assert all("import os" in text[1] for text in texts.values())


def test_engines_are_found_sorted_and_know_their_settings() -> None:
    assert list(engines.names()) == sorted(engines.names())
    assert engines.Known()["mujoco"] == ("shipped", "tuned")
    with pytest.raises(KeyError):
        engines.make("nobody", "tuned")
