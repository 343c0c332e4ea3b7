"""Friction as a case file writes it: of a contact by coefficients, of a slide by forces."""

from collections.abc import Callable
from typing import Annotated

from pydantic import Field, Tag

from ... import friction as noun
from .element import numbers
from .field import In
from .part import Made, Part, plain_or_map
from .words import wrong

Coefficient = Annotated[float, In("1", least=0)]


class Coefficients(Part):
    """What holds at rest, and what brakes in motion."""

    static: Coefficient
    kinetic: Coefficient

    def model_post_init(self, context: object) -> None:
        _holds_as_well_as_it_brakes(self.static, self.kinetic)


Friction = Annotated[
    Annotated[
        Coefficients,
        Made(Coefficient, lambda mu: Coefficients.model_construct(static=mu, kinetic=mu)),
        Tag("<plain>"),
    ]
    | Annotated[Coefficients, Tag("<map>")],
    plain_or_map(),
]
"""One coefficient stands for both."""


def _map(law: Callable[..., object]) -> Made:
    """A law as a map of its numbers."""
    return Made(numbers(law), lambda written: law(**dict(written)))


FrictionForce = Annotated[
    Annotated[noun.Bounds, Made(noun.Newtons, lambda f: noun.Bounds(f, f)), Tag("<plain>")]
    | Annotated[noun.Bounds, _map(noun.Bounds), Tag("<map>")],
    plain_or_map(),
]
"""One number stands for both directions."""


class DryFriction(Part):
    static: FrictionForce | None = Field(None, description="as `kinetic` if not given")
    kinetic: FrictionForce
    smooth: Annotated[noun.Smooth, _map(noun.Smooth)] | None = None

    def model_post_init(self, context: object) -> None:
        if self.static is not None:
            for way in ("forward", "backward"):
                _holds_as_well_as_it_brakes(getattr(self.static, way), getattr(self.kinetic, way))

    def law(self) -> noun.DryFriction:
        """The law, with what was left out."""
        return noun.DryFriction(self.static or self.kinetic, self.kinetic, self.smooth)


Dry = Made(DryFriction, DryFriction.law)


def _holds_as_well_as_it_brakes(static: float, kinetic: float) -> None:
    if kinetic > static:  # at rest it would both stick and slide
        raise wrong(f"kinetic friction {kinetic:g} is above static friction {static:g}")
