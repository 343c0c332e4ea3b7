"""The questions that every force element answers, so that nobody asks which one it is."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from ...fields.kind import Fields
from ...trajectory import Array
from ..body import Body
from ..motion import Motion
from ..point import Anchor


@dataclass(frozen=True)
class Force:
    """A force element; one without quantities, energy or numbers says nothing of them.

    Its fields are what a case file gives: what it refers to (`a` and `b`, `at`, or `body`) under
    its `word`, and beside that its numbers with their units.
    """

    word: ClassVar[str]
    freedom: ClassVar[Literal["turn", "shift"]] = "turn"
    """Which freedom of the joint that it is about lets it act: a turn, or a shift."""
    stated: ClassVar[bool] = False  # whether it follows from places and rates: states claim it
    winds: ClassVar[bool] = False  # whether it needs a joint's angle, and not only its rate
    inner: ClassVar[str] = ""
    """The quantity that is its inner state, which its producer gives; it begins with `begins`."""
    given: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    """For each of its quantities: the reactions of its own by which a producer gives it."""
    works: ClassVar[bool] = True  # whether it has a power
    name: str  # by which the scene has it

    def refers(self) -> tuple[Anchor, ...]:
        """The points on which it acts, in the order of the file."""
        raise NotImplementedError

    @property
    def about(self) -> str | None:
        """The joint about or along which it acts, between the two parts; or None."""
        return None

    @property
    def corner(self) -> bool:
        """Whether its law has a corner where something comes to rest, which costs steps orders."""
        return False

    @property
    def ends(self) -> bool:
        """Whether it would stop a free body in a finite time, if nothing else moves that."""
        return False

    @property
    def turn(self) -> str:
        """The turn of that joint, by its name where it has one; else empty."""
        return ""

    @property
    def begins(self) -> float:
        """The inner state at the start, of what has one."""
        raise NotImplementedError

    def why_unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """Why it cannot act on what it refers to, in words for the case file."""
        return None

    def quantities(self) -> dict[str, Fields]:
        """The fields that can be observed of it, by part."""
        return {}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) one of its quantities; else KeyError."""
        raise KeyError(f"{self.name}.{field}")

    def power(self, motion: Motion) -> Array:
        """(N,) what it does to all that it acts on [W], of what works."""
        raise NotImplementedError

    def potential(self, motion: Motion) -> Array | float:
        """(N,) its potential energy [J], its share of U in (2.45)."""
        return 0.0

    def numbers(self) -> dict[str, float]:
        """The numbers that an engine has of it, for the equal-physics audit."""
        return {}


@dataclass(frozen=True)
class Limit(Force):
    """(2.14) on one side: what it measures ends somewhere, and only there it exerts something.

    Its sides are its reactions. Without a word of a restitution what strikes one keeps no rate.
    """

    works = False  # what does not move takes no work, and an impact's is none of a power
    measured: ClassVar[str]  # the quantity that ends

    @property
    def sides(self) -> dict[str, tuple[float, float]]:
        """By its reaction, for each end: the sense in which it pushes, and where it is [m or rad].

        What is measured, less where it ends, keeps this sense.
        """
        raise NotImplementedError

    @property
    def back(self) -> float:
        """The part of the rate that it throws back where it is struck."""
        return 0.0

    def reactions(self) -> Iterator[str]:
        """Yields what it exerts at each end, by quantity."""
        return (f"{self.name}.{side}" for fields in self.given.values() for side in fields)

    def gaps(self, motion: Motion) -> Iterator[Array]:
        """Yields for each side how far (N,) it is from its end, below zero where it is passed."""
        at = self.observe(motion, self.measured)
        return (sense * (at - end) for sense, end in self.sides.values())

    def rate(self, motion: Motion) -> Array:
        """(N,) how fast [m/s or rad/s] what is measured grows."""
        raise NotImplementedError
