"""Masses, inertias and points of the shapes a case can name.

Shared by the generated reference and the engines, so it is tested by itself against
integrals over the shape (tests/cases/test_shape.py). Hand-written systems carry their own.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from ..fields.field import NUMBER, In, Plain
from ..fields.number import Names, number
from ..fields.part import Length, Mass
from ..fields.words import wrong
from .body import Body
from .point import CENTER, Vector

# How many: a whole number, or a parameter that is one.


@dataclass(frozen=True)
class Count(Plain):
    """A whole number from `least` to `most`; `least` stands for a mistaken parameter, too."""

    least: int
    most: int

    def check(self, value: object, known: Names) -> int:
        amount = number(value, "1", known)
        if amount is None:
            return self.least
        if not self.least <= amount.value <= self.most or amount.value != round(amount.value):
            by_name = f" ({value})" if isinstance(value, str) else ""
            raise wrong(
                f"should be a whole number from {self.least} to {self.most}, is "
                f"{amount.value:.15g}{by_name}",
                number=True,
            )
        return round(amount.value)

    def schema(self) -> dict[str, Any]:
        literal = {"type": "integer", "minimum": self.least, "maximum": self.most}
        return {"anyOf": [literal, {"type": "string"}], "description": NUMBER}


Points = Mapping[str, Vector]
POINT = ": what turns without inertia has no equation of its turn; a point mass is a `particle`"
Inertia = Annotated[float, In("kg m²", above=0, why=POINT)]
CORNERS = ("lower_left", "lower_right", "upper_left", "upper_right")
Spokes = Annotated[int, Count(least=3, most=100)]  # with 100 it is as good as round


def bar(*, name: str, mass: Mass, length: Length, points: Points) -> Body:
    """Slender bar along its own x from `start` to `end`: J = m l²/12 (Exercise 2.3)."""
    ends = {"start": (-length / 2, 0.0), "end": (length / 2, 0.0)}
    return Body(name, "bar", mass, (mass * length**2 / 12,), {CENTER: (0.0, 0.0), **ends, **points})


def disk(*, name: str, mass: Mass, radius: Length, points: Points) -> Body:
    """Thin homogeneous disk: J = m R²/2 (Exercise 2.2)."""
    inertia = mass * radius**2 / 2
    return Body(name, "disk", mass, (inertia,), {CENTER: (0.0, 0.0), **points}, radius=radius)


def block(*, name: str, mass: Mass, width: Length, height: Length, points: Points) -> Body:
    """Homogeneous rectangle with its corners: J = m (w² + h²)/12."""
    inertia = mass * (width**2 + height**2) / 12
    places = [(x * width / 2, y * height / 2) for y in (-1, 1) for x in (-1, 1)]
    own = {CENTER: (0.0, 0.0), **dict(zip(CORNERS, places, strict=True)), **points}
    return Body(name, "block", mass, (inertia,), own, size=(width, height))


def particle(*, name: str, mass: Mass) -> Body:
    """Point mass: no inertia, no angle."""
    return Body(name, "particle", mass, (), {CENTER: (0.0, 0.0)})


def rigid(
    *, name: str, mass: Mass, inertia: Inertia, points: Points, radius: Length | None = None
) -> Body:
    """Any rigid body, by its mass and its inertia about the centre of mass; round, if it says so.

    A ring has J = m R².
    """
    return Body(name, "rigid", mass, (inertia,), {CENTER: (0.0, 0.0), **points}, radius=radius)


def spokes(
    *, name: str, number: Spokes, length: Length, mass: Mass, inertia: Inertia, points: Points
) -> Body:
    """A hub with spokes that touches with `tip0`, `tip1`, … on a circle, counter-clockwise.

    At angle 0 it stands on tip0 (left) and tip1.
    """
    turns = [(k - 0.5) * math.tau / number for k in range(number)]
    places = [(length * math.sin(turn), -length * math.cos(turn)) for turn in turns]
    own = {CENTER: (0.0, 0.0), **dict(zip(tips(number), places, strict=True)), **points}
    return Body(name, "spokes", mass, (inertia,), own, tips=tips(number))


def tips(number: int) -> tuple[str, ...]:
    """The names of the points with which so many spokes touch."""
    return tuple(f"tip{k}" for k in range(number))


SHAPES: dict[str, Callable[..., Body]] = {
    make.__name__: make for make in (bar, disk, block, particle, rigid, spokes)
}
"""By the word of the case file."""
