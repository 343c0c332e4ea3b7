"""The sample interval is a whole multiple of 4 h, so that a ladder h, 2h, 4h meets every sample."""

from collections.abc import Iterator, Mapping
from math import isfinite, isnan

from ..grammar.file import File
from ..parse import Finding

_SEARCHED = 10_000  # counts of samples tried on each side


def sampling(file: File) -> Iterator[Finding]:
    """A mistake where some step does not divide the interval, with the nearest counts that do."""
    steps = tuple(file.step.values()) if isinstance(file.step, Mapping) else (file.step,)
    if any(isnan(number) for number in (file.duration, *steps)):
        return  # a mistaken parameter, found elsewhere
    if _fits(file.duration, file.samples, steps):
        return
    below = range(file.samples - 1, max(2, file.samples - _SEARCHED), -1)
    above = range(file.samples + 1, file.samples + _SEARCHED)
    near = [
        next((n for n in counts if _fits(file.duration, n, steps)), None)
        for counts in (below, above)
    ]
    found = " or ".join(str(n) for n in near if n is not None)
    interval = file.duration / (file.samples - 1)
    yield (
        ("samples",),
        f"the sample interval {interval:.6g} s is not a whole multiple of 4 h for every step h; "
        + (f"samples: {found} would be" if found else "no count near it is: change the duration"),
    )


def _fits(duration: float, samples: int, steps: tuple[float, ...]) -> bool:
    for h in steps:
        ratio = duration / (samples - 1) / (4 * h)
        if not isfinite(ratio) or round(ratio) < 1 or abs(ratio - round(ratio)) > 1e-9 * ratio:
            return False
    return True
