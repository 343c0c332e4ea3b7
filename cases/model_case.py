"""A case of a model of the user's own: a file that an engine compiles, and what is claimed of it.

All its names are the model's own, which only the engine that compiles it knows.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from .fields.number import Amount
from .mistake import Mistake, Path, Source
from .trajectory import Array

DURATION, SAMPLES = 1.0, 26
TOLERANCE = 1e-3  # rad and m
JOINTS = "joints"
"""In `allow`: all joints together."""


class Law(Protocol):
    """A law in time of one number."""

    @property
    def corners(self) -> tuple[float, ...]:
        """When [s] it jumps or has a kink."""
        ...

    def at(self, times: Array) -> Array:
        """(N, 1) its values at the times [s]; on a jump those after it."""
        ...


@dataclass(frozen=True)
class Steps:
    """Values at times [s], each of which stays until the next; before the first the first."""

    times: tuple[float, ...]
    values: tuple[float, ...]

    @property
    def corners(self) -> tuple[float, ...]:
        """When [s] it jumps: at all times but the first."""
        return self.times[1:]

    def at(self, times: Array) -> Array:
        """(N, 1) its values at the times [s]; on a jump those after it."""
        places = np.searchsorted(self.times, times, side="right") - 1
        return np.array(self.values)[np.maximum(places, 0)][:, None]


@dataclass(frozen=True)
class RandomRates:
    """Rates up to `most` [rad/s, m/s], drawn by chance: what rests hides much."""

    most: float = 0.5
    seed: int = 0


@dataclass(frozen=True)
class ModelStart:
    """Where a model starts: a keyframe, joints and rates by name over it, rates drawn by chance.

    Without anything it is the first keyframe; without one where the model stands, with rates.
    """

    keyframe: str | None = None
    joints: Mapping[str, tuple[Amount, ...]] = field(default_factory=dict[str, Any])
    rates: Mapping[str, tuple[Amount, ...]] = field(default_factory=dict[str, Any])
    random_rates: RandomRates | None = None


@dataclass(frozen=True)
class ModelCase:
    """One variant of one case file with a `model`, or a model alone.

    path: of the model's file; given: a compiled model in its place, from Python. control: by
    actuator. allow: by quantity, or `joints`. source: the case file, or none, for messages.
    """

    name: str
    path: str
    file: str
    """As the user typed it."""
    source: Source
    title: str = ""
    initial: ModelStart = ModelStart()
    control: Mapping[str, Law] = field(default_factory=dict[str, Law])
    contacts: bool = True
    duration: float = DURATION
    samples: int = SAMPLES
    allow: Mapping[str, Amount] = field(default_factory=lambda: {JOINTS: Amount(TOLERANCE)})
    given: Any = None
    in_folder: bool = False
    """Whether it was only found in a folder: what is wrong with it is a row, and no mistake."""

    def mistake(self, path: Path, what: str) -> Mistake:
        """Returns a mistake at a place of the case file; without one of the model's."""
        return self.source.mistake(path, what)


def of_model(
    path: str, file: str, name: str, given: Any = None, *, in_folder: bool = False
) -> ModelCase:
    """Returns the case of a model alone: 1 s from its first keyframe, 1e-3 rad and m."""
    return ModelCase(name, path, file, Source(file, (), {}), given=given, in_folder=in_folder)
