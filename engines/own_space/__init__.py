"""A user's own pymunk `Space`, read into the words of a case file.

It stands beside the adapter, whose every file the stored rows and causes hang on.
"""

import sys
from typing import Any, Protocol


class AnySpace(Protocol):
    """A `pymunk.Space`, as far as one can say so without pymunk."""

    @property
    def constraints(self) -> Any:
        """Its joints, springs and motors."""
        ...

    def step(self, dt: float) -> None:
        """Goes on by dt [s]."""


def is_space(given: Any) -> bool:
    """Whether it is a `pymunk.Space`; pymunk is not imported for it."""
    pymunk = sys.modules.get("pymunk")
    return pymunk is not None and isinstance(given, pymunk.Space)
