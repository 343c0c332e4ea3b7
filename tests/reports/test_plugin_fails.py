"""What must be red in pytest: a reference, an audit, and a row that got worse."""

import pytest
from given.inner import inner
from given.swing import swing

pytest_plugins = ["pytester"]

# `spawn` would lose what a conftest changed: the workers of these runs are forks.
FORKED = "import multiprocessing; multiprocessing.set_start_method('fork', force=True)\n"
WORSE = """\
from pathlib import Path
from dataclasses import fields
from textmech.reports.output import committed
from textmech.reports.data.row import Comparison
key = ("swing", "mujoco", "shipped", "native", "rod.angle")
said = dict.fromkeys(field.name for field in fields(Comparison))
said |= dict(version={version!r}, step=0.002, error={largest}, verdict={verdict!r})
committed.rows = lambda: {{key: Comparison(**said)}}
committed.is_shipped = lambda file: Path(file).name == "swing.yaml"
"""


def run(pytester: pytest.Pytester, change: str, engine: str = "mujoco.shipped") -> pytest.RunResult:
    pytester.makefile(".yaml", swing=swing("1.0e-6"))
    pytester.makeconftest(FORKED + change)
    return inner(pytester, "swing.yaml", "--textmech-engine", engine)


@pytest.mark.slow
def test_a_reference_that_is_not_certified_is_red(pytester: pytest.Pytester) -> None:
    change = "import textmech.reference.certificate.agreement as a; a.Check.holds = False\n"
    done = run(pytester, change)
    assert done.ret == pytest.ExitCode.TESTS_FAILED
    done.assert_outcomes(failed=3)  # the reference, and nothing can be judged by it
    done.stdout.fnmatch_lines(["*the reference (generated) is not certified*"])


@pytest.mark.slow
def test_an_audit_that_fails_is_red(pytester: pytest.Pytester) -> None:
    done = run(pytester, "import textmech.reports.compare.judge.compare as c; c.EQUAL = -1.0\n")
    done.assert_outcomes(passed=1, failed=1, xfailed=1)
    done.stdout.fnmatch_lines(["*: audit*", "*FAILS*"])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("version", "largest", "verdict", "red"),
    [
        ("installed", "1.0", "agrees", True),
        ("installed", "1e-9", "beyond", True),
        ("installed", "1.0", "beyond", False),
        ("another", "1.0", "agrees", False),
    ],
)
def test_a_row_that_got_worse_is_red(
    pytester: pytest.Pytester, version: str, largest: str, verdict: str, red: bool
) -> None:
    from mujoco import __version__ as installed

    known = installed if version == "installed" else version
    done = run(pytester, WORSE.format(version=known, largest=largest, verdict=verdict))
    done.assert_outcomes(passed=2, failed=int(red), xfailed=int(not red))
    if red:
        done.stdout.fnmatch_lines(["*committed*"])
