"""Bodies that touch floors, walls and each other: textbooks' numbers, and planted mistakes."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.machines.examples import THROWN, duration, example
from given.mutants import mutant, with_mode

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, System
from textmech.reference.systems.contact.bouncing_disk import BouncingDisk

# A disk that bounces ever lower, where it is highest: e² of the height before.

G = 9.80665
H, R = 0.8, 0.25  # the heights are those of the lowest point


@pytest.mark.mutant("of bounces that pile up the closed form tells no end")
@pytest.mark.parametrize("e", [0.001, 0.2, 0.5, 0.9])
def test_bounces_that_pile_up_are_told_up_to_the_ones_we_tell_apart(e: float) -> None:
    """As many as the integrator finds; the flight that is left is too short for either."""
    disk, t1 = BouncingDisk(m=1.3, R=R, e=e, y0=R + H), math.sqrt(2 * H / G)
    limit = t1 * (1 + e) / (1 - e)
    events = disk.closed_events(2 * limit)
    found = follow(disk, np.linspace(0.0, 2 * limit, 11)).events
    assert len(events) == len(found)
    # Of 132 bounces each adds the rounding of some 10 s.
    assert [t for _, t in events] == pytest.approx([event.time for event in found], abs=1e-11)
    # What is left is a geometric series of flights, the first of them shorter than 1e-6 s.
    assert 0.0 <= limit - events[-1][1] < 1e-6 / (1 - e)


# Bodies that leave one of two planes: when they do is known, how they go on is not.

NAMES = {"sliding_ladder": "top opens", "tipping_block": "tips"}


@pytest.mark.parametrize("name", NAMES)
def test_what_was_held_by_nothing_at_the_end_is_held_by_nothing(name: str) -> None:
    """The force falls to zero without a jump, and the accelerations go on where they were."""
    system = example(name)
    (event,) = follow(system, np.linspace(0.0, duration(name), 3)).events
    q, v = np.split(event.before, 2)
    before, after = (mode.accelerations(event.time, q, v) for mode in system.modes.values())
    np.testing.assert_allclose(before, after, atol=1e-10)


def test_the_ladder_leaves_at_two_thirds_of_its_height() -> None:
    """A textbook's number, whatever its mass and length; then it goes on at ẋ = ⅓ √(2 …)."""
    system = example("sliding_ladder", m=0.7, l=3.1)
    (event,) = follow(system, np.linspace(0.0, 1.5, 4)).events
    high = math.sin(math.radians(70))
    assert math.sin(event.after[1]) == pytest.approx(2 / 3 * high, rel=1e-12)
    assert event.after[2] ** 2 == pytest.approx(G * 3.1 * high**3 / 9, rel=1e-12)  # ẋ² = g l s³/9


# Two bodies that touch: textbooks' numbers, what is kept and lost, and planted mistakes.

TOP = math.sin(math.radians(78))  # of the disk on a disk, where it starts


def leaving(**changed: float) -> tuple[float, float]:
    """sin θ and (R + r) θ̇²/g where the disk leaves."""
    followed = follow(example("disk_on_disk", **changed), np.linspace(0.0, 2.0, 5))
    (event,) = (event for event in followed.events if event.name == "leaves")
    _, theta, _, _, _, rate, _, _ = event.before
    return math.sin(theta), 0.6 * rate**2 / G


def test_a_smooth_disk_leaves_at_two_thirds_of_its_height() -> None:
    """½ m v² = m g (R + r)(s₀ − s) and m v²/(R + r) = m g s: s = ⅔ s₀."""
    height, speed = leaving(mu=0.0)
    assert height == pytest.approx(2 / 3 * TOP, rel=1e-11)
    assert speed == pytest.approx(height, rel=1e-11)


def test_a_disk_that_only_rolls_on_a_fixed_one_leaves_at_four_sevenths() -> None:
    """¾ m v² = m g (R + r)(s₀ − s): s = 4/7 s₀; with all friction and an immovable drum."""
    height, _ = leaving(mu=1e5, M=1e9)
    assert height == pytest.approx(4 / 7 * TOP, rel=1e-5)


def test_a_rolling_disk_turns_a_light_drum_as_its_inertia_has_it() -> None:
    """(2.45) m (1 + 1/(2 + 2 m/M)) v²/2 = m g (R + r)(s₀ − s), up to where it slips."""
    system = example("disk_on_disk")
    (event, _) = follow(system, np.linspace(0.0, 0.8, 3)).events
    _, theta, _, _, _, rate, _, _ = event.before
    moves = (1 + 1 / (2 + 2 / 3.0)) * (0.6 * rate) ** 2 / 2
    assert event.name == "slips"
    assert moves == pytest.approx(G * 0.6 * (TOP - math.sin(theta)), rel=1e-10)


def test_momentum_stays_and_each_blow_takes_its_share_of_energy() -> None:
    """½ (1 − e²) m m'/(m + m') (v − v')² is lost, and no momentum."""
    masses = np.array([1.0, 0.6, 1.7])
    for event in follow(example("cradle"), np.linspace(0.0, 1.0, 3)).events:
        k = 0 if event.name == "first strikes" else 1
        v, after = event.before[3:], event.after[3:]
        assert masses @ after == pytest.approx(masses @ v, rel=1e-14)
        m = masses[k] * masses[k + 1] / (masses[k] + masses[k + 1])
        lost = (1 - 0.8**2) * m * (v[k] - v[k + 1]) ** 2 / 2
        assert (masses @ (v**2 - after**2)) / 2 == pytest.approx(lost, rel=1e-12)


