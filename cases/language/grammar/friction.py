"""Friction as a case file writes it: of a contact by coefficients, of a slide by forces."""

from typing import Annotated

from pydantic import Field, Tag

from .field import In
from .part import Part, plain_or_map
from .words import wrong

Coefficient = Annotated[float, In("1", least=0)]
Newtons = Annotated[float, In("N", least=0)]


class Coefficients(Part):
    """What holds at rest, and what brakes in motion."""

    static: Coefficient
    kinetic: Coefficient

    def model_post_init(self, context: object) -> None:
        _holds_as_well_as_it_brakes(self.static, self.kinetic)


Friction = Annotated[
    Annotated[Coefficient, Tag("<plain>")] | Annotated[Coefficients, Tag("<map>")], plain_or_map()
]


class TwoWay(Part):
    """A force against motion along the slide, and one against motion the other way."""

    forward: Newtons
    backward: Newtons


FrictionForce = Annotated[
    Annotated[Newtons, Tag("<plain>")] | Annotated[TwoWay, Tag("<map>")], plain_or_map()
]


class Smooth(Part):
    """The smooth law (2.95) in place of the exact one."""

    band: Annotated[float, In("m/s", above=0)]
    sharpness: Annotated[float, In("s/m", above=0)]


class DryFriction(Part):
    static: FrictionForce | None = Field(None, description="as `kinetic` if not given")
    kinetic: FrictionForce
    smooth: Smooth | None = None

    def model_post_init(self, context: object) -> None:
        if self.static is not None:
            held, braked = both_ways(self.static), both_ways(self.kinetic)
            for way in ("forward", "backward"):
                _holds_as_well_as_it_brakes(getattr(held, way), getattr(braked, way))


def both_ways(force: float | TwoWay) -> TwoWay:
    """One number stands for both directions."""
    if isinstance(force, TwoWay):
        return force
    return TwoWay.model_construct(forward=force, backward=force)


def _holds_as_well_as_it_brakes(static: float, kinetic: float) -> None:
    if kinetic > static:  # at rest it would both stick and slide
        raise wrong(f"kinetic friction {kinetic:g} is above static friction {static:g}")
