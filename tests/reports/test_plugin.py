"""The pytest plug-in, as it behaves in somebody else's project."""

import sys
import tomllib
from pathlib import Path
from typing import cast
from xml.etree import ElementTree as ET

import pytest
from given.inner import inner
from given.swing import SWING, swing

from textmech.cases.find import shipped
from textmech.reports.pytest_plugin import _configured

pytest_plugins = ["pytester"]


@pytest.fixture
def project(pytester: pytest.Pytester) -> pytest.Pytester:
    pytester.makefile(".yaml", swing=SWING)
    pytester.makepyfile("def test_own(): pass")
    return pytester


@pytest.mark.slow
def test_it_is_inert_in_other_projects(project: pytest.Pytester) -> None:
    inner(project).assert_outcomes(passed=1)


@pytest.mark.slow
def test_other_projects_may_have_an_engine_option(project: pytest.Pytester) -> None:
    project.makeconftest("def pytest_addoption(parser): parser.addoption('--engine')")
    inner(project, "--engine", "x").assert_outcomes(passed=1)


@pytest.mark.slow
def test_a_named_file_is_compared(project: pytest.Pytester) -> None:
    done = project.runpytest_subprocess("swing.yaml", "-v", "--textmech-engine", "mujoco.tuned")
    done.assert_outcomes(passed=3)  # the reference, the audit, the angle
    done.stdout.fnmatch_lines(["swing.yaml::swing-mujoco.tuned-rod.angle PASSED*"])


@pytest.mark.slow
def test_configured_files_are_compared(project: pytest.Pytester) -> None:
    project.makeini("[pytest]\ntextmech_cases = sw*.yaml")
    inner(project, "--textmech-engine", "mujoco.tuned").assert_outcomes(passed=4)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ini", "what"),
    [
        ("textmech_cases = case/*.yaml", "no case file fits 'case/*.yaml'; *"),
        (
            "textmech_cases = sw*.yaml\ntestpaths = tests",
            "*swing.yaml is below none of `testpaths`*",
        ),
        (
            "textmech_cases = ../mine.yaml",
            "*mine.yaml is not below *, where alone pytest looks: name it to pytest",
        ),
    ],
)
def test_files_that_the_ini_file_names_and_nothing_finds_are_no_pass(
    project: pytest.Pytester, ini: str, what: str
) -> None:
    project.makeini(f"[pytest]\n{ini}")
    (project.path.parent / "mine.yaml").write_text(SWING, encoding="utf-8")
    project.mkdir("tests").joinpath("test_own.py").write_text("def test_own(): pass")
    done = inner(project)
    assert done.ret == pytest.ExitCode.USAGE_ERROR
    done.stderr.fnmatch_lines([f"ERROR: textmech_cases: {what}"])
    inner(project, "tests").assert_outcomes(passed=1)  # whoever names a folder has said which


@pytest.mark.slow
def test_whoever_stands_in_a_folder_has_said_which(project: pytest.Pytester) -> None:
    project.makeini("[pytest]\ntextmech_cases = sw*.yaml")
    folder = project.mkdir("tests")
    folder.joinpath("test_own.py").write_text("def test_own(): pass")
    project.chdir()
    done = project.run(sys.executable, "-c", f"import os, pytest; os.chdir({str(folder)!r}); "
                       "raise SystemExit(pytest.main(['-q']))")  # fmt: skip
    assert done.ret == 0


@pytest.mark.slow
def test_a_failure_prints_the_row_and_the_files_line(project: pytest.Pytester) -> None:
    promised = "reach: {mujoco: {rod.angle: 1.0e-12}}\n"
    project.makefile(".yaml", swing=swing("1.0e-6") + promised)
    done = inner(project, "swing.yaml", "--textmech-engine", "mujoco.tuned")
    done.assert_outcomes(passed=2, failed=1)
    done.stdout.fnmatch_lines(["*swing.yaml:10: rod.angle", "*verdict*FAILS*"])
    assert "Traceback" not in done.stdout.str()


