"""Grammar of dry friction: coefficients of a contact, friction forces or moments of a joint.

The models here are what a case file may write; from them the nouns of `friction` are made, which
all of the project calculates with. A slide and a pin have the same keys in other units.
"""

from collections.abc import Callable
from typing import Annotated, Any

from pydantic import Field, Tag, create_model

from . import friction as noun
from .field import In
from .part import Made, Part, plain_or_map
from .words import wrong

Coefficient = Annotated[float, In("1", least=0)]


class Coefficients(Part):
    """Coefficients of friction: `static` holds at rest, `kinetic` brakes in motion."""

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
"""Friction of a contact: a plain number, which is both coefficients, or a map of the two."""


class DryFriction(Part):
    """The keys of a joint's dry friction and what must fit together in them.

    Their types are Any since they differ in their units: `dry` makes a model for each.
    """

    static: Any = Field(None, description="as `kinetic` if not given")
    kinetic: Any
    smooth: Any = None
    stribeck: Any = None

    def model_post_init(self, context: object) -> None:
        if self.static is not None:
            for way in ("forward", "backward"):
                _holds_as_well_as_it_brakes(getattr(self.static, way), getattr(self.kinetic, way))
        if self.stribeck is not None:
            if self.smooth is not None:
                raise wrong("has both `smooth` and `stribeck`: (2.95) knows one kinetic friction")
            if self.static is None or self.static == self.kinetic:
                raise wrong("`stribeck` needs a `static` friction above the kinetic: it falls")

    def law(self) -> noun.DryFriction:
        """Returns the noun: the static friction is the kinetic one where it is left out."""
        return noun.DryFriction(
            self.static or self.kinetic, self.kinetic, self.smooth, self.stribeck
        )


def dry(force: str, speed: str, slowness: str, of: str) -> Any:
    """Returns the type of a field that holds the dry friction of a joint, in these units.

    force: the unit of what it exerts; speed: of how fast it slips; slowness: of one over that, as
    the sharpness of the smooth law has it; of: what the models' names end with.
    """
    swift, sharp = Annotated[float, In(speed, above=0)], Annotated[float, In(slowness, above=0)]
    bounds = _bounds(force, of)
    fields: dict[str, Any] = {
        "static": (bounds | None, DryFriction.model_fields["static"]),
        "kinetic": (bounds, ...),
        "smooth": (_map(noun.Smooth, of, band=swift, sharpness=sharp) | None, None),
        "stribeck": (_map(noun.Stribeck, of, speed=swift) | None, None),
    }
    name = f"DryFriction{of}"
    written = create_model(name, __base__=DryFriction, __doc__=noun.DryFriction.__doc__, **fields)
    return Annotated[noun.DryFriction, Made(written, DryFriction.law)]


def _bounds(force: str, of: str) -> Any:
    """Returns the type of the bounds forward and backward, in this unit; one number gives both."""
    size = Annotated[float, In(force, least=0)]
    both = _map(noun.Bounds, of, forward=size, backward=size)
    return Annotated[
        Annotated[noun.Bounds, Made(size, lambda f: noun.Bounds(f, f)), Tag("<plain>")]
        | Annotated[both, Tag("<map>")],
        plain_or_map(),
    ]


def _map(law: Callable[..., object], of: str, **units: Any) -> Any:
    """Returns the type of a noun that is written as a map of its numbers, each in its unit."""
    fields: dict[str, Any] = {key: (unit, ...) for key, unit in units.items()}
    written = create_model(f"{law.__name__}{of}", __base__=Part, __doc__=law.__doc__, **fields)
    return Annotated[law, Made(written, lambda written: law(**dict(written)))]


# Annotations for the fields of the models: of a slide, a pin, and a drag without `static`.
OF_SLIDE = dry("N", "m/s", "s/m", "OfSlide")
OF_PIN = dry("N m", "rad/s", "s/rad", "OfPin")
FrictionForce = Made(_bounds("N", "OfGuide"), lambda bounds: bounds)


def _holds_as_well_as_it_brakes(static: float, kinetic: float) -> None:
    """Raises a mistake if the static friction is less than the kinetic one."""
    if kinetic > static:  # with a force between them it could neither stay at rest nor slide
        raise wrong(f"kinetic friction {kinetic:g} is above static friction {static:g}")
