"""`make quick` runs what mirrors a change: something for every program, and no other room's."""

from pathlib import Path

import executed
import pytest
import touched
from given.command.tree import FILES


def mirrored(name: str) -> set[str]:
    return {str(test) for test in touched.mirror(Path(name))}


@pytest.mark.parametrize(
    ("file", "folder"),
    [
        ("cases/scene/quantity.py", "tests/cases"),
        ("reference/mechanism/modes/mode.py", "tests/reference/mechanism"),
        ("engines/pymunk/callbacks/friction.py", "tests/engines/pymunk"),  # no folder is its own
        ("reports/compare/judge/verdict.py", "tests/reports/compare"),
        ("cases/four_bar.yaml", "tests/cases"),
    ],
)
def test_a_program_has_the_tests_of_its_folder_and_of_those_above(file: str, folder: str) -> None:
    room, folders = Path("tests") / Path(file).parts[0], [Path(folder)]
    while folders[-1] != room:
        folders.append(folders[-1].parent)
    tests = {test for each in folders for test in (touched.ROOT / each).glob("test_*.py")}
    assert mirrored(file) == {str(test.relative_to(touched.ROOT)) for test in tests}
    assert any(Path(name).parent == Path(folder) for name in mirrored(file))


@pytest.mark.slow
def test_every_program_has_some() -> None:
    for file in FILES:
        found = touched.mirror(file.relative_to(touched.ROOT))
        assert found, file
        assert all((touched.ROOT / test).is_file() for test in found)


def test_a_test_has_itself_and_one_that_is_gone_nothing() -> None:
    assert mirrored("tests/test_touched.py") == {"tests/test_touched.py"}
    assert mirrored("tests/test_gone.py") == set()
    assert mirrored("README.md") == set()


def test_what_differs_is_printed_once_and_by_kind(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    changed = [
        "README.md",
        "reports/runs/cache/key.py",
        "reports/runs/cache/gone.py",
        "tests/test_rooms.py",
    ]
    monkeypatch.setattr(touched, "changed", lambda: [Path(name) for name in changed])
    touched.main()
    tests = capsys.readouterr().out.split()
    assert len(tests) == len(set(tests))
    assert set(tests) == {
        *touched.ALWAYS,
        "tests/test_rooms.py",
        *mirrored("reports/runs/cache/key.py"),
        *touched.cases([Path("reports/runs/cache/key.py")]),
    }
    touched.main("--files")
    assert capsys.readouterr().out.split() == ["reports/runs/cache/key.py", "tests/test_rooms.py"]


def test_where_nothing_differs_there_is_still_something_to_check(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of no file the type checker would take all, and so would pytest."""
    monkeypatch.setattr(touched, "changed", list)
    for words in ((), ("--files",)):
        touched.main(*words)
        assert capsys.readouterr().out.split() == list(touched.ALWAYS)


@pytest.mark.parametrize(
    ("files", "first"),
    [
        (["cases/four_bar.yaml"], "cases/four_bar.yaml"),
        (["reference/systems/pendula/stopped_pendulum.py"], "cases/stopped_pendulum.yaml"),
        (["reference/systems/walkers/compass_walker.py"], "cases/compass_walker.yaml"),
    ],
)
def test_a_case_and_a_system_have_their_own_cases(files: list[str], first: str) -> None:
    assert touched.cases([Path(file) for file in files])[0] == first


def test_of_several_programs_each_has_a_case_as_long_as_there_is_room() -> None:
    files = sorted(executed.read())[-40:]
    chosen = touched.cases([Path(file) for file in files])
    assert len(chosen) == len(set(chosen)) == touched.CASES
    assert chosen[0] == executed.read()[files[0]][0]


def test_what_is_said_to_be_executed_is_there() -> None:
    known = executed.read()
    for program, cases in known.items():
        assert (touched.ROOT / program).is_file(), f"{program}: python tests/executed.py"
        assert cases
        assert all((touched.ROOT / case).is_file() for case in cases)
    computing = [name for name in known if name.startswith(("reference/", "engines/"))]
    assert len(computing) > 150


def test_cases_are_chosen_by_what_they_add_for_their_cost() -> None:
    ran = {
        "a": ({"p": frozenset({"f", "g"})}, 1.0),
        "b": ({"p": frozenset({"f", "g", "h"})}, 9.0),
        "c": ({"p": frozenset({"h"})}, 2.0),
        "d": ({"q": frozenset({"f"})}, 0.1),
    }
    assert executed.chosen("p", ran) == ["a", "c"]
    assert executed.chosen("q", ran) == ["d"]
