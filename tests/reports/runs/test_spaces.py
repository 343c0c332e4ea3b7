"""A function that makes a Space stands wherever a case may: its name, what it does, what it is."""

import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pymunk
import pytest
from given.command import textmech

from textmech.cases.mistake import CaseError
from textmech.engines.pymunk.model import contact
from textmech.reports import advise, load, run, solve
from textmech.reports.runs.selection import choose_cases, names_function

GAME = """
import pymunk

def make_space():
    print("made")
    space = pymunk.Space()
    space.gravity = (0, 900)
    body = pymunk.Body(2, pymunk.moment_for_box(2, (100, 10)))
    body.position = (450, 100)
    space.add(body, pymunk.PivotJoint(space.static_body, body, (400, 100)))
    return space

def exits():
    raise SystemExit(3)

def divides():
    return 1 / 0

class Odd(Exception):
    def __str__(self):
        raise ValueError("no text")

def odd():
    raise Odd

def needs(width):
    return width

def wrong():
    return 3

number = 3
"""


@pytest.fixture
def game(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder of a module `mygame`, where the command is."""
    (tmp_path / "mygame.py").write_text(GAME, encoding="utf-8")
    (tmp_path / "broken.py").write_text("def f(:\n", encoding="utf-8")
    (tmp_path / "lacks.py").write_text("import no_such_module\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    for name in ("mygame", "broken", "lacks"):
        sys.modules.pop(name, None)


def told(word: str) -> str:
    with pytest.raises(CaseError) as caught:
        choose_cases([word])
    (mistake,) = caught.value.mistakes
    assert mistake.file == word
    return mistake.what


def test_the_case_is_called_as_the_function(game: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = [*sys.path]
    (case,) = choose_cases(["mygame:make_space"])
    assert (case.name, case.source.file) == ("make_space", "mygame:make_space")
    assert capsys.readouterr() == ("", "made\n")  # what it prints would be among results
    assert sys.path == path


@pytest.mark.parametrize(
    ("word", "what"),
    [
        ("mygame:exits", "exits() raises SystemExit: 3 ("),
        ("mygame:divides", "divides() raises ZeroDivisionError: division by zero ("),
        ("mygame:odd", "odd() raises Odd: "),
        ("mygame:needs", "needs() raises TypeError: "),
        ("mygame:number", "number() raises TypeError: 'int' object is not callable"),
        ("mygame:wrong", "wrong() should return a pymunk.Space, and not int"),
        ("os:getcwd", "getcwd() should return a pymunk.Space, and not str"),
        ("mygame:nothing", "mygame ("),
        ("nogame:x", "importing nogame raises ModuleNotFoundError: No module named 'nogame'"),
        ("broken:x", "importing broken raises SyntaxError: "),
        ("lacks:x", "importing lacks raises ModuleNotFoundError: No module named 'no_such_module'"),
        ("mygame:", "is no file; a function is named as mygame:make_space"),
        (":x", "is no file; a function is named as mygame:make_space"),
        ("mygame:make_space()", "is no file; a function is named as mygame:make_space"),
        ("my game:\x1b[31m", "is no file; a function is named as mygame:make_space"),
        ("../mygame:make_space", "is no file; a function is named as mygame:make_space"),
    ],
)
def test_what_is_wrong_with_a_function_is_told(game: Path, word: str, what: str) -> None:
    assert told(word).startswith(what)


def test_the_place_is_told_where_it_raises(game: Path) -> None:
    line = GAME.splitlines().index("    return 1 / 0") + 1
    assert told("mygame:divides").endswith(f"({game / 'mygame.py'}:{line})")


@pytest.mark.skipif(os.name == "nt", reason="there no file has such a name")
def test_a_file_with_a_colon_is_a_file(game: Path) -> None:
    (game / "a:b").write_text("title: x\n", encoding="utf-8")
    assert not names_function("a:b")
    assert names_function("c:d")


@pytest.mark.slow
def test_check_and_run_take_it(game: Path) -> None:
    done = textmech("check", "mygame:make_space", folder=game)
    assert (done.returncode, done.stdout) == (0, "mygame:make_space: 1 case, no mistakes\n")
    assert "its units are written as m and kg, places may be off by 0.001 of" in done.stderr
    done = textmech("run", "mygame:make_space", "--engine", "pymunk", "--json", folder=game)
    assert done.returncode == 0
    rows = json.loads(done.stdout)["summary"]
    assert {row["case"] for row in rows} == {"make_space"}


@pytest.mark.slow
def test_python_takes_a_space_itself(game: Path) -> None:
    space = pymunk.Space()
    space.gravity = 0, 900
    body = pymunk.Body(2, pymunk.moment_for_box(2, (100, 10)))
    body.position = 450, 100
    space.add(body, pymunk.PivotJoint(space.static_body, body, (400, 100)))
    assert [case.name for case in load([space, "bar_pendulum"])] == ["space", "bar_pendulum"]
    (named,), motion = load("mygame:make_space"), solve(space).motion
    assert solve(named).motion.equals(motion)
    assert set(run(space, engines="pymunk.tuned").summary.worst) == {"agrees"}
    assert {*advise(space, engines="pymunk").case} == {"space"}
    assert tuple(body.position) == (450, 100)  # nothing is changed of it
    with pytest.raises(CaseError, match="another case beside it has the name 'space'"):
        load([space, space])


@pytest.mark.slow
@pytest.mark.mutant("a corner's circle of a tenth of a pixel")
def test_a_box_of_pixels_lands(monkeypatch: pytest.MonkeyPatch) -> None:
    """It lands at 424 a second, 4.2 in a step of pymunk's; its circles have to be larger."""
    space = pymunk.Space()
    space.gravity = (0.0, -900.0)
    space.add(pymunk.Segment(space.static_body, (-500.0, 0.0), (500.0, 0.0), 0.0))
    body = pymunk.Body(2.0, pymunk.moment_for_box(2.0, (40.0, 40.0)))
    body.position = (0.0, 120.0)
    space.add(body, pymunk.Poly.create_box(body, (40.0, 40.0)))

    def off() -> float:
        rows = run(space, engines=["pymunk.shipped"]).tolerance
        return float(rows[rows.quantity == "body0.y"].error.max())

    assert off() < 4.3
    monkeypatch.setattr(contact, "FALLEN", 0.0)
    monkeypatch.setenv("TEXTMECH_CACHE", os.devnull)  # where the answer of above is not
    assert off() > 50.0
