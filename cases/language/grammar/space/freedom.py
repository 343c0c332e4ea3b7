"""The freedoms that a joint names: shifts along axes, then turns about axes, in their order."""

from collections.abc import Callable
from itertools import pairwise
from typing import Annotated, ClassVar

import numpy as np
from pydantic import AfterValidator, Field

from ....fields.part import OneOf, Part
from ....fields.text import IDENTIFIER, Text, label
from ....fields.vector import Direction
from ....fields.words import wrong
from ....scene.joint import HELD, Freedom
from ....scene.point import Vector
from ....scene.rotation import Vector3

PARALLEL = 1e-9  # sine of an angle: axes are typed with up to ten digits

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
    """In the order of the file; a mistake where they are no coordinates."""
    freedoms = tuple(left.named(name) for name, left in written.items())
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
    """Coordinates, rates and what drives exert are quantities, as the joint's reactions are."""
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