@pytest.mark.slow
def test_a_finding_is_an_expected_failure_with_the_row_as_its_reason(
    project: pytest.Pytester,
) -> None:
    project.makefile(".yaml", swing=swing("1.0e-6"))
    done = inner(project, "swing.yaml", "-rx", "--textmech-engine", "mujoco.shipped")
    done.assert_outcomes(passed=2, xfailed=1)
    done.stdout.fnmatch_lines(["*rod.angle*allowed 1.0e-06*beyond*"])


@pytest.mark.slow
def test_mistakes_of_a_file_are_shown_as_they_are(project: pytest.Pytester) -> None:
    project.makefile(".yaml", swing=SWING.replace("mass: 0.5", "mas: 0.5"))
    done = inner(project, "swing.yaml")
    done.assert_outcomes(failed=1)
    done.stdout.fnmatch_lines(["*swing.yaml:4:*did you mean 'mass'?*"])
    assert "Traceback" not in done.stdout.str()


MINE = "pymunk: {midpoint: true, error_bias: 0.0, step: 0.005}\n"


@pytest.mark.slow
def test_ones_own_settings_are_what_has_to_agree(project: pytest.Pytester) -> None:
    """By a word, and by pytest's ini; what the engine has by itself is a finding."""
    project.makefile(".yaml", swing=swing("1.0e-2"), mine=MINE)
    words = ("swing.yaml", "--textmech-engine", "pymunk.mine", "--textmech-settings", "mine.yaml")
    inner(project, *words).assert_outcomes(passed=3)
    project.makefile(".yaml", swing=swing("1.0e-6"))
    done = inner(project, *words)
    done.assert_outcomes(passed=2, failed=1)
    done.stdout.fnmatch_lines(["*rod.angle, by your own settings", "*verdict*beyond"])
    project.makeini("[pytest]\ntextmech_settings = mine.yaml\n")
    inner(project, *words[:3]).assert_outcomes(passed=2, failed=1)
    shipped = inner(project, "swing.yaml", "--textmech-engine", "pymunk")
    assert shipped.parseoutcomes()["failed"] == 1


@pytest.mark.slow
def test_junit_has_a_rows_numbers_as_properties(project: pytest.Pytester) -> None:
    project.makefile(".yaml", swing=swing("1.0e-6"))
    inner(project, "swing.yaml", "--textmech-engine", "mujoco.shipped", "--junitxml", "j.xml")
    root = ET.parse(project.path / "j.xml").getroot()
    told = {
        case.get("name"): {p.get("name"): p.get("value") for p in case.iter("property")}
        for case in root.iter("testcase")
    }
    row = told["swing-mujoco.shipped-rod.angle"]
    assert row["verdict"] == "beyond"
    assert float(row["error"] or "nan") > float(row["allowed"] or "nan") == 1e-6
    (skipped,) = root.iter("skipped")
    assert "  " not in (skipped.get("message") or "  ")


@pytest.mark.slow
def test_a_broken_file_costs_itself_alone(project: pytest.Pytester) -> None:
    project.makefile(".yaml", swing=swing("1.0e-2"), bad="title: [\n")
    done = inner(project, "bad.yaml", "swing.yaml", "--textmech-engine", "mujoco.tuned")
    done.assert_outcomes(passed=3, failed=1)


@pytest.mark.slow
def test_a_case_that_is_not_there_does_not_look_like_a_pass(project: pytest.Pytester) -> None:
    done = inner(project, "swing.yaml", "--textmech-case", "swung")
    assert done.ret == pytest.ExitCode.USAGE_ERROR
    done.stderr.fnmatch_lines(["*no such case*swung*"])


@pytest.mark.slow
def test_a_case_that_is_deselected_is_there(project: pytest.Pytester) -> None:
    done = inner(project, "swing.yaml", "--textmech-case", "swing", "-k", "nothing")
    assert done.ret == pytest.ExitCode.NO_TESTS_COLLECTED


