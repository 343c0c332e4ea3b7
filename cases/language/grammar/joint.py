"""Joints as a case file writes them: in the plane by a kind's word, in space by axes.

Each is the freedoms that it leaves. In space some have names that the file gives.
"""

from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from ...fields.friction_grammar import OF_PIN, OF_SLIDE
from ...fields.part import OneOf, Pair, Part
from ...fields.text import IDENTIFIER, Text, label
from ...fields.vector import Direction
from ...fields.words import wrong
from ...scene.frame import SPACE
from ...scene.joint import FREEDOMS, HELD, Freedom, planar_joint
from ...scene.joint import Joint as Noun
from ...scene.point import Vector, anchor
from ...scene.rotation import Vector3
from .element import Element, element

PARALLEL = 1e-9  # sine of an angle: axes are typed with up to ten digits


class _Joint(Element):
    elsewhere: ClassVar[Mapping[str, str]] = {
        "damping": "among the `forces` there is a `torsion_damper` of a turn, and a `damper`",
        "stiffness": "among the `forces` there is a `torsion` spring of a turn, and a `spring`",
        **dict.fromkeys(
            ("stops", "limits", "range"),
            "where a turn ends stands among the `forces`: {stops: JOINT, low: -90 deg}",
        ),
    }

    @property
    def kind(self) -> str:
        """The word is the kind."""
        return self.word


class _NeverBrakes(_Joint):
    @model_validator(mode="before")
    @classmethod
    def _no_friction(cls, value: Any) -> Any:
        if isinstance(value, dict) and "dry_friction" in value:
            raise wrong("only a slide or a pin has `dry_friction`")
        return value


def _joint(kind: str) -> type[Element]:
    turns, shifts, swings = (
        any(freedom.kind == which for freedom in FREEDOMS[kind])
        for which in ("turn", "shift", "swing")
    )
    brakes = shifts != turns and not swings
    accepted = {"kind": False, "along": shifts, "angle": not turns, "dry_friction": brakes}
    accepted["length"] = swings
    return element(
        kind,
        planar_joint,
        base=_Joint if brakes else _NeverBrakes,
        without=[key for key, plays in accepted.items() if not plays],
        needs=["along"] if shifts else [],
        typed={"dry_friction": (OF_SLIDE if shifts else OF_PIN) | None},
    )


# In space: the freedoms that a joint names, shifts along axes, then turns about axes, in order.


Label = Annotated[str, Text(label, f"^{IDENTIFIER}$")]


class Left(Part):
    """One freedom, written as what would leave just it, with its axis."""

    word: ClassVar[str]
    leaves: ClassVar[Callable[[Vector, str], Freedom]]

    def named(self, name: str) -> Freedom:
        """The freedom."""
        return type(self).leaves(getattr(self, self.word), name)


class FreeShift(Left):
    """A shift along an axis of the first part."""

    word, leaves = "slide", Freedom.shift
    slide: Direction


class FreeTurn(Left):
    """A turn about an axis, which stands in the axes that the freedoms before it leave."""

    word, leaves = "hinge", Freedom.turn
    hinge: Direction


def parallel(a: Vector3, b: Vector3) -> bool:
    """Whether two unit vectors lie on one line."""
    return float(np.linalg.norm(np.cross(a, b))) < PARALLEL


def _freedoms(written: dict[str, Left]) -> tuple[Freedom, ...]:
    """The freedoms in the file's order; a mistake where they are not independent."""
    freedoms = tuple(freedom.named(name) for name, freedom in written.items())
    shifts = [f for f in freedoms if f.kind == "shift"]
    turns = [f for f in freedoms if f.kind == "turn"]
    for f, g in pairwise(freedoms):
        if (f.kind, g.kind) == ("turn", "shift"):
            raise wrong(f"{g.name!r} slides and stands after the hinge {f.name!r}: slides first")
    for kind, some in (("slides", shifts), ("hinges", turns)):
        if len(some) > 3:
            raise wrong(f"has {len(some)} {kind}, and at most 3 are independent")
    for i, f in enumerate(shifts):
        if _spanned(f.axis, [g.axis for g in shifts[:i]]):
            raise wrong(f"{f.name!r} slides where those before it already let it")
    for f, g in pairwise(turns):
        if parallel(f.axis, g.axis):
            raise wrong(f"{f.name!r} and {g.name!r} turn about the same axis")
    _no_name_twice(freedoms)
    return freedoms


def _spanned(axis: Vector3, others: list[Vector3]) -> bool:
    """Whether the others, which are independent, span the axis too."""
    if not others or not np.isfinite([axis, *others]).all():
        return False
    rest = np.array(axis) - np.linalg.pinv(np.array(others)) @ np.array(others) @ np.array(axis)
    return float(np.linalg.norm(rest)) < PARALLEL


