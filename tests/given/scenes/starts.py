"""What the case files say of how the hand-written systems start, typed again."""

import math

_BLOCK = [("block", 0, 0.0, 0.0), ("block", 3, 0.0, 0.0)]
# What the case files say of the start, typed again: body, column of its pose, value, margin. Of
# the rocker they only say near which of the two ways to close the loop it is.
STARTS: dict[str, list[tuple[str, int, float, float]]] = {
    "anisotropic_drift": _BLOCK,
    "ball_on_rope": [
        ("ball", 0, 0.6, 0.0), ("ball", 1, 0.25, 0.0), ("ball", 3, 0.0, 0.0), ("ball", 4, 0.0, 0.0),
    ],
    "bar_pendulum": [("bar", 2, 24.6 * math.pi / 180, 1e-15), ("bar", 5, 0.0, 0.0)],
    "bearing": [("disk", 2, 0.0, 0.0), ("disk", 5, 9.0, 0.0)],
    "bouncing_disk": [("wheel", 1, 0.7, 0.0), ("wheel", 4, 0.0, 0.0), ("wheel", 5, 0.0, 0.0)],
    "charge_in_field": [
        ("electron", 0, 0.0, 0.0), ("electron", 1, 0.0, 0.0), ("electron", 3, 2.0, 0.0),
        ("electron", 4, 0.0, 0.0),
    ],
    "compass_walker": [
        ("left", 2, 1.7842780686758, 0.0), ("right", 2, 1.3573145849140, 1e-15),
        ("left", 5, -0.8616538877376, 0.0), ("right", 5, -0.6753027032217, 0.0),
    ],
    "light_feet": [
        ("left", 2, 1.7696248305769222, 1e-15), ("right", 2, 1.371967823012871, 1e-15),
        ("left", 5, -0.6280764237234776, 0.0), ("right", 5, -0.5790887993278023, 0.0),
    ],
    "double_pendulum": [
        ("upper", 2, -61 * math.pi / 180, 1e-15), ("lower", 2, -33 * math.pi / 180, 1e-15),
    ],
    "driven_edge": [
        ("sleigh", 0, 0.35, 1e-15), ("sleigh", 1, 0.0, 0.0), ("sleigh", 2, 0.0, 0.0),
        ("sleigh", 3, 0.8 * math.sin(50 * math.pi / 180), 1e-15), ("sleigh", 4, 0.525, 1e-15),
        ("sleigh", 5, 1.5, 0.0),
    ],
    "drag_stops": [("block", 0, 0.0, 0.0), ("block", 3, 2.0, 0.0)],
    "driven_knee": [
        ("shank", 0, 0.225, 1e-15), ("shank", 1, 0.0, 0.0), ("shank", 2, 0.0, 0.0),
        ("shank", 5, 0.0, 0.0),
    ],
    "dynamometer": _BLOCK,
    "turning_sled": [
        ("sled", 0, 0.0, 0.0), ("sled", 1, 0.0, 0.0), ("sled", 2, 50 * math.pi / 180, 1e-15),
        ("sled", 3, 3.0, 0.0), ("sled", 4, -0.5, 0.0), ("sled", 5, 0.0, 0.0),
    ],
    "falling_drag": [("ball", 1, 0.0, 0.0), ("ball", 4, 0.0, 0.0)],
    "elastic_pendulum": [
        ("bob", 0, math.cos(40 * math.pi / 180), 1e-15), ("bob", 3, 0.0, 0.0),
        ("bob", 1, -math.sin(40 * math.pi / 180), 1e-15), ("bob", 4, 0.0, 0.0),
    ],
    "four_bar": [
        ("crank", 2, 70 * math.pi / 180, 1e-15), ("rocker", 2, 96 * math.pi / 180, 0.01),
    ],
    "friction_cone": _BLOCK,
    "friction_of_rest": _BLOCK,
    "growing_force": _BLOCK,
    "knife_edge": [
        ("blade", 0, 0.0, 0.0), ("blade", 1, 0.0, 0.0), ("blade", 2, 0.0, 0.0),
        ("blade", 3, 0.3, 0.0), ("blade", 4, 0.0, 0.0), ("blade", 5, 1.3, 0.0),
    ],
    "paired_rotors": [
        ("one", 2, 0.0, 0.0), ("one", 5, 2.0, 0.0), ("two", 2, 0.0, 0.0), ("two", 5, 2.0, 0.0),
    ],
    "particle_pendulum": [
        ("bob", 0, 0.45, 1e-15), ("bob", 1, 0.6, 1e-15), ("bob", 3, 0.0, 0.0), ("bob", 4, 0.0, 0.0),
    ],
    "rhombus": [
        ("left", 2, -130 * math.pi / 180, 1e-15), ("lower_right", 2, -130 * math.pi / 180, 1e-15),
        ("right", 2, -60 * math.pi / 180, 1e-15), ("lower_left", 2, -60 * math.pi / 180, 1e-15),
    ],
    "rimless_wheel": [
        ("wheel", 0, 0.0, 1e-16), ("wheel", 1, 0.3 * math.cos(math.pi / 8), 1e-16),
        ("wheel", 2, 0.0, 0.0), ("wheel", 5, -3.3, 0.0),
    ],
    "rolling_wheel": [
        ("wheel", 0, 0.0, 0.0), ("wheel", 1, 0.25, 0.0), ("wheel", 2, 0.0, 0.0),
        ("wheel", 3, 0.4, 1e-15), ("wheel", 5, -1.6, 1e-15),
    ],
    "sleigh": [
        ("sleigh", 0, 0.35, 1e-15), ("sleigh", 1, 0.0, 0.0), ("sleigh", 2, 0.0, 0.0),
        ("sleigh", 3, 0.8, 0.0), ("sleigh", 4, 0.525, 1e-15), ("sleigh", 5, 1.5, 0.0),
    ],
    "sliding_block": [("block", 0, 0.0, 0.0), ("block", 3, -2.0, 0.0)],
    "sliding_disk": [
        ("wheel", 0, 0.0, 0.0), ("wheel", 1, 0.25, 0.0), ("wheel", 2, 0.0, 0.0),
        ("wheel", 3, -3.0, 0.0), ("wheel", 5, -20.0, 0.0),
    ],
    "sliding_ladder": [
        ("rod", 0, 0.75 * math.cos(70 * math.pi / 180), 1e-15),
        ("rod", 1, 0.75 * math.sin(70 * math.pi / 180), 1e-15),
        ("rod", 2, -70 * math.pi / 180, 1e-15), ("rod", 5, 0.0, 0.0),
    ],
    "smooth_dynamometer": _BLOCK,
    "smooth_growing_force": _BLOCK,
    "spring_mass_damper": [("mass", 1, -0.6, 0.0), ("mass", 4, 0.0, 0.0)],
    "stopped_pendulum": [("bar", 2, 10 * math.pi / 180, 1e-15), ("bar", 5, 0.0, 0.0)],
    "stribeck_brake": [("block", 0, 0.0, 0.0), ("block", 3, 2.0, 0.0)],
    "stribeck_drive": _BLOCK,
    "viscous_drift": _BLOCK,
    "viscous_growing_force": _BLOCK,
    "running_gait": [
        ("jumper", 0, math.cos(112 * math.pi / 180), 1e-15), ("jumper", 3, 5.11575105401509, 1e-14),
        ("jumper", 1, math.sin(112 * math.pi / 180), 1e-15),
        ("jumper", 4, -0.5072041586666318, 1e-14),
    ],
    "spring_mass_jump": [
        ("jumper", 0, math.cos(115 * math.pi / 180), 1e-15), ("jumper", 3, 9.0, 1e-14),
        ("jumper", 1, math.sin(115 * math.pi / 180), 1e-15), ("jumper", 4, -0.2, 1e-14),
    ],
    "cradle": [
        ("left", 0, 0.0, 0.0), ("left", 3, 1.0, 0.0), ("middle", 0, 0.37, 0.0),
        ("right", 0, 0.63, 0.0), ("right", 3, 0.0, 0.0),
    ],
    "disk_on_disk": [
        ("wheel", 0, 0.6 * math.cos(78 * math.pi / 180), 1e-15),
        ("wheel", 1, 0.6 * math.sin(78 * math.pi / 180), 1e-15), ("wheel", 5, 0.0, 0.0),
        ("drum", 2, 0.0, 0.0), ("drum", 5, 0.0, 0.0),
    ],
    "stacked_blocks": [
        ("lower", 0, 0.0, 0.0), ("lower", 1, 0.1, 0.0), ("upper", 0, 0.1, 0.0),
        ("upper", 1, 0.25, 1e-16), ("upper", 3, 0.0, 0.0),
    ],
    "tipping_block": [
        ("box", 0, 0.0, 0.0), ("box", 1, 0.3, 0.0), ("box", 2, 0.0, 0.0), ("box", 5, 0.0, 0.0),
    ],
    "torsion_pendulum": [("disk", 2, 70 * math.pi / 180, 1e-15), ("disk", 5, 1.0, 0.0)],
    "trunk_on_legs": [
        ("trunk", 0, 0.0, 0.0), ("trunk", 1, 0.8, 0.0), ("trunk", 2, 12 * math.pi / 180, 1e-15),
        ("trunk", 4, 0.0, 0.0), ("trunk", 5, 1.0, 0.0),
    ],
}  # fmt: skip