@pytest.mark.slow
def test_a_case_with_mistakes_says_them_also_where_it_is_asked_for(
    project: pytest.Pytester,
) -> None:
    project.makefile(".yaml", bad="title: [\n")
    done = inner(project, "bad.yaml", "--textmech-case", "bad")
    done.assert_outcomes(failed=1)
    done.stdout.fnmatch_lines(["*bad.yaml:*"])


@pytest.mark.parametrize(
    ("pattern", "found"),
    [("cases/*.yaml", True), ("./cases/../cases/*.yaml", True), ("other/*.yaml", False)],
)
def test_cases_are_found_in_a_folder_of_any_name(pattern: str, found: bool, tmp_path: Path) -> None:
    class Config:
        rootpath = tmp_path / "project[1]"

        def getini(self, name: str) -> list[str]:
            return [pattern]

    config = cast("pytest.Config", Config())
    assert _configured(Config.rootpath / "cases" / "swing.yaml", config) is found


@pytest.mark.parametrize(
    ("pattern", "file", "fits"),
    [
        ("cases/*.yaml", "cases/a.yaml", True),
        ("cases/*.yaml", "cases/deep/a.yaml", False),
        ("cases/**/*.yaml", "cases/deep/er/a.yaml", True),
        ("cases/**/*.yaml", "cases/a.yaml", True),
        ("**/a.yaml", "cases/deep/a.yaml", True),
        ("cases/**", "cases/deep/a.yaml", True),
        ("*.yaml", "cases/a.yaml", False),
        ("./cases//[ab].yaml", "cases/b.yaml", True),
    ],
)
def test_a_pattern_is_as_a_shell_has_it(
    pattern: str, file: str, fits: bool, tmp_path: Path
) -> None:
    class Config:
        rootpath = tmp_path

        def getini(self, name: str) -> list[str]:
            return [pattern]

    assert _configured(tmp_path / file, cast(pytest.Config, Config())) is fits


def test_every_shipped_file_is_compared_by_our_own_tests() -> None:
    """Those in a folder of their own too: they would be left out without a word."""
    root = Path(__file__).parents[2]
    told = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))

    class Config:
        rootpath = root

        def getini(self, name: str) -> list[str]:
            return [told["tool"]["pytest"]["ini_options"][name]]

    files = {*(root / "cases").rglob("*.yaml")}
    assert {*shipped().values()} <= files
    assert {file.parent.name for file in files} == {"cases", "questions"}
    assert all(_configured(file, cast("pytest.Config", Config())) for file in files)


@pytest.mark.slow
def test_a_file_whose_name_no_table_can_carry_is_a_mistake(project: pytest.Pytester) -> None:
    """As for the command: a spreadsheet computes what begins with =."""
    (project.path / "=swing.yaml").write_text(SWING, encoding="utf-8")
    done = inner(project, "=swing.yaml")
    done.assert_outcomes(failed=1)
    done.stdout.fnmatch_lines(["*file name should begin with a letter*"])


@pytest.mark.slow
def test_two_files_of_one_name_do_not_share_their_rows(project: pytest.Pytester) -> None:
    strict = project.mkdir("strict") / "swing.yaml"
    strict.write_text(swing("1.0e-12"), encoding="utf-8")
    done = inner(project, "strict/swing.yaml", "swing.yaml")
    assert done.ret == pytest.ExitCode.USAGE_ERROR
    done.stderr.fnmatch_lines(["*have one name*"])


@pytest.mark.mutant("pytest's own option for the time limit changes nothing")
@pytest.mark.slow
def test_it_takes_a_time_limit(project: pytest.Pytester) -> None:
    project.makepyfile(
        "from textmech.reports.system.limit import limit\ndef test_own(): assert limit() == 2.5"
    )
    done = project.runpytest_subprocess("--textmech-time-limit", "2.5")
    done.assert_outcomes(passed=1)
    for word in ("0", "nan", "soon"):
        done = project.runpytest_subprocess("--textmech-time-limit", word)
        assert done.ret == pytest.ExitCode.USAGE_ERROR
        done.stderr.fnmatch_lines([f"*should be a time in s above 0, is '{word}'*"])
