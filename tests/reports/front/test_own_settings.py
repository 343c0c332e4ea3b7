"""A user's own settings: under their names, at their own step, and told where they do nothing."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner, Result
from given.command import textmech
from given.command.lines import said
from given.otherwise import otherwise
from given.scenes.swing import SWING

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference.solve import Solution, solve
from textmech.reports.compare.trial.ladder import judged_step, sampled
from textmech.reports.compare.trial.run import climbed
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.front.cli import command
from textmech.reports.front.show.terminal import without_effect
from textmech.reports.runs import selection, suite
from textmech.reports.runs import tasks as unit
from textmech.reports.runs.cache.store import Store
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import BOOK, choose_book, choose_engines
from textmech.reports.tables import write
from textmech.reports.tables.row import BEYOND, FAILS, Comparison

Make = Callable[..., Trial]


def written(folder: Path, name: str, text: str = "mujoco: {step: 1.0e-3}\n") -> str:
    file = folder / name
    file.parent.mkdir(exist_ok=True)
    file.write_text(text, encoding="utf-8")
    return str(file)


def test_each_file_is_a_column_of_its_name(tmp_path: Path) -> None:
    files = [written(tmp_path, "coarse.yaml"), written(tmp_path, "fine.yaml")]
    found = choose_engines(["mujoco"], [*files, "shipped"])
    assert [engine.setting for engine in found] == ["shipped", "coarse", "fine"]
    assert [e.setting for e in choose_engines(["mujoco"], [files[0], files[0], "shipped"])] == [
        "shipped",
        "coarse",
    ]


@pytest.mark.parametrize(
    ("names", "settings", "wanted"),
    [
        ([], [], True),
        ([BOOK], [], True),
        (["mujoco", BOOK], ["tuned"], True),
        (["mujoco"], [], False),
        ([], ["tuned"], False),
    ],
)
def test_the_book_is_asked_by_name_or_where_nothing_is_named(
    names: list[str], settings: list[str], wanted: bool
) -> None:
    assert choose_book(names, settings) == wanted


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("shipped.yaml", "built-in setting"),
        ("law.yaml", "'law' says how an engine realises a scene"),
        ("other/coarse.yaml", "already has the name 'coarse'"),
        ("=cmd().yaml", "letters, digits"),
        ("a\nb.yaml", "letters, digits"),
    ],
)
def test_names_that_clash_or_are_none_are_mistakes(tmp_path: Path, name: str, words: str) -> None:
    files = [written(tmp_path, "coarse.yaml"), written(tmp_path, name)]
    with pytest.raises(CaseError, match=words):
        choose_engines(["mujoco"], files)


@pytest.mark.parametrize("word", ["", "folder"])
def test_what_is_no_file_is_told(tmp_path: Path, word: str) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    with pytest.raises(CaseError, match="is no file" if word else "has no name"):
        choose_engines(["mujoco"], [str(folder) if word else ""])


@pytest.mark.mutant("of an option whose name has a line break the rest of the name is told")
@pytest.mark.parametrize("escape", ["\\n", "\\u2028", "\\x0b"])
def test_a_name_of_two_lines_is_told_where_it_stands(escape: str, tmp_path: Path) -> None:
    file = written(tmp_path, "mine.yaml", f'mujoco: {{"a{escape}b": 1}}\n')
    with pytest.raises(CaseError) as wrong:
        choose_engines(["mujoco"], [file])
    (mistake,) = wrong.value.mistakes
    assert (mistake.line, mistake.column) == (1, 10)
    assert mistake.what == "unknown option: a name is one line"


def own(trial: Make, step: float, **more: Any) -> Any:
    return trial(setting="mine", own_step=step, **more).engine


@pytest.mark.parametrize("step", [1 / 60, 0.03, 0.05, 0.013, 0.04, 1e-3])
def test_samples_are_taken_where_the_own_step_is(moving: Case, trial: Make, step: float) -> None:
    """25 samples a second: 1/60 s meets none of them, and a larger step has fewer."""
    engine = own(trial, step)
    case = sampled(moving, engine)
    assert judged_step(case, engine) == step
    assert case.times / step == pytest.approx(np.rint(case.times / step), abs=1e-9)
    assert case.times[-1] <= moving.duration * (1 + 1e-12)
    assert case.times[-1] > moving.duration - max(2 * step, moving.interval)
    assert (case is moving) == (step in (0.04, 1e-3))


def measured(case: Case, *engines: Any) -> list[Comparison]:
    report = suite.measure(Request([case], engines, jobs=1, book=False))
    return [row for row in report.comparisons if row.quantity != "audit"]


@pytest.mark.slow
def test_a_games_step_is_judged_as_it_is(moving: Case, trial: Make) -> None:
    """x is off by h t: the step shows in the error, and the reference is solved for its times."""
    (row,) = measured(moving, own(trial, 1 / 60))
    assert row.step == 1 / 60
    assert row.error == pytest.approx(1 / 60 * row.when if row.when else 0, rel=1e-12)
    assert row.when == pytest.approx(1.0)
    assert row.verdict == BEYOND
    assert row.protocol == "31 samples at whole steps of its own"


@pytest.mark.slow
def test_its_own_samples_need_a_certified_reference(
    moving: Case, trial: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(case: Case) -> Solution:
        found = solve(case)
        return replace(found, checks=(replace(found.checks[0], difference=1.0),))

    monkeypatch.setattr(unit, "solve", broken)  # the case's own samples are solved by the suite
    engine, store = own(trial, 1 / 60), Store(Path(moving.source.file).parent)
    pair = unit.Pair(moving, engine, store, "none")
    (way,) = unit.planned(pair)
    one = unit.Unit(pair, way)
    rungs = one.rungs(pair.reference())
    climb = unit.Climb(one, {at: climbed(rung) for at, rung in rungs.items()})
    rows = unit.judged(climb).rows
    assert {row.verdict for row in rows} == {FAILS}
    assert all("the reference is not certified" in row.because for row in rows)


@pytest.mark.slow
def test_a_step_that_leaves_no_room_is_refused(moving: Case, trial: Make) -> None:
    (row,) = measured(moving, own(trial, 0.6))
    assert said(row) == "refused: adapter: 1 s are less than two of its steps of 0.6 s"


@pytest.mark.slow
def test_options_without_effect_are_told(moving: Case, trial: Make) -> None:
    shipped = trial(setting="shipped", own_step=1e-3).engine
    same, other = own(trial, 1e-3), replace(own(trial, 1e-3), setting="faster", rate=2.0)
    rows = measured(moving, shipped, same, other)
    assert list(without_effect(rows)) == [
        "moving: mujoco.mine changes nothing: every number is shipped's"
    ]


@pytest.mark.mutant("a file of settings that nobody uses is taken in silence")
def test_a_file_that_no_chosen_engine_uses_is_a_mistake(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("pymunk: {midpoint: true}\n", encoding="utf-8")
    for names in (["mujoco"], ["pymunk.shipped"]):
        with pytest.raises(CaseError, match=r"no chosen engine uses it, which is for pymunk\.mine"):
            choose_engines(names, [str(file)])
    (one,) = choose_engines(["pymunk.mine"], [str(file)])
    assert (one.name, one.setting) == ("pymunk", "mine")
    assert "mine" in {one.setting for one in choose_engines(["pymunk"], [str(file)])}
    blind = otherwise(selection, "        if not used and not spare:\n", "        if False:\n")
    assert [one.setting for one in blind.choose_engines(["pymunk.shipped"], [str(file)])] == [
        "shipped"
    ]


def test_a_setting_whose_file_is_not_named_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(CaseError, match="no such engine; did you mean"):
        choose_engines(["pymunk.mine"], [])
    Path("mine.yaml").write_text("pymunk: {midpoint: true}\n", encoding="utf-8")
    with pytest.raises(CaseError, match=r"say --settings mine\.yaml too"):
        choose_engines(["pymunk.mine"], [])


# Own settings through the command, in the engines themselves.

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
