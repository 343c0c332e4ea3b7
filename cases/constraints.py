"""The constraints that act in a state of a user's own model, as plain numbers, row by row.

What solves for their forces, an engine or a person, is judged by `reference/laws/constraints.py`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from .trajectory import Array

Bound = Literal["none", "loss", "one way", "cone"]
"""How the force of a constraint is bounded: not at all, |f| ≤ loss, f ≥ 0, or by a cone."""


@dataclass(frozen=True)
class Constraint:
    """A constraint of one row, or a contact with a cone of friction of several.

    bounds: the loss (1,) [N, N m]; or of a cone, whose first row is its normal, the coefficients of
    friction of the others: f₁² ≥ Σ f_j² / μ_j².
    """

    name: str
    bound: Bound
    first: int
    bounds: Array = field(default_factory=lambda: np.zeros(0))

    @property
    def rows(self) -> slice:
        """The slice of its rows among all constraints'."""
        wide = len(self.bounds) if self.bound == "cone" else 0
        return slice(self.first, self.first + 1 + wide)


@dataclass(frozen=True)
class Constrained:
    """A state in which constraints act: M a = smooth + Jᵀ f, with a (n,) and smooth (n,).

    smooth: all other forces, less the bias. J (k, n): its rows' accelerations are J a, which a_ref
    (k,) would be at no force; R (k,) [1/kg, …] is the softness, f (k,) the force of each.
    """

    constraints: Sequence[Constraint]
    M: Array
    smooth: Array
    a: Array
    J: Array
    a_ref: Array
    R: Array
    f: Array
