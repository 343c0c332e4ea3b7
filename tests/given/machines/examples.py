"""The hand-written systems as their cases set them, and what their starts must be."""

import math

from textmech.reference.system import MOVING, Mode, System
from textmech.reference.systems import written

BOOK = {"F_minus": 3.0, "F_plus": 3.0, "Fs_minus": 6.0, "Fs_plus": 6.0}
BAND = {"Delta": 5e-4, "A": 1e5}
THROWN = {"b": 0.0, "v0": 1.55, "x0": -0.15}
PARAMETERS: dict[str, dict[str, float]] = {
    "anisotropic_drift": {
        "m": 1.0, "A": 5.0, "w": 2 * math.pi,
        "F_minus": 3.0, "F_plus": 1.0, "Fs_minus": 4.0, "Fs_plus": 1.5,
    },
    "ball_on_rope": {"m": 0.6, "L": 1.0, "x0": 0.6, "y0": 0.25, "vx0": 0.0, "vy0": 0.0},
    "bar_pendulum": {"m": 1.2, "l": 0.8, "phi0": math.radians(24.6)},
    "bearing": {
        "m": 1.5, "R": 0.3, "M_s": 0.5, "M_k": 0.3, "d": 0.05, "M": 0.1, "k": 0.0, "w0": 9.0,
    },
    "bouncing_disk": {"m": 0.8, "R": 0.2, "e": 1.0, "y0": 0.7},
    "charge_in_field": {"m": 1.3, "e": 0.7, "B": 5.0, "v0": 2.0, "F": 1.5},
    "compass_walker": {
        "M": 10.0, "m": 5.0, "l": 1.0, "gamma": 0.02, "mu": 1.0,
        "left0": 1.7842780686758, "right0": 1.3573145849140,
        "w0": 0.8616538877376, "u0": 0.6753027032217,
    },
    "light_feet": {
        "M": 10.0, "m": 0.1, "l": 1.0, "J_f": 2e-5, "gamma": 0.009, "mu": 1.0,
        "left0": 1.7696248305769222, "right0": 1.371967823012871,
        "w0": 0.6280764237234776, "u0": 0.5790887993278023,
    },
    "double_pendulum": {
        "m1": 1.0, "l1": 0.6, "m2": 0.7, "l2": 0.9,
        "a0": math.radians(-61), "b0": math.radians(-33),
    },
    "drag_stops": {"m": 2.0, "d": 3.0, "alpha": 0.5, "v0": 2.0},
    "driven_edge": {
        "m": 1.7, "J": 0.09, "a": 0.35, "w0": 1.5, "A": 0.8, "Omega": 2.0,
        "alpha": math.radians(50),
    },
    "driven_knee": {"m": 3.5, "l": 0.45, "c": 40.0, "d": 1.5, "A": 2.5, "Omega": 5.0},
    "dynamometer": {"m": 1.0, "c": 2.0, "u": 2.0, **BOOK},
    "falling_drag": {"m": 0.5, "d": 0.2},
    "elastic_pendulum": {"m": 1.5, "c": 90.0, "l0": 0.7, "r0": 1.0, "phi0": math.radians(-40)},
    "four_bar": {
        "m": 1.0, "a": 0.3, "b": 0.8, "c": 0.6, "d": 0.9, "crank0": math.radians(70),
    },
    "friction_cone": {
        "m": 2.0, "mu_s": 0.5, "mu_k": 0.35, "beta": math.radians(10), "b_x": 4.0, "b_y": 1.0,
    },
    "friction_of_rest": {"m": 1.0, "c": 10.0, "u": 0.5, "mu_s": 0.6, "mu_k": 0.3},
    "growing_force": {"m": 1.0, "b": 1.0, **BOOK},
    "knife_edge": {"m": 1.4, "J": 0.06, "beta": math.radians(15), "u0": 0.3, "w0": 1.3},
    "paired_rotors": {
        "m1": 1.5, "R1": 0.3, "m2": 0.8, "R2": 0.2, "M": 0.3, "Omega": 6.0, "w0": 2.0,
    },
    "particle_pendulum": {"m": 0.6, "x0": 0.45, "y0": 0.6},
    "rhombus": {
        "m": 0.5, "l": 0.4, "c": 60.0, "l0": 0.5,
        "left0": math.radians(-130), "right0": math.radians(-60),
    },
    "rimless_wheel": {
        "n": 8.0, "l": 0.3, "m": 2.0, "J": 0.09, "gamma": 0.1, "mu": 2.0, "w0": 3.3,
    },
    "rolling_wheel": {
        "m": 1.3, "R": 0.25, "mu": 0.5, "beta": math.radians(20), "F": 2.5, "v0": 0.4, "w0": 1.6,
    },
    "sleigh": {"m": 1.7, "J": 0.09, "a": 0.35, "v0": 0.8, "w0": 1.5},
    "sliding_block": {
        "m": 1.4, "mu_s": 0.5, "mu_k": 0.4, "beta": math.radians(20), "v0": -2.0,
    },
    "sliding_disk": {
        "m": 1.3, "R": 0.25, "mu": 0.4, "beta": math.radians(10), "v0": 3.0, "w0": 20.0,
    },
    "sliding_ladder": {"m": 2.0, "l": 1.5, "phi0": math.radians(70)},
    "cradle": {
        "m1": 1.0, "m2": 0.6, "m3": 1.7, "R": 0.05, "e": 0.8, "v0": 1.0, "x2": 0.37, "x3": 0.63,
    },
    "disk_on_disk": {
        "m": 1.0, "M": 3.0, "R": 0.5, "r": 0.1, "mu": 0.4, "theta0": math.radians(78), "L": 0.6,
    },
    "stacked_blocks": {
        "m1": 2.0, "m2": 1.0, "w1": 0.8, "h1": 0.2, "w2": 0.2, "h2": 0.1, "mu1": 0.1, "mu2": 0.4,
        "b": 30.0, "v0": 0.0, "x0": 0.1,
    },
    "tipping_block": {"m": 3.0, "w": 0.3, "H": 0.6, "b": 12.0, "mu": 0.8},
    "smooth_dynamometer": {"m": 1.0, "c": 2.0, "u": 2.0, **BOOK, **BAND},
    "smooth_growing_force": {"m": 1.0, "b": 1.0, **BOOK, **BAND},
    "spring_mass_damper": {"m": 1.0, "c": 36.0, "d": 1.2, "l0": 0.5, "y0": -0.6},
    "stopped_pendulum": {
        "m": 1.2, "l": 0.8, "phi0": math.radians(10), "low": math.radians(-60), "e": 0.0,
    },
    "stribeck_brake": {"m": 1.3, "F": 3.0, "Fs": 6.0, "v_s": 0.5, "P": 0.5, "v0": 2.0},
    "stribeck_drive": {"m": 2.0, "c": 2.0, "u": 1.0, "F": 3.0, "Fs": 6.0, "v_s": 0.5},
    "running_gait": {
        "m": 80.0, "c": 20000.0, "l0": 1.0, "alpha": math.radians(112), "vx0": 5.11575105401509,
        "vy0": -0.5072041586666318, "x2": 1.2783908793771184, "x3": 2.556781758754237,
        "x4": 3.835172638131355,
    },
    "spring_mass_jump": {
        "m": 80.0, "c": 16000.0, "l0": 1.0, "alpha": math.radians(115), "vx0": 9.0, "vy0": -0.2,
    },
    "torsion_pendulum": {
        "m": 1.5, "R": 0.3, "c": 2.4, "phi0": math.radians(-15), "d": 0.1, "M": 0.6, "Omega": 7.0,
        "phi": math.radians(70), "w0": 1.0,
    },
    "turning_sled": {
        "m": 1.5, "l": 0.8, "d": 0.6, "d_across": 7.0, "phi0": math.radians(50), "u0": 3.0,
        "w0": -0.5,
    },
    "viscous_drift": {"m": 1.3, "A": 5.0, "w": 6.0, "d_minus": 4.0, "d_plus": 1.0},
    "viscous_growing_force": {"m": 1.3, "b": 1.0, "d_minus": 3.0, "d_plus": 2.0},
    "trunk_on_legs": {
        "m": 30.0, "l": 0.9, "c": 4000.0, "l0": 0.6, "y0": 0.8, "phi0": math.radians(12), "w0": 1.0,
    },
}  # fmt: skip

