"""The motion of a system, from event to event: every event is the end of a step."""

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.linalg import LinAlgError
from numpy.typing import NDArray

from ..integrators.budget import motion
from ..integrators.explicit import DormandPrince
from ..integrators.implicit import Radau
from ..integrators.march import IntegrationError, Method, Slope, Step, march
from ..integrators.radau import radau_table
from ..system import Array, Guard, Mode, System, instant
from .event_location import INSIDE, SOON, TOUCH, Fall, Within, clear, first
from .mode_onset import Early
from .stuck import Stuck, Watched, slope
from .zeno import (
    MOST,
    NEAR,
    ROUNDING,
    ZenoError,
    accumulation,
    converged,
    ends_here,
    pile,
    settles,
)

TOLERANCE = 1e-15  # per step; the integrators do not go below 4 ε, so: as well as doubles can
STAGES = 5  # of the implicit integrator

Chosen = Callable[[Mode, Slope, int], Method]
"""(mode, its slope, size of y) → the integrator that follows it."""


def either(mode: Mode, f: Slope, n: int, *, tolerance: float = TOLERANCE) -> Method:
    """The explicit integrator, or the implicit one for a stiff mode."""
    if mode.stiff:
        return Radau(f, tolerance, radau_table(STAGES))
    return DormandPrince(f, n, tolerance)


@dataclass(frozen=True)
class Change:
    """The k-th event of its name, from 1: states y just before and just after it."""

    name: str | None  # None for a change of mode that nobody observes
    k: int
    time: float
    mode_before: str
    mode_after: str
    before: Array
    after: Array
    guard: int | None = None  # which of the mode's fell; None at a corner


@dataclass(frozen=True)
class Touch:
    """A guard that came to zero at `time` and turned back: whether it fell is rounding.

    jumps: whether its motion is another one than if it had.
    """

    name: str | None
    time: float
    jumps: bool


Kept = tuple[float, int, Array]
"""t, the number of the phase, y."""


@dataclass(frozen=True)
class Followed:
    """States y (N, ·), (q, v) each, at the samples, and the changes of mode in order.

    A phase lasts from one change to the next; `phase` (N,) numbers it at each sample and `phases`
    names its mode. march: the start and the end of every accepted step. rows: the same with three
    states inside each step, if they were asked for. An event stands in both twice, as the last row
    of one phase and the first of the next. touched: what came to zero and was taken for no event.
    endless: the times [s] of each pile of events without end, as far as they were followed.
    """

    y: Array
    phase: NDArray[np.int64]
    phases: tuple[str, ...]
    changes: tuple[Change, ...]
    steps: int
    march: tuple[Kept, ...] = ()
    rows: tuple[Kept, ...] = ()
    touched: tuple[Touch, ...] = ()
    endless: tuple[Array, ...] = ()

    @property
    def modes(self) -> tuple[str, ...]:
        """The mode at each sample."""
        return tuple(self.phases[k] for k in self.phase)

    def still(self, t: float, phase: int) -> float:
        """t, or just before it where the phase ends at a corner: its laws in time are those before.

        A force that jumps there, and lets the motion go on in another mode, has done nothing yet.
        """
        ends = self.changes[phase] if phase < len(self.changes) else None
        corner = ends is not None and ends.guard is None and t == ends.time
        return math.nextafter(t, -math.inf) if corner else t

    @property
    def events(self) -> tuple[Change, ...]:
        """The changes that have a name."""
        return tuple(change for change in self.changes if change.name is not None)


def follow(system: System, times: Array, *, by: Chosen = either, every: bool = False) -> Followed:
    """y, phases and changes at the times, starting at times[0]; on an event, the state after it.

    by: the integrator of each mode. every: whether the rows are kept. Raises ZenoError where the
    events do not end, and Stuck where the steps shrink to nothing or the equations have no answer.
    """
    motion(float(times[0]), float(times[-1]))
    walk = _Walk(system, np.asarray(times, dtype=np.float64), by, every)
    while walk.lasts():
        walk.through_one_mode()
    return Followed(
        np.array(walk.y), np.array(walk.phase, dtype=np.int64), tuple(walk.phases),
        tuple(walk.changes), walk.steps, tuple(walk.march), tuple(walk.rows),
        tuple(walk.touched), tuple(walk.endless),
    )  # fmt: skip


