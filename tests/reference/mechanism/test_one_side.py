"""Springs that only press or only pull, in the generated mechanism: when they act, and mistakes."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene.observe import observe
from textmech.reference.formalisms import energy, lagrange
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.mechanism.modes.unilateral import OneSided
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import Followed, follow
from textmech.reference.solve import solve
from textmech.reference.system import Array, Guard

G = 9.80665
HOP = """\
scene:
  points: {O: [0, 0], high: [0, 2]}
  bodies: {bob: {particle: {mass: 2}}}
  joints: {guide: {slide: [ground.O, bob.center], along: [0, 1]}}
  forces: {leg: {spring: [ground.O, bob.center], stiffness: 800, rest_length: 0.5, only: SIDE}}
initial: {bob: {y: Y, vy: VY}}
allow: {bob.y: 1.0e-3, leg.force: 1.0}
"""


def mechanism(tmp_path: Path, y: float, vy: float, side: str = "compression", **words: str) -> Any:
    text = HOP.replace("SIDE", side).replace("VY", repr(vy)).replace("Y", repr(y))
    for old, new in words.items():
        assert text.count(old) == 1
        text = text.replace(old, new)
    return scenes.mechanism(scenes.typed(tmp_path, text))


def named(followed: Followed) -> list[str | None]:
    return [change.name for change in followed.changes]


def stance(v: float) -> float:
    """How long [s] a mass that lands on its leg with v [m/s] stays there."""
    w = math.sqrt(800 / 2)
    return 2 * (math.pi - math.atan(v * w / G)) / w


@pytest.mark.slow
@pytest.mark.parametrize("drop", [0.02, 0.3])
def test_hopping_by_its_closed_form(tmp_path: Path, drop: float) -> None:
    """(2.44) a fall, then ÿ = −ω² (y − y_∞) until λ = λ₀ again, and so on: nothing is lost."""
    fall = math.sqrt(2 * drop / G)
    v = G * fall
    down, up = fall, fall + stance(v)
    wanted, flight = [], 2 * fall
    while up < 1.0:
        wanted += [("leg tightens", down), ("leg slackens", up)]
        down, up = up + flight, up + flight + stance(v)
    wanted += [("leg tightens", down)] if down < 1.0 else []
    found = follow(mechanism(tmp_path, 0.5 + drop, 0.0), np.linspace(0.0, 1.0, 11))
    assert named(found) == [name for name, _ in wanted]
    times = [change.time for change in found.changes]
    assert times == pytest.approx([t for _, t in wanted], abs=1e-12)


STARTS: list[tuple[str, float, float, str]] = [
    ("compression", 0.6, 0.0, "leg slack"),
    ("compression", 0.4, 0.0, "leg acts"),
    ("compression", 0.5, -1.0, "leg acts"),  # at λ₀: by where it goes
    ("compression", 0.5, 1.0, "leg slack"),
    ("tension", 0.6, 0.0, "leg acts"),
    ("tension", 0.4, 0.0, "leg slack"),
    ("tension", 0.5, 1.0, "leg acts"),
    ("tension", 0.5, -1.0, "leg slack"),
]


@pytest.mark.parametrize(("side", "y", "vy", "mode"), STARTS)
def test_its_state_at_the_start(tmp_path: Path, side: str, y: float, vy: float, mode: str) -> None:
    system = mechanism(tmp_path, y, vy, side)
    assert system.start()[0] == mode
    q, v = system.start()[1:]
    acts = mode == "leg acts"
    pull = 800 / 2 * (y - 0.5) if acts else 0.0
    assert system.modes[mode].accelerations(0.0, q, v)[1] == pytest.approx(-G - pull, rel=1e-13)


def test_at_rest_on_its_rest_length_it_is_pressed_at_once(tmp_path: Path) -> None:
    """Neither λ nor λ̇ tell; gravity does, in no time."""
    found = follow(mechanism(tmp_path, 0.5, 0.0), np.linspace(0.0, 0.1, 3))
    assert found.modes == ("leg acts",) * 3
    assert [change.time for change in found.changes] == [0.0]


def test_an_elastic_rope_catches(tmp_path: Path) -> None:
    """Up from the floor to its end: free, then ÿ = −g − ω² (y − λ₀), and free again."""
    v = 3.0
    found = follow(mechanism(tmp_path, 0.1, v, "tension"), np.linspace(0.0, 0.4, 5))
    reached = (v - math.sqrt(v * v - 2 * G * 0.4)) / G
    speed, w = v - G * reached, 20.0
    held = 2 * math.atan(speed * w / G) / w  # a half turn less what gravity pulls before it
    assert named(found) == ["leg tightens", "leg slackens"]
    times = [change.time for change in found.changes]
    assert times == pytest.approx([reached, reached + held], abs=1e-12)


BETWEEN = """\
scene:
  points: {L: [-1, 0], R: [1, 0]}
  gravity: none
  bodies: {bob: {particle: {mass: 2}}}
  joints: {guide: {slide: [ground.L, bob.center], along: [1, 0]}}
  forces:
    left: {spring: [ground.L, bob.center], stiffness: 800, rest_length: 1, only: compression}
    right: {spring: [ground.R, bob.center], stiffness: 800, rest_length: 1, only: compression}
