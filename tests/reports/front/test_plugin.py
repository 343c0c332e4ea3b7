"""The pytest plug-in, as it behaves in somebody else's project."""

import sys
import tomllib
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast
from xml.etree import ElementTree as ET

import pytest
from given.command.inner import inner
from given.command.lines import row
from given.command.report_folders import CERTIFICATE
from given.otherwise import otherwise
from given.scenes.pendulum import pendulum
from given.scenes.swing import SWING, swing

from textmech.cases.find import shipped
from textmech.cases.mistake import Mistake
from textmech.reports.front import pytest_plugin
from textmech.reports.front.pytest_plugin import _configured
from textmech.reports.tables import committed
from textmech.reports.tables.row import (
    AGREES,
    BEYOND,
    CRASHED,
    DEVIATES,
    DIVERGED,
    FAILS,
    REFUSED,
    Comparison,
)

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
    done = inner(project, "swing.yaml", "-v", "--textmech-engine", "mujoco.tuned")
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
    root = Path(__file__).parents[3]
    told = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))

    class Config:
        rootpath = root

        def getini(self, name: str) -> list[str]:
            return [told["tool"]["pytest"]["ini_options"][name]]

    files = {*(root / "cases").rglob("*.yaml")}
    assert {*shipped().values()} <= files
    assert {file.parent.name for file in files} == {"cases", "models", "questions"}
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
        "from textmech.reports.compare.trial.limit import limit\n"
        "def test_own(): assert limit() == 2.5"
    )
    inner(project, "--textmech-time-limit", "2.5").assert_outcomes(passed=1)
    for word in ("0", "nan", "soon"):
        done = inner(project, "--textmech-time-limit", word)
        assert done.ret == pytest.ExitCode.USAGE_ERROR
        done.stderr.fnmatch_lines([f"*should be a time in s above 0, is '{word}'*"])


# What must be red in pytest: a reference, an audit, and a row that got worse.

# `spawn` would lose what a conftest changed: the workers of these runs are forks.
WORSE = """\
import multiprocessing
from dataclasses import fields
from pathlib import Path
from mujoco import __version__ as version
from textmech.reports.tables.row import Comparison
from textmech.reports.tables import committed
multiprocessing.set_start_method("fork", force=True)
key = ("swing", "mujoco", "shipped", "native", "rod.angle")
said = dict.fromkeys(field.name for field in fields(Comparison))
said |= dict(version=version, step=0.002, error=1.0, verdict={verdict!r})
committed.rows = lambda: {{key: Comparison(**said)}}
committed.is_shipped = lambda file: Path(file).name == "swing.yaml"
"""


@pytest.mark.slow
@pytest.mark.parametrize(("verdict", "red"), [("agrees", 1), ("beyond", 0)])
def test_a_row_that_got_worse_is_red(project: pytest.Pytester, verdict: str, red: int) -> None:
    project.makefile(".yaml", swing=swing("1.0e-6"))
    project.makeconftest(WORSE.format(verdict=verdict))
    done = inner(project, "swing.yaml", "--textmech-engine", "mujoco.shipped")
    done.assert_outcomes(passed=2, failed=red, xfailed=1 - red)
    if red:
        done.stdout.fnmatch_lines(["*committed*"])


# The plug-in where a file has mistakes, or asks for endless work.

ONLY = ("--textmech-engine", "mujoco.tuned")


@pytest.mark.slow
def test_a_mistake_that_solving_finds_costs_its_own_file(pytester: pytest.Pytester) -> None:
    pytester.makefile(".yaml", good=pendulum(), still=pendulum(angle="-90 deg"))
    done = inner(pytester, "good.yaml", "still.yaml", *ONLY)
    done.assert_outcomes(passed=3, failed=3)  # each: the reference, the audit, the angle
    done.stdout.fnmatch_lines(["*still.yaml:11:9: allow.rod.angle: never moves*"])


