"""A function in a fork of the test's process: what it needs is imported, what it does is gone.

A process of its own would import pandas and both engines again, and so would each of its workers.
"""

import multiprocessing
from collections.abc import Callable
from pathlib import Path
from typing import Any

FORK = multiprocessing.get_context("fork")


def forked(function: Callable[..., Any], *arguments: Any) -> Any:
    """What it returns. Raises EOFError if it raises: the fork prints why."""
    here, there = FORK.Pipe(duplex=False)
    process = FORK.Process(target=lambda: there.send(function(*arguments)))
    process.start()
    there.close()
    try:
        return here.recv()
    finally:
        process.join()


TOLD = Path("/proc/self/status").exists()
"""Whether the system tells what runs."""


def runs(process: int) -> bool:
    """Whether it does: one that has ended and that nobody has asked for does not."""
    status = Path(f"/proc/{process}/status")
    return status.exists() and "State:\tZ" not in status.read_text(encoding="utf-8")
