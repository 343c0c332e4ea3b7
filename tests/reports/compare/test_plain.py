"""Plain numbers: of motions known in closed form, and of some that are known from engines."""

from dataclasses import replace

import numpy as np
import pytest
from given.adapters.planning import SHIPPED, planned
from given.otherwise import otherwise
from given.scenes import SHIPPED as CASES
from given.scenes import cases_of, solved
from given.scenes import scene as scene_of

from textmech.cases.case import Case
from textmech.cases.scene import Scene
from textmech.cases.trajectory import ANGLE, VX, VY, Array, Trajectory, X, Y
from textmech.reference.solve import solve
from textmech.reports.compare.judge import figures
from textmech.reports.compare.judge.figures import Plain, numbers, plain
from textmech.reports.compare.trial.start import first
from textmech.reports.compare.trial.trial import Trial

G = 9.80665


def told(scene: Scene, reference: Trajectory, motion: Trajectory) -> dict[str, Plain]:
    return {one.what: one for one in numbers(scene, reference, motion)}


def changed(motion: Trajectory, body: str, **columns: Array | float) -> Trajectory:
    """The same with other columns of a body's states, and no other record of them."""
    states = motion.states[body].copy()
    for name, values in columns.items():
        states[:, {"x": X, "y": Y, "angle": ANGLE, "vx": VX, "vy": VY}[name]] = values
    return replace(motion, states={**motion.states, body: states}, record=None)


def thrown(times: Array, back: float, late: float = 0.0) -> Trajectory:
    """Dropped from 1 m, and thrown back with a share of the speed, `late` seconds after it fell.

    It is faster upwards at the very start, and falls through the floor when it comes down again.
    """
    strikes = np.sqrt(2 / G)
    speed, after = G * strikes, times - strikes - late
    falls = times <= strikes
    states = np.zeros((len(times), 6))
    up = np.where(after < 0, 0.0, back * speed - G * after)
    states[:, VY] = np.where(falls, -G * times, up)
    states[0, VY] = 9.0
    states[:, Y] = np.where(falls, 1 - G * times**2 / 2, after * (back * speed - G * after / 2))
    return Trajectory(times, {"ball": states}, {})


@pytest.mark.slow
@pytest.mark.parametrize(("back", "late"), [(0.5, 0.0), (0.7, 2e-3), (0.0, 0.0)])
def test_restitution(back: float, late: float) -> None:
    changes = {"events": {"tops": None}, "duration": 1.6, "samples": 33}
    case = scene_of("bouncing_particle", changes, m=2, mu=0.5, e=0.7)
    reference = solve(case).trajectory
    steps = np.linspace(0.0, 1.6, 16001)
    motion = replace(thrown(case.times, back, late), record=thrown(steps, back, late))
    found = told(case.scene, reference, motion)
    # both speeds are read within a step of the strike: g h / v
    assert found["restitution of touch"].value == pytest.approx(back, abs=3e-4)
    assert found["restitution of touch"].wanted == 0.7
    assert "creep of touch" not in found  # what flies does not stick


SPRUNG = """\
title: A strong spring throws a ball up after the blow, faster than the blow does
scene:
  points: {U: [0, 1.0]}
  bodies: {ball: {disk: {mass: 1, radius: 0.1}}}
  contacts: {touch: {between: [ball, ground.floor], friction: 0, restitution: 0.3}}
  forces: {s: {spring: [ball.center, ground.U], stiffness: 40, rest_length: 0.2}}
initial: {ball: {x: 0, y: 0.3, vy: -2.5}}
events: {lands: {touch.gap: falls to zero}}
duration: 0.5
samples: 26
allow: {ball.y: 2.0e-3}
"""


def sprung() -> float:
    """The restitution that is read of an engine that has the reference's motion, by 0.1 ms."""
    (case,) = cases_of(SPRUNG)
    finely = replace(case, samples=5001)
    reference, record = solve(case).trajectory, solve(finely).trajectory
    found = told(case.scene, reference, replace(reference, record=record))
    return found["restitution of touch"].value


@pytest.mark.slow
def test_what_pulls_after_a_blow_is_no_restitution() -> None:
    assert sprung() == pytest.approx(0.3, abs=3e-3)  # a step of 0.1 ms by 20 m/s²


