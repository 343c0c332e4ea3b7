"""What is stated of an event's time is true, and more so where what falls is flat.

Known functions of 40 digits tell when it is: of free fall, of a throw that only just reaches a
height, and of a bar that swings from one side to a stop.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import mpmath
import numpy as np
import pytest
from given import scenes
from given.laws.certified import certified, stated

from textmech.cases.case import Case
from textmech.reference.certificate import certify, errors
from textmech.reference.certificate import event_time_error as timed
from textmech.reference.certificate.event_time_error import time_bound
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.system import Array, Guard, Mode, System
from textmech.reference.systems.contact.bouncing_disk import BouncingDisk
from textmech.reference.systems.pendula.stopped_pendulum import G, StoppedPendulum
from textmech.reports.compare.events.times import reference_events

SAMPLES = 11
MANY = 20  # random scenes a seed
WIDE = 1e4  # times ε of the size over the slope: what is stated more coarsely says nothing


class Flight(Mode):
    """A particle in the plane, under its weight."""

    coordinates = ("x", "y")

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return np.array([0.0, -G])


@dataclass
class Throw(System):
    """From x = 0 and y0 [m] with vx and vy [m/s], until it reaches `height` [m]."""

    y0: float
    vx: float
    vy: float
    height: float

    def __post_init__(self) -> None:
        self.modes = {"rises": Flight(), "goes on": Flight()}

    def start(self) -> tuple[str, Array, Array]:
        return "rises", np.array([0.0, self.y0]), np.array([self.vx, self.vy])

    def guards(self, mode: str) -> Sequence[Guard]:
        def then(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return "goes on", q, v

        reaches = Guard("reaches", lambda t, q, v: self.height - float(q[1]), then)
        return [reaches] if mode == "rises" else []


@dataclass
class Known:
    """A system, when its event is, and the speed and the size of what falls to zero there."""

    system: System
    time: Any  # of mpmath's numbers
    slope: float
    size: float


def rising(vy: float, way: float) -> Any:
    """(v − √(v² − 2 g s))/g, when a throw with v has come up by s."""
    v, g = mpmath.mpf(vy), mpmath.mpf(G)
    return (v - mpmath.sqrt(v * v - 2 * g * mpmath.mpf(way))) / g


def swinging(length: float, begin: float, end: float) -> Any:
    """(K(k) − F(ψ))/Ω from rest at `begin` to `end`, both from the x axis, beyond hanging or not.

    sin(θ/2) = k sin ψ, θ from hanging, Ω² = 3 g/(2 l).
    """
    half = (mpmath.mpf(begin) + mpmath.pi / 2) / 2, (mpmath.mpf(end) + mpmath.pi / 2) / 2
    k = mpmath.sin(half[0])
    psi = mpmath.asin(mpmath.sin(half[1]) / k)
    rate = mpmath.sqrt(3 * mpmath.mpf(G) / (2 * mpmath.mpf(length)))
    return (mpmath.ellipk(k * k) - mpmath.ellipf(psi, k * k)) / rate


def fall(rng: np.random.Generator) -> Known:
    """From a nanometre to 100 m above the floor."""
    radius = rng.uniform(0.05, 1.0)
    disk = BouncingDisk(m=1.0, R=radius, e=0.0, y0=radius + 10.0 ** rng.uniform(-9.0, 2.0))
    h = float(disk.start()[1][0])
    time = mpmath.sqrt(2 * mpmath.mpf(h) / mpmath.mpf(G))
    speed = math.sqrt(2.0 * G * h)
    return Known(disk, time, speed, h + speed)


def throw(rng: np.random.Generator) -> Known:
    """That comes above the height by a tenth of it, or by as little as 1e-10 of it."""
    y0, vx, vy = rng.uniform(-2.0, 2.0), 10.0 ** rng.uniform(-2.0, 2.0), rng.uniform(0.5, 20.0)
    depth = 10.0 ** rng.uniform(-9.5, -1.0)
    height = y0 + vy**2 / (2.0 * G) * (1.0 - depth)
    with mpmath.workdps(40):
        time = rising(vy, mpmath.mpf(height) - mpmath.mpf(y0))
    return Known(Throw(y0, vx, vy, height), time, vy * math.sqrt(depth), 100.0 + vx)


def swing(rng: np.random.Generator) -> Known:
    """From close to the top, or from a nanoradian above the stop."""
    low = rng.uniform(-1.5, 1.2)
    begin, length = low + (1.55 - low) * 10.0 ** rng.uniform(-9.0, 0.0), rng.uniform(0.1, 3.0)
    slope = math.sqrt(3.0 * G / length * (math.sin(begin) - math.sin(low)))
    system = StoppedPendulum(1.0, length, begin, low, 0.0)
    return Known(system, swinging(length, begin, low), slope, 100.0)


def followed(known: Known) -> tuple[float, float]:
    """By how much [s] the time of the first event is off, and may be."""
    until = 1.5 * float(known.time)
    found = follow(known.system, np.linspace(0.0, until, SAMPLES))
    return abs(float(found.events[0].time - known.time)), time_bound(known.system, found)


KINDS: dict[str, Callable[[np.random.Generator], Known]] = {
    "fall": fall, "throw": throw, "swing": swing
}  # fmt: skip


def drawn(kind: str, seed: int) -> list[Known]:
    rng = np.random.default_rng(seed)
    with mpmath.workdps(40):
        return [KINDS[kind](rng) for _ in range(MANY)]


Patch = pytest.MonkeyPatch


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_the_time_of_an_event_is_off_by_no_more_than_is_stated(kind: str, seed: int) -> None:
    with mpmath.workdps(40):
        for known in drawn(kind, seed):
            off, may = followed(known)
            assert off <= may
            coarse = errors.EPS * (known.size / known.slope + float(known.time))
            assert may <= WIDE * coarse, known


def stopping(rng: np.random.Generator) -> tuple[float, float]:
    """By how much [s] the stop of a block on a spring that is pulled is off, and may be.

    v = u (1 − cos ω τ) + a ω sin ω τ, with a = (F_s − F)/c, is zero at tan(ω τ/2) = −a ω/u. The
    block may move by a micrometre: its state does not tell how large the numbers of its force are.
    """
    stiff, kinetic = 10.0 ** rng.uniform(1.0, 3.0), rng.uniform(0.1, 5.0)
    static = kinetic * (1.0 + 10.0 ** rng.uniform(-7.0, -1.0))
    hook = 0.5 + 0.9 * static / stiff
    u = 10.0 ** rng.uniform(-4.0, 0.0) * static / math.sqrt(stiff)
    omega, a = mpmath.sqrt(stiff), (mpmath.mpf(static) - mpmath.mpf(kinetic)) / stiff
    slips = (mpmath.mpf(static) / stiff - (mpmath.mpf(hook) - mpmath.mpf(0.5))) / u
    stops = slips + 2 * (mpmath.pi - mpmath.atan(a * omega / u)) / omega
    text = f"""\
