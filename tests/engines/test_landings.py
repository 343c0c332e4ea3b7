"""Landings: when, forces at every sample, and nothing lost in the floor."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from given.engine_scenes import WHEEL, G, incline, launched, machine, touching
from given.landings import HINGED
from given.planning import TUNED, every, moved
from given.scenes import tail, typed

from textmech.cases.case import Case
from textmech.cases.scene import Anchor, Push, Signal
from textmech.cases.scene.observe import observe
from textmech.cases.scene.shape import bar
from textmech.cases.trajectory import Array, Trajectory, Y
from textmech.reference.solve import solve
from textmech.reports.compare.events.times import engine_events, reference_events
from textmech.reports.compare.trial.start import first

DROPPED = """\
scene:
  bodies: {rod: {bar: {mass: 2, length: 0.8}}}
  contacts: {tip: {between: [rod.start, ground.floor], friction: 0.3}}
events: {lands: {tip.gap: falls to zero}}
initial: {rod: {start: [0, 0.1], angle: 50 deg}}
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


Solved = Callable[[str, float, int], tuple[Case, Trajectory]]


@dataclass(frozen=True)
class Near:
    """How near a tuned engine comes at 1e-4 s; about a third of it is measured."""

    angle: float  # rad
    normal: float  # N
    time: float = 3e-5  # s: when the tip lands


@dataclass(frozen=True)
class Hops:
    """How near at a step: the landings' times [s], and the body's height [m]."""

    step: float
    time: float
    height: float


# MuJoCo's floor gives way while the tip lands: an impact of a few steps, an error of h.
DROPS = {"pymunk": Near(2e-5, 6e-4), "mujoco": Near(1e-3, 2.2e-2)}  # measured 3.2e-6, 3.0e-4 rad
HINGES = {"pymunk": Near(8e-4, 6e-3), "mujoco": Near(1.3e-3, 4.5e-2)}  # 2.7e-4, 4.3e-4 rad
# Each of MuJoCo's landings takes 1e-3 s, and a hop begins as much later: after four of them the
# body is 6e-3 m off, see its recipe. At 1e-3 s it drowns the third hop.
HOPS = {
    "pymunk": (Hops(1e-3, 7e-4, 9e-4), Hops(1e-4, 7e-5, 9e-5)),  # a step, as the hops add up
    "mujoco": (Hops(1e-4, 1.8e-2, 1.7e-2),),  # 6.0e-3, 5.6e-3
}
# m: pymunk's slop; MuJoCo comes out of the landing by and by, from 1.8e-4 to 1.1e-4 here
RESTS = {"pymunk": (-1e-6, 1e-7), "mujoco": (-1.4e-4, 6e-5)}
ENDS = {"pymunk": 1e-12, "mujoco": 1e-8}  # N: measured 3.6e-14, 3.6e-10


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> Solved:
    """A scene's case and its exact motion, once for all engines."""

    @cache
    def of(text: str, duration: float, samples: int) -> tuple[Case, Trajectory]:
        folder = tmp_path_factory.mktemp("case")
        case = typed(folder, text, tail=tail(duration, samples))
        return case, solve(case).trajectory

    return of


def ran(name: str, case: Case, exact: Trajectory, step: float, *forces: str) -> Trajectory:
    start = first(exact)
    return moved(TUNED[name], case.scene, start, case.times, step, reactions=forces, record=True)


def off(case: Case, run: Trajectory, exact: Trajectory, quantity: str) -> float:
    wanted = observe(case.scene, exact, quantity)
    return float(np.abs(observe(case.scene, run, quantity) - wanted).max())


def landings(case: Case, exact: Trajectory, run: Trajectory) -> tuple[Array, Array]:
    """Wanted and found [s]."""
    wanted = reference_events(case.scene, every(exact), case.events["lands"])
    return wanted, engine_events(case.scene, every(run), case.events["lands"])


@pytest.mark.slow
@pytest.mark.parametrize("name", DROPS)
def test_a_bar_falls_on_its_end(name: str, solved: Solved) -> None:
    """It stays, with the impact's own restitution, and its force is right at once."""
    (case, exact), near = solved(DROPPED, 0.25, 26), DROPS[name]
    run = ran(name, case, exact, 1e-4, "tip.normal")
    assert off(case, run, exact, "rod.angle") < near.angle
    assert off(case, run, exact, "tip.normal") < near.normal
    (wanted,), (landed,) = landings(case, exact, run)
    assert abs(landed - wanted) < near.time


@pytest.mark.slow
@pytest.mark.parametrize("name", HINGES)
def test_a_pin_and_the_floor_do_not_undo_each_other(name: str, solved: Solved) -> None:
    """What a joint holds down is lifted slowly: at once it would shake by 0.02 rad."""
    (case, exact), near = solved(HINGED, 0.5, 26), HINGES[name]
    run = ran(name, case, exact, 1e-4, "tip.normal")
    assert off(case, run, exact, "rod.angle") < near.angle
    assert off(case, run, exact, "tip.normal") < near.normal
    (wanted,), (landed,) = landings(case, exact, run)
    assert abs(landed - wanted) < near.time


@pytest.mark.slow
@pytest.mark.parametrize(("name", "near"), [(n, near) for n, hops in HOPS.items() for near in hops])
def test_a_hopper_lands_four_times(name: str, near: Hops, solved: Solved) -> None:
    """Two landings are 66 ms apart, and a foot deep in the floor would drown the hop between."""
    case, exact = solved(HOPPER, 1.5, 76)
    run = ran(name, case, exact, near.step)
    wanted, found = landings(case, exact, run)
    assert len(wanted) == 4
    assert found == pytest.approx(wanted, abs=near.time)
    assert off(case, run, exact, "body.y") < near.height


@pytest.mark.parametrize("name", RESTS)
def test_a_disk_rests_on_the_floor_once_it_has_landed(name: str) -> None:
    """No deeper than what holds it up: with pymunk's default bias it stayed 1.8e-4 m in it."""
    (deep, about), times = RESTS[name], np.linspace(0.0, 0.6, 4)
    scene = incline(WHEEL, touching("wheel", 0.3))
    run = moved(TUNED[name], scene, launched(0.0, height=0.5), times, 1e-4)
    assert np.sqrt(2 * 0.5 / G) < times[2]
    assert run.states["wheel"][2:, Y] - 0.3 == pytest.approx(deep, abs=about)


@pytest.mark.parametrize("name", ENDS)
def test_each_contact_reads_its_own_force(name: str) -> None:
    """A bar on both ends, one of which is pushed down."""
    rod = bar(name="rod", mass=2.0, length=0.8, points={})
    ends = touching("rod", 0.3, point="start"), touching("rod", 0.3, point="end")
    hand = Push("hand", Anchor("rod", "end"), Signal("constant", (0.0, -5.0)))
    wanted = tuple(f"{end.name}.normal" for end in ends)
    scene = machine([rod], contacts=ends, forces=[hand])
    at_rest = {"rod": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)}
    times = np.linspace(0.0, 0.1, 6)
    run = moved(TUNED[name], scene, at_rest, times, 1e-4, reactions=wanted)
    for each, force in zip(wanted, (G, G + 5.0), strict=True):
        assert run.reactions[each] == pytest.approx(force, abs=ENDS[name])
