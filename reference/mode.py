"""A system that switches: modes with equations of their own, and guards that end them.

A disk that slides obeys other equations than one that rolls; each is a mode, a `System` with the
same coordinates. What the modes idealise (rolling asks for enough friction) is `possible`.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from .system import Array, System


@dataclass(frozen=True)
class Guard:
    """Where g(t, q, v) falls through zero the mode ends, and `then` gives the next and its state.

    event is the name of what happens there, or None for a change that nobody observes. A guard at
    zero when its mode begins has to rise first; if it falls at once, the mode ends at once.
    """

    event: str | None
    g: Callable[[float, Array, Array], float]
    then: Callable[[float, Array, Array], tuple[str, Array, Array]]


class Switching:
    """Defaults for a system of several modes, all with the same coordinates and bodies."""

    modes: Mapping[str, System]
    longest: float | None = None  # no step [s] is longer: a guard may know more of time than q does
    implicit: bool = False  # whether the modes are stiff

    def start(self) -> tuple[str, Array, Array]:
        """The mode at t = 0, q (n,) and v (n,)."""
        raise NotImplementedError

    def guards(self, mode: str) -> Sequence[Guard]:
        """What ends the mode; of guards that fall together, the first."""
        return ()

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """q and v at time t by known functions, where there are any."""
        return None

    def closed_events(self, until: float) -> list[tuple[str, float]] | None:
        """Names and times [s] of the events up to `until` by known functions, None if unknown."""
        return None

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """Why the mode cannot be at this state: friction, contact, tipping. None if it can."""
        return None
