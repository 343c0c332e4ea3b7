"""A session at whose end a file of the checkout is another one fails, and says which."""

import pytest

pytest_plugins = ["pytester"]

LOOKS = """\
from pathlib import Path
from given.command.checkout import Unchanged
def pytest_configure(config):
    config.pluginmanager.register(Unchanged(Path(__file__).parent))
"""
TABLE = "reports/tolerance.csv"


def ended(pytester: pytest.Pytester, line: str) -> tuple[int, list[str]]:
    """The exit code, and what is told, where a test does this and passes."""
    for part in ("cases", "reports"):
        pytester.mkdir(part)
    (pytester.path / TABLE).write_text("table", encoding="utf-8")
    pytester.makeconftest(LOOKS)
    pytester.makepyfile(f"from pathlib import Path\ndef test_it(): {line}")
    done = pytester.runpytest_inprocess()
    done.assert_outcomes(passed=1)
    return int(done.ret), [line for line in done.outlines if "CHANGED" in line]


@pytest.mark.mutant("a test that {does} in the checkout")
@pytest.mark.parametrize(
    ("does", "line", "changed"),
    [
        ("writes a table anew", f"Path({TABLE!r}).write_text('other')", TABLE),
        ("leaves a new file", "Path('cases/new.yaml').write_text('')", "cases/new.yaml"),
        ("deletes a file", f"Path({TABLE!r}).unlink()", TABLE),
    ],
)
def test_what_is_another_file_afterwards_is_told(
    pytester: pytest.Pytester, does: str, line: str, changed: str
) -> None:
    assert ended(pytester, line) == (1, [f"CHANGED while the tests ran: {changed}"])


@pytest.mark.parametrize(
    "line", [f"Path({TABLE!r}).write_text('table')", "Path('reports/.writing-x').write_text('')"]
)
def test_what_is_the_same_afterwards_is_not(pytester: pytest.Pytester, line: str) -> None:
    assert ended(pytester, line) == (0, [])
