"""A mechanism of which states are claimed: it answers for q, q̇ and q̈, and need not move."""

from collections.abc import Mapping
from typing import Any

from .system import Array, Mode


class Stated(Mode):
    """A mode with as many coordinates as freedoms, and v = q̇.

    Its ingredients give every quantity once more, by the chapter's formalisms.
    """

    def quantities(self, q: Array, v: Array, a: Array) -> Mapping[str, Any]:
        """By quantity, derived by hand for the accelerations a = q̈: numbers, or a matrix (n, n)."""
        return {}
