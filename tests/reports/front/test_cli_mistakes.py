"""What a mistake, a disk, a terminal or a file name costs: its own file, and an exit code."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from given.command import NEW, textmech
from given.scenes.pendulum import pendulum

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.cases.mistake import CaseError
from textmech.reference import solve
from textmech.reference.certificate.agreement import Check
from textmech.reports.front.cli import command
from textmech.reports.front.command.options import Folder
from textmech.reports.front.show.console import shown
from textmech.reports.runs import selection
from textmech.reports.runs.selection import choose_cases
from textmech.reports.tables import write

# What a mistake in one file costs: its own file, and the exit code of the command.


@pytest.fixture
def files(tmp_path: Path) -> Path:
    (tmp_path / "good.yaml").write_text(pendulum(), encoding="utf-8")
    (tmp_path / "bad.yaml").write_text(pendulum(length=-1), encoding="utf-8")
    (tmp_path / "long.yaml").write_text(pendulum(step=1e-9), encoding="utf-8")
    (tmp_path / "still.yaml").write_text(pendulum(angle="-90 deg"), encoding="utf-8")
    return tmp_path


@pytest.mark.slow
def test_a_mistake_costs_its_own_file(files: Path) -> None:
    names = ("bad.yaml", "good.yaml", "long.yaml", "still.yaml")
    done = textmech("run", *names, "--engine", "mujoco.tuned", folder=files)
    assert done.returncode == 2
    assert "good in mujoco" in done.stdout
    assert "bad.yaml:4:" in done.stderr
    assert "long.yaml:10:1: step: " in done.stderr
    assert "still.yaml:11:9: allow.rod.angle: never moves" in done.stderr  # only solving tells
    assert "3 files have mistakes and are left out" in done.stderr


def test_without_a_sound_file_nothing_runs(files: Path) -> None:
    done = textmech("run", "bad.yaml", "long.yaml", folder=files)
    assert (done.returncode, done.stdout) == (2, "")
    assert "2 mistakes; nothing was written" in done.stderr or "3 mistakes" in done.stderr


@pytest.mark.slow
def test_check_says_what_would_take_for_ever_and_allow_long_goes_on(files: Path) -> None:
    done = textmech("check", "long.yaml", "good.yaml", folder=files)
    assert done.returncode == 2
    assert "good.yaml: 1 case, no mistakes" in done.stdout
    assert "--allow-long" in done.stderr
    assert textmech("check", "--allow-long", "long.yaml", folder=files).returncode == 0


@pytest.mark.slow
def test_check_says_no_mistakes_only_where_nothing_fails(
    files: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = solve.solve

    def uncertified(case: Case) -> solve.Solution:
        return replace(sound(case), checks=(Check("closed form", 2e-3, 1e-12),))

    monkeypatch.setattr(solve, "solve", uncertified)
    done = CliRunner().invoke(command, ["check", str(files / "good.yaml")])
    assert done.exit_code == 1
    assert "FAILS: the reference's closed form: 2.00e-03 is above 1.0e-12" in done.output
    assert "no mistakes" not in done.output


@pytest.mark.slow
@pytest.mark.mutant("a scene that is changed under its system, told by numbers alone")
def test_a_scene_that_is_changed_under_its_system_is_told_as_that(files: Path) -> None:
    text = shipped()["bar_pendulum"].read_text(encoding="utf-8")
    edited = files / "edited.yaml"
    edited.write_text(text.replace("{mass: m, length: l}", "{mass: 1.7, length: l}"), "utf-8")
    done = CliRunner().invoke(command, ["check", str(edited)])
    assert done.exit_code == 1
    what = "the system 'bar_pendulum' moves otherwise than this scene, or by other forces: leave"
    assert f"FAILS: {what}" in done.output
    (files / "sound.yaml").write_text(text, "utf-8")
    assert what not in CliRunner().invoke(command, ["check", str(files / "sound.yaml")]).output


@pytest.mark.slow
def test_what_a_system_has_no_mode_for_is_told_as_that(files: Path) -> None:
    """A ladder that starts at 7° lies on the floor before the end."""
    text = shipped()["sliding_ladder"].read_text(encoding="utf-8")
    (files / "low.yaml").write_text(text.replace("phi0: 70 deg", "phi0: 7 deg"), "utf-8")
    done = CliRunner().invoke(command, ["check", str(files / "low.yaml")])
    assert done.exit_code == 1
    what = "the system 'sliding_ladder' has no mode for what happens here: leave out `system`"
    assert f"FAILS: {what}" in done.output


@pytest.mark.parametrize(
    "name",
    ["#h.yaml", "=cmd().yaml", "@x.yaml", "a\nb.yaml", "esc\x1b[31m.yaml", "l" * 150 + ".yaml"],
)
def test_a_name_that_reports_cannot_carry_is_a_mistake(files: Path, name: str) -> None:
    (files / name).write_text(pendulum(), encoding="utf-8")
    done = textmech("check", name, folder=files)
    assert done.returncode == 2
    assert "name" in done.stderr
    assert "\x1b" not in done.stderr


def test_names_that_no_file_can_have(files: Path) -> None:
    for name in ("n" * 300 + ".yaml", b"\xff\xfe.yaml", ""):
        done = textmech("check", name, folder=files)
        assert done.returncode == 2, name


def test_a_name_that_is_not_utf8(files: Path) -> None:
    name = b"caf\xe9.yaml"
    with open(os.path.join(os.fsencode(files), name), "wb") as file:
        file.write(pendulum().encode())
    done = textmech("check", name, folder=files)
    assert done.returncode == 2
    assert "caf\\udce9" in done.stderr


def test_own_settings_that_are_given_as_a_case_are_one_mistake(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("mujoco: {integrator: RK4, step: 0.004}\n", encoding="utf-8")
    for word in ("run", "check"):
        done = textmech(word, file)
        assert done.returncode == 2
        assert done.stderr.startswith(f"{file}: holds an engine's options, and is no case: say")
        assert "1 mistake" in done.stderr


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("<!-- of a robot -->\n<mujoco model='m'>\n  <worldbody/>\n</mujoco>\n", "an MJCF model"),
        ("<?xml version='1.0'?>\n<robot name='r'><link name='a'/></robot>\n", "a URDF model"),
        ("<sdf version='1.6'>\n  <model name='m'/>\n</sdf>\n", "an SDF model"),
        ("<html>\n<p>unclosed", "XML with the root <html>"),
    ],
)
def test_a_model_of_an_engine_is_told_as_one(tmp_path: Path, text: str, told: str) -> None:
    """In Python; beside it nothing else is said of it."""
    file = tmp_path / "model.xml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(CaseError) as error:
        choose_cases([str(file)])
    (mistake,) = error.value.mistakes
    assert mistake.what.startswith(f"is {told}; ")
    read = told in ("an MJCF model", "a URDF model")
    assert ("read a model as it is" in mistake.what) == read


def test_causes_tells_a_model_as_one(tmp_path: Path) -> None:
    (tmp_path / "model.xml").write_text("<mujoco/>\n", encoding="utf-8")
    done = textmech("causes", "model.xml", folder=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("model.xml: is an MJCF model; ")


ROBOT = """\
<mujoco><worldbody><body><joint name="swing" axis="0 1 0"/><geom size=".1" pos="0 0 -1"/></body>
</worldbody></mujoco>"""


@pytest.mark.slow
def test_check_compares_a_models_equations(tmp_path: Path) -> None:
    (tmp_path / "robot.xml").write_text(ROBOT, encoding="utf-8")
    (tmp_path / "torn.xml").write_text("<mujoco><worldbody>", encoding="utf-8")
    done = textmech("check", "robot.xml", folder=tmp_path)
    assert done.returncode == 0
    first, *parts = done.stdout.splitlines()
    assert first.startswith("robot.xml: MuJoCo ")
    assert first.endswith("compiles it: 1 body, 1 joint, 1 degree of freedom; own step 2 ms, euler")
    assert all("from the textbook's, at 100 states" in part for part in parts)
    assert [part.split("  ")[1] for part in parts] == ["mass matrix", "bias", "passive forces"]
    both = textmech("check", "robot.xml", "torn.xml", "--json", folder=tmp_path)
    told = json.loads(both.stdout)
    assert both.returncode == told["exit_code"] == 2
    assert [part["holds"] for part in told["files"][0]["equations"]] == [True] * 5
    assert "does not compile it" in told["files"][1]["mistakes"][0]["what"]


@pytest.mark.slow
def test_run_compares_a_models_steps_with_their_limit(tmp_path: Path) -> None:
    (tmp_path / "robot.xml").write_text(ROBOT, encoding="utf-8")
    (tmp_path / "rests.xml").write_text("<mujoco/>", encoding="utf-8")
    done = textmech("run", "robot.xml", "rests.xml", folder=tmp_path)
    assert done.returncode == 0
    assert "its limit for h → 0 by DOP853, known to " in done.stdout
    (own,) = [line for line in done.stdout.splitlines() if line.startswith("  own ")]
    assert own.split()[:5] == ["own", "Euler", "2", "ms", "swing.angle"]
    assert "nothing moves" in done.stdout
    told = json.loads(textmech("run", "robot.xml", "--json", folder=tmp_path).stdout)
    assert {row["setting"] for row in told["tolerance"]} == {"own", "recommended", "rk4"}
    asked = textmech("run", "robot.xml", "--engine", "pymunk", folder=tmp_path)
    assert asked.returncode == 2
    assert "is a model, which MuJoCo alone reads" in asked.stderr


@pytest.mark.mutant("a model of an engine is read as YAML")
def test_a_model_that_is_read_as_a_case_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(selection, "xml_root", lambda file: "")
    file = tmp_path / "model.xml"
    file.write_text("<mujoco>\n  <worldbody/>\n</mujoco>\n", encoding="utf-8")
    with pytest.raises(CaseError, match="should be a map of keys") as error:
        choose_cases([str(file)])
    assert "MJCF" not in str(error.value)


def test_a_file_of_settings_without_its_ending_is_found_near(tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text("mujoco: {integrator: RK4}\n", encoding="utf-8")
    done = textmech("run", "four_bar", "--settings", "mine", folder=tmp_path)
    assert done.returncode == 2
    assert "mine: no such setting; did you mean 'mine.yaml'?" in done.stderr


def test_without_words_it_helps_and_blames_nobody() -> None:
    done = textmech()
    assert done.returncode == 2
    assert done.stderr.startswith("Usage: ")


@pytest.mark.slow
def test_list_finds_words_or_says_that_it_does_not() -> None:
    done = textmech("list", "wheel", "slope")
    assert "rimless_wheel\n" in done.stdout
    assert "four_bar" not in done.stdout
    done = textmech("list", "unicorn")
    assert (done.returncode, done.stdout) == (2, "")
    assert "no shipped case has unicorn in it" in done.stderr


@pytest.mark.parametrize("said", ["x", "-1", "0", "nan", ""])
@pytest.mark.parametrize(("of", "unit"), [("TIME", "seconds"), ("MEMORY", "GiB")])
def test_a_limit_that_is_none_is_said(
    said: str, of: str, unit: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(f"TEXTMECH_{of}_LIMIT", said)
    done = textmech("run", "bar_pendulum", "--engine", "mujoco.shipped")
    assert done.returncode == 2
    assert f"$TEXTMECH_{of}_LIMIT should be a number of {unit} above 0, is {said!r}" in done.stderr


def test_no_number_is_no_time_limit() -> None:
    done = textmech("run", "bar_pendulum", "--time-limit", "nan")
    assert done.returncode == 2
    assert "'--time-limit': nan is no finite number" in done.stderr


@pytest.mark.slow
def test_a_scene_that_is_not_its_systems_is_told_by_every_command(tmp_path: Path) -> None:
    """It has other events than its system, whose forces the mechanism's phases tell."""
    text = shipped()["stribeck_drive"].read_text(encoding="utf-8")
    file = tmp_path / "stribeck_drive.yaml"
    file.write_text(text.replace("rest_length: 5}", "rest_length: 10}"), encoding="utf-8")
    done = textmech("check", file)
    assert done.returncode == 1
    assert "the system 'stribeck_drive' moves otherwise than this scene" in done.stdout
    done = textmech("run", file, "--engine", "pymunk.shipped", "--out", tmp_path / "o", "--page")
    assert done.returncode == 1
    assert "the reference is not certified" in done.stdout + done.stderr
    assert ",inf," in (tmp_path / "o" / "reference.csv").read_text(encoding="utf-8")
    done = textmech("plot", file, "--engine", "pymunk.shipped", "-o", tmp_path / "a.png")
    assert "FAILS: the reference is not certified" in done.stdout
    done = textmech("advise", file, "--engine", "pymunk")
    assert "refused: the reference is not certified: the system" in done.stdout


