"""The simplest walker before its limit: massless legs, a hip M, and feet of a small mass m.

For m/M → 0 it becomes `simplest_walker`, which no engine can run.
"""

from dataclasses import dataclass

from .compass_walker import CompassWalker


@dataclass(frozen=True)
class LightFeet(CompassWalker):
    """A walker with all of a leg's mass m [kg] at its foot, where its moment of inertia is J_f."""

    J_f: float

    @property
    def c(self) -> float:
        """l [m]: how far below the hip a leg has its centre."""
        return self.l

    @property
    def J(self) -> float:
        """J_f [kg m²]."""
        return self.J_f
