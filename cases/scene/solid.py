"""Masses, tensors and points of the shapes that a case in space can name.

Shared by the generated reference and the engines, so it is tested by itself against integrals
over the shape (tests/cases/space/test_shape.py). Hand-written systems carry their own.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, BeforeValidator

from ..fields.field import In
from ..fields.part import Length, Mass
from ..fields.vector import Direction
from ..fields.words import wrong
from ..trajectory import Array
from .body import Body
from .frame import SPACE
from .point import CENTER, Vector

Tensor = tuple[float, float, float, float, float, float]
"""J₁₁, J₂₂, J₃₃, J₁₂, J₁₃, J₂₃ about the centre of mass, in body axes: the entries of the matrix,
so that products of inertia carry the minus sign (2.32)."""

ROUNDING = 1e-9  # of the largest principal moment: tensors are typed with up to ten digits

Points = Mapping[str, Vector]
_Moment = Annotated[float, In("kg m²")]


def _six(given: Any) -> Any:
    """Six, or a mistake that names them: three may be meant as principal moments."""
    if isinstance(given, list | tuple) and len(given) < 6:
        what = f"should be the six J11, J22, J33, J12, J13, J23, has {len(given)}"
        raise wrong(what + "; beside principal moments the last three are 0" * (len(given) == 3))
    return given


def possible(tensor: Tensor) -> Tensor:
    """The tensor (2.32) as it is given, if any distribution of mass has it.

    Raises a mistake in plain words: a principal moment is negative, or above the sum of the other
    two, though J₁ + J₂ − J₃ = 2 ∫ x₃² dm ≥ 0.
    """
    if not all(map(math.isfinite, tensor)):
        return tensor  # a mistaken parameter, found elsewhere
    low, middle, high = (float(x) for x in np.linalg.eigvalsh(SPACE.tensor(tensor)))
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


def without_inertia(tensor: Sequence[float]) -> Array | None:
    """(3,) the unit vector in body axes about which a body has no inertia; at most one is."""
    if not all(map(math.isfinite, tensor)):
        return None  # a mistaken parameter, found elsewhere
    moments, axes = np.linalg.eigh(SPACE.tensor(tensor))
    return axes[:, 0] if moments[0] <= ROUNDING * moments[-1] else None


Inertia = Annotated[
    tuple[_Moment, _Moment, _Moment, _Moment, _Moment, _Moment],
    AfterValidator(possible),
    BeforeValidator(_six),
]
_AT_CENTER = {CENTER: (0.0, 0.0, 0.0)}


def bar(*, name: str, mass: Mass, length: Length, points: Points) -> Body:
    """Slender bar along its own x from `start` to `end`: J = m l²/12 diag(0, 1, 1)."""
    J = mass * length**2 / 12
    ends = {"start": (-length / 2, 0.0, 0.0), "end": (length / 2, 0.0, 0.0)}
    tensor = (0.0, J, J, 0.0, 0.0, 0.0)
    return Body(name, "bar", mass, tensor, {**_AT_CENTER, **ends, **points}, frame=SPACE)


def disk(*, name: str, mass: Mass, radius: Length, axle: Direction, points: Points) -> Body:
    """Thin homogeneous disk about its axle u: J = m R²/4 (1 + u uᵀ)."""
    tensor = _tensor_about(axle, mass * radius**2 / 4, mass * radius**2 / 2)
    return Body(name, "disk", mass, tensor, {**_AT_CENTER, **points}, radius, axle, frame=SPACE)


def sphere(*, name: str, mass: Mass, radius: Length, points: Points) -> Body:
    """Homogeneous ball: J = 2/5 m R² 1."""
    J = 2 * mass * radius**2 / 5
    tensor = (J, J, J, 0.0, 0.0, 0.0)
    return Body(name, "sphere", mass, tensor, {**_AT_CENTER, **points}, radius, frame=SPACE)


def block(*, name: str, mass: Mass, size: tuple[Length, Length, Length], points: Points) -> Body:
    """Homogeneous cuboid with edges a, b, c along its axes: J₁₁ = m (b² + c²)/12."""
    a, b, c = (x * x for x in size)
    k = mass / 12
    tensor = (k * (b + c), k * (a + c), k * (a + b), 0.0, 0.0, 0.0)
    return Body(name, "block", mass, tensor, {**_AT_CENTER, **points}, size=size, frame=SPACE)


def particle(*, name: str, mass: Mass) -> Body:
    """Point mass: no inertia, no attitude."""
    return Body(name, "particle", mass, (), _AT_CENTER, frame=SPACE)


def rigid(
    *,
    name: str,
    mass: Mass,
    inertia: Inertia,
    points: Points,
    radius: Length | None = None,
    axle: Direction | None = None,
) -> Body:
    """Any rigid body, by its mass and its tensor J₁₁, J₂₂, J₃₃, J₁₂, J₁₃, J₂₃ (2.32).

    With a radius it is round about its axle, or in all directions if it has none.
    """
    return Body(name, "rigid", mass, inertia, {**_AT_CENTER, **points}, radius, axle, frame=SPACE)


def _tensor_about(axis: Vector, across: float, along: float) -> Tensor:
    """A tensor with equal moments across an axis: J = J⊥ 1 + (J∥ − J⊥) u uᵀ."""
    u, v, w = axis
    d = along - across
    return (
        across + d * u * u,
        across + d * v * v,
        across + d * w * w,
        d * u * v,
        d * u * w,
        d * v * w,
    )


SHAPES: dict[str, Callable[..., Body]] = {
    make.__name__: make for make in (bar, disk, sphere, block, particle, rigid)
}
"""By the word of the case file."""