@dataclass
class _Walk:
    """Where the motion stands, and the samples so far."""

    system: System
    times: Array
    by: Chosen
    every: bool
    y: list[Array] = field(default_factory=list)
    phase: list[int] = field(default_factory=list)
    phases: list[str] = field(default_factory=list)
    changes: list[Change] = field(default_factory=list)
    march: list[Kept] = field(default_factory=list)
    rows: list[Kept] = field(default_factory=list)
    touched: list[Touch] = field(default_factory=list)
    endless: list[Array] = field(default_factory=list)
    steps: int = 0
    passed: float = -math.inf  # the last corner: from then on what is given is as it is behind it
    spent: int | None = None  # the guard that has just fired, if its mode goes on
    fired: defaultdict[str, list[float]] = field(default_factory=lambda: defaultdict(list))
    passing: set[str] = field(default_factory=set[str])  # those after whose last a motion goes on

    def __post_init__(self) -> None:
        mode, q, v = self.system.start()
        self.t, self.now = float(self.times[0]), np.concatenate([q, v]).astype(np.float64)
        # An event on the last sample may be found just behind it.
        self.together = instant(float(self.times[-1] - self.times[0]))
        self.stops = np.append(self.times, self.times[-1] + self.together)
        self.corners = on_samples(self.system.corners, self.stops)
        self._enter(mode)
        self._keep(self.t)

    def lasts(self) -> bool:
        """Whether the end is still ahead."""
        return self.t < self.stops[-1]

    def through_one_mode(self) -> None:
        """Steps until a guard of the mode falls, a corner is met or the samples end."""
        mode = self.system.modes[self.phases[-1]]
        f = Watched(mode, float(self.times[-1] - self.times[0]), self.now)
        try:
            self._walk(mode, f)
        except IntegrationError as error:
            if len(self.y) == len(self.times) and self.t >= self.times[-1]:
                self.t = float(self.stops[-1])  # an event on the last sample: all is told
                return
            raise Stuck(str(error), mode, error.time, f.y) from error
        except (ArithmeticError, LinAlgError) as error:
            raise Stuck(str(error), mode, self.t, f.y) from error

    def _walk(self, mode: Mode, watched: Slope) -> None:
        guards = self.system.guards(self.phases[-1])
        corner = next((t for t in self.corners if t > self.t), math.inf)
        here = between(self.passed, min(self.corners.get(corner, [math.inf])))
        ends = stops(self.t, self.stops, corner, self.system.longest if guards else None)
        falls = [here(_falling(mode, guard)) for guard in guards]
        f, bare = here(watched), here(slope(mode))
        method, probe = self.by(mode, f, len(self.now)), self.by(mode, bare, len(self.now))
        early, begins = Early(bare, self.now, ends.tolist()), True
        for step in march(method, ends, self.now, anew=bool(self.changes) and not mode.stiff):
            self.steps += 1
            state = inside(step, probe)
            length = step.t_next - step.t
            looks = self.every and not mode.stiff
            if guards and not looks:  # a stiff state may turn faster than the cubic
                sure = not begins and not mode.stiff
                looks = not (sure and clear(falls, f, step.t, length, step.y, step.y_next))
            near = falls if looks else ()
            none = [guard.rounds(mode.parted(step.y)[0]) for guard in guards if looks]
            known = (fall for fall, size in zip(near, none, strict=True) if size)
            soon = SOON if begins and any(_at_zero(fall, step) for fall in known) else ()
            points = [0.0, *(part * length for part in (*soon, *INSIDE) if looks), length]
            states = [state(at) for at in points]
            spent = self.spent if begins else None
            fallen = partial(
                first, near, step.t, points, states, state,
                begins=begins, spent=spent, nothing=none, soon=len(soon), together=self.together,
            )  # fmt: skip
            earliest, touched = fallen()
            room = early.rounding(step.t, points) if earliest is not None else None
            if room is not None:
                earliest, touched = fallen(rounding=room)
            for i, at in touched:
                self.touched.append(Touch(guards[i].event, step.t + at, guards[i].jumps))
            if earliest is not None:
                i, after = earliest
                self._note(step.t, [part * after for part in (*INSIDE, 1.0)], state)
                self._switch(guards[i], i, step.t + after, state(after))
                return
            begins = begins and room is not None
            self._stepped(step.t_next, step.y_next)
            self._note(step.t, points[1:], state, states[1:])
            self.now = step.y_next
            self._keep(step.t_next)
        if self.t == corner:
            self._cross(mode)

    def _cross(self, mode: Mode) -> None:
        """A corner: the mode may be another one beyond it."""
        self.passed, self.spent, before = max(self.corners[self.t]), None, self.now
        name, q, v = self.system.beyond(self.phases[-1], self.passed, *mode.parted(before))
        if name != self.phases[-1]:
            self._change(Change(None, 0, self.t, self.phases[-1], name, before, np.append(q, v)))

    def _keep(self, t: float) -> None:
        self.t = t  # and a sample, if there is one
        if len(self.y) < len(self.times) and self.times[len(self.y)] <= t:
            self.y.append(self.now)
            self.phase.append(len(self.changes))

    def _note(
        self, t: float, lengths: list[float], state: Within, states: Sequence[Array] = ()
    ) -> None:
        """Rows of a step, but not those just behind the last sample."""
        if self.every:
            at_lengths = states or [state(length) for length in lengths]
            rows = zip(lengths, at_lengths, strict=True)
            k, end = len(self.changes), self.stops[-2]
            self.rows += [(t + length, k, y) for length, y in rows if t + length <= end]

    def _enter(self, mode: str) -> None:
        self.phases.append(mode)
        self._stepped(self.t, self.now)
        if self.every:
            self.rows.append((self.t, len(self.changes), self.now))

    def _stepped(self, t: float, y: Array) -> None:
        if t <= self.stops[-2]:  # and not behind the last sample
            self.march.append((t, len(self.changes), y))

    def _switch(self, guard: Guard, i: int, t: float, before: Array) -> None:
        self._stepped(t, before)
        ended = self.phases[-1]
        parted = self.system.modes[ended].parted(before)
        mode, q, v = guard.then(t, *parted)
        name = guard.event or f"{ended} to {mode}"
        if guard.at_last is not None:
            self.passing.add(name)
        following = self._piles_up(name, t, refused=guard.at_last is None)
        if following is not None and guard.at_last is not None:
            last, a = guard.at_last(t, *parted), self.system.modes[mode].accelerations(t, q, v)
            if last is not None and converged(v, last[2], a, following):
                mode, q, v = last
                self.endless.append(pile(self.fired[name]))
        self.spent = i if mode == ended else None
        k, after = len(self.fired[name]), np.concatenate([q, v])
        back = mode == ended and np.array_equal(before, after)
        if guard.vain and (back or self._trembles(t, ended, parted[1], v)):
            self.t, self.now, self.spent = t, before, i
            self.fired[name].pop()
            return
        self._change(Change(guard.event, k, t, ended, mode, before, after, i))

    def _trembles(self, t: float, mode: str, before: Array, after: Array) -> bool:
        """Whether the mode has only just begun, by another event, and this one changes no rate."""
        last = self.changes[-1] if self.changes else None
        if last is None or t - last.time > self.together or last.mode_before == mode:
            return False
        return bool(np.max(np.abs(after - before)) <= ROUNDING * np.max(np.abs(before)))

    def _change(self, change: Change) -> None:
        self.changes.append(change)
        self.t, self.now = change.time, change.after
        self._enter(change.mode_after)
        if self.t - self.times[len(self.y) - 1] <= self.together:
            self.y[-1], self.phase[-1] = self.now, len(self.changes)
        self._keep(on_sample(self.t, self.stops))

    def _piles_up(self, name: str, t: float, *, refused: bool) -> float | None:
        """The next distance [s] if this may be the last of infinitely many, else None.

        Raises ZenoError if that is refused.
        """
        begin, end = float(self.times[0]), float(self.times[-1])
        self.fired[name].append(t)
        if sum(map(len, self.fired.values())) > MOST:
            raise ZenoError(name, t, f"is one of more than {MOST} events")
        limit = accumulation(self.fired[name])
        if not refused:
            return settles(name, self.fired[name], end - begin)
        if limit is None or not ends_here(limit, t, begin, end):
            return None
        if not self._is_passed(limit, NEAR * (end - begin)):
            raise ZenoError(
                name, t, f"happens without end before {limit:.6g} s (a Zeno sequence), seen"
            )
        return None

    def _is_passed(self, limit: float, near: float) -> bool:
        """Whether what piles up there does so between events after whose last a motion goes on.

        Between two bounces friction turns round: both pile up at one time, and the bounces end.
        """
        others = (accumulation(self.fired[name]) for name in self.passing)
        return any(other is not None and abs(other - limit) <= near for other in others)


