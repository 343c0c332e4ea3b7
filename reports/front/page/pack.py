"""Numbers as letters: six bits a letter, of those that markup takes as they are.

A picture has some hundred points across, so the 4096 levels of two letters are more than a curve
shows; as decimal digits it would be three times as long. What turns often needs three letters.
"""

import math
from collections.abc import Sequence

import numpy as np

from ....cases.trajectory import Array

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
BASE = len(LETTERS)
CURVE, POSE = 2, 3  # letters of a number: a hundred turns in 4096 levels would be seen to jump
HALF = BASE**CURVE // 2
DIGITS = 6  # of a step, and of where the levels begin: more would be other digits elsewhere
DECADES = 9.0  # of an error below its largest: what is smaller is drawn as nothing

Packed = tuple[float, float, str]
"""Where the levels begin, what one is, and the letters of all numbers."""


def packed(numbers: Array, width: int = CURVE) -> Packed:
    """In even levels over the range of the numbers (N,). Raises ValueError of what is not finite.

    Level k is low + k step; width: how many letters a number has.
    """
    _finite(numbers)
    low, high = float(np.min(numbers)), float(np.max(numbers))
    step = _few((high - low) / (BASE**width - 1))
    low = _of_step(low, step)
    levels = np.zeros(len(numbers)) if step == 0.0 else np.round((numbers - low) / step)
    return low, step, _letters(levels, width)


def unpacked(found: Sequence[float | str], width: int = CURVE) -> Array:
    """(N,) to within half a level."""
    low, step, letters = found
    return float(low) + float(step) * _levels(str(letters), width)


def packed_by_size(numbers: Array) -> Packed:
    """Errors (N,), each to half a percent, down to 1e-9 of the largest; what is smaller becomes 0.

    Level 0 is 0, level k < 2048 is largest 10^(−(k − 1) step); from 2048 on the same, negative.
    Raises ValueError of what is not finite.
    """
    _finite(numbers)
    sizes = np.abs(numbers)
    largest, step = _few(float(np.max(sizes, initial=0.0))), _few(DECADES / (HALF - 2))
    if largest == 0.0:
        return 0.0, step, _letters(np.zeros(len(numbers)))
    kept = sizes > largest * 10**-DECADES
    down = np.round(-np.log10(np.where(kept, sizes, largest) / largest) / step)
    levels: Array = np.where(kept, np.clip(down, 0, HALF - 2) + 1, 0.0)
    return largest, step, _letters(np.where(numbers < 0, levels + HALF, levels))


def unpacked_by_size(found: Sequence[float | str]) -> Array:
    """(N,) to within half a percent."""
    largest, step, letters = found
    levels = _levels(str(letters))
    size = float(largest) * 10 ** (-(levels % HALF - 1) * float(step))
    return np.where(levels % HALF == 0, 0.0, np.where(levels < HALF, size, -size))


def _finite(numbers: Array) -> None:
    if not np.all(np.isfinite(numbers)):
        raise ValueError("a number that is not finite has no level")


def _letters(levels: Array, width: int = CURVE) -> str:
    whole = np.clip(levels, 0, BASE**width - 1).astype(np.int64)
    places = [whole // BASE**k % BASE for k in reversed(range(width))]
    return "".join(LETTERS[k] for k in np.stack(places, axis=1).ravel().tolist())


def _levels(letters: str, width: int = CURVE) -> Array:
    places = np.array([LETTERS.index(letter) for letter in letters], dtype=np.float64)
    weights = float(BASE) ** np.arange(width)[::-1]
    levels: Array = places.reshape(-1, width) @ weights
    return levels


def _of_step(low: float, step: float) -> float:
    """The number to DIGITS, and beside a narrow range to a hundredth of a step at least."""
    few = _few(low)
    if abs(few - low) <= step / 100 or step == 0.0:
        return few
    return round(low, 2 - math.floor(math.log10(step)))


def _few(number: float) -> float:
    return float(f"{number:.{DIGITS}g}")
