"""Mistakes drawn by chance: where they may be, and what is said of one that is planted."""

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import drawn
import mutants
import pytest
import touched
import tried
from drawn import Mistake, Spot
from given.tree import ROOT

SOURCE = '''\
"""It tells 1 of nothing."""
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    ONE = 1


def half(x: "1" = 1) -> "1":
    """The half of 1."""
    # not of 1
    return x / 2
'''


def test_shares_are_in_proportion_and_together_the_count() -> None:
    assert drawn.shares({"a": 60, "b": 30, "c": 10}, 10) == {"a": 6, "b": 3, "c": 1}
    found = drawn.shares({"a": 5619, "b": 13105, "c": 9186, "d": 9412}, 150)
    assert sum(found.values()) == 150
    assert found == {"a": 22, "b": 53, "c": 37, "d": 38}  # of 22.58, 52.67, 36.92 and 37.83


def test_only_lines_that_do_something_are_drawn() -> None:
    assert drawn.code(SOURCE) == {2, 8, 11}


def ones(text: str) -> list[Spot]:
    """Each 1 and 2, wherever it stands."""
    lines = [n for n, line in enumerate(text.splitlines(), 1) for sign in line if sign in "12"]
    return [Spot(line, "ours_1_2", i) for i, line in enumerate(lines)]


def exchanged(text: str, spot: Spot) -> str:
    """That one is a 3."""
    places = [i for i, sign in enumerate(text) if sign in "12"]
    at = places[spot.occurrence]
    return f"{text[:at]}3{text[at + 1 :]}"


@pytest.mark.slow
def test_a_draw_is_the_same_for_a_seed_and_plants_nothing_in_words_or_types() -> None:
    folders = {"a": {"a/half.py": SOURCE}}
    one, again, other = (drawn.draw(folders, 2, seed, ones, exchanged) for seed in (1, 1, 2))
    assert one == again
    assert {m.change for m in one} == {m.change for m in other}  # there are no others
    assert {m.change for m in one} == {
        'def half(x: "1" = 1) -> "1": -> def half(x: "1" = 3) -> "1":',
        "return x / 2 -> return x / 3",
    }
    assert [m.number for m in one] == [1, 2]
    with pytest.raises(ValueError, match="a has no 3 mistakes"):
        drawn.draw(folders, 3, 1, ones, exchanged)


def test_the_tools_operators_are_there_and_plant_one_change() -> None:
    pytest.importorskip("cosmic_ray", reason="`make mutants` installs it, and nothing else asks it")
    from cosmic_ray.plugins import operator_names  # pyright: ignore[reportMissingImports]

    assert set(drawn.operators()) <= set(operator_names())
    found = drawn.draw({"a": {"a/half.py": SOURCE}}, 5, 1)
    for one in found:
        lines = zip(SOURCE.splitlines(), one.source.splitlines(), strict=True)
        assert [n for n, (old, new) in enumerate(lines, 1) if old != new] == [one.line]


THING = "def double(x):\n    return 2 * x\n"
SEES = """\
import sys
sys.path.insert(0, "cases")
from thing import double
def test_others(): assert double(0) == 0
def test_double(): assert double(2.5) == 5
"""
BLIND = "def test_blind(): pass\n"
ALWAYS_RED = "def test_red(): assert False\n"


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., tried.Copy]:
    """A copy of a small tree with one program and these tests of its room."""

    def made(name: str, **tests: str) -> tried.Copy:
        copy = tried.Copy(tmp_path / name)
        for part in ("cases", "tests/cases"):
            (copy.root / part).mkdir(parents=True)
        shutil.copy(ROOT / "tests" / "limited.py", copy.root / "tests")
        (copy.root / "pyproject.toml").write_text("[tool.pytest.ini_options]\n", encoding="utf-8")
        (copy.root / "cases" / "thing.py").write_text(THING, encoding="utf-8")
        for test, text in tests.items():
            place = copy.root / "tests" / "cases" / f"test_{test}.py"
            place.write_text(text, encoding="utf-8")
        monkeypatch.setattr(touched, "ROOT", copy.root)
        monkeypatch.setattr(tried, "_text", lambda test: test.read_text(encoding="utf-8"))
        return copy

    return made


