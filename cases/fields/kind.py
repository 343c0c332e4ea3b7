"""Types of what can be observed of an element: its fields, each with a unit and a kind."""

from collections.abc import Mapping
from typing import Literal

Kind = Literal[
    "coordinate", "velocity", "force", "energy", "momentum", "residual", "event",
    "acceleration", "inertia",
]  # fmt: skip
Fields = Mapping[str, tuple[str, Kind]]
"""field → unit, kind."""

WORK: Fields = {"work": ("J", "energy")}
"""The field of what has a power: the work it has done since the start, as `power` sums it up."""

RESERVED = ("energy", "momentum", "ground")  # parts that no element can be called
