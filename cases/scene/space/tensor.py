"""Inertia tensors in space: which a body can have, and about which axes it has none."""

import math

import numpy as np

from ...fields.words import wrong
from ...trajectory import Array

Tensor = tuple[float, float, float, float, float, float]
"""J₁₁, J₂₂, J₃₃, J₁₂, J₁₃, J₂₃ about the centre of mass, in body axes: the entries of the matrix,
so that products of inertia carry the minus sign (2.32)."""

ROUNDING = 1e-9  # of the largest principal moment: tensors are typed with up to ten digits


def matrix(tensor: Tensor) -> Array:
    """J (3, 3) from J₁₁, J₂₂, J₃₃, J₁₂, J₁₃, J₂₃ (2.32)."""
    a, b, c, d, e, f = tensor
    return np.array([[a, d, e], [d, b, f], [e, f, c]])


def possible(tensor: Tensor) -> Tensor:
    """The tensor (2.32) as it is given, if any distribution of mass has it.

    Raises a mistake in plain words: a principal moment is negative, or above the sum of the other
    two, though J₁ + J₂ − J₃ = 2 ∫ x₃² dm ≥ 0.
    """
    if not all(map(math.isfinite, tensor)):
        return tensor  # a mistaken parameter, found elsewhere
    low, middle, high = (float(x) for x in np.linalg.eigvalsh(matrix(tensor)))
    least = max(abs(low), abs(high))
    if least == 0:
        raise wrong("is zero: a body without inertia is a `particle`")
    if low < -ROUNDING * least:
        raise wrong(f"no body has this tensor: its principal moment {low:g} kg m² is negative")
    if high > low + middle + ROUNDING * least:
        raise wrong(
            f"no body has this tensor: of its principal moments {low:g}, {middle:g} and {high:g} "
            "kg m² the largest is above the sum of the others"
        )
    return tensor


def without_inertia(tensor: Tensor) -> Array | None:
    """(3,) the unit vector in body axes about which a body has no inertia; at most one is."""
    if not all(map(math.isfinite, tensor)):
        return None  # a mistaken parameter, found elsewhere
    moments, axes = np.linalg.eigh(matrix(tensor))
    return axes[:, 0] if moments[0] <= ROUNDING * moments[-1] else None
