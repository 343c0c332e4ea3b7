"""Contacts that slide and stick natively, against closed forms: blocks, disks, and ends of bars."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from given.closed_motions import braked, leaning_bar, sliding_then_rolling
from given.engine_scenes import (
    BLOCK,
    RADIUS,
    WHEEL,
    G,
    incline,
    launched,
    leaning,
    thrown,
    touching,
)
from given.planning import NAMES, TUNED, every, moved

from textmech.cases.scene.shape import bar
from textmech.cases.trajectory import ANGLE, OMEGA, VX, X, Y

STEP = 1e-4
TIMES = np.linspace(0.0, 2.0, 21)
RIGID = bar(name="rod", mass=2.0, length=0.8, points={})


@dataclass(frozen=True)
class Near:
    """How near a tuned engine comes at 1e-4 s [m, m/s, rad, N]; measured values stand beside."""

    still: float  # m and m/s of what rests from the start
    slides: float  # m of what slides on all the time
    brakes: float  # m of what stops, or turns back without a rest
    forces: float  # N of a block's contact
    depth: float  # m in the floor
    rolls: tuple[float, float]  # m, and m/s of the slip that is left
    steep: tuple[float, float]  # m and rad of a disk that slides and turns
    falling: tuple[float, float]  # m and rad of a bar whose end slides without friction
    leaning: tuple[float, float]  # and with it
    lying: tuple[float, float]  # m and rad of a bar on both ends
    lying_forces: float  # N


NEAR = {
    # The floor is a soft spring, 4e-7 m deep under its load and 3e-6 under a leaning bar's end,
    # into which the end goes deeper as its force grows. Friction of second order: 2e-6 m when the
    # slip ends within a step.
    "mujoco": Near(
        still=1e-15,  # measured 4e-20
        slides=5e-8,  # 1.7e-8
        brakes=1.5e-7,  # 4.9e-8
        forces=1e-14,  # 3.6e-15, also from the start: it is settled
        depth=1e-6,  # 3.9e-7
        rolls=(4e-6, 2e-6),  # 1.5e-6, 8.7e-7
        steep=(1e-8, 1.2e-5),  # 3.3e-9, 4.8e-6
        falling=(1e-15, 1.7e-6),  # 0: nothing pushes it sideways; 5.6e-7
        leaning=(4e-8, 2e-6),  # 1.5e-8, 6.5e-7
        lying=(4e-8, 1.2e-11),  # 1.1e-8, 3.6e-12
        lying_forces=2.2e-5,  # 7.1e-6: the arm of friction is as much shorter as they are deep
    ),
    # An impulse stops a block within the step, which is then over: h² a / 2 = 2e-8 m at most.
    "pymunk": Near(
        still=1e-15,  # measured 1e-19
        slides=3e-12,  # 9.4e-13
        brakes=2e-8,  # 7.9e-9
        forces=1.5e-7,  # 5.8e-8 at the start, from which the seed rises
        depth=1e-14,  # 2.4e-15
        rolls=(5e-9, 1e-13),  # 1.7e-9, 2e-14
        steep=(3e-12, 1e-13),  # 1.1e-12, 2.5e-14
        falling=(1e-15, 4e-7),  # 0: nothing pushes it sideways; 1.5e-7
        leaning=(1e-8, 4e-7),  # 4.0e-9, 1.5e-7
        lying=(4e-14, 5e-15),  # 1.1e-14, 1.6e-15
        lying_forces=2e-6,  # 7.4e-7: what the seed of 1e-8 m leaves between two ends that stick
    ),
}
# Degrees, coefficient of friction, speed [m/s]: what it does.
BLOCKS = {
    "below the friction angle": (16.0, 0.3, 0.0, "still"),
    "well below it": (15.0, 0.4, 0.0, "still"),
    "above it": (30.0, 0.3, 0.0, "slides"),
    "braking to rest": (0.0, 0.4, 3.0, "brakes"),
    "thrown up, and stays": (15.0, 0.4, -3.0, "brakes"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("what", BLOCKS)
def test_block(what: str, name: str) -> None:
    degrees, mu, v, does = BLOCKS[what]
    near, slope = NEAR[name], math.radians(degrees)
    scene = incline(BLOCK, touching("block", mu), slope=slope)
    forces = ("touch.normal", "touch.tangent")
    run = moved(TUNED[name], scene, thrown(v), TIMES, STEP, reactions=forces, record=True)
    rows, wanted = run.states["block"], braked(TIMES, v, mu, slope)
    assert np.abs(rows[:, X] - wanted).max() < getattr(near, does)
    assert np.abs(rows[:, Y]).max() < near.depth
    weight, pull = 1.3 * G * math.cos(slope), 1.3 * G * math.sin(slope)
    assert run.reactions["touch.normal"] == pytest.approx(weight, abs=near.forces)
    if does != "slides":
        assert abs(every(run).states["block"][-1, VX]) < 1e-15
        assert run.reactions["touch.tangent"][-1] == pytest.approx(-pull, abs=1e-14)
    if does == "still":
        assert np.abs(rows[:, VX]).max() < near.still
        assert run.reactions["touch.normal"] == pytest.approx(weight, abs=1e-14)
        assert run.reactions["touch.tangent"] == pytest.approx(-pull, abs=1e-14)
    else:  # while it slides
        braking = -math.copysign(mu * weight, v or 1.0)
        assert run.reactions["touch.tangent"][0] == pytest.approx(braking, abs=near.forces)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("omega", [0.0, 20.0], ids=["without spin", "backspin"])
def test_a_disk_slides_then_rolls(omega: float, name: str) -> None:
    times, mu, v = np.linspace(0.0, 3.0, 21), 0.2, 2.0
    scene = incline(WHEEL, touching("wheel", mu))
    rows = moved(TUNED[name], scene, launched(v, omega), times, STEP).states["wheel"]
    place, slip = NEAR[name].rolls
    assert np.abs(rows[:, X] - sliding_then_rolling(times, v, omega, mu)).max() < place
    assert abs(rows[-1, VX] - (2 * v - RADIUS * omega) / 3) < slip
    assert abs(rows[-1, VX] + RADIUS * rows[-1, OMEGA]) < slip


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_a_disk_on_a_slope_too_steep_slides_and_turns(name: str) -> None:
    beta = math.radians(40)
    scene = incline(WHEEL, touching("wheel", 0.1), slope=beta)
    rows = moved(TUNED[name], scene, launched(0.0), TIMES, STEP).states["wheel"]
    a = G * (math.sin(beta) - 0.1 * math.cos(beta))
    turned = -2 * 0.1 * G * math.cos(beta) / RADIUS * TIMES**2 / 2
    assert np.abs(rows[:, X] - a * TIMES**2 / 2).max() < NEAR[name].steep[0]
    assert np.abs(rows[:, ANGLE] - turned).max() < NEAR[name].steep[1]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("mu", [0.0, 0.1])
def test_the_end_of_a_bar_slides(mu: float, name: str) -> None:
    """Released at 60°; on a smooth floor its centre falls straight down."""
    times, released = np.linspace(0.0, 0.28, 8), math.radians(60)
    scene = incline(RIGID, touching("rod", mu, point="start"))
    rows = moved(TUNED[name], scene, leaning(0.8, released), times, STEP).states["rod"]
    x, turned, _ = leaning_bar(times, 0.8, released, mu)
    place, angle = NEAR[name].leaning if mu else NEAR[name].falling
    assert np.abs(rows[:, X] - x).max() < place
    assert np.abs(rows[:, ANGLE] - turned).max() < angle


ENDS = touching("rod", 0.3, point="start"), touching("rod", 0.3, point="end")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("v", [0.0, 2.0], ids=["at rest", "sliding"])
def test_a_bar_lies_on_both_ends(v: float, name: str) -> None:
    times, start = np.linspace(0.0, 0.5, 21), (0.0, 0.0, 0.0, v, 0.0, 0.0)
    rows = moved(TUNED[name], incline(RIGID, *ENDS), {"rod": start}, times, STEP).states["rod"]
    place, angle = NEAR[name].lying
    assert np.abs(rows[:, X] - braked(times, v, 0.3, 0.0)).max() < place
    assert np.abs(rows[:, ANGLE]).max() < angle


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("v", [0.0, 2.0], ids=["at rest", "sliding"])
def test_each_end_carries_half(v: float, name: str) -> None:
    times, start = np.linspace(0.0, 0.5, 21), (0.0, 0.0, 0.0, v, 0.0, 0.0)
    wanted = tuple(f"{end.name}.{way}" for end in ENDS for way in ("normal", "tangent"))
    run = moved(TUNED[name], incline(RIGID, *ENDS), {"rod": start}, times, STEP, reactions=wanted)
    for end in ENDS:
        normal, tangent = (run.reactions[f"{end.name}.{way}"] for way in ("normal", "tangent"))
        assert normal == pytest.approx(G, abs=NEAR[name].lying_forces)
        assert tangent == pytest.approx(-0.3 * G if v else 0.0, abs=NEAR[name].lying_forces)
