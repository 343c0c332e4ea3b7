"""Every hand-written system in space obeys every law, and planted mistakes are seen by name."""

import importlib
import math
from collections.abc import Callable, Iterator
from typing import Any
from unittest import mock

import numpy as np
import pytest
from given.laws import difference
from given.laws import spatial_laws as laws
from given.machines import gimbals, robots, spatial, wheels
from given.machines.spatial import SPATIAL, VARIANTS, closed, only, states, variant
from given.mutants import in_ground_axes, mutant, transposed

from textmech.reference.formalisms import appell, chaplygin, voronets
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Mode

# Every hand-written system in space obeys every law, and planted mistakes are seen by name.

ASKED: dict[str, dict[str, laws.Law]] = {
    name: {"lagrangian": laws.lagrangian(name), **{law.__name__: law for law in laws.COMMON}}
    for name in SPATIAL
}
ASKED["tilting_disk"]["rolling"] = ASKED["tilting_ring"]["rolling"] = laws.rolling
EACH = [(name, law) for name, known in ASKED.items() for law in known]

# What the case files say of the start, typed again: columns of the pose and their values.
c20, s20 = math.cos(math.radians(20)), math.sin(math.radians(20))
c6, s6, c12, s12 = (f(math.radians(a)) for a in (6, 12) for f in (math.cos, math.sin))
minus, plus = 0.75, -0.35  # half of psi0 − phi0, of psi0 + phi0
STARTS: dict[str, dict[int, float]] = {
    "heavy_top": {
        0: 0.0, 1: -0.05 * math.sin(math.radians(40)), 2: 0.05 * math.cos(math.radians(40)),
        3: c20, 4: s20, 5: 0.0, 6: 0.0, 10: 0.6, 11: -0.9, 12: 150.0,
    },
    "tilting_disk": {
        0: 0.0, 1: 0.0, 2: 0.25 * c12, 3: c6, 4: s6, 5: 0.0, 6: 0.0,
        7: 0.25 * 5.0, 8: -0.25 * 0.3 * c12, 9: -0.25 * 0.3 * s12, 10: 0.3, 11: 5.0, 12: -0.8,
    },
    "torque_free": {
        0: 0.0, 1: 0.0, 2: 0.0, 7: 0.3, 8: -0.2, 9: 4.0, 10: 1.0, 11: 2.0, 12: 3.0,
        3: math.cos(0.35) * math.cos(plus), 4: math.sin(0.35) * math.cos(minus),
        5: math.sin(0.35) * math.sin(minus), 6: math.cos(0.35) * math.sin(plus),
    },
}  # fmt: skip
STARTS["tilting_ring"] = STARTS["tilting_disk"]


def start(name: str, mode: Mode) -> float:
    """How far the pose of the start is from the typed one, of 1 or its size."""
    (pose,) = mode.poses(0.0, *mode.start()).values()
    return max(abs(pose[i] - value) / (1 + abs(value)) for i, value in STARTS[name].items())


def seen(name: str, mode: Mode, *by: str) -> None:
    """Sound, the laws hold; with the mistake each of these is broken."""
    for law in by:
        ask = ASKED[name][law]
        assert not laws.broken(ask(only(name), states(name, 20))), "sound, and yet refused"
        assert laws.broken(ask(mode, states(name, 20))), law


@pytest.mark.parametrize(("name", "law"), EACH)
def test_mode_obeys(name: str, law: str):
    violation = ASKED[name][law](only(name), states(name))
    assert not laws.broken(violation), violation


@pytest.mark.parametrize("name", SPATIAL)
def test_it_starts_as_the_case_says(name: str):
    assert start(name, only(name)) < 1e-15


@pytest.mark.parametrize("name", VARIANTS)
def test_motion_meets_the_closed_form(name: str):
    """To 1e-12 of each coordinate's size, and at the start to rounding.

    Over 4 s, and 1 s of tops, which have a dozen nutations then: phases lose 1e-14 a radian.
    """
    system = variant(name)
    times = np.linspace(0.0, 1.0 if VARIANTS[name][0] == "heavy_top" else 4.0, 21)
    known = np.array([np.concatenate(closed(system, t)) for t in times.tolist()])
    size = 1 + np.abs(known).max(0)
    assert np.all(np.abs(known[0] - np.concatenate(system.start()[1:])) <= 2e-15 * size)
    assert np.all(np.abs(follow(system, times).y - known).max(0) <= 1e-12 * size)


@pytest.mark.mutant("gravity upside down in the accelerations of {name}")
@pytest.mark.parametrize("name", ["heavy_top", "tilting_disk", "tilting_ring"])
def test_sign_of_gravity(name: str):
    sound: Any = only(name)
    module: Any = importlib.import_module(type(sound).__module__)

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        with mock.patch.object(module, "G", -9.80665):
            return sound.accelerations(t, q, v)

    seen(name, mutant(sound, accelerations=accelerations), "lagrangian", "free_bodies", "energy")


