"""The book's approximations of dry friction as producers of motions, to be compared with the law.

The smooth law (2.95) makes a system of its own, `systems/smooth_friction`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..laws.friction import Dry, boxcar
from ..system import Array, Guard, System
from ..systems.friction.stick_slip import Pull, guards, modes
from .stepping import stepped


@dataclass(frozen=True)
class Karnopp(System):
    """A block m [kg] at rest at x = 0, with the band |v| ≤ Δ [m/s] in place of v = 0.

    Taken literally it keeps in the band the v with which it sticks; by Karnopp's own rule v := 0.
    """

    m: float
    pull: Pull
    dry: Dry
    Delta: float
    literal: bool

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", modes(self.m, self.pull, self.dry))

    def start(self) -> tuple[str, Array, Array]:
        """At rest at x = 0, where it must stick."""
        return "stuck", np.zeros(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.91) `slips` and `stops`."""
        return guards(self.pull, self.dry, mode, Delta=self.Delta, keeps_v=self.literal)


def boxcars(
    m: float,
    F_a: Callable[[float, float], float],
    dry: Dry,
    *,
    Delta: float,
    h: float,
    steps: int,
) -> Array:
    """(2.94) with (2.93) in steps of h [s] from rest: x and v at every step, (steps + 1, 2).

    But for the edges it is (2.91) taken literally, and for h → 0 so is its motion.
    """
    return stepped(
        m, F_a, lambda v, f: boxcar(dry, Delta, v, f), h=h, steps=steps, rests=lambda *_: False
    )