scene:
  points: {{hook: {{at: [{hook!r}, 0], velocity: [{u!r}, 0]}}}}
  forces: {{coil: {{spring: [block.center, ground.hook], stiffness: {stiff!r}, rest_length: 0.5}}}}
duration: {float(stops + a / u / 2)!r}
samples: {SAMPLES}
"""
    case = scenes.scene("dry_slide", text, static=static, kinetic=kinetic)
    system = scenes.mechanism(case)
    found = follow(system, case.times)
    return abs(float(found.changes[1].time - stops)), time_bound(system, found)


@pytest.mark.slow
@pytest.mark.mutant("the rounding of forces left out of what a guard is known to")
def test_the_time_of_a_stop_is_off_by_no_more_than_is_stated(monkeypatch: Patch) -> None:
    with mpmath.workdps(40):
        rng = np.random.default_rng(1)
        for _ in range(MANY):
            off, may = stopping(rng)
            assert off <= may
        monkeypatch.setattr(timed, "noise", lambda f, t, y, h, peak: None)
        rng = np.random.default_rng(1)
        found = [stopping(rng) for _ in range(MANY)]
    assert any(off > 100.0 * may for off, may in found)


@pytest.mark.slow
@pytest.mark.mutant("the slope of a guard left out of what is stated of its event's time: a {kind}")
@pytest.mark.parametrize("kind", ["throw", "swing"])
def test_an_error_without_the_slope_is_seen(kind: str, monkeypatch: Patch) -> None:
    """As it was: a time was known as well as a double is, however flat the guard."""
    monkeypatch.setattr(timed, "_time_below", lambda g, room, t, most: math.ulp(t))
    with mpmath.workdps(40):
        found = [followed(known) for known in drawn(kind, 1)]
    assert any(off > 100.0 * may for off, may in found)


@pytest.mark.slow
@pytest.mark.mutant("the state's own error left out of what a guard is known to")
def test_a_guard_that_is_known_exactly_is_seen(monkeypatch: Patch) -> None:
    monkeypatch.setattr(timed, "sizes", lambda peak, tolerance: 0.0 * peak)
    monkeypatch.setattr(timed, "EPS", 0.0)
    with mpmath.workdps(40):
        found = [followed(known) for known in drawn("throw", 1)]
    assert any(off > may for off, may in found)


def test_what_is_left_of_one_event_is_left_of_the_next() -> None:
    """An elastic ball bounces as late as all of its bounces before: the errors add up."""
    disk = BouncingDisk(m=1.0, R=0.25, e=1.0, y0=0.75)
    few, many = (time_bound(disk, follow(disk, np.linspace(0.0, t, SAMPLES))) for t in (0.5, 5.0))
    known = disk.closed_events(5.0)
    assert known is not None
    assert many > len(known) / 2 * few > 0.0


@pytest.mark.slow
def test_what_a_guard_leaves_open_is_stated(monkeypatch: Patch) -> None:
    monkeypatch.setattr(certify, "time_bound", lambda system, followed: 1e-6)
    checks = {check.name: check for check in certified(scenes.SHIPPED["landing"])}
    assert checks["error of lands.time"].certified == 1e-6


def passing(kind: str, depth: float, seed: int) -> tuple[Case, Any]:
    """A throw above a height, or a bar beyond an angle, that it exceeds by that part; and when."""
    rng = np.random.default_rng(seed)
    if kind == "throw":
        vx, vy = rng.uniform(0.0, 3.0), rng.uniform(1.0, 10.0)
        height = vy**2 / (2.0 * G) * (1.0 - depth)
        time = rising(vy, height)
        text = f"""\
