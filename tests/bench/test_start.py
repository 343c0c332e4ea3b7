"""A command imports what it needs, and no more: that is what its start costs."""

import subprocess
import sys

import pytest

from bench import table
from bench.start import BOUNDS, Begun, begun, least, lines

HEAVY = (
    *("numpy", "pydantic", "ruamel.yaml", "pint", "pandas", "matplotlib", "jinja2"),
    *("scipy.linalg", "scipy.special", "scipy.optimize", "scipy.interpolate"),
    *("mujoco", "pymunk"),
)
NEEDED = {
    "--help": set(),
    "import": {"numpy", "pydantic"},
    "list": {"ruamel.yaml"},
    "show": {"numpy", "pydantic", "ruamel.yaml", "pint", "mujoco"},
    "check": {"numpy", "pydantic", "ruamel.yaml", "pint", "mujoco", "pymunk", "scipy.linalg"},
}
TOLD = "import atexit, sys; atexit.register(lambda: sys.stderr.write('|'.join(sys.modules)));"


def imported(words: list[str], first: str = "") -> set[str]:
    """Which of the heavy ones are there at the end."""
    _, code, *more = words
    command = [sys.executable, "-c", f"{TOLD} {first}{code}", *more]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    return {*HEAVY} & {*done.stderr.splitlines()[-1].split("|")}


@pytest.mark.mutant("what starts imports pandas, which it has no use for")
@pytest.mark.parametrize("name", NEEDED)
@pytest.mark.slow
def test_a_start_imports_what_it_needs(name: str) -> None:
    words = lines()[name]
    assert imported(words) <= NEEDED[name]
    assert not imported(words, "import pandas; ") <= NEEDED[name]


def test_every_start_has_a_bound() -> None:
    assert lines().keys() == BOUNDS.keys() == NEEDED.keys()


@pytest.mark.slow
def test_what_takes_longer_costs_more() -> None:
    assert least(["-c", "sum(range(10**7))"], 1) > least(["-c", ""], 1) > 0.0


def test_each_start_is_measured_beside_its_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    from bench import start

    took = iter([0.5, 0.1, 0.6, 0.2, 0.2, 0.2])
    monkeypatch.setattr(start, "least", lambda words, rounds: next(took))
    rows = [*begun(3)]
    assert rows[1] == Begun("list", 0.6, BOUNDS["list"], 0.6 / 0.5)
    head, first, second, *_ = table.start(rows)
    assert head.split()[-2:] == ["import", "numpy"]
    assert first.split() == ["--help", "0.10", "s", "0.20", "s", "0.2"]
    assert second.endswith("1.2  above")
    assert all(len(line) <= 80 for line in table.start(rows))
