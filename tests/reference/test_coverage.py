"""Which equations count as used: those whose function runs."""

import cProfile
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.watched import Oscillator, Watched

from textmech.reference import coverage
from textmech.reference.coverage import CALLS, equations, look, noting
from textmech.reference.laws import momentum
from textmech.reference.laws.force import spring, weight
from textmech.reference.motion import follow as motion
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Mode


@pytest.mark.parametrize(
    ("docstring", "numbers"),
    [
        ("(2.44) d/dt ∂T/∂q̇", ["2.44"]),
        ("(2.23), (2.27) m r̈_c = F", ["2.23", "2.27"]),
        ("(2.23), (2.27): all of it", ["2.23", "2.27"]),
        ("(2.1) r = r_c + d and (2.6) ṙ", ["2.1"]),
        ("(2.1) and (2.6) r", ["2.1", "2.6"]),
        ("(2.10) is not (2.1)", ["2.10"]),
        ("\n    (2.14) on the next line", ["2.14"]),
        ("Newton's law (2.23)", []),
        ("2.23 without brackets", []),
        ("(3.1) another chapter", []),
        ("", []),
        (None, []),
    ],
)
def test_equations_that_open_a_docstring(docstring: str | None, numbers: list[str]) -> None:
    assert equations(docstring) == numbers


def noted(work: Callable[[], object]) -> set[str]:
    with noting() as found:
        work()
    return found


def test_only_what_runs_is_noted() -> None:
    assert noted(lambda: spring(1.0, 0.5, (1.0, 0.0))) == {"2.82"}
    assert noted(lambda: None) == set()


def test_naming_a_function_is_not_running_it() -> None:
    assert noted(lambda: momentum.spin_rate) == set()


def test_what_is_not_of_the_reference_does_not_count() -> None:
    def elsewhere() -> None:
        """(2.99) A docstring in a test."""

    assert noted(elsewhere) == set()


def test_another_profiler_is_put_back_even_after_an_error() -> None:
    before = sys.getprofile()
    with pytest.raises(ZeroDivisionError):
        noted(lambda: 1 / 0)
    assert sys.getprofile() is before


def test_a_profile_of_the_whole_goes_on_after_it() -> None:
    """cProfile's is no function that `sys.setprofile` would take."""
    profile = cProfile.Profile()
    profile.enable()
    try:
        assert noted(lambda: spring(1.0, 0.5, (1.0, 0.0))) == {"2.82"}
        equations("(2.44) seen by the profile")
    finally:
        profile.disable()
    seen = {getattr(entry.code, "co_name", "") for entry in profile.getstats()}
    assert "equations" in seen


def test_a_watch_ends_and_starts_anew() -> None:
    def long() -> None:
        for _ in range(CALLS + 1):
            equations(None)
        spring(1.0, 0.5, (1.0, 0.0))

    def looking() -> None:
        long()
        look()
        spring(1.0, 0.5, (1.0, 0.0))

    assert noted(long) == set()
    assert noted(looking) == {"2.82"}


class Falls(Mode):
    """Pulled by a spring, which no phase before it is."""

    coordinates = ("x",)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return -np.array(spring(1.0, 0.5, (float(q[0]) + 9.0, 0.0))[:1])


def late() -> None:
    swing = Watched([(None, lambda t, x, v: x)], Oscillator(), "off")
    swing.modes = {**swing.modes, "off": Falls()}
    follow(swing, np.array([0.0, 1.5, 1.6]))


def test_what_begins_late_is_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """A phase after the end of the watch; without `look` its equations would be lost."""
    monkeypatch.setattr(coverage, "CALLS", 300)
    assert noted(late) == {"2.82"}
    monkeypatch.setattr(motion, "look", lambda: None)
    assert noted(late) == set()


def test_looking_alone_does_nothing() -> None:
    before = sys.getprofile()
    look()
    assert sys.getprofile() is before


def test_of_two_watches_the_inner_one_looks() -> None:
    """And the outer one goes on when the inner one ends."""
    inner: set[str] = set()

    def outer() -> None:
        def within() -> None:
            look()
            spring(1.0, 0.5, (1.0, 0.0))

        inner.update(noted(within))
        weight(1.0, (0.0, -1.0))

    assert noted(outer) == {"2.81"}
    assert inner == {"2.82"}


@pytest.mark.slow
def test_claimed_equations_are_executed() -> None:
    for name, case in scenes.EVERY.items():
        left = sorted(set(case.origin.equations) - scenes.solved(name).equations)
        assert not left, f"{name} claims {left}, which nothing in its solution executes"


@pytest.mark.mutant("the calls of an import count among those that a watch looks at")
def test_an_import_is_not_looked_at(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else a case solved first in a process would be noted as using less than later."""
    lines = f"def f():\n    pass\nfor _ in range({CALLS + 1}):\n    f()\n"
    (tmp_path / "calls_much.py").write_text(lines, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)

    def work() -> None:
        import_module("calls_much")
        spring(1.0, 0.5, (1.0, 0.0))

    assert noted(work) == {"2.82"}
