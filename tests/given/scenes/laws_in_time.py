"""Every law in time of the grammar, in the words of a file and as a number by another hand.

Corners lie beside samples; a table begins after the start and ends after the end.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.integrate import fixed_quad

PRESCRIBED = ("constant", "ramp", "sine", "polynomial", "table")
MOVING = ("ramp", "sine", "polynomial")
ALL = ("constant", "ramp", "sine", "step", "pulse", "polynomial", "table")


Number = Callable[[float], float]


@dataclass(frozen=True)
class InTime:
    """A law: its words, s(t), ṡ(t) and s̈(t) with their corners [s]."""

    words: str
    number: Number
    slope: Number
    bend: Number = lambda t: 0.0
    corners: tuple[float, ...] = ()

    def times(self, order: int, t: float) -> float:
        """s integrated so often from 0 to t, by quadrature; its rates for −1 and −2."""
        if order <= 0:
            return (self.number, self.slope, self.bend)[-order](t)
        ends = [0.0, *(c for c in self.corners if c < t), t]
        weighed = {1: self.number, 2: lambda u: (t - u) * self.number(u)}[order]
        f = np.vectorize(weighed)  # smooth in each piece, where 20 nodes leave rounding
        return float(sum(fixed_quad(f, a, b, n=20)[0] for a, b in pairwise(ends)))


def _table(t: float) -> float:
    """0.4 until 0.1307, a line to −0.9 at 0.3711, from there one to 1.1 at 1.7, and no more."""
    if t <= 0.1307:
        return 0.4
    if t <= 0.3711:
        return 0.4 - 1.3 * (t - 0.1307) / 0.2404
    return -0.9 + 2.0 * (min(t, 1.7) - 0.3711) / 1.3289


def _table_slope(t: float) -> float:
    return 0.0 if t < 0.1307 else -1.3 / 0.2404 if t < 0.3711 else 2.0 / 1.3289


PHASE = math.radians(40)
LAWS: dict[str, InTime] = {
    "constant": InTime("1.3", lambda t: 1.3, lambda t: 0.0),
    "ramp": InTime("-0.7", lambda t: -0.7 * t, lambda t: -0.7),
    "sine": InTime(
        "{amplitude: 0.9, angular_frequency: 5.3, phase: 40 deg}",
        lambda t: 0.9 * math.sin(5.3 * t + PHASE),
        lambda t: 0.9 * 5.3 * math.cos(5.3 * t + PHASE),
        lambda t: -0.9 * 5.3 * 5.3 * math.sin(5.3 * t + PHASE),
    ),
    "step": InTime(
        "{amplitude: 1.1, at: 0.21374}",
        lambda t: 1.1 if t >= 0.21374 else 0.0,
        lambda t: 0.0,
        corners=(0.21374,),
    ),
    "pulse": InTime(
        "{amplitude: -1.7, from: 0.1837, until: 0.6411}",
        lambda t: -1.7 if 0.1837 <= t < 0.6411 else 0.0,
        lambda t: 0.0,
        corners=(0.1837, 0.6411),
    ),
    "polynomial": InTime(
        "{coefficients: [0.5, -0.4, 0, 1.2]}",
        lambda t: 0.5 - 0.4 * t + 1.2 * t * t * t,
        lambda t: -0.4 + 3.6 * t * t,
        lambda t: 7.2 * t,
    ),
    "table": InTime(
        "{times: [0.1307, 0.3711, 1.7], values: [0.4, -0.9, 1.1]}",
        _table,
        _table_slope,
        corners=(0.1307, 0.3711, 1.7),
    ),
}


def words(law: str, along: tuple[float, ...] = ()) -> str:
    """`sine: {…}`; along a direction, whose amplitude has as many entries."""
    found = LAWS[law].words
    if along and law in ("polynomial", "table"):
        found = found.replace("{", f"{{along: {[*along]}, ", 1)
    elif along:
        size = found.split("amplitude: ")[-1].split(",")[0].rstrip("}")
        found = found.replace(size, str([float(size) * u for u in along]), 1)
    return f"{law}: {found}"
