"""Users' models on the page and on paper: drawn as they move, judged as far as they can be."""

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given.command import textmech
from given.otherwise import otherwise
from matplotlib.figure import Figure

from textmech.engines.own_model.drawing import states
from textmech.engines.own_model.opened import opened
from textmech.reports.compare.own_rows import Modelled, modelled
from textmech.reports.front.interface import run
from textmech.reports.front.page import model_motion as drawing
from textmech.reports.front.page import models as section
from textmech.reports.front.page.folder import of_cases
from textmech.reports.front.page.model_motion import model_motion
from textmech.reports.front.page.motion_frames import motion_frames
from textmech.reports.front.page.notebook import drawn
from textmech.reports.front.page.page import page
from textmech.reports.front.page.picture import picture
from textmech.reports.front.page.poses import read

from .conftest import ARM, HOSTILE_MODEL, LATE, arm, report_of
from .test_page import Parsed, data


def test_no_name_in_a_model_is_markup(models_page: Path) -> None:
    text = models_page.read_text(encoding="utf-8")
    parsed = Parsed(text)
    assert (parsed.wrong, parsed.open) == ([], [])
    assert "img" not in parsed.names
    assert parsed.names.count("script") == 3
    assert "<b onload" not in text


def test_each_model_has_a_section_that_its_row_leads_to(models_page: Path) -> None:
    """Whatever it is called: as a part of the page, or as a place in a folder."""
    parsed = Parsed(models_page.read_text(encoding="utf-8"))
    assert len(parsed.ids) == len(set(parsed.ids))
    assert {"case work", "sub/arm v1.2", "constructor", HOSTILE_MODEL, "still"} <= set(parsed.ids)
    assert {"#case%20work", "#sub%2Farm%20v1.2"} <= set(parsed.links)


def test_what_is_not_judged_is_said(models_page: Path, arms: SimpleNamespace) -> None:
    text = models_page.read_text(encoding="utf-8")
    assert f"judged until 0.2 s: {LATE.replace('-09', '-9')}" in text
    assert "no limit: the integrator `discrete` has the step in its law" in text
    assert "nothing moves" in text
    assert set(data(text, "motions")) == set(arms.motions)
    assert set(arms.motions) == {HOSTILE_MODEL, "constructor", "work", "sub/arm v1.2"}


def test_of_models_nothing_is_said_of_the_textbook_and_of_one_as_of_one(
    models_page: Path, arms: SimpleNamespace
) -> None:
    text = models_page.read_text(encoding="utf-8")
    assert "6 models in mujoco" in text
    assert "Each at its own setting, all is kept by 0 of 6 models." in text
    assert 'id="heat"' not in text
    lines = report_of(arms.models).lines
    assert section.result(lines[-1:]) == "still: nothing moves."
    said = section.result(lines[1:2])
    assert re.match(
        r"constructor: .* of what is allowed at its own setting; all is kept from", said
    )


def test_rows_of_models_count_in_no_share_of_cases(
    made: SimpleNamespace, arms: SimpleNamespace
) -> None:
    of_models = report_of(arms.models)
    both = replace(
        made.folder,
        comparisons=[*made.folder.comparisons, *of_models.comparisons],
        certificates=[*made.folder.certificates, *of_models.certificates],
        rungs=[*made.folder.rungs, *of_models.rungs],
        steps=[*made.folder.steps, *of_models.steps],
        models=of_models.lines,
    )
    assert of_cases(both) == made.folder
    text = page(both, made.cases, made.motions | arms.motions, arms.models)
    assert "2 cases and 6 models" in text
    parts = ("overview", "heat", "work", "trust")
    for part in parts:
        alone, beside = (
            t.partition(f'id="{part}"')[2].partition("<h2>")[2] for t in (made.text, text)
        )
        assert alone.partition("</details>")[0] == beside.partition("</details>")[0], part
    assert made.text.partition('id="result">')[2].partition("<")[0] in text
    assert data(text, "rows")["work"] == data(made.text, "rows")["work"]


# What is drawn of a model is what was computed.


def ends(model: Modelled, module: Any = drawing) -> float:
    """By how much [m, 1] poses that are drawn differ from the computed ones where a motion ends."""
    steps, motion = model.steps, module.model_motion(model)
    assert steps is not None
    own, last = opened(model.case).own, steps.limit.times[-1:]
    ways = {"": steps.limit.y} | {
        f"mujoco.{each.setting.name}.native": each.y
        for each in steps.settings
        if each.y is not None
    }
    worst = 0.0
    for way, y in ways.items():
        if way in motion["covered"]:
            continue
        shown = read(motion["ghosts"][way] if way else motion).at(last)
        for body, rows in states(own, y[-1:]).items():
            if body in shown:
                sign = np.sign(shown[body][0, 3:] @ rows[0, 3:7])
                off = shown[body][0] * ([1] * 3 + [sign] * 4) - rows[0, :7]
                worst = max(worst, float(np.abs(off).max()))
    return worst


@pytest.mark.mutant("every setting of a model is drawn stepped by RK4")
def test_poses_are_those_of_the_limit_and_of_each_setting(arms: SimpleNamespace) -> None:
    model = arms.models[1]
    assert ends(model) < 2e-4
    was = "stepped_states(own, each, setting.options, "
    wrong = otherwise(drawing, was, "stepped_states(own, each, {'integrator': 'RK4'}, ")
    assert ends(model, wrong) > 2e-3


