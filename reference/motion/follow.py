"""The motion of a system that switches: every event is the end of a step.

No interpolation: the step in which a guard falls through zero is repeated under a root-finder,
with its length as the unknown, until it ends on the event.
"""

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from ..integrators.explicit import DormandPrince
from ..integrators.implicit import Radau
from ..integrators.march import Method, Slope, Step, march
from ..integrators.radau import radau_table
from ..mode import Guard, Switching
from ..system import Array, System

TOLERANCE = 1e-15  # per step, as for smooth motions: as well as doubles can
TOGETHER = 1e-12  # s: how well an event is located, so closer ones are one instant
ROOT = 1e-15  # s: what the root-finder is asked for, to keep the promise above
INSIDE = (0.25, 0.5, 0.75)  # of a step: a guard turns no faster than the motion, at most once
HALVINGS = 40  # of a step, in search of the rise of a guard that begins at zero: to 1e-12 of it
MOST = 10_000  # events
SEEN = 6  # firings of one name from which an accumulation is judged: five distances
NEAR = 1e-5  # of the duration: an accumulation point this close ends the motion


class ZenoError(RuntimeError):
    """Events without end in a finite time; `time` is how far it got, `event` what happens."""

    def __init__(self, event: str, time: float, reason: str) -> None:
        super().__init__(f"'{event}' {reason} at t = {time!r}")
        self.event, self.time = event, time


@dataclass(frozen=True)
class Event:
    """The k-th event of its name, from 1: states y (2n,) just before and just after it."""

    name: str | None  # None for a change of mode that nobody observes
    k: int
    time: float
    mode_before: str
    mode_after: str
    before: Array
    after: Array


@dataclass(frozen=True)
class Followed:
    """States y (N, 2n) and modes (N,) at the samples, and the changes of mode, in order."""

    y: Array
    modes: tuple[str, ...]
    changes: tuple[Event, ...]

    @property
    def events(self) -> tuple[Event, ...]:
        """The changes that have a name."""
        return tuple(change for change in self.changes if change.name is not None)


def follow(switching: Switching, times: Array, *, tolerance: float = TOLERANCE) -> Followed:
    """y, modes and events at the times, starting at times[0]; on an event, the state after it.

    Raises ZenoError where the events do not end.
    """
    walk = _Walk(switching, np.asarray(times, dtype=np.float64), tolerance)
    while walk.lasts():
        walk.through_one_mode()
    return Followed(np.array(walk.y), tuple(walk.modes), tuple(walk.changes))


@dataclass
class _Walk:
    """Where the motion stands, and the samples so far."""

    switching: Switching
    times: Array
    tolerance: float
    y: list[Array] = field(default_factory=list)
    modes: list[str] = field(default_factory=list)
    changes: list[Event] = field(default_factory=list)
    spent: int | None = None  # the guard that has just fired, if its mode goes on
    fired: defaultdict[str, list[float]] = field(default_factory=lambda: defaultdict(list))

    def __post_init__(self) -> None:
        self.mode, q, v = self.switching.start()
        self.t, self.now = float(self.times[0]), np.concatenate([q, v]).astype(np.float64)
        # An event on the last sample may be found just behind it.
        self.stops = np.append(self.times, self.times[-1] + TOGETHER)
        self._keep(self.t)

    def lasts(self) -> bool:
        """Whether the end is still ahead."""
        return self.t < self.stops[-1]

    def through_one_mode(self) -> None:
        """Steps until a guard of the mode falls or the samples end."""
        f = slope(self.switching.modes[self.mode])
        guards = self.switching.guards(self.mode)
        probe, begins = self._method(f), True
        for step in march(self._method(f), self._stops(), self.now):

            def state(h: float, step: Step = step) -> Array:
                if h == 0.0 or h == step.t_next - step.t:
                    return step.y_next if h else step.y
                return step.y + probe.attempt(step.t, step.y, h, np.abs(step.y))

            spent = self.spent if begins else None
            found = first(guards, step.t, step.t_next - step.t, state, begins=begins, spent=spent)
            if found is not None:
                self._switch(guards, found[0], step.t + found[1], state(found[1]))
                return
            begins = False
            self.t, self.now = step.t_next, step.y_next
            self._keep(self.t)

    def _method(self, f: Slope) -> Method:
        if self.switching.implicit:
            return Radau(f, self.tolerance, radau_table(5))
        return DormandPrince(f, len(self.now), self.tolerance)

    def _stops(self) -> Array:
        """Now and the samples to come, and times between them where steps must not be longer."""
        stops = np.append(self.t, self.stops[self.stops > self.t])
        if self.switching.longest is None:
            return stops
        pieces = np.ceil(np.diff(stops) / self.switching.longest).astype(int)
        spans = zip(stops[:-1], stops[1:], pieces, strict=True)
        between = [np.linspace(a, b, n, endpoint=False) for a, b, n in spans]
        return np.append(np.concatenate(between), stops[-1])

    def _keep(self, t: float) -> None:
        """A sample, if there is one at t."""
        if len(self.y) < len(self.times) and self.times[len(self.y)] <= t:
            self.y.append(self.now)
            self.modes.append(self.mode)

    def _switch(self, guards: Sequence[Guard], i: int, t: float, before: Array) -> None:
        guard = guards[i]
        mode, q, v = guard.then(t, *np.split(before, 2))
        self.spent = i if mode == self.mode else None
        after = np.concatenate([q, v])
        self._refuse_zeno(name := guard.event or f"{self.mode} to {mode}", t)
        k = len(self.fired[name])
        self.changes.append(Event(guard.event, k, t, self.mode, mode, before, after))
        self.t, self.mode, self.now = t, mode, after
        if t - self.times[len(self.y) - 1] <= TOGETHER:
            self.y[-1], self.modes[-1] = after, mode
        self._keep(t)

    def _refuse_zeno(self, name: str, t: float) -> None:
        self.fired[name].append(t)
        if sum(map(len, self.fired.values())) > MOST:
            raise ZenoError(name, t, f"is one of more than {MOST} events")
        end = float(self.times[-1])
        limit = accumulation(self.fired[name][-SEEN:])
        if limit is not None and limit <= end and limit - t <= NEAR * (end - self.times[0]):
            raise ZenoError(
                name, t, f"happens without end before {limit:.6g} s (a Zeno sequence), seen"
            )


