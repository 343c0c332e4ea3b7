"""A smooth motion: integrated between the corners of its laws, and asked at its samples."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from second.equations import Row, Solved, redundant, solve
from second.instant import Now
from second.moving import Array

RTOL = 1e-11
ATOL = 1e-12


@dataclass
class State:
    """How a motion's numbers are ordered: places, rates, turned angles, inner states, works."""

    model: Any
    works: tuple[str, ...] = ()
    cuts: list[int] = field(init=False)

    def __post_init__(self) -> None:
        m = self.model
        sizes = [len(m.layout.rest()), m.n, m.turns, len(m.inner), len(self.works)]
        self.cuts = list(np.cumsum(sizes)[:-1])

    def now(self, t: float, y: Array) -> Now:
        """The instant of such numbers."""
        x, u, turned, inner, _ = np.split(y, self.cuts)
        return Now(self.model, t, x, u, turned, inner)

    def rate(self, now: Now, solved: Solved) -> Array:
        """Their derivative."""
        m = self.model
        turned = self.turnings(now)
        inner = [now.effects[name].inner for name in m.inner]
        works = [power(now, solved, name) for name in self.works]
        x = m.layout.rate(now.x, now.u)
        return np.concatenate([x, solved.a, np.array([*turned, *inner, *works], dtype=float)])

    def turnings(self, now: Now) -> list[float]:
        """The rates of all turned angles, of a universal joint too, which does not name them."""
        if not self.model.layout.space:
            return []
        turning = [held for held in now.held.values() if held.joint.hinges]
        return [l.v for held in turning for l in held.turnings()]


def power(now: Now, solved: Solved, name: str) -> float:
    """What a force, or the drives of a joint, do per second."""
    if name in now.effects:
        return now.effects[name].power
    return sum(
        solved.of(name, rate) * now.coordinate(rate).v
        for rate in now.model.drives
        if rate.split(".")[0] == name
    )


def smooth(now: Now) -> list[Row]:
    """The rows of a motion without contacts that open."""
    return [Row(*row) for row in now.rows()]


@dataclass
class Piece:
    """A piece of a motion: its span, its numbers at any time in it, and what holds there."""

    start: float
    end: float
    at: Callable[[float], Array]
    mode: Any = None


@dataclass
class Motion:
    """A motion: its pieces, and every sample with what is solved for there."""

    state: State
    pieces: list[Piece]
    times: Array
    samples: list[tuple[Now, Solved]]


def spans(model: Any, duration: float) -> list[tuple[float, float]]:
    """The spans between the corners of all laws."""
    inside = [t for t in model.corners if 0 < t < duration]
    return list(zip([0.0, *inside], [*inside, duration], strict=True))


def moved(model: Any, y: Array, state: State, duration: float, samples: int) -> Motion:
    """The motion from a start."""
    first = state.now(0.0, y)
    several = redundant(first, smooth(first))

    def solved(now: Now) -> Solved:
        return solve(now, smooth(now), redundant=several)

    pieces = []
    for a, b in spans(model, duration):
        last = np.nextafter(b, a)  # a law that jumps at b has not jumped within

        def rate(t: float, y: Array, last: float = last) -> Array:
            now = state.now(min(t, last), y)
            return state.rate(now, solved(now))

        # what is read between two steps is as good as they are where none is longer than a sample
        h = duration / (samples - 1)
        sol = solve_ivp(
            rate, (a, b), y, "DOP853", rtol=RTOL, atol=ATOL, max_step=h, dense_output=True
        )
        if not sol.success or sol.sol is None:
            raise ArithmeticError(sol.message)
        pieces.append(Piece(a, b, sol.sol))
        y = sol.y[:, -1]
    times = np.linspace(0.0, duration, samples)
    found = []
    for t in times:
        piece = next((p for p in pieces if t < p.end), pieces[-1])  # what is just after a corner
        now = state.now(t, piece.at(t))
        found.append((now, solved(now)))
    return Motion(state, pieces, times, found)