scene: {{bodies: {{ball: {{particle: {{mass: 1.0}}}}}}}}
initial: {{ball: {{x: 0.0, y: 0.0, vx: {vx!r}, vy: {vy!r}}}}}
events: {{passes: {{ball.y: {{rises to: {height!r}}}}}}}
allow: {{ball.y: 1.0e-3, passes.time: 1.0e-2}}
"""
        return scenes.parsed(text, tail=scenes.tail(1.3 * float(time), 26)), time
    length, begin = rng.uniform(0.3, 2.0), rng.uniform(-0.5, 1.4)
    end = -math.pi - begin + depth * (begin + math.pi / 2)
    time = swinging(length, begin, end)
    text = f"""\
initial: {{bar: {{angle: {begin!r}}}}}
events: {{passes: {{bar.angle: {{falls to: {end!r}}}}}}}
duration: {1.3 * float(time)!r}
allow: {{bar.angle: 1.0e-3, hinge.fx: null, passes.time: 1.0e-2}}
"""
    return scenes.scene("pendulum", text, l=length), time


def passed(case: Case, time: Any) -> tuple[float, float]:
    """By how much [s] the time of `passes` is off, and what is stated of it."""
    solution = solve(case)
    record = solution.trajectory.record
    assert record is not None
    (found,) = reference_events(case.scene, record, case.events["passes"])
    return abs(float(mpmath.mpf(float(found)) - time)), stated(solution)["passes.time"]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["throw", "swing"])
@pytest.mark.parametrize("depth", [0.5, 1e-4, 1e-7])
def test_the_time_of_a_passage_is_off_by_no_more_than_is_stated(kind: str, depth: float) -> None:
    with mpmath.workdps(40):
        off, may = passed(*passing(kind, depth, 1))
        assert off <= may <= 1e-13 / math.sqrt(depth)


@pytest.mark.slow
@pytest.mark.mutant("the slope of a quantity left out of what is stated of its passage: a {kind}")
@pytest.mark.parametrize("kind", ["throw", "swing"])
def test_a_passage_without_its_slope_is_seen(kind: str, monkeypatch: Patch) -> None:
    monkeypatch.setattr(errors, "lateness", lambda *_: 0.0)
    with mpmath.workdps(40):  # of which one, rounding decides
        each = (passed(*passing(kind, 1e-7, seed)) for seed in range(1, 9))
        assert any(off > may for off, may in each)
