"""Every shipped case that is smooth moves the same, read a second time."""

from typing import Any

import pytest

from second import answer, both, size
from second.motion import Motion

BAR = 1e-7  # of the size of the motion: both integrate to some 1e-10 of it, forces to 1e-9
SWITCHES = {
    "anisotropic_drift", "ball_on_rope", "bearing", "bouncing_disk", "compass_walker", "cradle",
    "disk_on_disk", "dynamometer", "dynamometer_smooth", "friction_cone", "friction_of_rest",
    "growing_force", "growing_force_smooth", "rimless_wheel", "rolling_into_wall",
    "simplest_walker", "sliding_block", "sliding_disk", "sliding_ladder", "stacked_blocks",
    "stopped_pendulum", "stribeck_brake", "stribeck_drive", "tipping_block", "bouncing_ball",
    "break_away", "creeping_block", "friction_at_rest", "heavy_on_light", "held_joint", "landing",
    "rolling_down", "sinking_ball", "running_gait", "running_step", "spring_mass_jump",
    "trunk_on_legs",
}  # fmt: skip
"""Files whose motion is not smooth: `test_switching.py` has them."""
SHORT = {
    "charge_in_field", "elastic_pendulum", "falling_drag", "falling_too_far",
    "growing_force_viscous", "pushed_cart", "rolling_sphere", "rolling_wheel", "shaken_pendulum",
    "spinning_body", "torque_free", "turning_sled", "wheel_from_above",
}  # fmt: skip
"""Files that take a fifth of a second a case: the others are slow tests."""
SMOOTH = [
    name
    for name, case in both.EVERY.items()
    if case.states is None and name.split(".")[0] not in SWITCHES and name != "drag_stops.root"
]


def disagree(motion: Motion, told: both.Answer, wanted: list[str]) -> dict[str, float]:
    """The quantities that lie further apart than the bar, and by how much of the motion.

    A work is summed up by the reference over its samples, and no better than it says.
    """
    found = {}
    for name in wanted:
        known, seen = both.answered(told, name), answer.observed(motion, name)
        parts = size.parts(motion, name, known, seen)
        stated = both.stated(told, name) if name.endswith(".work") else 0.0
        if not parts < BAR + stated / size.size(motion, name, known):
            found[name] = parts
    return found


def at_samples(case: dict[str, Any]) -> list[str]:
    """The quantities that a case asks over its samples, and not at events."""
    return [name for name in case["allow"] if name.split(".")[0] not in (case.get("events") or {})]


def unhurried(names: list[str], short: set[str]) -> list[Any]:
    """The names, all but those of short files as slow tests."""
    return [
        n if n.split(".")[0] in short else pytest.param(n, marks=pytest.mark.slow) for n in names
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", unhurried(SMOOTH, SHORT))
def test_a_smooth_case_moves_the_same(name: str) -> None:
    case = both.reread(name)
    assert disagree(answer.motion(case), both.stored(name), at_samples(case)) == {}
