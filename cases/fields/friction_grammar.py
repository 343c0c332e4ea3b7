"""Grammar of dry friction: coefficients of a contact, friction forces or moments of a joint.

The models here are what a case file may write; from them the classes of `friction` are made, with
which all of the project calculates. A slide and a pin have the same keys in different units.
"""

from collections.abc import Callable
from typing import Annotated, Any

from pydantic import Field, Tag, create_model

from . import friction
from .field import In
from .part import Made, Part, plain_or_map
from .words import wrong

Coefficient = Annotated[float, In("1", least=0)]


class Coefficients(Part):
    """Coefficients of friction: `static` holds at rest, `kinetic` brakes in motion."""

    static: Coefficient
    kinetic: Coefficient

    def model_post_init(self, context: object) -> None:
        _require_static_not_below_kinetic(self.static, self.kinetic)


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
                _require_static_not_below_kinetic(
                    getattr(self.static, way), getattr(self.kinetic, way)
                )
        if self.stribeck is not None:
            if self.smooth is not None:
                raise wrong("has both `smooth` and `stribeck`: (2.95) has one kinetic friction")
            if self.static is None or self.static == self.kinetic:
                raise wrong("`stribeck` needs a `static` friction above the kinetic: it falls")

    def law(self) -> friction.DryFriction:
        """Returns the law: the static friction is the kinetic one where it is left out."""
        return friction.DryFriction(
            self.kinetic if self.static is None else self.static,
            self.kinetic,
            self.smooth,
            self.stribeck,
        )


def dry(force: str, speed: str, slowness: str, suffix: str) -> Any:
    """Returns the type of a field that holds the dry friction of a joint, in these units.

    force: the unit of what it exerts; speed: of how fast it slips; slowness: of one over that, as
    the sharpness of the smooth law has it; suffix: what the models' names end with.
    """
    Speed, Sharpness = (Annotated[float, In(unit, above=0)] for unit in (speed, slowness))
    bounds = _bounds(force, suffix)
    smooth = _map_type(friction.Smooth, suffix, band=Speed, sharpness=Sharpness)
    fields: dict[str, Any] = {
        "static": (bounds | None, DryFriction.model_fields["static"]),
        "kinetic": (bounds, ...),
        "smooth": (smooth | None, None),
        "stribeck": (_map_type(friction.Stribeck, suffix, speed=Speed) | None, None),
    }
    name = f"DryFriction{suffix}"
    written = create_model(
        name, __base__=DryFriction, __doc__=friction.DryFriction.__doc__, **fields
    )
    return Annotated[friction.DryFriction, Made(written, DryFriction.law)]


def _bounds(force: str, suffix: str) -> Any:
    """Returns the type of the bounds forward and backward, in this unit; one number gives both."""
    size = Annotated[float, In(force, least=0)]
    both = _map_type(friction.Bounds, suffix, forward=size, backward=size)
    return Annotated[
        Annotated[friction.Bounds, Made(size, lambda f: friction.Bounds(f, f)), Tag("<plain>")]
        | Annotated[both, Tag("<map>")],
        plain_or_map(),
    ]


def _map_type(law: Callable[..., object], suffix: str, **units: Any) -> Any:
    """Returns the type of what is written as a map of its numbers, each in its unit."""
    fields: dict[str, Any] = {key: (unit, ...) for key, unit in units.items()}
    written = create_model(f"{law.__name__}{suffix}", __base__=Part, __doc__=law.__doc__, **fields)
    return Annotated[law, Made(written, lambda numbers: law(**dict(numbers)))]


# Annotated types of the dry friction of a slide and of a pin, and the mark of a field that holds
# the coefficients d₊ and d₋ of a viscous force, whose power of the speed is no dry friction.
OF_SLIDE = dry("N", "m/s", "s/m", "OfSlide")
OF_PIN = dry("N m", "rad/s", "s/rad", "OfPin")
VISCOUS = Made(_bounds("N", "OfGuide"), lambda bounds: bounds)


def _require_static_not_below_kinetic(static: float, kinetic: float) -> None:
    """Raises a mistake if the static friction is less than the kinetic one."""
    if kinetic > static:  # with a force between them it could neither stay at rest nor slide
        raise wrong(f"kinetic friction {kinetic:g} is above static friction {static:g}")
