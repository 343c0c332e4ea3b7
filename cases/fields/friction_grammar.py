"""Friction as a case file writes it: of a contact by coefficients, of a joint by what it exerts."""

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
"""One coefficient stands for both."""


class DryFriction(Part):
    """Dry friction of a slide; that of a pin has the same keys in other units, see `dry`."""

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
        """The law, with what was left out."""
        return noun.DryFriction(
            self.static or self.kinetic, self.kinetic, self.smooth, self.stribeck
        )


def dry(force: str, speed: str, slowness: str, of: str) -> Any:
    """The law with what it exerts, and how fast it slips, in these units; of: a slide or a pin."""
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
    """Type of the friction bounds forward and backward, in this unit; one number gives both."""
    size = Annotated[float, In(force, least=0)]
    both = _map(noun.Bounds, of, forward=size, backward=size)
    return Annotated[
        Annotated[noun.Bounds, Made(size, lambda f: noun.Bounds(f, f)), Tag("<plain>")]
        | Annotated[both, Tag("<map>")],
        plain_or_map(),
    ]


def _map(law: Callable[..., object], of: str, **units: Any) -> Any:
    """A law as a map of its numbers."""
    fields: dict[str, Any] = {key: (unit, ...) for key, unit in units.items()}
    written = create_model(f"{law.__name__}{of}", __base__=Part, __doc__=law.__doc__, **fields)
    return Annotated[law, Made(written, lambda written: law(**dict(written)))]


OF_SLIDE = dry("N", "m/s", "s/m", "OfSlide")
OF_PIN = dry("N m", "rad/s", "s/rad", "OfPin")
FrictionForce = Made(_bounds("N", "OfGuide"), lambda bounds: bounds)


def _holds_as_well_as_it_brakes(static: float, kinetic: float) -> None:
    if kinetic > static:  # at rest it would both stick and slide
        raise wrong(f"kinetic friction {kinetic:g} is above static friction {static:g}")
