"""The sample interval is a whole multiple of 4 h, so that a ladder h, 2h, 4h meets every sample."""

from collections.abc import Iterator, Mapping
from math import ceil, isfinite, isnan

from ...mistake import Path
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
    if not found and (off := _off(file, interval)):
        path, better = off
        yield path, f"4 h should divide the sample interval {interval:.6g} s: {better:g} s does"
        return
    yield (
        ("samples",),
        f"the sample interval {interval:.6g} s is not a whole multiple of 4 h for every step h; "
        + (f"samples: {found} would be" if found else "no count near it is: change the duration"),
    )


def _off(file: File, interval: float) -> tuple[Path, float] | None:
    """Where the step [s] stands that does not divide the interval, and a smaller one that does."""
    steps = file.step if isinstance(file.step, Mapping) else {None: file.step}
    for name, h in steps.items():
        if _fits(interval, 2, (h,)) or not 0 < h <= interval / 4:
            continue
        least = ceil(interval / (4 * h))
        fitting = [interval / (4 * k) for k in range(least, 4 * least)]
        even = [x for x in fitting if abs(float(f"{x:.1e}") / x - 1) < 1e-9]
        path = ("step",) if name is None else ("step", name)
        return path, (even or fitting)[0]
    return None


def _fits(duration: float, samples: int, steps: tuple[float, ...]) -> bool:
    for h in steps:
        ratio = duration / (samples - 1) / (4 * h)
        if not isfinite(ratio) or round(ratio) < 1 or abs(ratio - round(ratio)) > 1e-9 * ratio:
            return False
    return True
