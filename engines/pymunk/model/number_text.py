"""Numbers as Python writes them."""

import math
from typing import Any


def written(value: Any) -> str:
    """A number or vector as Python writes it."""
    if isinstance(value, tuple):
        return f"({', '.join(written(float(x)) for x in value)})"
    return "math.inf" if value == math.inf else repr(value)
