"""The laws of momentum (2.22)–(2.28) in integral form, along motions of free pairs of bodies."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from given import momenta
from given.momenta import Acting, Point, System, planar, samples
from given.scenes import mechanism, typed
from given.spring_pair import FREE, pair

from textmech.cases.case import Case
from textmech.reference.laws import momentum
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array

TIMES = samples(0.5, 32)
BARS = """\
scene:
  bodies: {one: {bar: {mass: 1.2, length: 0.8}}, two: {bar: {mass: 0.7, length: 0.5}}}
  joints: {elbow: {pin: [one.end, two.start]}}
initial:
  one: {x: 0, y: 1, angle: 20 deg, vx: 0.5, vy: 3, omega: 4}
  two: {angle: -70 deg, omega: -6}
allow: {one.x: 1.0e-2}
"""


def bars(case: Case) -> System:
    """Two pinned bars thrown into the air, generated from their scene."""
    generated = mechanism(case)
    motion = Answer(generated, follow(generated, TIMES)).trajectory(TIMES)
    bodies = {
        name: planar(m, m * l**2 / 12, motion.states[name])
        for name, m, l in (("one", 1.2, 0.8), ("two", 0.7, 0.5))
    }
    g = np.array([0.0, -9.80665, 0.0])
    weights = [Acting(b.r, np.tile(b.m * g, (len(TIMES), 1))) for b in bodies.values()]
    return System(TIMES, bodies, weights)


@cache
def in_space() -> System:
    """Two bodies and a spring, tumbling and falling."""
    return pair(TIMES, follow(FREE, TIMES).y)


@pytest.fixture(scope="module")
def in_the_plane(tmp_path_factory: pytest.TempPathFactory) -> System:
    path: Path = tmp_path_factory.mktemp("bars")
    return bars(typed(path, BARS))


@pytest.mark.parametrize("law", momenta.LAWS)
def test_a_pair_of_bars_obeys(law: Callable[[System], float], in_the_plane: System):
    assert law(in_the_plane) <= momenta.LIMIT


@pytest.mark.slow
@pytest.mark.parametrize("law", momenta.LAWS)
def test_two_bodies_in_space_obey(law: Callable[[System], float]):
    assert law(in_space()) <= momenta.LIMIT


@pytest.mark.slow
def test_each_body_changes_by_the_force_between_them():
    """What the laws leave out inside: alone, one of the pair obeys none of them."""
    s = in_space()
    alone = replace(s, bodies={"one": s.bodies["one"]}, forces=s.forces[:1])
    for law in momenta.LAWS:
        assert law(alone) > 1e-3


def absolute(s: System) -> float:
    """(2.28) with absolute velocities in D_A, which the printed text leaves open."""
    A = momenta.wandering(s.times)
    by = s.moment(A.r) + s.m * np.cross(A.a, s.centre - A.r)
    return s.law(s.D(A.r, 0.0), by)


def uncorrected(s: System) -> float:
    """Ḋ_A = M_A for a point that is not fixed."""
    A = momenta.wandering(s.times)
    return s.law(s.D(A.r, A.v), s.moment(A.r))


def about_the_origin_with_M_c(s: System) -> float:
    """Ḋ₀ = M_c."""
    return s.law(s.D(0.0, 0.0), s.moment(s.centre))


@pytest.mark.slow
@pytest.mark.mutant("{wrong}")
@pytest.mark.parametrize("wrong", [absolute, uncorrected, about_the_origin_with_M_c])
def test_another_law_does_not_hold(wrong: Callable[[System], float], in_the_plane: System):
    assert wrong(in_the_plane) > 1e-2
    assert wrong(in_space()) > 1e-2


@pytest.mark.slow
def test_the_point_must_move_as_its_acceleration_says(monkeypatch: pytest.MonkeyPatch):
    """A centre of mass, too, is a moving point: there M_A + m r̈_A × a = M_c."""
    s = in_space()
    force = np.sum([f.force for f in s.forces], axis=0)
    monkeypatch.setattr(momenta, "wandering", lambda times: Point(s.centre, s.p / s.m, force / s.m))
    assert momenta.about_a_moving_point(s) <= momenta.LIMIT


def moment_change(M_A: Array, m: float, a_A: Array, a: Array) -> Array:
    """(2.28) with the factors of its last term exchanged."""
    return M_A + m * np.cross(a, a_A)


def spin_only(m: float, J: Array, r: Array, v: Array, omega: Array) -> Array:
    """(2.24) without the part of the centre."""
    return J @ omega


def steiner_only(m: float, J: Array, r: Array, v: Array, omega: Array) -> Array:
    """(2.24) without the body's own turning."""
    return np.cross(r, m * v)


@pytest.mark.mutant("{wrong}")
@pytest.mark.parametrize(
    ("name", "wrong", "law"),
    [
        ("moment_change", moment_change, momenta.about_a_moving_point),
        ("angular_momentum", spin_only, momenta.about_the_origin),
        ("angular_momentum", steiner_only, momenta.about_the_origin),
        ("angular_momentum", steiner_only, momenta.about_the_centre),
    ],
)
def test_a_planted_mistake_is_seen(
    name: str,
    wrong: Callable[..., Array],
    law: Callable[[System], float],
    in_the_plane: System,
    monkeypatch: pytest.MonkeyPatch,
):
    assert getattr(momenta, name) is getattr(momentum, name)
    monkeypatch.setattr(momenta, name, wrong)
    for s in (in_the_plane, in_space()):
        assert law(s) > 1e-3


@pytest.mark.mutant("J ω in body axes added to moments in ground axes")
def test_spin_in_body_axes_is_seen():
    """J ω of body axes added to moments in ground axes."""
    s = in_space()
    turned = {
        name: replace(b, R=np.tile(np.eye(3), (len(TIMES), 1, 1))) for name, b in s.bodies.items()
    }
    assert momenta.about_the_centre(replace(s, bodies=turned)) > 1e-3
