"""A block with dry friction on a guide, whatever pulls it: (2.88) with (2.89)."""

from collections.abc import Sequence

import numpy as np

from ...laws.friction import Dry
from ...system import Array, Guard, System
from .stick_slip import Pull, guards, modes, possible


class BlockOnGuide(System):
    """m [kg], q = (x,); sliding friction F and static friction Fs [N], to −x and to +x."""

    m: float
    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", modes(self.m, self.pull, self.dry))

    @property
    def pull(self) -> Pull:
        """The forces on the block but friction."""
        raise NotImplementedError

    @property
    def dry(self) -> Dry:
        """The bounds of the friction [N]."""
        return Dry(self.F_minus, self.F_plus, self.Fs_minus, self.Fs_plus)

    def start(self) -> tuple[str, Array, Array]:
        """At rest at x = 0; a spring has no force there."""
        return "stuck", np.zeros(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.89) `slips` and `stops`."""
        return guards(self.pull, self.dry, mode)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) F_a within the static friction where it sticks."""
        return possible(self.modes[mode], self.dry, t, q, v) if mode == "stuck" else None