# What a disk, a terminal or a file name can do to a run: a message, and never a traceback.

ONE = ("--engine", "mujoco.shipped")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("TEXTMECH_CACHE", os.devnull)
    (tmp_path / "cart.yaml").write_text(NEW, encoding="utf-8")
    return tmp_path


@pytest.fixture
def said(folder: Path) -> Callable[..., str]:
    """What the command says that ends with bad input."""

    def run(*words: str) -> str:
        done = textmech("run", *words, *ONE, folder=folder)
        assert done.returncode == 2
        return done.stderr

    return run


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--out", ""], "name is empty"),
        (["--keep", ""], "name is empty"),
        (["--keep", "/proc"], "cannot write to /proc"),
        (["--out", "cart.yaml"], "cart.yaml"),
        (["--out", "o", "--keep", "o"], "one folder"),
    ],
)
def test_a_place_that_takes_nothing_is_said_before_the_work(
    words: list[str], message: str, said: Callable[..., str]
) -> None:
    err = said("cart.yaml", *words)
    assert message in err
    assert "engines" not in err


def test_a_folder_that_is_tried_keeps_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where the signal comes while something is made there."""
    (tmp_path / "o").mkdir()
    make = os.mkdir

    def struck(*words: Any) -> None:
        make(*words)
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "mkdir", struck)
    with pytest.raises(KeyboardInterrupt):
        Folder().convert(str(tmp_path / "o"), None, None)
    assert list((tmp_path / "o").iterdir()) == []


@pytest.mark.slow
def test_a_folder_in_a_reports_place_costs_no_other_report(
    folder: Path, said: Callable[..., str]
) -> None:
    (folder / "o" / "events.csv").mkdir(parents=True)
    assert "events.csv: Is a directory; nothing was written" in said("cart.yaml", "--out", "o")
    assert [file.name for file in (folder / "o").iterdir()] == ["events.csv"]


def shell(script: str, folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """The run by a shell, which does something to its streams."""
    command = (
        f"{sys.executable} -m textmech.reports.front.cli run cart.yaml {' '.join(ONE)} --out o"
    )
    return subprocess.run(
        ["bash", "-o", "pipefail", "-c", script.replace("RUN", command)],
        capture_output=True,
        encoding="latin-1",
        cwd=folder,
        env=os.environ | variables,
        check=False,
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("script", "code"),
    [("RUN >&- 2>&- <&-", 0), ("RUN | head -c 1", 0), ("RUN >/dev/full", 2)],
)
def test_a_stream_that_takes_nothing_costs_no_report(script: str, code: int, folder: Path) -> None:
    done = shell(script, folder)
    assert done.returncode == code
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    assert {file.name for file in (folder / "o").iterdir()} == set(write.FILES)
    assert ("the reports are in o" in done.stderr) == (code == 2)


@pytest.mark.slow
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_an_output_that_is_cut_short_is_told_where_somebody_reads(
    unbuffered: str, folder: Path
) -> None:
    """A file may have 1 kB: of what is unbuffered Python drops the rest without a word."""
    listed = f"{sys.executable} -m textmech.reports.front.cli list --json > said"
    script = f"trap '' XFSZ; ulimit -f 1; {listed}"
    done = shell(script, folder, PYTHONUNBUFFERED=unbuffered)
    assert done.returncode == 2
    assert "File too large" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
def test_a_document_that_finds_no_room_names_its_reports(folder: Path) -> None:
    done = shell("RUN --json >/dev/full", folder, PYTHONUNBUFFERED="1")
    assert done.returncode == 2
    assert "Error: No space left on device; the reports are in o" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "file", "said"),
    [
        ("plot cart.yaml -o p.png", "p.png", "the picture is p.png"),
        ("advise cart.yaml --engine mujoco --out ad", "ad/advice.csv", ""),
    ],
)
def test_what_is_there_is_not_called_unwritten(
    words: str, file: str, said: str, folder: Path
) -> None:
    done = shell(f"{sys.executable} -m textmech.reports.front.cli {words} >/dev/full", folder)
    assert (folder / file).exists() == bool(said)
    assert done.returncode == 2
    assert (said or "nothing was written") in done.stderr


@pytest.mark.slow
def test_a_stream_without_the_letters_spells_them_out(folder: Path) -> None:
    done = shell("RUN", folder, PYTHONIOENCODING="cp437", PYTHONUTF8="0")
    assert done.returncode == 0, done.stderr
    assert r"worst, \xd7 allowed" in done.stdout  # ×


def test_control_characters_are_shown_and_not_sent() -> None:
    assert shown("a\033[31m\0\x9b\n\tb×") == r"a\x1b[31m\x00\x9b" + "\n\tb×"
