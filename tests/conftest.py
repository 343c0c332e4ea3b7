"""The tests write nothing in the checkout."""

from pathlib import Path

import pytest
from given.checkout import Unchanged


def pytest_configure(config: pytest.Config) -> None:
    """Of the session itself: its workers would see each other's moment."""
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(Unchanged(Path(__file__).parents[1]))