initial: {bob: {x: -0.2, vx: 0}}
allow: {bob.x: 1.0e-3}
"""


def test_what_happens_in_one_instant_is_told_in_the_scenes_order(tmp_path: Path) -> None:
    """The one lets go where the other catches, a quarter of a period on: w = 20 rad/s."""
    found = follow(scenes.mechanism(scenes.typed(tmp_path, BETWEEN)), np.linspace(0.0, 0.15, 4))
    assert named(found) == ["left slackens", "right tightens"]
    assert [change.time for change in found.changes] == pytest.approx([math.pi / 40] * 2, abs=1e-12)


@pytest.mark.parametrize("side", ["compression", "tension"])
def test_both_modes_obey_their_laws(tmp_path: Path, side: str) -> None:
    """(2.60) from the energies of the mode, (2.51), and of a slack leg neither force nor U."""
    system = mechanism(tmp_path, 0.45, 1.0, side)
    random = np.random.default_rng(3)
    system.start()
    for mode in ("leg acts", "leg slack"):
        system.built.name((mode.removeprefix("leg "),))
        for _ in range(10):
            q, v = np.array([0.0, random.uniform(0.2, 0.9)]), np.array([0.0, random.normal()])
            one = system.modes[mode]
            a = one.accelerations(0.0, q, v)
            assert a == pytest.approx(lagrange.multipliers(one, 0.0, q, v)[0], rel=1e-12)
            assert abs(energy.power_balance(one, 0.0, q, v)) < 1e-10
            stored = 400.0 * (q[1] - 0.5) ** 2 if mode == "leg acts" else 0.0
            assert one.U(0.0, q) == pytest.approx(2 * G * q[1] + stored, rel=1e-13)


def test_impossible_states_are_said(tmp_path: Path) -> None:
    system = mechanism(tmp_path, 0.45, 1.0)
    q, v = system.start()[1:]
    system.built.name(("slack",))
    assert system.possible("leg acts", 0.0, q, v) is None
    assert system.possible("leg slack", 0.0, q, v) == (
        "leg is slack on the wrong side of its rest length"
    )


@pytest.mark.slow
def test_a_scene_without_any_reaction_is_certified(tmp_path: Path) -> None:
    """Nothing holds the mass: there is no force to be small beside."""
    free = HOP.replace("  joints: {guide: {slide: [ground.O, bob.center], along: [0, 1]}}\n", "")
    free = free.replace("SIDE", "compression").replace(
        "y: Y, vy: VY", "x: 0.1, y: 0.6, vx: 0.2, vy: 0"
    )
    assert solve(scenes.typed(tmp_path, free)).holds


@pytest.mark.slow
def test_energy_is_kept_through_every_event(tmp_path: Path) -> None:
    system = mechanism(tmp_path, 0.8, 0.0)
    times = np.linspace(0.0, 3.0, 61)
    motion = Answer(system, follow(system, times)).trajectory(times)
    total = observe(system.base.scene, motion, "energy.total")
    assert np.ptp(total) < 1e-12 * abs(total[0])


BESIDE = """\
scene:
  points: {O: [0, 0], wall: [-1, 0.1]}
  bodies: {ball: {disk: {mass: 1.5, radius: 0.1}}}
  contacts: {touch: {between: [ball, ground.floor], friction: {static: 0.5, kinetic: 0.4}}}
  forces:
    band: {spring: [ground.wall, ball.center], stiffness: 30, rest_length: 0.8, only: tension}
