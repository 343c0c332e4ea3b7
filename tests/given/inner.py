"""pytest inside a test: in a fork, where all that it needs is imported, and nothing it does stays.

A process of its own would import pandas and both engines again, and so would each of its workers.
"""

import multiprocessing
from multiprocessing.connection import Connection

import mujoco  # noqa: F401
import pymunk  # noqa: F401
import pytest

from textmech.reports import session  # noqa: F401

FORK = multiprocessing.get_context("fork")


def inner(pytester: pytest.Pytester, *words: str) -> pytest.RunResult:
    """What pytest says in the folder of the test."""
    here, there = FORK.Pipe(duplex=False)
    process = FORK.Process(target=_run, args=(pytester, words, there))
    process.start()
    there.close()
    try:
        code, out, err, seconds = here.recv()
    finally:
        process.join()
    return pytest.RunResult(code, out, err, seconds)


def _run(pytester: pytest.Pytester, words: tuple[str, ...], there: Connection) -> None:
    done = pytester.runpytest_inprocess(*words)
    there.send((done.ret, done.outlines, done.errlines, done.duration))