@pytest.mark.slow
@pytest.mark.mutant("the fastest way back, long after the blow, read as its restitution")
def test_the_fastest_way_back_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(figures, "_besides", lambda *given: -100.0)
    assert sprung() > 0.6


def test_energy_lost(moving: Case) -> None:
    """Of what the reference has, by a free particle whose v² falls by 3 % in a second."""
    case = replace(moving, duration=2.0)
    t, scene, reference = case.times, case.scene, solve(case).trajectory
    for share in (0.03, -0.03):
        motion = changed(reference, "ball", vx=np.sqrt(1 - share * t))
        name = "energy lost" if share > 0 else "energy gained"
        assert told(scene, reference, motion)[name].value == pytest.approx(3.0, rel=1e-12)


@pytest.mark.slow
def test_what_the_textbook_loses_is_not_lost() -> None:
    """A damped spring's own loss."""
    name = "spring_mass_damper.critical"
    scene, reference = CASES[name].scene, solved(name).trajectory
    assert told(scene, reference, reference)["energy lost"].value == 0.0


def test_gap() -> None:
    """A bar that is shifted as a whole by 3 mm along x and 4 mm along y."""
    reference = solved("bar_pendulum").trajectory
    states = reference.states["bar"]
    motion = changed(reference, "bar", x=states[:, X] + 3e-3, y=states[:, Y] + 4e-3)
    found = told(CASES["bar_pendulum"].scene, reference, motion)["gap of hinge"]
    assert (found.value, found.unit) == (pytest.approx(5e-3, abs=1e-12), "m")


def test_creep_and_depth() -> None:
    """A block that should rest, 2 mm deep and going down the slope at 5 mm/s."""
    reference, scene = solved("sliding_block.below").trajectory, CASES["sliding_block.below"].scene
    t = reference.times
    slip = np.where(t > 0, 5e-3, 1.0)  # it starts as it likes
    motion = changed(reference, "block", x=5e-3 * t, vx=slip, y=-1e-3)
    steps = changed(motion, "block", y=np.where(t == t[7], -2e-3, -1e-3))
    found = told(scene, reference, replace(motion, record=steps))
    assert found["creep of touch"].value == pytest.approx(5e-3, rel=1e-12)
    assert found["depth of touch"].value == pytest.approx(2e-3, rel=1e-12)
    assert "energy lost" not in found  # it has none
    assert {one.value for one in numbers(scene, reference, reference)} == {0.0}


def test_friction_while_it_slides() -> None:
    """Braking with 0.3 instead of 0.4; at rest it may be anything. Depth is no loss of energy."""
    reference, scene = (
        solved("sliding_block.braking").trajectory,
        CASES["sliding_block.braking"].scene,
    )
    slip, normal = reference.states["block"][:, VX], np.full(len(reference.times), 1.3 * G)
    along = np.where(slip > 0, -0.3 * normal, 0.9 * normal)
    deep = changed(reference, "block", y=-2e-3)
    motion = replace(deep, reactions={"touch.normal": normal, "touch.tangent": along})
    found = told(scene, reference, motion)
    assert found["friction of touch"].value == pytest.approx(0.3, rel=1e-12)
    assert found["friction of touch"].wanted == 0.4
    # of 5.85 J, by rounding; and what slides as it should does not creep
    assert found["energy lost"].value == pytest.approx(0.0, abs=1e-9)
    assert found["creep of touch"].value == pytest.approx(0.0, abs=1e-9)


