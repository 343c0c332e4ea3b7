"""A run of four steps: its feet are where a leg that is reset in flight sets them, and its gait."""

import math
from typing import Any

import numpy as np
import pytest
from given.examples import example

from textmech.reference.motion.follow import Change, follow
from textmech.reference.system import Array
from textmech.reference.systems.walkers.running_gait import RunningGait, _Runner

G = 9.80665  # m/s²
TIMES = np.linspace(0.0, 1.0, 11)


def gait(**changes: float) -> RunningGait:
    found: Any = example("running_gait", **changes)
    return found


def events(system: RunningGait, name: str, times: Array = TIMES) -> list[Change]:
    return [event for event in follow(system, times).events if event.name == name]


def test_each_leg_touches_down_at_the_angle_of_the_first() -> None:
    """λ = λ₀, φ = α, and the rates with which the run began."""
    system = gait()
    begun = np.concatenate(system.start()[1:])
    downs = events(system, "touches down")
    assert len(downs) == 3
    for down in downs:
        assert down.after == pytest.approx(begun, abs=1e-11)


def test_a_leg_that_is_reset_in_flight_sets_its_feet_there() -> None:
    """Of the jump alone: its take-off, then a parabola until the leg at α reaches the floor."""
    run = gait()
    numbers = {name: getattr(run, name) for name in ("m", "c", "l0", "alpha", "vx0", "vy0")}
    feet = [0.0]
    for _ in range(3):
        jump = example("spring_mass_jump", **numbers)
        off = follow(jump, np.array([0.0, 0.3])).events[0].before
        x, y, _, vx, vy, _ = jump.modes["stance"].poses(0.0, *np.split(off, 2))["jumper"]
        low = numbers["l0"] * math.sin(numbers["alpha"])
        lasts = (vy + math.sqrt(vy * vy + 2 * G * (y - low))) / G
        feet.append(feet[-1] + x + vx * lasts - numbers["l0"] * math.cos(numbers["alpha"]))
        numbers |= {"vx0": vx, "vy0": vy - G * lasts}
    assert feet == pytest.approx(run.feet, abs=1e-12)


def ends(system: RunningGait) -> Array:
    run = follow(system, TIMES)
    q, v = np.split(run.y[-1], 2)
    return np.array(system.modes[run.modes[-1]].poses(0.0, q, v)["jumper"])


@pytest.mark.mutant(
    "running gait: a foot 1 mm off",
    "running gait: a flight seen from the foot that was left",
    "running gait: a leg that pulls in flight",
    "running gait: no weight in stance",
)
@pytest.mark.parametrize("mistake", ["a foot", "the leap", "a leg that pulls", "no weight"])
def test_a_mistake_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A foot 1 mm off; a flight seen from the foot that was left; stance in flight; no gravity."""
    sound = ends(gait())
    wrong = gait(x2=gait().x2 + 1e-3) if mistake == "a foot" else gait()
    if mistake == "the leap":
        monkeypatch.setattr(RunningGait, "_seen", lambda self, k, other, q, v: (q, v))
    elif mistake == "a leg that pulls":
        wrong.modes["flight 2"] = wrong.modes["stance 2"]  # type: ignore[index]
    elif mistake == "no weight":
        rates = _Runner.accelerations
        floats = lambda self, t, q, v: rates(self, t, q, v) + np.array([G * math.sin(q[1]), 0.0])  # noqa: E731
        monkeypatch.setattr(_Runner, "accelerations", floats)
    assert np.abs(ends(wrong) - sound).max() > 1e-3


def test_two_legs_at_once_are_no_run() -> None:
    """A second foot that the mass on the first has in reach."""
    system = gait(x2=-0.2)
    assert "to foot 2 is -" in str(system.possible("stance 1", 0.0, *system.start()[1:]))
    assert gait().possible("stance 1", 0.0, *gait().start()[1:]) is None
