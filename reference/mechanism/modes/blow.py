"""One way in which contacts may take a blow: the velocities after it, and whether laws allow it.

Rows that repeat what others hold, as of a disk in a groove, change nothing of the motion as long as
they ask for the same; which of them bears how much of the blow is for nobody to say. So they are
solved by their rank, and the laws need some impulses that keep them (`leeway`).
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...coverage import equation
from ...system import Array
from ..constraints.leeway import FITS, Leeway, sized
from .element import Element, State, sign
from .loose import NONE, rank, unit

CONE = 1e-12  # of the impulses: one that needs all of the cone sticks
ROUNDING = 1e-12  # of the velocities
TURNS = 2  # of refinement, as in a mode: light bodies beside heavy ones
APART = 1e-8  # of the velocities: ten times what rows leave that are taken for dependent
SAME = 1e-9  # of the velocities: as far apart as linear programmes leave one


@dataclass(frozen=True)
class Condition:
    """f_a (n,) and g of (2.15)."""

    f: Array
    g: float

    def rate(self, v: Array) -> float:
        """f_a q̇ᵃ − g [m/s]."""
        return float(self.f @ v) - self.g


@dataclass(frozen=True)
class Meeting:
    """A closed contact in the instant: its rows, and the normal velocity after it."""

    element: Element
    normal: Condition
    tangent: Condition
    after: float
    strikes: bool


@dataclass(frozen=True)
class Blow:
    """q̇⁺ (n,); shared: its impulses are open; loose: so is which of several velocities it is.

    grip: the friction that all needs which sticks; unknown where impulses are open.
    """

    v: Array
    shared: bool = False
    loose: bool = False
    grip: float | None = None


@dataclass(frozen=True)
class _Rows:
    """f (r, n), what a unit of each impulse exerts (r, n), and f q̇⁺ (r,)."""

    f: Array
    columns: Array
    after: Array
    normals: Sequence[int | None]  # where each contact's normal row stands
    stuck: Mapping[tuple[str, str], int]  # and the row of no slip of what sticks


def blow(
    M: Array,
    joints: Sequence[Condition],
    meetings: Sequence[Meeting],
    v: Array,
    states: Sequence[State],
) -> Blow | None:
    """The velocities after it, or None where what the contacts do contradicts the laws."""
    rows = _rows(joints, meetings, states, len(v))
    if not len(rows.f):
        after, impulse, ways = v, np.zeros(0), np.zeros((0, 0))
    else:
        after, impulse, ways = _solve(M, rows, v)
    fast = float(np.max(np.abs(v)))
    if np.max(np.abs(rows.f @ after - rows.after), initial=0.0) > APART * _fast(rows, v):
        return None
    return _allowed(M, rows, meetings, states, (v, after, impulse), ways, fast)


def _fast(rows: _Rows, v: Array) -> float:
    """The scale against which rates of the rows are small."""
    sizes = np.abs(rows.f) @ np.abs(v)
    return float(max(np.max(sizes, initial=0.0), np.max(np.abs(rows.after), initial=0.0)))


def _rows(
    joints: Sequence[Condition], meetings: Sequence[Meeting], states: Sequence[State], n: int
) -> _Rows:
    rows = [joint.f for joint in joints]
    columns = list(rows)
    after = [joint.g for joint in joints]
    normals: list[int | None] = []
    stuck: dict[tuple[str, str], int] = {}
    for meeting, state in zip(meetings, states, strict=True):
        if state == "open":
            normals.append(None)
            continue
        normals.append(len(rows))
        lean = -meeting.element.kinetic * sign(state)
        rows.append(meeting.normal.f)
        columns.append(meeting.normal.f + lean * meeting.tangent.f)
        after.append(meeting.after)
        mine = meeting.element.together
        if state == "sticks" and mine not in stuck:  # its other points do not slip either
            stuck[mine] = len(rows)
            rows.append(meeting.tangent.f)
            columns.append(meeting.tangent.f)
            after.append(meeting.tangent.g)
    shape = (len(rows), n)
    f, exerts = np.array(rows).reshape(shape), np.array(columns).reshape(shape)
    return _Rows(f, exerts, np.array(after), normals, stuck)


def _solve(M: Array, rows: _Rows, v: Array) -> tuple[Array, Array, Array]:
    """q̇⁺ (n,), the least impulses (r,) that give it, and those (k, r) that change no row's rate."""
    root = np.sqrt(M)
    f, sizes = unit(rows.f / root)
    columns = rows.columns / root / sizes[:, None]
    across, s, along = np.linalg.svd(f @ columns.T)
    k = min(rank(f), int(np.sum(s > NONE * s[0])))
    v_after, impulse = v, np.zeros(len(f))
    for _ in range(1 + TURNS):
        residual = (rows.after - rows.f @ v_after) / sizes
        if k == len(f):
            more = np.linalg.solve(f @ columns.T, residual)
        else:
            more = along[:k].T @ ((across.T @ residual)[:k] / s[:k])
        v_after, impulse = v_after + more @ columns / root, impulse + more / sizes
    return v_after, impulse, along[k:] / sizes