@pytest.mark.slow
def test_endless_work_is_said_and_allow_long_goes_on(pytester: pytest.Pytester) -> None:
    pytester.makefile(".yaml", slow=pendulum(step=1e-9))
    done = inner(pytester, "slow.yaml", *ONLY)
    done.assert_outcomes(failed=1)
    done.stdout.fnmatch_lines(["*slow.yaml:10:1: step: *--textmech-allow-long*"])
    done = inner(pytester, "slow.yaml", "--textmech-allow-long", "--collect-only", "-q", *ONLY)
    done.stdout.fnmatch_lines(["slow.yaml::slow-mujoco.tuned-rod.angle"])


@pytest.mark.slow
def test_the_settings_of_the_ini_file_may_be_of_another_engine(pytester: pytest.Pytester) -> None:
    """What its settings are for may be all that is not asked now; who names a file means it."""
    pytester.makefile(".yaml", good=pendulum(), mine="pymunk: {step: 2.5e-3}\n")
    pytester.makeini("[pytest]\ntextmech_settings = mine.yaml\n")
    done = inner(pytester, "good.yaml", "--collect-only", "-q", *ONLY)
    done.stdout.fnmatch_lines(["good.yaml::good-mujoco.tuned-rod.angle"])
    done = inner(pytester, "good.yaml", "--textmech-settings", "mine.yaml", *ONLY)
    done.assert_outcomes(errors=1)
    done.stdout.fnmatch_lines(["*--textmech-settings: mine.yaml: no chosen engine uses it*"])


# What a row is in pytest: passed, failed, or a failure that was expected.

PASSED, FAILED, EXPECTED = "passed", "failed", "xfailed"


def ended(module: Any, kind: str, item: Any) -> str:
    """What pytest calls a test that ends so."""
    try:
        getattr(module, kind).runtest(item)
    except pytest.xfail.Exception:
        return EXPECTED
    except module.RowError:
        return FAILED
    return PASSED


