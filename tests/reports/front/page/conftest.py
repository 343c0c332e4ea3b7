"""A small run with its page: two cases, one of them with a title that would be markup."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pandas as pd
import pytest
from given.scenes.swing import SWING

from textmech.cases.case import Case
from textmech.cases.model_case import ModelCase, of_model
from textmech.reports.compare.own_rows import Modelled, modelled
from textmech.reports.front.page.folder import folder
from textmech.reports.front.page.model_motion import model_motion
from textmech.reports.front.page.motions import motions
from textmech.reports.front.page.page import NAME, page
from textmech.reports.runs import suite
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_cases, choose_engines
from textmech.reports.runs.suite import Report
from textmech.reports.tables import write

ODD = "hostile? & <b>"  # a file may have any name
HOSTILE = "<script>window.struck = 1</script></script><b onload=x>& A bar that swings"
ADVICE = {
    "case": ["swing", "swing", ODD],
    "engine": ["mujoco", "pymunk", "mujoco"],
    "tolerance": ["as allowed", "1e-3", "as allowed"],
    "margin": ["2", "2", "2"],
    "want": ["both", "cheapest", ""],
    "recipe": ["RK4", "error_bias 0", ""],
    "settings": ["mujoco: {integrator: RK4}", "pymunk: {error_bias: 0.0}", ""],
    "step": ["0.008", "0.00063", ""],
    "cost": ["500", "1600", ""],
    "shipped_cost": ["500", "100", "500"],
    "ratio": ["1.2e-05", "0.3", ""],
    "quantity": ["rod.angle", "rod.angle", ""],
    "remains": ["", "", "<i>nothing cures it</i>"],
}
CAUSES = {
    "case": ["swing", "swing", ODD],
    "engine": ["pymunk", "pymunk", "pymunk"],
    "setting": ["shipped"] * 3,
    "quantity": ["rod.angle"] * 3,
    "error": ["0.1"] * 3,
    "allowed": ["0.01"] * 3,
    "cure": ["bias + step", "midpoint", "bias + step"],
    "options": ["", "", ""],
    "step": ["1e-3", "0.01", "1e-3"],
    "error_after": ["1e-4"] * 3,
    "cost": ["1000", "200", "1000"],
    "law": ["h²", "", ""],
}
VERSIONS = {
    "case": ["swing"] * 3,
    "engine": ["mujoco"] * 3,
    "version": ["3.10.0", "3.9.0", "4.0.0"],
    "setting": ["shipped"] * 3,
    "quantity": ["rod.angle"] * 3,
    "error": ["0.1", "0.1", "0.001"],
    "allowed": ["0.01"] * 3,
    "verdict": ["beyond", "beyond", "agrees"],
    "moved": ["", "", "yes"],
}


HOSTILE_MODEL = '"><img src=x onerror=window.struck=1><script>window.struck=2</script>'
ARM = """
<mujoco>
  <option timestep="0.01" {option}/>
  <worldbody>
    <geom type="plane" size="5 5 .1"/>
    <body name="&lt;script&gt;window.struck=3&lt;/script&gt;" pos="0 0 1">
      <joint name="&lt;b onload=x&gt;" axis="0 1 0"/>
      <geom type="box" size=".2 .05 .05" pos=".2 0 0"/>
      <body name="__proto__" pos=".4 0 0">
        <joint name="__proto__" axis="0 1 0"/>
        <inertial pos=".1 0 0" mass="1" diaginertia=".01 .02 .015"/>
        <body pos=".3 0 0"><joint type="ball"/><geom size=".05"/></body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
STILL = "<mujoco><worldbody><geom size='1'/></worldbody></mujoco>"
LATE = "later a disturbance of 1e-09 exceeds a tolerance"


def arm(name: str, text: str = "", **fields: Any) -> ModelCase:
    """A case of a model that is given as text, shorter than a second."""
    case = of_model("", name, name, text or ARM.format(option=""))
    return replace(case, duration=0.4, samples=6, **fields)


@pytest.fixture(scope="session")
def shipped() -> list[Case]:
    """All shipped cases."""
    return choose_cases([])


@pytest.fixture(scope="package")
def made(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """The report, its folder with advice, causes and versions beside it, its motions, the page."""
    place = tmp_path_factory.mktemp("page")
    (place / "swing.yaml").write_text(SWING, encoding="utf-8")
    hostile = SWING.replace("A bar that swings", f'"{HOSTILE}"').replace("rod", "arm")
    (place / f"{ODD}.yaml").write_text(hostile, encoding="utf-8")
    cases = choose_cases([str(place / "swing.yaml"), str(place / f"{ODD}.yaml")])
    report = suite.measure(Request(cases, choose_engines([], [])))
    write.write(write.tables(report, cases), place)
    told = {"advice.csv": ADVICE, "causes.csv": CAUSES, "versions.csv": VERSIONS}
    beside = {name: pd.DataFrame(columns) for name, columns in told.items()}
    found, moved = replace(folder(place), beside=beside), motions(report)
    text = page(found, cases, moved)
    (place / "index.html").write_text(text, encoding="utf-8")
    return SimpleNamespace(
        odd=ODD, place=place, cases=cases, report=report, folder=found, motions=moved, text=text
    )


@pytest.fixture(scope="session")
def whole(report: Report, shipped: list[Case], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Returns the file of a page of the committed rows and this session's motions."""
    file = tmp_path_factory.mktemp("whole") / NAME
    text = page(folder(write.HERE), shipped, motions(report), report.models)
    file.write_text(text, encoding="utf-8")
    return file


@pytest.fixture(scope="package")
def arms() -> SimpleNamespace:
    """Models of names that attack, one without a limit, and one in which nothing moves."""
    no_limit = ARM.format(option='integrator="discrete"')
    cases = [
        arm(HOSTILE_MODEL, title=HOSTILE_MODEL), arm("constructor"), arm("work"),
        arm("sub/arm v1.2"), arm("stepped", no_limit), arm("still", STILL),
    ]  # fmt: skip
    models = [modelled(case) for case in cases]
    first = models[0]
    assert first.steps is not None
    models[0] = replace(first, steps=replace(first.steps, until=0.2, late=LATE))
    return SimpleNamespace(models=models, motions=motions_of(models))


def motions_of(models: list[Modelled]) -> dict[str, Any]:
    return {m.case.name: motion for m in models if (motion := model_motion(m))}


def report_of(models: list[Modelled]) -> Report:
    """The report of models alone."""
    return Report(
        comparisons=[row for model in models for row in model.comparisons],
        rungs=[row for model in models for row in model.rungs],
        steps=[row for model in models for row in model.step_errors],
        certificates=[row for model in models for row in model.certificates],
        models=models,
    )


@pytest.fixture(scope="package")
def models_page(arms: SimpleNamespace, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of these models alone."""
    place = tmp_path_factory.mktemp("models")
    write.write(write.tables(report_of(arms.models), []), place)
    text = page(folder(place), [], arms.motions, arms.models)
    (place / "index.html").write_text(text, encoding="utf-8")
    return place / "index.html"