def _at_zero(fall: Fall, step: Step) -> bool:
    """Whether a guard is zero at a step's begin, beside what it is at the end."""
    return abs(fall(step.t, step.y)) <= TOUCH * abs(fall(step.t_next, step.y_next))


def _falling(mode: Mode, guard: Guard) -> Fall:
    return lambda t, y: guard.g(t, *mode.parted(y))


# The states inside a step, between its two ends.


def inside(step: Step, probe: Method) -> Within:
    """A function for the states in an accepted step, each by a step of its own, or by several."""

    def state(h: float) -> Array:
        if h == 0.0 or h == step.t_next - step.t:
            return step.y_next if h else step.y
        there = step.y + probe.attempt(step.t, step.y, h, np.maximum(np.abs(step.y), step.floor))
        if np.isfinite(there).all():
            return there
        *_, last = march(probe, (step.t, step.t + h), step.y)  # a part may be harder than the whole
        return last.y_next

    return state


def rows_at(system: System, followed: Followed, times: Array) -> list[Kept]:
    """Returns the states at any times [s] of a motion, each by a step from the last one before it.

    On an event that is the state after it.
    """
    march, begins = followed.march, np.array([t for t, _, _ in followed.march])
    rows = list[Kept]()
    for t in times.tolist():
        t0, phase, y = march[int(np.searchsorted(begins, t, side="right")) - 1]
        if t > t0:
            mode = system.modes[followed.phases[phase]]
            probe = either(mode, slope(mode), len(y))
            step = Step(t0, y, t - t0, math.inf, y, 0, np.zeros(len(y)))
            y = inside(step, probe)(t - t0)
        rows.append((t, phase, y))
    return rows


