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
LONG = {
    "opening_loop", "viscous_drift", "bar_pendulum", "five_axis_robot.from_rest", "paired_rotors",
    "driven_wheel.circle", "spatial_four_bar", "sprung_gimbal.free", "sprung_gimbal.driven",
    "universal_shaft", "leaking_pendulum", "top_on_floor", "upright_wheel.level",
    "crossed_pendulum",
    "slider_crank", "driven_robot", "five_axis_robot.swinging", "robot_knife", "skew_chain",
    "gyroscope", "heavy_top.cusp", "heavy_top.loops", "heavy_top.waves", "double_pendulum",
    "rhombus", "driven_wheel.weave", "driven_wheel.clothoid", "four_bar",
}  # fmt: skip
"""Those that take more than a second and a half."""
SMOOTH = [
    name
    for name, case in both.SHIPPED.items()
    if "states" not in case and name.split(".")[0] not in SWITCHES and name != "drag_stops.root"
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


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] if n in LONG else []) for n in SMOOTH]
)
def test_a_smooth_case_moves_the_same(name: str) -> None:
    case = both.SHIPPED[name]
    assert disagree(answer.motion(case), both.stored(name), at_samples(case)) == {}