def test_what_a_thrown_block_loses_is_what_friction_takes() -> None:
    """½ m₂ v₀² = μ₂ m₂ g d₂ + μ₁ (m₁ + m₂) g d₁, d the ways that each has slipped at the end."""
    (x1, x2, v1, v2) = follow(example("stacked_blocks", **THROWN), np.array([0.0, 2.0])).y[-1]
    lost = 0.4 * G * (x2 - x1 + 0.15) + 0.1 * 3.0 * G * x1
    assert (v1, v2) == (0.0, 0.0)
    assert lost == pytest.approx(1.55**2 / 2, rel=1e-12)


def apart(system: System, name: str) -> float:
    """How far [m, rad, or the same per second] a motion goes from the generated one."""
    case, times = scenes.EVERY[name], np.linspace(0.0, scenes.EVERY[name].duration, 15)
    motions = []
    for one in (system, scenes.mechanism(case)):
        found = follow(one, times)
        rows = zip(times.tolist(), found.modes, found.y, strict=True)
        poses = [one.modes[mode].poses(t, *one.modes[mode].parted(y)) for t, mode, y in rows]
        motions.append([[pose[body] for body in case.scene.bodies] for pose in poses])
    return float(np.max(np.abs(np.subtract(*motions))))


def _swapped(self: Any, k: int, v: Array) -> Array:
    """The masses of a blow in each other's place."""
    m, n = (self.m1, self.m2, self.m3)[k : k + 2]
    v = v.copy()
    u, relative = (n * v[k] + m * v[k + 1]) / (m + n), v[k + 1] - v[k]
    v[k], v[k + 1] = u + self.e * relative * m / (m + n), u - self.e * relative * n / (m + n)
    return v


def _softer(self: Any, k: int, v: Array) -> Array:
    """e² in place of e."""
    m, n = (self.m1, self.m2, self.m3)[k : k + 2]
    v = v.copy()
    u, relative = (m * v[k] + n * v[k + 1]) / (m + n), self.e**2 * (v[k + 1] - v[k])
    v[k], v[k + 1] = u + relative * n / (m + n), u - relative * m / (m + n)
    return v


@pytest.mark.mutant("cradle: {struck}")
@pytest.mark.parametrize("struck", [_swapped, _softer])
def test_a_wrong_blow_is_seen(struck: Callable[..., Array]) -> None:
    sound = example("cradle")
    assert apart(sound, "cradle.unlike") < 1e-12
    assert apart(mutant(sound, _struck=struck), "cradle.unlike") > 1e-2


def _only_the_lower(self: Any) -> tuple[float, float]:
    """The floor does not feel the upper block."""
    return -self.s[0] * self.mu1 * self.m1 * G, -self.s[1] * self.mu2 * self.m2 * G


def _one_way(self: Any) -> tuple[float, float]:
    """Friction drives the upper block whichever way it slips."""
    return -self.s[0] * self.mu1 * (self.m1 + self.m2) * G, self.mu2 * self.m2 * G


@pytest.mark.slow
@pytest.mark.mutant("stacked blocks: {sliding}")
@pytest.mark.parametrize(
    ("variant", "mode", "sliding"),
    [
        ("pulled", "together", _only_the_lower),
        ("pulled", "left behind", _only_the_lower),
        ("thrown", "drags", _one_way),
    ],
)
def test_a_wrong_friction_of_blocks_is_seen(variant: str, mode: str, sliding: Any) -> None:
    sound, name = example("stacked_blocks", **THROWN if variant == "thrown" else {}), variant
    wrong = mutant(sound.modes[mode], _sliding=sliding)
    assert apart(sound, f"stacked_blocks.{name}") < 1e-12
    assert apart(with_mode(sound, mode, wrong), f"stacked_blocks.{name}") > 1e-3


def _fixed_drum(self: Any, q: Array, v: Array) -> float:
    """The drum does not give way."""
    if self.flies or self.sigma:
        return -self.sigma * self.mu * self.normal(q, v)
    return -G * math.cos(q[1]) / (3 / self.m)


def _straight(self: Any, q: Array, v: Array) -> float:
    """A normal force without the path's curvature."""
    return self.m * G * math.sin(q[1])


@pytest.mark.slow
@pytest.mark.mutant(
    "disk on disk: a drum that does not give way",
    "disk on disk: normal force without the path's curvature",
)
@pytest.mark.parametrize(("mode", "lost"), [("rolls", "friction"), ("slips", "normal")])
def test_a_lost_term_of_the_disk_is_seen(mode: str, lost: str) -> None:
    sound = example("disk_on_disk")
    method = {"friction": _fixed_drum, "normal": _straight}[lost]
    wrong = mutant(sound.modes[mode], **{lost: method})
    assert apart(sound, "disk_on_disk.rolls") < 1e-12
    assert apart(with_mode(sound, mode, wrong), "disk_on_disk.rolls") > 1e-3
