"""A small run with its page: two cases, one of them with a title that would be markup."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pandas as pd
import pytest
from given.scenes.swing import SWING

from textmech.cases.case import Case
from textmech.reports.front.page.folder import folder
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
    text = page(folder(write.HERE), shipped, motions(report))
    file.write_text(text, encoding="utf-8")
    return file