def _no_name_twice(freedoms: tuple[Freedom, ...]) -> None:
    """Raises a mistake where a freedom, its rate or its effort takes a name that is taken."""
    taken = dict.fromkeys(HELD, "")
    for f in freedoms:
        for name in (f.name, f.rate, f.effort):
            if name in taken:
                by = f" by {taken[name]!r}" if taken[name] else ""
                raise wrong(f"{f.name!r} needs the name {name!r}, which is taken{by}")
        taken |= dict.fromkeys((f.name, f.rate, f.effort), f.name)


Freedoms = Annotated[
    dict[Label, Annotated[Left, OneOf("freedom", {"slide": FreeShift, "hinge": FreeTurn})]],
    Field(min_length=1),
    AfterValidator(_freedoms),
]


class SpatialJointed(Part):
    """A joint as a case file writes it, before the key above it names it."""

    kind: ClassVar[Any]

    def points(self) -> tuple[str, str]:
        """The two points it joins."""
        return getattr(self, self.kind)

    def left(self) -> tuple[Freedom, ...]:
        """The freedoms that it leaves."""
        return ()

    def named(self, name: str) -> Noun:
        """The joint."""
        a, b = map(anchor, self.points())
        return Noun(name, self.kind, a, b, self.left(), frame=SPACE)


class Hinge(SpatialJointed):
    """Lets the second part turn about an axis."""

    kind = "hinge"
    hinge: Pair
    axis: Direction = Field(description="in the axes of the first part")

    def left(self) -> tuple[Freedom, ...]:
        return (Freedom.turn(self.axis, "angle"),)


class Ball(SpatialJointed):
    """Lets the second part turn in any way."""

    kind = "ball"
    ball: Pair

    def left(self) -> tuple[Freedom, ...]:
        return (Freedom("ball"),)


class Universal(SpatialJointed):
    """Lets the second part turn about an axis of the first, and about one of its own."""

    kind = "universal"
    universal: Pair
    axes: tuple[Direction, Direction] = Field(
        description="in the axes of the first part, and of the second"
    )

    def model_post_init(self, context: object) -> None:
        if parallel(*self.axes):
            raise wrong("the two `axes` are parallel: then it is a `hinge`")

    def left(self) -> tuple[Freedom, ...]:
        return tuple(Freedom.turn(axis) for axis in self.axes)


class SpatialSlide(SpatialJointed):
    """Lets the second point shift along a line."""

    kind = "slide"
    slide: Pair
    along: Direction = Field(description="in the axes of the first part")

    def left(self) -> tuple[Freedom, ...]:
        return (Freedom.shift(self.along, "shift"),)


class SpatialWeld(SpatialJointed):
    """Lets the second part do nothing."""

    kind = "weld"
    weld: Pair


class Named(SpatialJointed):
    """Leaves freedoms with names: slides, then hinges; what is not named is held."""

    kind = "freedoms"
    freedoms: Freedoms
    of: Pair

    def points(self) -> tuple[str, str]:
        return self.of

    def left(self) -> tuple[Freedom, ...]:
        return self.freedoms  # type: ignore[return-value]  # as its validator makes them


KINDS: dict[int, dict[str, type[Part]]] = {
    2: {kind: _joint(kind) for kind in FREEDOMS},
    3: {joint.kind: joint for joint in (Hinge, Ball, Universal, SpatialSlide, SpatialWeld, Named)},
}
"""By the dimension of the frame."""
IN_SPACE = {
    "hinge": "in the plane it is `pin`",
    "revolute": "did you mean 'pin'?",
    "prismatic": "did you mean 'slide'?",
    "fixed": "did you mean 'weld'?",
    "rod": "did you mean 'distance'?",
    **dict.fromkeys(("ball", "universal", "freedoms"), "it joins parts in space (`space: 3`)"),
}
IN_THE_PLANE = {
    "pin": "in space it is `hinge`, with its `axis`",
    "revolute": "did you mean 'hinge'?",
    "prismatic": "did you mean 'slide'?",
    "spherical": "did you mean 'ball'?",
    "fixed": "did you mean 'weld'?",
    "distance": "rods join points of the plane",
    "slot": "in space it is `freedoms`, a slide and the hinges after it",
}
Joint = Annotated[Element, OneOf("joint", KINDS[2], IN_SPACE)]
SpatialJoint = Annotated[SpatialJointed, OneOf("joint", KINDS[3], IN_THE_PLANE)]