# Systems of other parameters: changes, and the events that follow in the duration.
VARIANTS: dict[str, tuple[str, dict[str, float], list[str]]] = {
    "resting": ("rolling_wheel", {"beta": 0.0, "F": 0.0}, []),
    "pushed": ("rolling_wheel", {"beta": 0.0}, []),
    "downhill": ("rolling_wheel", {"F": 0.0}, []),
    "backward": ("sleigh", {"v0": -0.8, "w0": 0.3}, []),
    "pure spin": ("sleigh", {"v0": 0.0, "w0": -4.0}, []),
    "blade ahead": ("sleigh", {"a": -0.2}, []),
    "straight": ("sleigh", {"w0": 0.0}, []),
    "slides straight": ("knife_edge", {"w0": 0.0}, []),
    "cycloid": ("knife_edge", {"u0": 0.0}, []),
    "turns the other way": ("driven_edge", {"w0": -0.7, "a": -0.2}, []),
    "undriven": ("torsion_pendulum", {"M": 0.0}, []),
    "creeping": ("torsion_pendulum", {"d": 3.0}, []),
    "free": ("spring_mass_damper", {"d": 0.0}, []),
    "critical": ("spring_mass_damper", {"d": 12.0}, []),
    "overdamped": ("spring_mass_damper", {"d": 30.0}, []),
    "plane, back": ("sliding_disk", {"beta": 0.0}, ["rolls"]),
    "plane, no spin": ("sliding_disk", {"beta": 0.0, "v0": -3.0, "w0": 0.0}, ["rolls"]),
    "up the incline": ("sliding_disk", {}, ["rolls"]),
    "too steep": ("sliding_disk", {"beta": math.radians(60)}, []),
    "too steep, released": (
        "sliding_disk", {"beta": math.radians(60), "v0": 0.0, "w0": 0.0}, [],
    ),
    "rolls from rest": ("sliding_disk", {"v0": 0.0, "w0": 0.0}, []),
    "stops above": ("sliding_block", {}, ["stops"]),
    "comes back": ("sliding_block", {"beta": math.radians(35)}, []),
    "rests": ("sliding_block", {"v0": 0.0}, []),
    "just sticks": ("sliding_block", {"v0": 0.0, "beta": math.atan(0.5) - 1e-6}, []),
    "just slides": ("sliding_block", {"v0": 0.0, "beta": math.atan(0.5) + 1e-6}, []),
    "friction rises": ("stribeck_brake", {}, ["stops"]),
    "pushed, too slow": ("stribeck_brake", {"P": 4.0, "v0": 0.5}, ["stops"]),
    "pushed, runs away": ("stribeck_brake", {"P": 4.0, "v0": 0.6}, []),
    "pushed as friction far off": ("stribeck_brake", {"P": 3.0, "v0": 1.0}, ["stops"]),
    "spun down": ("bearing", {}, ["stops"]),
    "spun down dry": ("bearing", {"d": 0.0}, ["stops"]),
    "spun down viscous": ("bearing", {"M_s": 0.0, "M_k": 0.0}, []),
    "driven against both": ("bearing", {"M": 0.7}, []),
    "driven without oil": ("bearing", {"M": 0.7, "d": 0.0, "w0": 0.0}, []),
    "bearing at rest": ("bearing", {"w0": 0.0}, []),
    "growing torque": ("bearing", {"w0": 0.0, "k": 0.2037}, ["slips"]),
    "growing torque without oil": ("bearing", {"w0": 0.0, "k": 0.2037, "d": 0.0}, ["slips"]),
    "brakes": ("sliding_block", {"beta": 0.0, "v0": 2.0}, ["stops"]),
    "drawn down the slope": ("friction_cone", {}, ["slips"]),
    "pushed up the slope": ("friction_cone", {"b_x": -4.0, "b_y": -1.5}, ["slips"]),
    "drawn up the slope": ("friction_cone", {"beta": math.radians(-12)}, ["slips"]),
    "drawn to the left": ("friction_cone", {"beta": 0.0, "b_x": -4.0, "b_y": 0.0}, ["slips"]),
    "dynamometer on a floor": ("friction_of_rest", {}, ["slips", "stops"] * 2),
    "slips for good": ("growing_force", {}, ["slips"]),
    "stick-slip": ("dynamometer", {}, ["slips", "stops"] * 2),
    "elastic": ("bouncing_disk", {}, ["bounces"] * 5),
    "plastic": ("bouncing_disk", {"e": 0.0}, ["lands"]),
    "handed on": ("cradle", {"m2": 1.0, "m3": 1.0, "e": 1.0}, ["first strikes", "second strikes"]),
    "handed back": (
        "cradle", {}, ["first strikes", "second strikes", "first strikes"],
    ),
    "pulled away": ("stacked_blocks", {}, ["slides", "slips"]),
    "thrown, and drags": ("stacked_blocks", THROWN, ["joins", "stops"]),
    "thrown on what rests": ("stacked_blocks", {**THROWN, "mu1": 0.5}, ["joins"]),
    "walks": ("rimless_wheel", {}, [f"spoke {k} strikes" for k in range(2, 8)]),
    "walks over with few spokes": (
        "rimless_wheel", {"n": 6.0, "gamma": 0.15, "w0": 4.0},
        [f"spoke {k} strikes" for k in range(2, 6)],
    ),
}  # fmt: skip
DURATION = {
    "stribeck_brake": 2.0,
    "sliding_block": 1.0,
    "sliding_disk": 2.0,
    "ball_on_rope": 1.5,
    "bouncing_disk": 3.0,
    "friction_cone": 5.0,
    "friction_of_rest": 6.0,
    "rimless_wheel": 2.0,
    "sliding_ladder": 0.7,
    "tipping_block": 1.0,
    "cradle": 1.0,
    "disk_on_disk": 0.8,
    "stacked_blocks": 0.8,
}  # 10 s else


def example(name: str, **changed: float) -> System:
    """The system of the case, with some of its parameters changed."""
    return written(name, {**PARAMETERS[name], **changed})


def only(name: str, **changed: float) -> Mode:
    """The only mode of a smooth system."""
    return example(name, **changed).modes[MOVING]


def duration(name: str) -> float:
    """How long [s] the system is followed."""
    return DURATION.get(name, 10.0)


SMOOTH = [name for name in PARAMETERS if list(example(name).modes) == [MOVING]]
MODES = [(name, mode) for name in PARAMETERS for mode in example(name).modes]
