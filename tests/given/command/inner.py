"""pytest inside a test, in a fork."""

from typing import Any

import mujoco  # noqa: F401  # the fork has it, and need not import it
import pymunk  # noqa: F401
import pytest

from textmech.reports.front import session  # noqa: F401

from ..forked import forked


def inner(pytester: pytest.Pytester, *words: str) -> pytest.RunResult:
    """What pytest says in the folder of the test."""
    return pytest.RunResult(*forked(_run, pytester, words))


def _run(pytester: pytest.Pytester, words: tuple[str, ...]) -> tuple[Any, ...]:
    done = pytester.runpytest_inprocess(*words)
    return done.ret, done.outlines, done.errlines, done.duration