@pytest.mark.mutant("friction is read of what flies, and energy of a sample on an impact")
def test_no_number_is_read_in_the_air_or_on_an_impact() -> None:
    """Thrown with spin it slips in the air; on a sample an impact's kinetic energy is not yet lost.

    An engine may tell a force there, as it sees the impact a step later.
    """
    name = "bouncing_disk.elastic"
    reference, scene = solved(name).trajectory, CASES[name].scene
    still = np.full(len(reference.times), 1.0)
    spun = changed(reference, "wheel", vx=1.0)
    motion = replace(spun, reactions={"touch.normal": still, "touch.tangent": 0.09 * still})
    assert "friction of touch" not in told(scene, spun, motion)
    anywhere = otherwise(figures, " & touches & away", "")
    names = [one.what for one in anywhere.numbers(scene, spun, motion)]
    assert ("friction of touch" in names) == bool(scene.contacts["touch"].friction)
    speed = reference.states["wheel"][:, VY].copy()
    k = int(np.argmin(np.abs(reference.times - reference.blows[0])))
    speed[k] *= 1.5
    late, near = (
        changed(reference, "wheel", vy=speed),
        2 * abs(reference.times[k] - reference.blows[0]),
    )
    rates = [
        one.value
        for within in (0.0, float(near))
        for one in numbers(scene, reference, late, within)
        if one.what.startswith("energy")
    ]
    assert rates[0] > 0.1
    assert rates[1] == pytest.approx(0.0, abs=1e-9)


def test_how_far_a_stop_is_passed_is_told() -> None:
    name = "stopped_pendulum.rests"
    reference, scene = solved(name).trajectory, CASES[name].scene
    (stop,) = scene.limits()
    gaps = np.concatenate([*stop.gaps(figures._motion(scene, reference))])
    assert told(scene, reference, reference)["how far past stop"].value == pytest.approx(
        0, abs=1e-9
    )
    deeper = changed(reference, "bar", angle=reference.states["bar"][:, ANGLE] + 0.25)
    other = changed(reference, "bar", angle=reference.states["bar"][:, ANGLE] - 0.25)
    passed = [told(scene, reference, each)["how far past stop"].value for each in (deeper, other)]
    assert max(passed) == pytest.approx(0.25 - np.min(gaps), abs=1e-9)


# Case, engine, its number and the value known by other measurements (a person's rounding).
KNOWN = [
    ("bouncing_disk.elastic", "mujoco", "restitution of touch", 0.13, 0.01),
    ("four_bar", "mujoco", "gap of D", 1.9e-3, 1e-4),
    ("disk_on_disk.rolls", "mujoco", "creep of touch", 5.1e-3, 2e-4),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "engine", "what", "value", "within"), KNOWN, ids=str)
def test_shipped_engines(name: str, engine: str, what: str, value: float, within: float) -> None:
    case, reference, shipped = CASES[name], solved(name).trajectory, SHIPPED[engine]
    trial = Trial(case, reference, shipped, planned(shipped, case.scene, first(reference)))
    (found,) = [one for one in plain(trial) if one.what == what]
    assert found.value == pytest.approx(value, abs=within)


@pytest.mark.slow
def test_bodies_on_each_other() -> None:
    """A corner 2 mm deep in the other's face, and past the end of the face, where it is not."""
    name = "stacked_blocks.pulled"
    scene, reference = CASES[name].scene, solved(name).trajectory
    found = told(scene, reference, reference)
    assert found["depth of left"].value == pytest.approx(0.0, abs=1e-9)
    deep = reference.states["upper"][:, Y] - 2e-3
    motion = changed(reference, "upper", y=deep)
    assert told(scene, reference, motion)["depth of left"].value == pytest.approx(2e-3, abs=1e-9)
    away = changed(motion, "upper", x=reference.states["upper"][:, X] + 10.0)
    assert told(scene, reference, away)["depth of left"].value == 0.0


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (Plain("gap of D", 1.873e-3, "m"), "gap of D: 1.87 mm"),
        (Plain("gap of D", 0.5, "m"), "gap of D: 0.5 m"),
        (Plain("creep of touch", 3e-20, "m/s"), "creep of touch: 0 mm/s"),
        (Plain("creep of axle", 0.02, "rad/s"), "creep of axle: 0.02 rad/s"),
        (Plain("energy lost", 5.812, "% a second"), "energy lost: 5.81 % a second"),
        (
            Plain("energy lost", 652.0, "% a second"),
            "energy lost: 6.52 times the largest kinetic energy a second",
        ),
        (Plain("restitution of touch", 0.128, "", 1.0), "restitution of touch: 0.128 (textbook 1)"),
        (Plain("restitution of touch", 0.1, ""), "restitution of touch: 0.1 (textbook 0)"),
    ],
    ids=str,
)
def test_words(number: Plain, text: str) -> None:
    assert str(number) == text
