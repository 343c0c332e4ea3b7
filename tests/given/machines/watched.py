"""x = cos t, or rest, with guards of a test's choice."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Guard, Mode, System


class Oscillator(Mode):
    """q̈ = −q."""

    coordinates = ("x",)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return -q


class Still(Mode):
    """Nothing moves."""

    coordinates = ("x",)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return np.zeros(1)


Plain = Callable[[float, float, float], float]


@dataclass
class Watched(System):
    """x = cos t (or rest at 1) with guards that change nothing, but may end in another mode."""

    watched: Sequence[tuple[str | None, Plain]]
    system: Mode
    after: str = "on"

    def __post_init__(self) -> None:
        self.modes = {"on": self.system, "off": Still()}

    def start(self) -> tuple[str, Array, Array]:
        return "on", np.ones(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        return [
            Guard(
                name,
                lambda t, q, v, g=g: g(t, float(q[0]), float(v[0])),
                lambda t, q, v: (self.after, q, v),
            )
            for name, g in (self.watched if mode == "on" else ())
        ]


def events(*watched: tuple[str | None, Plain], until: float = 10.0, samples: int = 11, **options):
    times = np.linspace(0.0, until, samples)
    return [
        (e.name, e.time) for e in follow(Watched(watched, Oscillator(), **options), times).events
    ]
