"""Which law sees a parameter of the paired rotors that is 5 % off."""

from .. import laws
from . import Law

SEEN_BY: dict[str, dict[str, Law]] = {
    "paired_rotors": {
        "m1": laws.free_cut, "R1": laws.equations, "m2": laws.reactions, "R2": laws.power,
        "M": laws.equations, "Omega": laws.free_cut,
    },
}  # fmt: skip