# Which law sees a parameter that is 5 % off in the explicit accelerations and reactions only.
PARAMETER = {
    ("heavy_top", "m"): "lagrangian", ("heavy_top", "l"): "energy",
    ("heavy_top", "A"): "free_bodies", ("heavy_top", "C"): "lagrangian",
    ("tilting_disk", "m"): "lagrangian", ("tilting_disk", "R"): "energy",
    ("tilting_ring", "m"): "free_bodies", ("tilting_ring", "R"): "lagrangian",
    ("tilting_ring", "A"): "energy", ("tilting_ring", "C"): "lagrangian",
    ("torque_free", "A"): "energy", ("torque_free", "B"): "lagrangian",
    ("torque_free", "C"): "free_bodies", ("torque_free", "gravity"): "lagrangian",
}  # fmt: skip
DROPS_OUT = {("torque_free", "m"), ("tilting_disk", "mu"), ("tilting_ring", "mu")}


@pytest.mark.mutant("{parameter} of {name} 5 % off in its explicit accelerations and reactions")
@pytest.mark.parametrize(("name", "parameter"), PARAMETER)
def test_parameter_off_in_the_explicit_accelerations(name: str, parameter: str):
    off: Any = only(name, **{parameter: 1.05 * SPATIAL[name][parameter]})
    explicit: dict[str, Callable[..., Any]] = {
        "accelerations": lambda self, t, q, v: off.accelerations(t, q, v),
        "reactions": lambda self, t, q, v: off.reactions(t, q, v),
    }
    seen(name, mutant(only(name), **explicit), PARAMETER[name, parameter])


@pytest.mark.parametrize(("name", "parameter"), sorted(DROPS_OUT))
def test_parameter_that_drops_out(name: str, parameter: str):
    """Of the motion: the mass of a body that nothing holds, friction that is enough."""
    sound, off = only(name), only(name, **{parameter: 1.05 * SPATIAL[name][parameter]})
    for t, q, v in states(name, 5):
        np.testing.assert_array_equal(off.accelerations(t, q, v), sound.accelerations(t, q, v))
        assert off.reactions(t, q, v) == sound.reactions(t, q, v)


@pytest.mark.mutant("each parameter of a body in space 5 % off at the start")
def test_parameter_off_at_the_start():
    """All that the start depends on and the accelerations do not; 5 % of it are seen."""
    found = {
        (name, key)
        for name, parameters in SPATIAL.items()
        for key, value in parameters.items()
        if start(name, only(name, **{key: 1.05 * value})) > 1e-3
    }
    known = {(name, key) for name, parameters in SPATIAL.items() for key in parameters}
    assert found | set(PARAMETER) | DROPS_OUT == known
    assert not found & DROPS_OUT
    assert found & set(PARAMETER) == {
        ("heavy_top", "l"),
        ("tilting_disk", "R"),
        ("tilting_ring", "R"),
    }


@pytest.mark.mutant("ω in the poses of {name} in ground axes")
@pytest.mark.parametrize("name", SPATIAL)
def test_spin_in_ground_axes_is_seen(name: str):
    """ω of a pose stands in body axes."""
    spoiled = mutant(only(name), poses=in_ground_axes)
    seen(name, spoiled, "rates_of_poses", "koenig", "free_bodies")


@pytest.mark.mutant("attitude in the poses of {name} transposed")
@pytest.mark.parametrize("name", SPATIAL)
def test_attitude_from_ground_to_body_is_seen(name: str):
    """A transposed E: the quaternion of the turn back."""
    seen(name, mutant(only(name), poses=transposed), "rates_of_poses", "free_bodies")


# The hand-written systems in space against what needs no multipliers, at a hundred states.

FORMS = {"voronets": voronets, "chaplygin": chaplygin, "appell": appell}
STATES = 100
LIMIT = 1e-12  # of the largest acceleration, or of 1 m/s² or rad/s²
# Which apply. What is driven throughout leaves nothing free; an Euler angle or a joint's angle
# depends on no other; a quaternion does, and appears everywhere.
APPLY: dict[str, set[str]] = {
    "heavy_top": {"appell"},
    "tilting_disk": set(FORMS),
    "tilting_ring": set(FORMS),
    "sprung_gimbal": {"appell"},
    "torque_free": {"voronets", "appell"},
    "upright_wheel": set(FORMS),
    "driven_wheel": set(),
    "driven_robot": set(),
    "five_axis_robot": {"appell"},
    "robot_knife": {"voronets", "appell"},
}


def drawn(name: str) -> tuple[Mode, Iterator[tuple[float, Array, Array]]]:
    """The system and its random states."""
    if name in spatial.SPATIAL:
        return spatial.only(name), spatial.states(name, STATES)
    if name in gimbals.PARAMETERS:
        return gimbals.gimbal(), gimbals.states(STATES)
    room: Any = wheels if name in wheels.PARAMETERS else robots
    mode = room.wheel(name) if room is wheels else room.robot(name)
    return mode, room.states(mode, STATES)


def test_every_system_in_space_is_asked() -> None:
    rooms = (spatial.SPATIAL, wheels.PARAMETERS, robots.PARAMETERS, gimbals.PARAMETERS)
    assert set(APPLY) == set().union(*rooms)


@pytest.mark.slow
@pytest.mark.parametrize("name", APPLY)
def test_formalisms_agree(name: str) -> None:
    mode, states = drawn(name)
    for at in states:
        for key, form in FORMS.items():
            found = form.accelerations(mode, *at)
            assert (found is not None) == (key in APPLY[name]), key
            if found is not None:
                assert difference(mode.accelerations(*at), found, 1.0) < LIMIT, key
