"""When a number has moved, and when that is a regression: thresholds that were measured.

Runs of the same code on another processor, or with other kernels of linear algebra, differ by
1e-10 of `allow` at most, and three written digits by 1 %: with what stands here such runs raise no
alarm.
"""

from dataclasses import dataclass
from math import inf, isinf, isnan


@dataclass(frozen=True)
class Rule:
    """Thresholds, each a part of something or a factor.

    moved: of the larger of two numbers, what they must differ by. floor: of what is allowed, the
    same. worse: the factor by which an error must grow to be a regression; matters: of what is
    allowed, where a grown error begins to be one.
    """

    moved: float = 0.011
    floor: float = 1e-6
    worse: float = 1.5
    matters: float = 1e-3

    def differ(self, was: float | None, now: float | None, allowed: float | None) -> bool:
        """Whether it is another number; one that is not there differs from every one that is."""
        if was is None or now is None:
            return was is not now
        if isnan(was) or isnan(now):
            return isnan(was) != isnan(now)
        if isinf(was) or isinf(now):
            return was != now
        off = abs(now - was)
        return off > self.floor * (allowed or 0.0) and off > self.moved * max(abs(was), abs(now))

    def grown(self, was: float | None, now: float | None, allowed: float | None) -> bool:
        """Whether an error that differs is a regression."""
        if was is None or now is None:
            return False  # then its verdict says more
        matters = allowed is None or not now <= self.matters * allowed
        return matters and not now <= self.worse * was

    def shrunk(self, was: float | None, now: float | None, allowed: float | None) -> bool:
        """Whether it would be a regression the other way round."""
        return self.grown(now, was, allowed)


def factor(was: float | None, now: float | None) -> float | None:
    """How many times as large it is; None where that is no number."""
    if was is None or now is None or isnan(was) or isnan(now) or was == now:
        return None
    if was == 0.0:
        return inf
    return None if isinf(was) else now / was
