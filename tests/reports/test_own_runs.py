"""Own settings through the command, in the engines themselves."""

from pathlib import Path

import pandas as pd
import pytest
from click.testing import CliRunner, Result
from given.command import textmech
from given.lines import said
from given.swing import SWING

from textmech.reports.cli import command
from textmech.reports.data.row import Comparison
from textmech.reports.output import write

GAME = "mujoco: {step: 0.016666666666666666}\npymunk: {step: 0.016666666666666666}\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "swing.yaml").write_text(SWING, encoding="utf-8")
    (tmp_path / "game.yaml").write_text(GAME, encoding="utf-8")
    (tmp_path / "same.yaml").write_text("pymunk: {collision_slop: 0.1}\n", encoding="utf-8")
    return tmp_path


def run(folder: Path, *words: str) -> Result:
    return CliRunner().invoke(command, ["run", str(folder / "swing.yaml"), *words])


@pytest.mark.slow
def test_a_games_step_is_taken_by_both_engines_as_it_is(folder: Path) -> None:
    out, kept = folder / "o", folder / "k"
    settings = ("--settings", str(folder / "game.yaml"), "--settings", "shipped")
    done = run(folder, *settings, "--out", str(out), "--keep", str(kept))
    assert done.exit_code == 0, done.output
    rows = write.read(out / "tolerance.csv", Comparison)
    own = [row for row in rows if row.setting == "game" and row.quantity == "rod.angle"]
    assert [row.engine for row in own] == ["mujoco", "pymunk"]
    for row in own:
        assert row.step == pytest.approx(1 / 60, rel=1e-2)
        assert row.protocol.endswith("7 samples at whole steps of its own")
        # Euler's error of the angle is h/2 of its rate at most: no sample is half a step late.
        assert row.error is not None
        assert 0 < row.error < 0.05
    frame = pd.read_csv(kept / "swing.csv")
    both = frame[["t [s]", "rod.angle [rad] mujoco.game.native"]].dropna()
    assert both["t [s]"].tolist() == pytest.approx([k / 15 for k in range(7)])
    assert frame["rod.angle [rad] reference"].notna().sum() == 6  # at the case's own times


@pytest.mark.slow
def test_options_without_effect_are_told_below_the_table(folder: Path) -> None:
    settings = ("--settings", str(folder / "same.yaml"), "--settings", "shipped")
    done = run(folder, "--engine", "pymunk", *settings)
    assert done.exit_code == 0, done.output
    assert "swing: pymunk.same changes nothing: every number is shipped's" in done.output


@pytest.mark.slow
def test_an_approximation_that_the_book_does_not_make_is_told(folder: Path) -> None:
    done = textmech("run", folder / "swing.yaml", "--engine", "book")
    assert done.returncode == 2
    assert "no row for swing: the book approximates dry friction alone" in done.stderr
    beside = textmech("run", folder / "swing.yaml", "growing_force", "--engine", "book")
    assert beside.returncode == 0
    assert "no row for swing: the book" in beside.stderr


WORK = """\
title: A mass on a stiff spring, with the spring's work
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {bob: {particle: {mass: 1.0}}}
  joints: {rail: {slide: [ground.O, bob.center], along: [1, 0]}}
  forces: {coil: {spring: [ground.O, bob.center], stiffness: 5.0e+3, rest_length: 0.5}}
initial: {bob: {x: 0.6}}
duration: 0.4
samples: 101
step: {mujoco: 1.0e-3, pymunk: 1.0e-4}
allow: {bob.x: 1.0e-3, coil.work: 10.0}
"""


@pytest.mark.slow
def test_work_that_its_own_samples_are_too_rough_for_is_refused_alone(tmp_path: Path) -> None:
    """It is summed between samples: pymunk's own step meets only every third."""
    file, out = tmp_path / "work.yaml", tmp_path / "o"
    file.write_text(WORK, encoding="utf-8")
    done = textmech("run", file, "--out", out)
    assert done.returncode == 0, done.stdout
    rows = {
        row.quantity: row
        for row in write.read(out / "tolerance.csv", Comparison)
        if (row.engine, row.setting) == ("pymunk", "shipped")
    }
    assert said(rows["coil.work"]) == (
        "refused: adapter: at samples so far apart as its own step asks for, the reference is too "
        "rough"
    )
    assert rows["bob.x"].verdict == "beyond"
    file.write_text(WORK.replace("bob.x: 1.0e-3, ", ""), encoding="utf-8")
    alone = textmech("run", file, "--engine", "pymunk.shipped")
    assert (alone.returncode, "crashed" in alone.stdout) == (0, False)
    file.write_text(WORK, encoding="utf-8")
    told = textmech("advise", file)
    assert "at samples as far apart as its own step asks for: 10 asks more" in " ".join(
        told.stdout.split()
    )
    assert "mujoco" in told.stdout