def test_steps_that_would_need_too_many_poses_are_drawn_at_their_samples(
    arms: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    model = arms.models[1]
    monkeypatch.setattr(drawing, "MOST", 0)
    motion = model_motion(model)
    assert motion is not None
    assert motion["ghosts"]
    for ghost in motion["ghosts"].values():
        assert ghost["held"]
        assert read(ghost).times == pytest.approx(model.limit.times, abs=1e-5)


def off(model: Modelled, module: Any = drawing) -> float:
    """By how much of itself the largest error of a curve differs from that of its row."""
    curves = module.model_motion(model)["curves"]["quantities"]
    worst = 0.0
    for row in model.comparisons:
        curve = curves[row.quantity]["off"][f"mujoco.{row.setting}.native"]["curve"]
        if row.error:
            worst = max(worst, abs(float(np.abs(curve).max()) / row.error - 1))
    return worst


@pytest.mark.mutant("errors of a model by their first component")
def test_curves_are_as_far_off_as_their_rows_say(arms: SimpleNamespace) -> None:
    model = arms.models[1]
    assert off(model) < 0.01
    assert off(model, otherwise(drawing, "else sizes(rows)", "else rows[:, 0]")) > 0.02


def test_a_hinge_has_its_angle_and_a_ball_none(arms: SimpleNamespace) -> None:
    model = arms.models[1]
    curves = arms.motions["constructor"]["curves"]["quantities"]
    angle = curves["__proto__.angle"]["reference"]
    assert angle == pytest.approx(model.steps.limit.q[:, 1], abs=2e-4)
    assert not any(curves["joint 2.turn"]["reference"])


def test_of_the_ground_only_what_is_near_is_drawn() -> None:
    hall = '<geom type="box" size="90 90 9"/><geom type="box" size=".1 .1 .1"/><body name="&lt;'
    text = ARM.format(option="").replace('<body name="&lt;', hall, 1)
    motion = model_motion(modelled(arm("hall", text, contacts=False), others=()))
    assert motion is not None
    assert len(motion["sketch"]["bodies"]["world"]["lines"]) == 6  # of the small box
    assert motion["size"] < 2.0


# On paper and in Python.


def paper(model: Modelled, motion: Any) -> Iterator[Any]:
    rows = model.comparisons, model.rungs, model.step_errors
    yield from picture(model.case.name, "__proto__.angle", motion, *rows).axes


def test_a_picture_says_the_worst_of_each_setting_and_where_nothing_is_judged(
    arms: SimpleNamespace,
) -> None:
    late, whole = ([*paper(m, arms.motions[m.case.name])] for m in arms.models[:2])
    lines = late[0].get_title(loc="left").splitlines()
    settings = [each.setting.name for each in arms.models[0].steps.settings]
    assert [line.partition(":")[0] for line in lines] == settings
    assert all("of what is allowed" in line for line in lines)
    assert late[2].get_title(loc="right") == "later than 0.2 s nothing is judged"
    assert whole[2].get_title(loc="right") == ""
    assert "limit" in late[1].get_legend_handles_labels()[1]


def test_in_python_a_model_is_plotted_against_its_limit(arms: SimpleNamespace) -> None:
    frames = motion_frames(report_of(arms.models[:2]))
    figures: dict[str, Figure] = {}
    for name, frame in frames.items():
        by: Any = ["engine", "setting", "realised"]
        motions: Any = {way: f.droplevel(by) for way, f in frame.groupby(level=by)}
        figures[name] = drawn(name, motions, frame.attrs["units"], ["__proto__.angle"], {})
    axes, others = (figure.axes[0] for figure in figures.values())
    assert axes.get_legend_handles_labels()[1][0] == "limit"
    assert axes.get_title(loc="right") == "later than 0.2 s nothing is judged"
    assert others.get_title(loc="right") == ""


@pytest.mark.slow
def test_a_models_result_shows_itself_in_a_notebook() -> None:
    found = run("stiff_wrist")
    html = found._repr_html_()
    assert "wrist.angle" in html
    assert "data:image/png" in html
    assert found.plot(quantities="elbow.angle").axes[0].get_ylabel() == "elbow.angle [rad]"


@pytest.mark.slow
def test_a_model_is_plotted_by_the_command(tmp_path: Path) -> None:
    (tmp_path / "robot.xml").write_text(ARM.format(option=""), encoding="utf-8")
    for words in (["robot.xml"], ["acrobot", "--quantity", "elbow.angle"]):
        done = textmech("plot", *words, "-o", "arm.svg", "--overwrite", folder=tmp_path)
        assert done.returncode == 0, done.stderr
        assert "worst" not in done.stderr
        assert b"own: " in (tmp_path / "arm.svg").read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["."], ". is a folder of models; plot one of: other, robot"),
        (["other.xml"], "other: no limit: the integrator `discrete` has the step in its law"),
        (["robot.xml", "--quantity", "elbow"], "no such quantity in this case: elbow"),
        (["robot.xml", "--engine", "pymunk"], "is a model, which MuJoCo alone reads"),
    ],
)
def test_what_cannot_be_plotted_of_models_is_told(
    tmp_path: Path, words: list[str], said: str
) -> None:
    (tmp_path / "robot.xml").write_text(ARM.format(option=""), encoding="utf-8")
    other = ARM.format(option='integrator="discrete"')
    (tmp_path / "other.xml").write_text(other, encoding="utf-8")
    done = textmech("plot", *words, "-o", "x.png", folder=tmp_path)
    assert done.returncode == 2
    assert said in done.stderr
    assert not (tmp_path / "x.png").exists()
