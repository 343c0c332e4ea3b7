"""The tests write nothing in the checkout, and strike what they start by Ctrl-C."""

import gc
import signal
from pathlib import Path

import pytest
from given.checkout import Unchanged


def pytest_configure(config: pytest.Config) -> None:
    """Of the session itself: its workers would see each other's moment."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # begun by `&`; it is inherited
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(Unchanged(Path(__file__).parents[1]))


def pytest_collection_finish() -> None:
    """What is collected stays to the end: no search for garbage has to pass through it."""
    gc.freeze()
