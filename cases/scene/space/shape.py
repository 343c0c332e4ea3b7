"""Masses, tensors and points of the shapes that a case in space can name.

Shared by the generated reference and the engines, so it is tested by itself against integrals
over the shape (tests/cases/space/test_shape.py). Hand-written systems carry their own.
"""

from collections.abc import Callable, Mapping
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator

from ...fields.field import In
from ...fields.part import Length, Mass
from ...fields.vector import Direction
from ...fields.words import wrong
from ..point import CENTER
from ..rotation import Vector3
from .body import SpatialBody
from .tensor import Tensor, possible

Points = Mapping[str, Vector3]
_Moment = Annotated[float, In("kg m²")]


def _six(given: Any) -> Any:
    """Six, or a mistake that names them: three may be meant as principal moments."""
    if isinstance(given, list | tuple) and len(given) < 6:
        what = f"should be the six J11, J22, J33, J12, J13, J23, has {len(given)}"
        raise wrong(what + "; beside principal moments the last three are 0" * (len(given) == 3))
    return given


Inertia = Annotated[
    tuple[_Moment, _Moment, _Moment, _Moment, _Moment, _Moment],
    AfterValidator(possible),
    BeforeValidator(_six),
]
_AT_CENTER = {CENTER: (0.0, 0.0, 0.0)}


def bar(*, name: str, mass: Mass, length: Length, points: Points) -> SpatialBody:
    """Slender bar along its own x from `start` to `end`: J = m l²/12 diag(0, 1, 1)."""
    J = mass * length**2 / 12
    ends = {"start": (-length / 2, 0.0, 0.0), "end": (length / 2, 0.0, 0.0)}
    tensor = (0.0, J, J, 0.0, 0.0, 0.0)
    return SpatialBody(name, "bar", mass, tensor, {**_AT_CENTER, **ends, **points})


def disk(*, name: str, mass: Mass, radius: Length, axle: Direction, points: Points) -> SpatialBody:
    """Thin homogeneous disk about its axle u: J = m R²/4 (1 + u uᵀ)."""
    tensor = _about(axle, mass * radius**2 / 4, mass * radius**2 / 2)
    return SpatialBody(name, "disk", mass, tensor, {**_AT_CENTER, **points}, radius, axle)


def sphere(*, name: str, mass: Mass, radius: Length, points: Points) -> SpatialBody:
    """Homogeneous ball: J = 2/5 m R² 1."""
    J = 2 * mass * radius**2 / 5
    tensor = (J, J, J, 0.0, 0.0, 0.0)
    return SpatialBody(name, "sphere", mass, tensor, {**_AT_CENTER, **points}, radius)


def block(
    *, name: str, mass: Mass, size: tuple[Length, Length, Length], points: Points
) -> SpatialBody:
    """Homogeneous cuboid with edges a, b, c along its axes: J₁₁ = m (b² + c²)/12."""
    a, b, c = (x * x for x in size)
    k = mass / 12
    tensor = (k * (b + c), k * (a + c), k * (a + b), 0.0, 0.0, 0.0)
    return SpatialBody(name, "block", mass, tensor, {**_AT_CENTER, **points}, size=size)


def particle(*, name: str, mass: Mass) -> SpatialBody:
    """Point mass: no inertia, no attitude."""
    return SpatialBody(name, "particle", mass, None, _AT_CENTER)


def rigid(
    *,
    name: str,
    mass: Mass,
    inertia: Inertia,
    points: Points,
    radius: Length | None = None,
    axle: Direction | None = None,
) -> SpatialBody:
    """Any rigid body, by its mass and its tensor J₁₁, J₂₂, J₃₃, J₁₂, J₁₃, J₂₃ (2.32).

    With a radius it is round about its axle, or in all directions if it has none.
    """
    return SpatialBody(name, "rigid", mass, inertia, {**_AT_CENTER, **points}, radius, axle)


def _about(axis: Vector3, across: float, along: float) -> Tensor:
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


SHAPES: dict[str, Callable[..., SpatialBody]] = {
    make.__name__: make for make in (bar, disk, sphere, block, particle, rigid)
}
"""By the word of the case file."""
