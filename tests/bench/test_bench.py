"""A run is compared with the plain loop of the same motion, and with no other."""

import csv
import io
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result
from given.adapters.planning import CASES, SHIPPED, TUNED, planned
from given.command import NEW

from bench import __main__ as command
from bench import reference
from bench.adapters import LOOPS, Loop, Pair, rows
from bench.row import Work, in_turn, ratio
from bench.start import BOUNDS, least, lines
from textmech.cases.case import Case
from textmech.cases.scene import Scene
from textmech.cases.trajectory import Array
from textmech.engines.engine import Engine, Plan, Start

FEW = (1, 1)  # steps, rounds


def briefly(name: str, duration: float) -> Case:
    return replace(CASES[name], duration=duration)


@pytest.mark.parametrize("engine", [*SHIPPED.values(), *TUNED.values()], ids=str)
@pytest.mark.parametrize("name", ["four_bar", "rolling_wheel.pushed", "towed_pendulum"])
def test_a_plain_loop_makes_the_adapters_motion(name: str, engine: Engine) -> None:
    """To the last bits: it takes the same steps."""
    both = list(rows(briefly(name, 0.02), [engine], *FEW))
    assert [row.over for row in both] == ["plain loop, samples", "plain loop, every step"]
    assert all(row.ratio > 0 and not row.wrong for row in both)


@pytest.mark.mutant("plain loop of {name} with another gravity")
@pytest.mark.parametrize("name", TUNED)
def test_another_motion_is_not_compared(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    loop = LOOPS[name]

    def heavier(
        engine: Engine, scene: Scene, start: Start, step: float, plan: Plan
    ) -> Callable[[], Loop]:
        x, y = scene.gravity
        scene = replace(scene, gravity=(x, 1.001 * y))
        return loop(engine, scene, start, step, planned(engine, scene, start, plan.realised))

    monkeypatch.setitem(LOOPS, name, heavier)
    (row,) = rows(briefly("four_bar", 0.2), [TUNED[name]], *FEW)
    assert row.wrong
    assert np.isnan(row.ratio)
    assert "another motion" in row.note


@pytest.mark.parametrize("name", ["four_bar", "growing_force"])  # with gravity, and without
def test_no_round_finds_its_scene_built(name: str) -> None:
    case, engine = CASES[name], SHIPPED["mujoco"]
    pair = Pair(case, {}, engine, Plan("native", held=(1,)), 1)
    gravities = [pair.unseen(k).gravity for k in range(5)]
    assert len({case.scene.gravity, *gravities}) == 6
    for gravity in gravities:
        assert gravity == pytest.approx(case.scene.gravity, rel=1e-14, abs=1e-200)


def measure(*words: object) -> Result:
    return CliRunner().invoke(command.bench, [str(word) for word in words])


@pytest.mark.slow
def test_a_case_of_ones_own_is_measured(tmp_path: Path) -> None:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    done = measure(file, "--rounds", 1, "--steps", 1)
    assert done.exit_code == 0, done.output
    assert "plain loop, every step" in done.stdout
    done = measure(file, "--engine", "pymunk.tuned", "--rounds", 1, "--steps", 1, "--csv")
    found = list(csv.DictReader(io.StringIO(done.stdout)))
    assert [row["name"] for row in found] == ["cart in pymunk.tuned"] * 2
    assert measure(file, "--engine", "book").exit_code == 2


def test_a_ratio_is_of_one_round_and_outlives_a_disturbed_one() -> None:
    slow = np.array([1.0, 10.0, 1.0, 10.0, 1.0])  # the machine, in both works
    assert ratio(1.1 * slow, slow) == (pytest.approx(1.1), pytest.approx(0.0))
    assert ratio(np.array([1.0, 1.1, 9.0, 1.2, 1.3]), np.ones(5)) == (1.2, pytest.approx(0.1))


def test_works_are_made_and_done_in_turn() -> None:
    done: list[str] = []

    def named(name: str) -> Callable[[int], Work]:
        def make(k: int) -> Work:
            done.append(f"make {name}{k}")
            return lambda: done.append(f"{name}{k}")

        return make

    assert in_turn([named("a"), named("b")], 2).shape == (2, 2)
    assert done == ["make a0", "a0", "make b0", "b0", "make a1", "a1", "make b1", "b1"]


def test_a_method_takes_the_loosest_tolerance_that_will_do() -> None:
    truth = np.zeros(1)

    def off(tolerance: float) -> Array:
        return np.array([20 * tolerance])

    assert reference.loosest(off, truth, 1e-8)[0] == pytest.approx(10**-9.5)
    assert reference.loosest(off, truth, 1e-30)[0] is None
    assert reference.loosest(off, truth, 1e-8, patience=-1.0)[0] is None


@pytest.mark.slow
def test_integrators_and_chains_are_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reference, "ERRORS", {"bar_pendulum": 1e-6})
    (row,) = reference.integrators(1)
    assert row.over in reference.SCIPYS
    assert row.ratio > 0
    assert [row.note for row in reference.scenes({False: 2, True: 2})] == ["", ""]


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
MODULES = "import atexit, sys; atexit.register(lambda: sys.stderr.write('|'.join(sys.modules)));"


def imported(words: list[str], first: str = "") -> set[str]:
    """Returns which of HEAVY are imported at the end."""
    _, code, *more = words
    program = [sys.executable, "-c", f"{MODULES} {first}{code}", *more]
    done = subprocess.run(program, capture_output=True, text=True, check=True, timeout=120)
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
