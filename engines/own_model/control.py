"""The controls of a model as functions of time."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ...cases.model_case import Law
from ...cases.trajectory import Array


@dataclass(frozen=True)
class Controls:
    """Numbers (nu,) that stay what they are at the start, and laws by the number of a control."""

    still: Array
    laws: Mapping[int, Law] = field(default_factory=dict[int, Law])

    @property
    def corners(self) -> tuple[float, ...]:
        """When [s] one of them jumps or has a kink: no integrator steps over that."""
        return tuple(sorted({t for law in self.laws.values() for t in law.corners if t > 0.0}))

    def at(self, time: float) -> Array:
        """(nu,) the controls at a time [s]; on a jump those after it."""
        u, t = self.still.copy(), np.array([time])
        for number, law in self.laws.items():
            u[number] = law.at(t)[0, 0]
        return u