# Where steps end: at samples, at corners of what is given in time, and often enough.


ALIKE = 8  # ulp: the same time, typed and counted in intervals
AT_ONCE = 256  # ulp: in so little time a force that grows from zero is nothing but rounding
Timed = Callable[[float, Array], Any]
"""(t, y) → a slope, or what guards a mode."""


def stops(now: float, samples: Array, corner: float, longest: float | None) -> Array:
    """Ends of steps up to the corner: now, the samples, and times between, `longest` [s] apart."""
    last = min(corner, samples[-1])
    times = np.array([now, *samples[(samples > now) & (samples < last)], last])
    if longest is None:
        return times
    pieces = np.ceil(np.diff(times) / longest).astype(int)
    spans = zip(times[:-1], times[1:], pieces, strict=True)
    between = [np.linspace(a, b, n, endpoint=False) for a, b, n in spans]
    return np.append(np.concatenate(between), times[-1])


def on_samples(corners: Iterable[float], samples: Array) -> dict[float, list[float]]:
    """The corners by the ends of steps: one that is a sample but for rounding ends with that."""
    by_end: dict[float, list[float]] = {}
    for corner in sorted(set(corners)):
        near = float(samples[np.argmin(np.abs(samples - corner))])
        alike = abs(near - corner) <= ALIKE * math.ulp(near)
        by_end.setdefault(near if alike else corner, []).extend([corner, *([near] * alike)])
    return by_end


def on_sample(t: float, samples: Array) -> float:
    """The time of an event, or the sample that comes at once: no step leads there."""
    ahead = samples[samples >= t][:1].tolist()
    return next((sample for sample in ahead if sample - t <= AT_ONCE * math.ulp(sample)), t)


def between(passed: float, corner: float) -> Callable[[Timed], Timed]:
    """A function of t, y as it is between two corners: at the second it may jump."""
    if passed == -math.inf and corner == math.inf:
        return lambda g: g
    last = math.nextafter(corner, -math.inf)
    return lambda g: lambda t, y: g(min(max(t, passed), last), y)