def _allowed(
    M: Array,
    rows: _Rows,
    meetings: Sequence[Meeting],
    states: Sequence[State],
    solution: tuple[Array, Array, Array],
    ways: Array,
    fast: float,
) -> Blow | None:
    """The velocities after the blow, if impulses + z₁ way₁ + … can keep the laws; else None."""
    v, v_after, impulse = solution
    size = float(np.max(np.abs(impulse), initial=0.0)) or 1.0

    def margins(v_after: Array, impulse: Array) -> Array:
        pushes = [margin / size for margin in _pushes(rows, meetings, impulse)]
        speeds = [rate / fast for rate in _speeds(meetings, states, v_after)] if fast else []
        return np.array([*pushes, *speeds])

    own_margins = margins(v_after, impulse)
    if not len(ways):
        fits = bool(np.all(own_margins >= -ROUNDING))
        return Blow(v_after, grip=_grip(rows, meetings, impulse)) if fits else None
    others = [(v_after + way @ rows.columns / M, impulse + way) for way in sized(ways, size)]
    slope = np.array([margins(*other) - own_margins for other in others]).T
    places = [str(i) for i in range(len(v))]
    own, *alternatives = (
        dict(zip(places, each.tolist(), strict=True)) for each in (v_after, *(x for x, _ in others))
    )
    leeway = Leeway(own, alternatives, own_margins, slope, fast or 1.0)
    if np.any(own_margins[~leeway.leans] < -FITS) or not leeway.fits:
        return None
    moved = [place for place in places if leeway.open(place)]
    if not moved:
        return Blow(v_after, shared=True)
    inmost = np.array([leeway.inmost.forces[place] for place in places])
    spans = [leeway.span(place) for place in moved]
    return Blow(inmost, shared=True, loose=any(high - low > SAME * fast for low, high in spans))


@equation
def _pushes(rows: _Rows, meetings: Sequence[Meeting], impulse: Array) -> Iterator[float]:
    """(2.87) for impulses, each ≥ 0: what touches pushes, and what sticks is within the cone.

    The points of one body that stick have one cone together.
    """
    closed = _closed(rows, meetings, impulse)
    yield from (normal for _, normal in closed)
    for mine, row in rows.stuck.items():
        own = [(e.kinetic, normal) for e, normal in closed if e.together == mine]
        cone, room = sum(mu * normal for mu, normal in own), 1.0 + sum(mu for mu, _ in own)
        yield from ((cone + way * impulse[row]) / room for way in (1.0, -1.0))


def _grip(rows: _Rows, meetings: Sequence[Meeting], impulse: Array) -> float:
    """The largest Λ_t / Λ_n of what sticks; without limit, where no normal impulse presses it."""
    small, most = ROUNDING * float(np.max(np.abs(impulse), initial=0.0)), 0.0
    closed = _closed(rows, meetings, impulse)
    for mine, row in rows.stuck.items():
        normal = sum(normal for e, normal in closed if e.together == mine)
        if abs(impulse[row]) > small:
            most = max(most, abs(impulse[row]) / normal if normal > small else math.inf)
    return most


def _closed(
    rows: _Rows, meetings: Sequence[Meeting], impulse: Array
) -> list[tuple[Element, float]]:
    """Each element whose normal row holds, and its normal impulse [N s]."""
    pairs = zip(meetings, rows.normals, strict=True)
    return [(m.element, float(impulse[at])) for m, at in pairs if at is not None]


def _speeds(meetings: Sequence[Meeting], states: Sequence[State], v: Array) -> Iterator[float]:
    """Each ≥ 0: what is open rises, and what slides does so the way that friction is against."""
    for meeting, state in zip(meetings, states, strict=True):
        if state == "open":
            yield meeting.normal.rate(v)
        elif (s := sign(state)) and not meeting.element.frictionless:
            yield s * meeting.tangent.rate(v)