def accumulation(instants: Sequence[float]) -> float | None:
    """Where instants whose distances shrink geometrically pile up; None if they do not."""
    distances = np.diff(instants)
    if len(distances) < SEEN - 1:
        return None
    if not distances.any():
        return instants[-1]
    if not distances.all():
        return None
    ratio = float(np.max(distances[1:] / distances[:-1]))
    return instants[-1] + float(distances[-1]) * ratio / (1.0 - ratio) if ratio < 1.0 else None


def slope(system: System) -> Slope:
    """ẏ = (v, q̈(t, q, v)) of y = (q, v)."""

    def f(t: float, y: Array) -> Array:
        n = len(y) // 2
        return np.concatenate([y[n:], system.accelerations(t, y[:n], y[n:])])

    return f


def first(
    guards: Sequence[Guard],
    t: float,
    h: float,
    state: Callable[[float], Array],
    *,
    begins: bool,
    spent: int | None,
) -> tuple[int, float] | None:
    """Which guard falls first in a step of length h, and how far into it.

    begins: the mode does, with this step. spent: the guard that ended it just before.
    """
    points = [0.0, *(part * h for part in INSIDE), h]
    states = [state(at) for at in points] if guards else []
    found = None
    for i, guard in enumerate(guards):

        def g(at: float, y: Array | None = None, guard: Guard = guard) -> float:
            return guard.g(t + at, *np.split(state(at) if y is None else y, 2))

        values = [g(at, y) for at, y in zip(points, states, strict=True)]
        at = crossing(g, points, values, begins=begins, spent=i == spent)
        if at is not None and (found is None or at < found[1] - TOGETHER):
            found = i, at
    return found


def crossing(
    g: Callable[[float], float],
    points: list[float],
    values: list[float],
    *,
    begins: bool,
    spent: bool,
) -> float | None:
    """The first zero that g falls through, of a function known at some points."""
    rise = next((i for i, value in enumerate(values) if value > 0.0), None)
    if rise is None:
        if begins and values[-1] < values[0]:
            return _begun(g, points[-1], spent)
        top = _near(g, points, values, -1.0)
        return None if top is None else _root(g, *top)
    fall = next((i for i in range(rise, len(values)) if values[i] <= 0.0), None)
    if fall is not None:
        return _root(g, points[fall - 1], points[fall])
    bottom = _near(g, points[rise:], values[rise:], 1.0)
    return None if bottom is None else _root(g, *bottom)


def _begun(g: Callable[[float], float], h: float, spent: bool) -> float | None:
    """The zero after a rise too short for the points to see; without one, the very beginning."""
    for k in range(1, HALVINGS):
        if g(h / 2**k) > 0.0:
            return _root(g, h / 2**k, h / 2 ** (k - 1))
    return None if spent else 0.0


def _near(
    g: Callable[[float], float], points: list[float], values: list[float], sign: float
) -> tuple[float, float] | None:
    """A dip below zero (sign 1) or a hump above it (−1) between the points: a bracket of its fall.

    It is looked for where the values come as near to zero as they differ from each other.
    """
    sizes = [sign * value for value in values]
    low = int(np.argmin(sizes))
    if len(points) < 2 or sizes[low] > max(sizes) - sizes[low]:
        return None
    left, right = points[max(low - 1, 0)], points[min(low + 1, len(points) - 1)]
    turn = minimize_scalar(
        lambda at: sign * g(at), bounds=(left, right), method="bounded", options={"xatol": TOGETHER}
    )
    if sign > 0.0:
        return (left, float(turn.x)) if turn.fun <= 0.0 else None
    return (float(turn.x), right) if turn.fun < 0.0 else None


def _root(g: Callable[[float], float], left: float, right: float) -> float:
    """Just beyond the zero between a positive value and one that is not: g has fallen there."""
    root = float(brentq(g, left, right, xtol=ROOT, rtol=4 * np.finfo(float).eps))
    beyond = ROOT
    while root < right and g(root) > 0.0:
        root, beyond = min(root + beyond, right), 2 * beyond
    return root
