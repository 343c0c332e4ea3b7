"""A folder of users' models in one table: a row each, whatever one of them is."""

import csv
import json
import os
from dataclasses import replace
from pathlib import Path

import pytest
from given.command import textmech
from given.machines.random_models import public_models
from given.otherwise import otherwise

from textmech.cases.model_case import of_model
from textmech.reports.compare import own_rows
from textmech.reports.front.command import own_advice
from textmech.reports.runs.chosen_models import choose_models
from textmech.reports.runs.request import requested
from textmech.reports.runs.suite import measure
from textmech.reports.search.advice.own_model import OwnAdvice, Recipe, Tried
from textmech.reports.tables import write

SWING = """\
<mujoco><option timestep="{step}"/><worldbody><body><joint name="swing" axis="0 1 0"/>
<geom size=".1" pos="0.3 0 -1"/></body></worldbody></mujoco>"""
NAMES = ["coarse", "fine", "odd; rm -rf ~", "rests", "torn"]


@pytest.fixture
def models(tmp_path: Path) -> Path:
    folder = tmp_path / "models"
    folder.mkdir()
    texts = [SWING.format(step=0.01), SWING.format(step=1e-4), SWING.format(step=1e-4), "<mujoco/>",
             "<mujoco><worldbody>"]  # fmt: skip
    for name, text in zip(NAMES, texts, strict=True):
        (folder / f"{name}.xml").write_text(text, encoding="utf-8")
    return folder


def test_a_name_that_a_table_would_misread_stands_in_quotes(tmp_path: Path) -> None:
    """A spreadsheet computes what begins with =, and no file of text holds half a letter."""
    (tmp_path / "arms").mkdir()
    for name in (b"=1+1.xml", b"a\nb.xml", b"a\xff.xml", b"arms/=1+1.xml", "ärmchen.xml".encode()):
        Path(os.fsdecode(os.fsencode(tmp_path) + b"/" + name)).write_text("<mujoco/>")
    names = [case.name for case in choose_models([str(tmp_path)]).cases]
    assert sorted(names) == ["'=1+1'", "'a\\nb'", "'a\\udcff'", "arms/=1+1", "ärmchen"]


@pytest.mark.slow
def test_each_model_of_a_folder_has_a_row(models: Path, tmp_path: Path) -> None:
    asked = ("run", str(models), "--causes", "--out", str(tmp_path / "out"))
    done = textmech(*asked, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "out" / "models.csv").read_text(encoding="utf-8")
    rows = {row["case"]: row for row in csv.DictReader(text.splitlines())}
    assert sorted(rows) == NAMES
    assert rows["coarse"]["verdict"] == "beyond"
    assert 'integrator="' in rows["coarse"]["cure"] or 'timestep="' in rows["coarse"]["cure"]
    assert rows["fine"]["verdict"] == "agrees"
    assert rows["fine"]["cure"] == ""
    assert rows["rests"]["because"] == "nothing moves"
    assert "does not compile it" in rows["torn"]["because"]
    table = done.stdout[done.stdout.index("model  ") :].splitlines()
    assert [line.partition("  ")[0].rstrip() for line in table[1:6]] == NAMES
    assert table[0].split()[-2:] == ["cure", "and"]
    again = textmech(*asked, "--json", folder=tmp_path)  # over its own tables
    told = json.loads(again.stdout)["models"]
    assert [row["case"] for row in told] == NAMES
    assert told[0]["cure"] == rows["coarse"]["cure"]


@pytest.mark.slow
@pytest.mark.mutant("the mildest of a model's quantities is called its worst")
def test_the_worst_quantity_is_told(models: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chosen = choose_models([str(models / "coarse.xml")])
    report = measure(requested([], [], [], models=chosen.cases))
    (line,) = report.lines
    worst = max(row.ratio or 0.0 for row in report.comparisons if row.setting == "own")
    assert line.ratio == worst
    assert write.tables(report, [])["models.csv"].ratio.tolist() == [worst]
    body = (
        '<body pos="1 0 0"><joint name="still" axis="0 0 1"/><geom size=".1" pos="0 0 -1"/></body>'
    )
    two = (models / "coarse.xml").read_text(encoding="utf-8").replace("</world", f"{body}</world")
    (models / "coarse.xml").write_text(two, encoding="utf-8")
    report = measure(requested([], [], [], models=chosen.cases))
    assert report.lines[0].quantity == "swing.angle"
    wrong = otherwise(own_rows, "return max(rows", "return min(rows")
    assert wrong.line(report.models[0]).quantity == "still.angle"


@pytest.mark.mutant("the dearest cure is told")
def test_the_cure_is_the_one_that_costs_least(monkeypatch: pytest.MonkeyPatch) -> None:
    def recipe(change: str, cost: float, ratio: float) -> Recipe:
        return Recipe(change, "Euler", 0.01, cost, ratio, "swing.angle", 0.01, [])

    tried = Tried("", "", 1.0, recipe("", 1.0, 9.0), cures=[
        recipe("armature 0.001", 1.0, 2.0), recipe("RK4", 3.7, 0.1)
    ], cheapest=recipe("5 ms", 2.0, 0.4))  # fmt: skip
    advice = OwnAdvice("robot", "", 2.0, [tried])
    assert own_advice._cure(advice) == "5 ms ×2"
    wrong = otherwise(own_advice, "min(keep", "max(keep")
    assert wrong._cure(advice) == "RK4 ×3.7"
    assert own_advice._cure(OwnAdvice("robot", "", 2.0, (), "no limit")) == "no limit"


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("file", public_models(), ids=lambda file: file.stem)
def test_every_public_model_has_rows(file: Path) -> None:
    """Of its first instants; how far each goes stands in public_models.csv."""
    report = own_rows.modelled(
        replace(of_model(str(file), file.name, file.stem), duration=0.04), ()
    )
    joints = {row.quantity for row in report.comparisons}
    assert len(joints) == len(report.comparisons) > 0
    assert own_rows.line(report).verdict in ("agrees", "beyond", "refused")
