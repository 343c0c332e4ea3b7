"""`make quick` runs what mirrors a change: something for every program, and no other room's."""

from pathlib import Path

import pytest
import touched
from given.tree import FILES


def mirrored(name: str) -> set[str]:
    return {str(test) for test in touched.mirror(Path(name))}


@pytest.mark.parametrize(
    ("file", "folder"),
    [
        ("cases/scene/quantity.py", "tests/cases"),
        ("reference/mechanism/modes/mode.py", "tests/reference/mechanism"),
        ("engines/pymunk/callbacks/friction.py", "tests/engines/pymunk"),  # no folder is its own
        ("reports/compare/judge/verdict.py", "tests/reports"),
        ("cases/four_bar.yaml", "tests/cases"),
    ],
)
def test_a_program_has_the_tests_of_the_nearest_folder(file: str, folder: str) -> None:
    beside = {str(path.relative_to(touched.ROOT)) for path in (touched.ROOT / folder).glob("*.py")}
    assert mirrored(file) == {name for name in beside if Path(name).name.startswith("test_")}
    assert mirrored(file)


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
        "reports/batch/cache/key.py",
        "reports/batch/cache/gone.py",
        "tests/test_rooms.py",
    ]
    monkeypatch.setattr(touched, "changed", lambda: [Path(name) for name in changed])
    touched.main()
    tests = capsys.readouterr().out.split()
    assert len(tests) == len(set(tests))
    assert set(tests) == {
        *touched.ALWAYS,
        "tests/test_rooms.py",
        *mirrored("reports/batch/cache/key.py"),
    }
    touched.main("--files")
    assert capsys.readouterr().out.split() == ["reports/batch/cache/key.py", "tests/test_rooms.py"]


def test_where_nothing_differs_there_is_still_something_to_check(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of no file the type checker would take all, and so would pytest."""
    monkeypatch.setattr(touched, "changed", list)
    for words in ((), ("--files",)):
        touched.main(*words)
        assert capsys.readouterr().out.split() == list(touched.ALWAYS)
