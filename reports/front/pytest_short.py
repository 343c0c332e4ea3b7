"""`--engine` and `--case` for this project's own pytest.

Not part of the installed plug-in: in somebody else's project these names may be taken.
"""

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds `--engine` and `--case`, short for the plug-in's own options."""
    group = parser.getgroup("textmech")
    for name in ("engine", "case"):
        group.addoption(
            f"--{name}",
            action="append",
            dest=f"textmech_{name}",
            default=[],
            metavar=name[0].upper(),
            help=f"short for --textmech-{name}",
        )
