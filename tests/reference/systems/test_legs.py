"""Masses on springs that only press: flights, energies, gaits, and mistakes planted in them."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.machines.examples import example
from given.mutants import mutant, with_mode
from scipy.integrate import solve_ivp

from textmech.cases.scene.quantity import at_event
from textmech.reference.motion.follow import Change, Followed, follow
from textmech.reference.system import Array, Guard, System
from textmech.reference.systems.walkers.running_gait import RunningGait, _Runner
from textmech.reference.systems.walkers.trunk_on_legs import TrunkOnLegs
from textmech.reports.compare.events.states import reference_states
from textmech.reports.compare.events.times import reference_events

# Masses on springs that only press: flights, energies, gaits, and mistakes planted in them.

G = 9.80665
STANCE = (80.0, 16000.0, 1.0)
TIMES = np.linspace(0.0, 0.8, 81)


def cartesian(x: float, y: float, vx: float, vy: float) -> tuple[float, Array]:
    """When the leg of `spring_mass_jump` is at its rest length again [s], and x, y, vx, vy then."""
    m, c, l0 = STANCE

    def slope(t: float, s: Array) -> list[float]:
        pushed = c / m * (l0 / math.hypot(s[0], s[1]) - 1.0)
        return [s[2], s[3], pushed * s[0], pushed * s[1] - G]

    def free(t: float, s: Array) -> float:
        return math.hypot(s[0], s[1]) - l0

    events: Any = free
    events.terminal, events.direction = True, 1.0
    found = solve_ivp(
        slope, (0.0, 1.0), [x, y, vx, vy], "DOP853", events=events, rtol=1e-13, atol=1e-13
    )
    assert found.t_events is not None
    assert found.y_events is not None
    return float(found.t_events[0][-1]), found.y_events[0][-1]


def jump(system: System) -> Followed:
    return follow(system, TIMES)


def poses(system: System, mode: str, y: Array) -> Array:
    q, v = np.split(y, 2)
    x, height, _, vx, vy, _ = system.modes[mode].poses(0.0, q, v)["jumper"]
    return np.array([x, height, vx, vy])


@pytest.mark.parametrize("alpha", [110.0, 115.0, 120.0])
def test_take_off_of_the_jump_in_other_coordinates(alpha: float) -> None:
    """Typed anew in x and y, and by another integrator: then a parabola."""
    leg = math.radians(alpha)
    system = example("spring_mass_jump", alpha=leg)
    found = jump(system)
    (off,) = found.events
    time, state = cartesian(math.cos(leg), math.sin(leg), 9.0, -0.2)
    assert off.name == "takes off"
    assert off.time == pytest.approx(time, abs=1e-12)
    assert poses(system, "stance", off.before) == pytest.approx(state, rel=1e-11)
    s = TIMES[-1] - time
    parabola = [*(state[:2] + s * state[2:]), state[2], state[3] - G * s]
    parabola[1] -= G * s * s / 2
    assert poses(system, "flight", found.y[-1]) == pytest.approx(parabola, rel=1e-11)


LATER: dict[str, Any] = {"g": lambda t, q, v: 1.001 - float(q[0])}


@pytest.mark.slow
@pytest.mark.mutant("a take-off 1 mm late", "a jumping leg that never lets go")
def test_a_leg_that_pulls_is_seen() -> None:
    """A take-off that is 1 mm late, and one at which the leg never lets go."""
    sound = example("spring_mass_jump")

    def late(self: System, mode: str) -> Sequence[Guard]:
        return [replace(guard, **LATER) for guard in sound.guards(mode)] if mode == "stance" else ()

    wrong = jump(mutant(sound, guards=late))
    assert abs(wrong.events[0].time - jump(sound).events[0].time) > 1e-4
    inside = [y for mode, y in zip(wrong.modes, wrong.y, strict=True) if mode == "stance"]
    beyond = np.array([1.0005, *inside[-1][1:]])
    assert "longer in stance" in str(sound.possible("stance", 0.0, *np.split(beyond, 2)))
    glued = jump(with_mode(sound, "flight", sound.modes["stance"]))
    assert np.abs(glued.y[-1] - jump(sound).y[-1]).max() > 0.1


def reached(y: float, phi: float) -> dict[str, str | None]:
    """What the trunk on two legs says of each mode, there."""
    trunk = example("trunk_on_legs")
    state = np.array([y, phi]), np.zeros(2)
    return {mode: trunk.possible(mode, 0.0, *state) for mode in trunk.modes}


def test_a_leg_of_the_trunk_that_pulls_or_passes_through_is_said() -> None:
    """Each leg by itself: level below its rest length, level above it, and pitched about it."""
    trunk: Any = example("trunk_on_legs")
    low, high = reached(0.95 * trunk.l0, 0.0), reached(1.05 * trunk.l0, 0.0)
    assert [mode for mode, said in low.items() if said is None] == ["stance"]
    assert [mode for mode, said in high.items() if said is None] == ["flight"]
    assert "the hind leg is 0.05 of its rest length longer in stance" in str(high["stance"])
    assert "the fore leg is 0.05 of its rest length longer in fore" in str(high["fore"])
    assert "the fore leg is -0.05 of its rest length longer in hind" in str(low["hind"])
    (sits,) = [mode for mode, said in reached(trunk.l0, 0.1).items() if said is None]
    assert sits == "hind"
    (sits,) = [mode for mode, said in reached(trunk.l0, -0.1).items() if said is None]
    assert sits == "fore"


@pytest.mark.mutant("a leg of the trunk that pulls, and nobody says so")
def test_a_trunk_that_never_says_so_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """By how much a leg is too long is a number that may be of any sign."""
    free = TrunkOnLegs._free
    monkeypatch.setattr(TrunkOnLegs, "_free", lambda self, leg, q: min(0.0, free(self, leg, q)))
    with pytest.raises((AssertionError, ValueError)):
        test_a_leg_of_the_trunk_that_pulls_or_passes_through_is_said()


ALPHA, SPEED = math.radians(112.0), 5.0  # 68° of attack at about 5 m/s: as published, it is stable
RUNS = 0.94030026326  # m: the apex of the gait that repeats itself
ENERGY = 80.0 * (SPEED**2 / 2 + G)


@pytest.mark.slow
def test_the_shipped_step_is_that_of_the_periodic_gait() -> None:
    """What touches down at the apex RUNS above takes off mirrored, and is there again."""
    case = scenes.SHIPPED["running_step"]
    numbers = case.parameters
    assert numbers["alpha"] == ALPHA
    assert numbers["vx0"] == pytest.approx(math.sqrt(2 * (ENERGY / 80.0 - G * RUNS)), rel=1e-9)
    assert numbers["vy0"] == pytest.approx(-math.sqrt(2 * G * (RUNS - math.sin(ALPHA))), rel=1e-9)
    solved = scenes.solved("running_step").trajectory
    assert solved.record is not None
    for name, value in {
        "takes_off.jumper.vx": numbers["vx0"],
        "takes_off.jumper.vy": -numbers["vy0"],
        "takes_off.jumper.y": math.sin(ALPHA),
        "apex.jumper.y": RUNS,
    }.items():
        at = at_event(name, case.events)
        assert at is not None
        times = reference_events(case.scene, solved.record, case.events[at.event])
        found = reference_states(case, solved.record, at, times)
        assert found == pytest.approx([value], rel=1e-8), name


# A run of four steps: its feet are where a leg that is reset in flight sets them, and its gait.

SECOND = np.linspace(0.0, 1.0, 11)


def gait(**changes: float) -> RunningGait:
    found: Any = example("running_gait", **changes)
    return found


def events(system: RunningGait, name: str, times: Array = SECOND) -> list[Change]:
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
    run = follow(system, SECOND)
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