def of_row(
    found: Comparison, module: Any = pytest_plugin, *, promised: bool = False, lost: str = ""
) -> str:
    """A row's own test. lost: what is said of it beside the committed one."""
    item = SimpleNamespace(
        row=lambda: found,
        case=SimpleNamespace(),
        path=Path("swing.yaml"),
        place=lambda *_: 1,
        user_properties=[],
        promised=promised,
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(committed, "worse", lambda case, row: lost)
        return ended(module, "ComparisonItem", item)


@pytest.mark.mutant("a failed row's path comes before its size")
@pytest.mark.parametrize(
    ("found", "line"),
    [
        ({"verdict": FAILS}, "×7.92 of 0.01 rad at 2.9 s"),
        ({"verdict": BEYOND, "when": None}, "×7.92 of 0.01 rad"),
        ({"verdict": DIVERGED, "ratio": None, "because": "it fell"}, "diverged: it fell"),
    ],
)
def test_a_failure_says_first_how_large_it_is(
    found: dict[str, Any], line: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """For pytest's short summary shows the beginning of the first line alone."""
    numbers = {"ratio": 7.919, "allowed": 0.01, "unit": "rad", "when": 2.9, "because": ""}
    told = replace(row(), **{**numbers, **found})

    monkeypatch.setattr(committed, "worse", lambda case, row: "")

    def said(module: Any = pytest_plugin) -> str:
        item = SimpleNamespace(
            row=lambda: told, case=SimpleNamespace(), path=Path("a.yaml"), place=lambda *_: 1,
            user_properties=[], promised=True,
        )  # fmt: skip
        with pytest.raises(module.RowError) as error:
            module.ComparisonItem.runtest(item)
        return str(error.value).splitlines()[0]

    assert said() == line
    if told.verdict == FAILS:
        was = "{_size_text(row)}\\n{place}: {row.quantity}\\n"
        path = otherwise(pytest_plugin, was, "{place}: {row.quantity}\\n")
        assert said(path).startswith("a.yaml:1")


def of_certificate(verdict: str, module: Any = pytest_plugin) -> str:
    """The test of a reference of which one of two checks has that verdict."""
    rows = [replace(CERTIFICATE, check="power"), replace(CERTIFICATE, verdict=verdict)]
    report = SimpleNamespace(certificates=rows)
    item = SimpleNamespace(report=lambda: report, case=SimpleNamespace(name=CERTIFICATE.case))
    return ended(module, "CertificateItem", item)


@pytest.mark.parametrize(
    ("verdict", "word"),
    [
        (AGREES, PASSED),
        (DEVIATES, PASSED),
        (BEYOND, EXPECTED),
        (DIVERGED, EXPECTED),
        (CRASHED, EXPECTED),
        (REFUSED, EXPECTED),
        ("changed", EXPECTED),
        (FAILS, FAILED),
    ],
)
def test_only_what_agrees_passes(verdict: str, word: str) -> None:
    assert of_row(replace(row(), verdict=verdict)) == word


@pytest.mark.mutant("beyond is a pass in pytest")
def test_a_finding_is_no_pass() -> None:
    found = replace(row(), verdict=BEYOND)
    passes = otherwise(
        pytest_plugin, "not in (AGREES, DEVIATES)", "not in (AGREES, DEVIATES, 'beyond')"
    )
    assert (of_row(found), of_row(found, passes)) == (EXPECTED, PASSED)


@pytest.mark.mutant("what a user's own settings have to keep is an expected failure")
def test_ones_own_settings_have_to_agree() -> None:
    """But what an engine cannot do, no setting can."""
    found = replace(row(), verdict=BEYOND)
    was = "if self.promised and row.verdict != REFUSED:"
    blind = otherwise(pytest_plugin, was, "if False:")
    assert of_row(found, promised=True) == FAILED
    assert of_row(found, blind, promised=True) == EXPECTED
    assert of_row(replace(found, verdict=DIVERGED), promised=True) == FAILED
    assert of_row(replace(found, verdict=REFUSED), promised=True) == EXPECTED
    assert of_row(row(), promised=True) == PASSED


@pytest.mark.mutant("a failed audit is an expected failure in pytest")
def test_an_audit_that_fails_is_no_finding() -> None:
    found = replace(row(), quantity="audit", verdict=FAILS)
    was = "if row.verdict == FAILS:"
    lenient = otherwise(pytest_plugin, was, f'{was[:-1]} and row.quantity != "audit":')
    assert (of_row(found), of_row(found, lenient)) == (FAILED, EXPECTED)


@pytest.mark.mutant("a row that got worse than committed passes in pytest")
@pytest.mark.parametrize(("verdict", "otherwise_"), [(AGREES, PASSED), (BEYOND, EXPECTED)])
def test_a_row_that_got_worse_than_committed_fails(verdict: str, otherwise_: str) -> None:
    lost = "above 10 × the committed 1e-9"
    found = replace(row(), verdict=verdict)
    blind = otherwise(pytest_plugin, "if lost:", "if lost and False:")
    assert (of_row(found, lost=lost), of_row(found, blind, lost=lost)) == (FAILED, otherwise_)


@pytest.mark.mutant("an uncertified reference passes in pytest")
def test_a_reference_of_which_one_check_fails_fails() -> None:
    blind = otherwise(pytest_plugin, "if broken:", "if broken and False:")
    assert of_certificate("holds") == PASSED
    assert (of_certificate(FAILS), of_certificate(FAILS, blind)) == (FAILED, PASSED)


def asked(file: str, module: Any = pytest_plugin) -> str:
    """What becomes of a row of that file, where only bad.yaml has a mistake."""
    report = SimpleNamespace(mistakes=[Mistake("bad.yaml", 1, 1, "title", "missing")])
    source = SimpleNamespace(source=SimpleNamespace(file=file))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_session_report", lambda session: report)
        try:
            module.CaseItem.report(SimpleNamespace(session=None, case=source))
        except module.RowError as error:
            return f"fails: {error}"
    return "is run"


@pytest.mark.mutant("the mistakes of a file are told of all others")
def test_mistakes_cost_their_own_file() -> None:
    assert asked("bad.yaml") == "fails: bad.yaml:1:1: title: missing"
    assert asked("good.yaml") == "is run"
    blamed = otherwise(pytest_plugin, "        if mine:", "        if not mine:")
    assert asked("good.yaml", blamed).startswith("fails")