initial: {ball: {x: 0, y: 0.2, angle: 0, vx: 1, omega: 0}}
events: {lands: {touch.gap: falls to zero}}
allow: {ball.x: 1.0e-3, ball.angle: 1.0e-2, band.force: 1.0e-2}
"""


@pytest.mark.slow
def test_beside_a_contact(tmp_path: Path) -> None:
    """It lands and rolls, pulled by the band until that is slack: all is certified."""
    case = scenes.typed(tmp_path, BESIDE, tail=scenes.tail(1.5, 31))
    solution = solve(case)
    assert solution.holds
    system = scenes.mechanism(case)
    found = follow(system, case.times)
    assert "band slackens" in named(found)
    assert "touch lands" in named(found)
    assert found.phases[0] == "touch open, band acts"
    assert found.phases[-1].endswith("band slack")
    slack = observe(case.scene, solution.trajectory, "band.force")[-1]
    assert slack == 0.0


HELD = """\
scene:
  points: {O: [0, 0]}
  bodies: {bob: {particle: {mass: 2}}}
  forces:
    cord: {rope: [ground.O, bob.center], length: 1.25}
    band: {spring: [ground.O, bob.center], stiffness: 30, rest_length: 1.25, only: tension}
initial: {bob: {x: 0.05, y: -0.2, vx: 0, vy: 0}}
allow: {bob.x: 1.0e-3, bob.y: 1.0e-3}
"""


@pytest.mark.slow
def test_beside_a_rope_that_holds_its_length(tmp_path: Path) -> None:
    """Rounding of a length that is held neither tightens nor slackens: the rope swings alone."""
    case = scenes.typed(tmp_path, HELD, tail=scenes.tail(2.0, 41))
    solution = solve(case)
    assert solution.holds
    assert solution.trajectory.switches.size == 1
    alone = HELD.replace("    band: {spring", "    # {spring")
    other = solve(scenes.typed(tmp_path, alone, tail=scenes.tail(2.0, 41)))
    for name in ("bob.x", "bob.y"):
        x, y = (observe(case.scene, one.trajectory, name) for one in (solution, other))
        assert x == pytest.approx(y, abs=1e-9)


@pytest.mark.slow
@pytest.mark.mutant(
    "a leg that only presses on the other side of its rest length", "a leg that never lets go"
)
def test_a_mistake_in_the_switch_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A guard of the other side, and a leg whose state never changes."""
    sound = follow(mechanism(tmp_path, 0.8, 0.0), np.linspace(0.0, 1.0, 11))
    monkeypatch.setattr(OneSided, "way", -1.0)
    wrong = follow(mechanism(tmp_path, 0.8, 0.0), np.linspace(0.0, 1.0, 11))
    assert named(wrong) != named(sound)
    monkeypatch.undo()

    def never(self: PlanarMechanism, mode: str) -> Sequence[Guard]:
        return ()

    monkeypatch.setattr(PlanarMechanism, "guards", never)
    glued = follow(mechanism(tmp_path, 0.8, 0.0), np.linspace(0.0, 1.0, 11))
    ends: list[Array] = [f.y[-1] for f in (sound, glued)]
    assert np.abs(ends[1] - ends[0]).max() > 0.1
