"""Which law sees a parameter that is 5 % off in a hand-written system that never switches."""

from .. import laws
from ..scenes import slowed
from . import Law, rotors

# Which law sees a parameter that is 5 % off in the explicit accelerations and reactions only.
# Where a mass drops out of the motion, the reactions tell.
PARAMETER: dict[str, dict[str, Law]] = {
    "rolling_wheel": {
        "m": laws.equations, "R": laws.equations, "beta": laws.free_cut, "F": laws.free_cut,
    },
    "bar_pendulum": {"m": laws.reactions, "l": laws.equations},
    "double_pendulum": {
        "m1": laws.equations, "l1": laws.free_cut, "m2": laws.power, "l2": laws.equations,
    },
    "four_bar": {
        "m": laws.multipliers, "a": laws.equations, "b": laws.free_cut, "c": laws.power,
    },
    "particle_pendulum": {"m": laws.reactions, "x0": laws.equations, "y0": laws.equations},
    "rhombus": {
        "m": laws.equations, "l": laws.free_cut, "c": laws.power, "l0": laws.equations,
    },
    **slowed.SEEN_BY, **rotors.SEEN_BY,
    "driven_edge": {
        "m": laws.reactions, "J": laws.multipliers, "a": laws.equations, "A": laws.equations,
        "Omega": laws.equations, "alpha": laws.equations,
    },
    "elastic_pendulum": {"m": laws.equations, "c": laws.power, "l0": laws.free_cut},
    "driven_knee": dict.fromkeys("mlcd", laws.reactions)
    | dict.fromkeys(("A", "Omega"), laws.equations),
    "knife_edge": {"m": laws.reactions, "beta": laws.power},
    "sleigh": {"m": laws.reactions, "J": laws.multipliers, "a": laws.equations},
    "spring_mass_damper": {
        "m": laws.equations, "c": laws.free_cut, "d": laws.power, "l0": laws.equations,
    },
    "torsion_pendulum": {
        "m": laws.equations, "R": laws.free_cut, "c": laws.equations, "phi0": laws.power,
        "d": laws.power, "M": laws.equations, "Omega": laws.free_cut,
    },
}  # fmt: skip

# Which law sees a parameter that is 5 % off in the start only.
AT_THE_START: dict[str, dict[str, Law]] = {
    "charge_in_field": {"v0": laws.start},
    "rolling_wheel": {"R": laws.start, "v0": laws.start, "w0": laws.start},
    "bar_pendulum": {"phi0": laws.closed_form}, "spring_mass_damper": {"y0": laws.start},
    "double_pendulum": {"a0": laws.start, "b0": laws.start},
    "four_bar": dict.fromkeys(("a", "b", "c", "d", "crank0"), laws.start),
    "rhombus": {"left0": laws.start, "right0": laws.start},
    "driven_edge": {"w0": laws.start, "A": laws.start, "alpha": laws.start},
    "elastic_pendulum": {"r0": laws.start, "phi0": laws.start},
    "knife_edge": {"u0": laws.start, "w0": laws.start},
    "sleigh": {"v0": laws.start, "w0": laws.start},
    "paired_rotors": {"w0": laws.start}, "torsion_pendulum": {"phi": laws.start, "w0": laws.start},
    "turning_sled": {"phi0": laws.start, "u0": laws.start, "w0": laws.start},
}  # fmt: skip
