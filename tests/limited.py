"""A plug-in of pytest for one planted mistake: bounds of work, and what was run until when.

Which test is under way stands in a file before it starts: who is killed in it can say nothing.
"""

import json
import os
import resource
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

TOLD, WORK, EACH = "MUTANT_TOLD", "MUTANT_WORK", "MUTANT_EACH"
"""Of the environment: the file; CPU seconds of all tests, and of one."""


def work() -> float:
    """CPU seconds of this process and of those that it has waited for."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


class Limits:
    """Ends the session where all tests took too long, and the process where one did."""

    def __init__(self, told: Path, whole: float, each: float) -> None:
        self.told, self.whole, self.each = told, whole, each
        self.state = {"at": "", "failed": "", "run": 0, "stopped": False, "work": 0.0}

    def tell(self) -> None:
        """Leaves what is known so far in the file."""
        self.state["work"] = work()
        self.told.write_text(json.dumps(self.state), encoding="utf-8")

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """One test, that may take its own share of work and no more."""
        self.state["at"] = item.nodeid
        self.tell()
        bound = int(time.process_time() + self.each) + 1
        resource.setrlimit(resource.RLIMIT_CPU, (bound, resource.getrlimit(resource.RLIMIT_CPU)[1]))
        done = yield
        self.state["run"] += 1
        if work() > self.whole:
            self.state["stopped"] = True
            item.session.shouldstop = "out of time"
        return done

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """The first that fails, in its set-up or its end too."""
        if report.failed:
            self.state["failed"] = self.state["failed"] or report.nodeid

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """A file that cannot be imported any more."""
        if report.failed:
            self.state["failed"] = self.state["failed"] or report.nodeid

    def pytest_sessionfinish(self) -> None:
        """What is known at the end."""
        self.tell()


def pytest_configure(config: pytest.Config) -> None:
    """Only where it is told its bounds."""
    if TOLD in os.environ:
        told, whole, each = Path(os.environ[TOLD]), os.environ[WORK], os.environ[EACH]
        config.pluginmanager.register(Limits(told, float(whole), float(each)))