def outcome(tree: Callable[..., tried.Copy], source: str, **tests: str) -> tried.Outcome:
    copy, sound = tree("copy", **tests), tried.Sound(tree("sound", **tests))
    found = tried.tried(Mistake(1, "cases/thing.py", 2, "", "", source), copy, sound)
    assert (copy.root / "cases" / "thing.py").read_text(encoding="utf-8") == THING
    return found


TRIPLE, FOREVER = THING.replace("2 *", "3 *"), THING.replace("return 2 * x", "while True: pass")
SAW = "tests/cases/test_sees.py::test_double"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "tests", "wanted"),
    [
        (TRIPLE, {"blind": BLIND, "sees": SEES}, (tried.SEEN, SAW, 2)),
        (TRIPLE, {"blind": BLIND}, (tried.SURVIVED, "", 1)),
        ("1 +\n", {"sees": SEES}, (tried.SEEN, "tests/cases/test_sees.py", 0)),
        (THING, {"sees": SEES}, (tried.SURVIVED, "", 2)),
        (TRIPLE, {"red": ALWAYS_RED, "sees": SEES}, (tried.SEEN, SAW, 2)),
        (TRIPLE, {"red": ALWAYS_RED, "blind": BLIND}, (tried.SURVIVED, "", 2)),
    ],
)
def test_what_becomes_of_a_mistake(
    tree: Callable[..., tried.Copy],
    source: str,
    tests: dict[str, str],
    wanted: tuple[str, str, int],
) -> None:
    """What is red without it has not seen it."""
    found = outcome(tree, source, **tests)
    assert (found.said, found.by) == wanted[:2]
    assert found.run >= wanted[2]


@pytest.mark.slow
def test_who_never_ends_is_told_as_that(
    tree: Callable[..., tried.Copy], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tried, "EACH", 1.0)
    found = outcome(tree, FOREVER, sees=SEES)
    assert (found.said, found.by) == (tried.TIMED_OUT, SAW.replace("double", "others"))


@pytest.mark.slow
def test_where_the_time_is_over_nothing_is_decided(
    tree: Callable[..., tried.Copy], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tried, "WORK", 0.0)
    assert outcome(tree, TRIPLE, sees=SEES).said == tried.UNDECIDED


def test_nearest_tests_come_first() -> None:
    first, *rest = tried.stages("reports/page/heat.py", ROOT)
    assert "tests/reports/page/test_rows.py" in first
    assert len(first) < 5
    named = [test for stage in (first, *rest) for test in stage]
    assert len(named) == len(set(named))
    assert set(named) == {
        str(test.relative_to(ROOT)) for test in (ROOT / "tests" / "reports").rglob("test_*.py")
    }


ROW = mutants.Row(1, 2, "cases/a.py", 3, "core/X", "a -> b", tried.SURVIVED, "", 9, "t 1", "c")


def test_what_a_person_types_is_kept_and_the_numbers_are_told(tmp_path: Path) -> None:
    file = tmp_path / "list.csv"
    typed = replace(ROW, why="b is a, here", done="test_a")
    mutants.write(file, [replace(typed, number=5), typed, replace(ROW, outcome=tried.SEEN)])
    assert mutants.rows(file)[0].number == 2
    assert typed in mutants.rows(file)
    mistakes = [Mistake(7, "cases/a.py", 30, "core/X", "a -> b", "")]
    assert [mutants.key(row) for row in mutants.chosen(file, mistakes)] == [mutants.key(ROW)]
    others = [replace(ROW, outcome=said) for said in (tried.SEEN, tried.TIMED_OUT, tried.UNDECIDED)]
    lines = mutants.told([typed, *others], 1, 6).splitlines()
    assert lines[0] == "cases/a.py:3: a -> b  (b is a, here)"
    assert lines[-1] == (
        "2 of 4 planted mistakes seen at the first try (1 by a time-out); "
        "1 not within the time for their tests; seed 1, 6 drawn, by t 1"
    )
