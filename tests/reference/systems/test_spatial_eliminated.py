"""The hand-written systems in space against what needs no multipliers, at a hundred states."""

from collections.abc import Iterator
from typing import Any

import pytest
from given import gimbals, robots, spatial, wheels
from given.laws import difference

from textmech.reference.formalisms import appell, chaplygin, voronets
from textmech.reference.system import Array, Mode

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
