"""Which words of a command line are models: files, shipped names and variants, folders."""

from pathlib import Path

import pytest
from given.otherwise import otherwise

from textmech.cases.find import models
from textmech.cases.model_case import of_model
from textmech.reports.runs import chosen_models
from textmech.reports.runs import models as of_models
from textmech.reports.runs.chosen_models import choose_models

STILL = "<mujoco/>"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.mutant("a shipped model in place of a user's file of its name")
def test_a_users_file_is_no_shipped_model(here: Path) -> None:
    (here / "hopper.xml").write_text(STILL)
    wrong = otherwise(chosen_models, "own if own.exists() else known.get(name, own)",
                      "known.get(name, own)")  # fmt: skip
    chosen = {each: each.choose_models(["hopper.xml"]).cases for each in (chosen_models, wrong)}
    assert [case.path for case in chosen[chosen_models]] == [str(here / "hopper.xml")]
    assert [case.path for case in chosen[wrong]] != [str(here / "hopper.xml")]
    (case,) = choose_models(["hopper"]).cases
    assert case.path == str(models()["hopper"].with_suffix(".xml"))


def test_a_variant_that_there_is_not_is_told(here: Path) -> None:
    chosen = choose_models(["hopper.slow", "hopper.yaml", "nothing"])
    assert [mistake.what for mistake in chosen.mistakes] == [
        "no such variant; did you mean 'hopper'?"
    ] * 2
    assert [*chosen.others] == ["nothing"]


def test_what_is_hidden_in_a_folder_is_none_of_its_models(here: Path) -> None:
    for name in ("a.xml", ".venv/b.xml", "deep/c.urdf", "deep/.d.xml"):
        (here / name).parent.mkdir(exist_ok=True)
        (here / name).write_text("<robot/>" if name.endswith("urdf") else STILL)
    assert [case.name for case in choose_models(["."]).cases] == ["a", "deep/c"]


def test_a_line_that_moves_is_another_result() -> None:
    """The rows name lines; all numbers are the same."""
    arm = '<mujoco><worldbody><body>{}<joint name="a"/><geom size="1"/></body></worldbody></mujoco>'
    cases = [of_model("", "MJCF", "arm", arm.format(text)) for text in ("", "\n", "<!-- -->")]
    plain, moved, same = (of_models.digest(of_models.Task(case)) for case in cases)
    assert plain == same
    assert plain != moved
