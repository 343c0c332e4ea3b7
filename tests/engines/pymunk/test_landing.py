"""Bars' ends on the floor, and landings: forces at every sample, and nothing lost in the floor."""

from pathlib import Path

import numpy as np
import pytest
from given.engine_scenes import WHEEL, G, incline, launched, machine, touching
from given.planning import TUNED, every, moved
from given.scenes import tail, typed

from textmech.cases.case import Case
from textmech.cases.observe import observe
from textmech.cases.scene import Anchor, Push, Signal
from textmech.cases.shape import bar
from textmech.cases.trajectory import Trajectory, Y
from textmech.reference.solve import solve
from textmech.reports.events.times import engine_events, reference_events
from textmech.reports.trial.start import first

ENGINE = TUNED["pymunk"]
LEANING = """\
scene:
  bodies: {rod: {bar: {mass: 2, length: 0.8}}}
  contacts: {tip: {between: [rod.start, ground.floor], friction: MU}}
initial: {rod: {start: [0, 0], angle: START deg}}
allow: {rod.angle: 1.0e-3}
"""
DROPPED = """\
scene:
  bodies: {rod: {bar: {mass: 2, length: 0.8}}}
  contacts: {tip: {between: [rod.start, ground.floor], friction: 0.3}}
events: {lands: {tip.gap: falls to zero}}
initial: {rod: {start: [0, 0.1], angle: 50 deg}}
allow: {rod.angle: 1.0e-3}
"""
HINGED = """\
scene:
  points: {O: [0, 0.3]}
  bodies: {rod: {bar: {mass: 2, length: 0.8}}}
  joints: {hinge: {pin: [ground.O, rod.start]}}
  contacts: {tip: {between: [rod.end, ground.floor], friction: 0}}
events: {lands: {tip.gap: falls to zero}}
initial: {rod: {angle: 20 deg}}
allow: {rod.angle: 1.0e-3}
"""
HOPPER = """\
scene:
  points: {O: [0, 0]}
  bodies: {body: {particle: {mass: 3}}, foot: {particle: {mass: 0.5}}}
  joints:
    mast: {slide: [ground.O, body.center], along: [0, 1]}
    guide: {slide: [ground.O, foot.center], along: [0, 1]}
  contacts: {touch: {between: [foot, ground.floor], friction: 0.0}}
  forces: {leg: {spring: [body.center, foot.center], stiffness: 500, rest_length: 0.6}}
events: {lands: {touch.gap: falls to zero}}
initial: {body: {y: 0.8}, foot: {y: 0.2}}
allow: {body.y: 2.0e-3}
"""


def ran(case: Case, exact: Trajectory, step: float, *forces: str) -> Trajectory:
    return moved(ENGINE, case.scene, first(exact), case.times, step, reactions=forces, record=True)


def off(case: Case, run: Trajectory, exact: Trajectory, quantity: str) -> float:
    wanted = observe(case.scene, exact, quantity)
    return float(np.abs(observe(case.scene, run, quantity) - wanted).max())


# Friction, where it starts [deg], seconds: rad and N at 1e-4 s. It sticks until it slips, which
# takes a whole step.
TIPS = {
    "it slides without friction": (0.0, 60, 0.28, (6e-7, 1e-4)),  # measured 1.9e-7, 3.1e-5
    "it slides": (0.1, 60, 0.28, (6e-7, 1e-4)),  # 1.8e-7, 2.9e-5
    "it sticks, then slips": (0.3, 80, 0.5, (3e-5, 6e-4)),  # 9.3e-6, 2.1e-4
}


@pytest.mark.parametrize("what", TIPS)
def test_a_bars_end_carries_as_much_at_every_sample(what: str, tmp_path: Path) -> None:
    """A contact that opened now and then carried nothing or the double: 15 N of 4.8."""
    mu, start, duration, (angle, force) = TIPS[what]
    text = LEANING.replace("MU", str(mu)).replace("START", str(start))
    case = typed(tmp_path, text, tail=tail(duration, round(50 * duration) + 1))
    exact = solve(case).trajectory
    run = ran(case, exact, 1e-4, "tip.normal")
    assert off(case, run, exact, "rod.angle") < angle
    assert off(case, run, exact, "tip.normal") < force


def test_a_bar_falls_on_its_end(tmp_path: Path) -> None:
    """It stays, with the impact's own restitution, and its force is right at once."""
    case = typed(tmp_path, DROPPED, tail=tail(0.25, 26))
    exact = solve(case).trajectory
    run = ran(case, exact, 1e-4, "tip.normal")
    assert off(case, run, exact, "rod.angle") < 2e-5  # measured 5e-6
    assert off(case, run, exact, "tip.normal") < 6e-4  # 2e-4
    (wanted,) = reference_events(case.scene, every(exact), case.events["lands"])
    (landed,) = engine_events(case.scene, every(run), case.events["lands"])
    assert abs(landed - wanted) < 3e-5  # 9e-6


@pytest.mark.parametrize("step", [1e-3, 1e-4])
def test_a_hopper_lands_four_times(step: float, tmp_path: Path) -> None:
    """Two landings are 66 ms apart, and a foot deep in the floor would drown the hop between."""
    case = typed(tmp_path, HOPPER, tail=tail(1.5, 76))
    exact = solve(case).trajectory
    run = ran(case, exact, step)
    wanted = reference_events(case.scene, every(exact), case.events["lands"])
    found = engine_events(case.scene, every(run), case.events["lands"])
    assert len(wanted) == 4
    assert found == pytest.approx(wanted, abs=0.7 * step)
    assert off(case, run, exact, "body.y") < 0.9 * step


def test_a_disk_rests_on_the_floor_once_it_has_landed() -> None:
    """As deep as the slop: with the default bias it stayed 1.8e-4 m in it."""
    scene, times = incline(WHEEL, touching("wheel", 0.3)), np.linspace(0.0, 0.6, 4)
    run = moved(ENGINE, scene, launched(0.0, height=0.5), times, 1e-4)
    assert np.sqrt(2 * 0.5 / G) < times[2]
    assert run.states["wheel"][2:, Y] - 0.3 == pytest.approx(-1e-6, abs=1e-7)


def test_a_pin_and_the_floor_do_not_undo_each_other(tmp_path: Path) -> None:
    """What a joint holds down is lifted slowly: at once it would shake by 0.02 rad."""
    case = typed(tmp_path, HINGED, tail=tail(0.5, 26))
    exact = solve(case).trajectory
    run = ran(case, exact, 1e-4, "tip.normal")
    assert off(case, run, exact, "rod.angle") < 8e-4  # 2.7e-4
    assert off(case, run, exact, "tip.normal") < 6e-3  # 1.8e-3


def test_each_contact_reads_its_own_impulse() -> None:
    """A bar on both ends, one of which is pushed down."""
    rod = bar(name="rod", mass=2.0, length=0.8, points={})
    ends = touching("rod", 0.3, point="start"), touching("rod", 0.3, point="end")
    hand = Push("hand", Anchor("rod", "end"), Signal("constant", (0.0, -5.0)))
    wanted = tuple(f"{end.name}.normal" for end in ends)
    run = moved(
        ENGINE,
        machine([rod], contacts=ends, forces=[hand]),
        {"rod": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)},
        np.linspace(0.0, 0.1, 6),
        1e-4,
        reactions=wanted,
    )
    for name, force in zip(wanted, (G, G + 5.0), strict=True):
        assert run.reactions[name] == pytest.approx(force, abs=1e-6)
