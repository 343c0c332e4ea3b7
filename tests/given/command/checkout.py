"""Whether tests leave the checkout as it was: a plug-in that looks at it before and after."""

from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

import pytest

PARTS = ("cases", "reference", "engines", "reports", "tests")
OTHERS = ("README.md", "CONTRIBUTING.md", "Makefile", "pyproject.toml")
PROGRAMS = (".py", ".pyc")  # no test writes one, and a person may while the tests run


def digests(root: Path) -> dict[str, str]:
    """Of each file that is no program, by its path; what is hidden does not count."""
    files = [file for part in PARTS for file in (root / part).rglob("*")]
    files += [root / name for name in OTHERS]
    names = {file: file.relative_to(root) for file in files if file.is_file()}
    return {
        name.as_posix(): sha256(file.read_bytes()).hexdigest()
        for file, name in names.items()
        if file.suffix not in PROGRAMS
        and not any(part.startswith((".", "__pycache__")) for part in name.parts)
    }


def differing(before: Mapping[str, str], after: Mapping[str, str]) -> list[str]:
    """What is another file, or is gone, or is new."""
    names = before.keys() | after.keys()
    return sorted(name for name in names if before.get(name) != after.get(name))


class Unchanged:
    """Fails a session at whose end a file is not what it was; a worker of xdist looks at none."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.before = digests(root)
        self.changed: list[str] = []

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """After the last test, of all workers."""
        self.changed = differing(self.before, digests(self.root))
        if self.changed and session.exitstatus == pytest.ExitCode.OK:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Which files."""
        for name in self.changed:
            terminalreporter.write_line(f"CHANGED while the tests ran: {name}", red=True)
