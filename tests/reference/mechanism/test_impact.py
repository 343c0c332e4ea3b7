"""What lands and what stands on its end: the impact law against its terms, and Painlevé."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.refused import refused
from given.rod import rod

from textmech.cases.scene import Anchor, Contact, Scene, shape
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reports.compare.events.times import reference_events

G = 9.80665
SHORT = "duration: 0.25\nsamples: 6\n"


@pytest.mark.slow
@pytest.mark.parametrize(
    "changed",
    [
        {"mu": 0.6},  # it sticks
        {"mu": 0.1},  # it slips
        {"y": 0.05, "e": 0.7, "mu": 0.3},
        {"y": 0.05, "e": 1},
        {"y": 0.05, "mu": 0.5},
    ],
)
def test_a_bar_on_its_end_is_certified(tmp_path: Path, changed: dict[str, Any]) -> None:
    solution = solve(rod(tmp_path, **changed))
    assert [check for check in solution.checks if not check.holds] == []


def test_an_elastic_impact_without_friction_keeps_the_energy(tmp_path: Path) -> None:
    """ω⁺ from v_n⁺ = −e v_n⁻: impulse −2 v_n / (1/m + d_x²/J)."""
    solution = solve(rod(tmp_path, y=0.05, e=1))
    record = solution.trajectory.record
    assert record is not None
    assert record.phase is not None
    i = int(np.flatnonzero(np.diff(record.phase))[0])
    v, J, d = math.sqrt(2 * G * 0.05), 1 / 12, -0.25
    impulse = 2 * v / (1 + d * d / J)
    assert record.states["rod"][i + 1, 4] == pytest.approx(impulse - v, abs=1e-12)
    assert record.states["rod"][i + 1, 5] == pytest.approx(d * impulse / J, abs=1e-11)


def test_a_disk_that_lands_turning_rolls_or_slides_by_the_cone() -> None:
    """Coulomb's impulse: it rolls if m |slip| / 3 ≤ μ m |v_n|, else v_x jumps by μ |v_n|."""
    for mu, rolls in ((0.4, True), (0.1, False)):
        disk = shape.disk(name="wheel", mass=1.3, radius=0.25, points={})
        touch = Contact("touch", Anchor("wheel", "center"), mu, mu)
        scene = Scene((0.0, -9.80665), {}, {"wheel": disk}, {}, {"touch": touch}, {})
        start = np.array([0.0, 1.25, 0.0]), np.array([1.0, 0.0, 4.0])
        followed = follow(PlanarMechanism(scene, start, 0.25), np.linspace(0.0, 0.46, 3))
        land = followed.changes[0]
        v_n, slip = math.sqrt(2 * 9.80665), 1.0 + 0.25 * 4.0
        jump = -slip / 3 if rolls else -mu * v_n
        assert land.after[3] - land.before[3] == pytest.approx(jump, abs=1e-12)
        assert land.mode_after == ("touch sticks" if rolls else "touch slides +")


@pytest.mark.slow
def test_painleve_is_refused(tmp_path: Path) -> None:
    """1 + 3 cos² − 3 μ sin cos < 0 from μ = 1.35 on, pushed into the floor: no motion at all."""
    solve(rod(tmp_path, mu=1.3, vx=-1))
    mistake = refused(rod(tmp_path, mu=2, vx=-1))
    assert mistake.where == "scene.contacts.tip.friction"
    assert "no motion satisfies the law (Painlevé's paradox)" in mistake.what


def test_starts_that_are_refused(tmp_path: Path) -> None:
    assert "tip starts 3 mm in the floor" in refused(rod(tmp_path, y=-0.003)).what
    assert "tip starts into the floor, with 1 m/s" in refused(rod(tmp_path, vy=-1)).what


BESIDE = """\
scene:
  points: {Q: [0, 0]}
  bodies:
    ball: {disk: {mass: 1, radius: 0.1}}
    leaning: {bar: {mass: 1, length: 1}}
    slider: {particle: {mass: 1}}
  joints:
    guide: {slide: [ground.Q, slider.center], along: [0, 1]}
    hold: {pin: [slider.center, leaning.start]}
  contacts:
    touch: {between: [ball, ground.floor], friction: 0.3}
    tip: {between: [leaning.end, ground.floor], friction: MU}
initial: {ball: {x: -1, y: 0.2, angle: 0}, leaning: {angle: ANGLE, end: [TIP, 0]}}
events: {lands: {touch.gap: falls to zero}, tip_lands: {tip.gap: falls to zero}}
allow: {leaning.x: 1.0e-3, lands.time: 1.0e-3}
"""


@pytest.mark.slow
@pytest.mark.parametrize("angle", [-0.758, -1.065, -0.418])
@pytest.mark.parametrize("mu", [0.0, 0.3])
def test_an_impact_does_not_concern_what_rests_apart(
    tmp_path: Path, angle: float, mu: float
) -> None:
    """Impulses of rounding, of either sign, on a tip that no joint ties to the disk that lands."""
    text = BESIDE.replace("MU", repr(mu)).replace("ANGLE", repr(angle))
    typed = scenes.typed(tmp_path, text.replace("TIP", repr(math.cos(angle))), tail=SHORT)
    solution = solve(typed)
    assert [check for check in solution.checks if not check.holds] == []
    record = solution.trajectory.record
    assert record is not None
    fall = math.sqrt(2 * 0.1 / G)
    times = {name: reference_events(typed.scene, record, e) for name, e in typed.events.items()}
    assert times["lands"].tolist() == pytest.approx([fall], abs=1e-12)
    assert times["tip_lands"].tolist() == []
