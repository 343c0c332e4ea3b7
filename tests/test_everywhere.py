"""`make everywhere` tries what pyproject.toml says, and ends red where anything is."""

import sys
import tomllib

import everywhere
import pytest

PROJECT = tomllib.loads((everywhere.ROOT / "pyproject.toml").read_text())["project"]
HERE = everywhere.Python(sys.executable, "3.13.0")


@pytest.mark.parametrize("python", everywhere.PYTHONS)
def test_all_that_is_required_has_a_least_version(python: str) -> None:
    names = [line.partition("==")[0] for line in everywhere.lowest(PROJECT, python)]
    assert {"numpy", "pymunk", "pytest"} <= set(names)
    assert len(names) == len(set(names))


def test_the_highest_of_the_least_versions_counts_that_the_python_asks_for() -> None:
    some = ["numpy>=2.0", "numpy>=2.1; python_version >= '3.13'", "click>=8.2,<9"]
    project = {"dependencies": some, "optional-dependencies": {"test": []}}
    assert everywhere.lowest(project, "3.9") == ["numpy==2.0", "click==8.2"]
    assert everywhere.lowest(project, "3.14") == ["numpy==2.1", "click==8.2"]
    project["dependencies"] = ["click"]
    with pytest.raises(ValueError, match="'click' names no least version"):
        everywhere.lowest(project, "3.14")


@pytest.mark.mutant("an environment that is red, and all is green in the end")
@pytest.mark.parametrize(("fails", "code"), [("", 0), ("lowest", 1), ("newest", 1)])
def test_one_that_is_red_is_said_and_ends_so(
    fails: str, code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def tried(python: everywhere.Python, which: str, *more: object) -> str:
        if which == fails:
            raise everywhere.Red("tests fail (exit code 1):", "1 failed")
        return "numpy 2.1.0"

    monkeypatch.setattr(everywhere, "pythons", lambda minors: [HERE])
    monkeypatch.setattr(everywhere, "tried", tried)
    assert everywhere.main() == code
    said = capsys.readouterr().out
    assert "Python 3.12: not here" in said
    assert said.count("green, numpy 2.1.0") == 2 - code
    assert said.count("red: tests fail (exit code 1):\n    1 failed") == code


def test_where_no_python_is_nothing_is_green(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(everywhere, "pythons", lambda minors: [])
    assert everywhere.main() == 1
