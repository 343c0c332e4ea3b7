"""When the events of a case happen: one reading of the reference, one of every engine.

The reference knows its phases, and an event is the boundary of two. An engine only has steps, and
it creeps: it never rests. So no threshold is a time here; a threshold only tells what is near.
What steps of a size can tell of the reference's own events, their reading of it says.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ....cases.case import Case, Event
from ....cases.mistake import Mistake
from ....cases.scene import Limit, Scene
from ....cases.scene.observe import observe
from ....cases.scene.passages import AROUND, passing, still
from ....cases.scene.passages import pieces as smooth_pieces
from ....cases.scene.quantity import at_event, table
from ....cases.trajectory import Array, Trajectory
from .rests import LOW, SHARES, STEPS, Rest, rests

CLOSE = 1e-6  # of the largest step of a march: rows as close are one
WHOLE = 1e-9  # steps: a ratio that is whole up to rounding
CURVE = 4  # steps in the curve that what falls is continued by: as good as an engine of order 4
SMALL = 1e-4  # of the largest value: a hump as low as this may be rounding or a soft floor
SURE = 2  # times an engine's steps: what they tell of the reference no engine near it can miss
FLAT = 8  # times what a line needs to zero: what comes there by its eighth power takes as long
AT_ONCE = 1e3  # times what is zero, in one step: no law of an engine's damps as fast
BESIDE = 0.1  # of the last distance of a pile: an event and one of the pile that are the same
TREMBLE = 1e-6  # steps: two zeros of a curve that touch are not rounding's to lose


def reference_events(scene: Scene, record: Trajectory, event: Event) -> Array:
    """Times (K,) [s] of the event, from the smooth pieces of the reference.

    One ends with a phase, or where a law jumps or bends: there what moves may begin or end to rest.
    """
    pieces, small = _pieces(scene, record, event)
    times = [before.end for before, after in pairwise(pieces) if _happens(event, before, after)]
    for piece in pieces if event.crosses else ():
        times += [t for t, curve in passing(piece.times, piece.u, small) if curve]
    return np.array(sorted(times), float)


@dataclass(frozen=True)
class _Piece:
    """A smooth piece of the record, as an event sees it.

    named: whether the mechanism says that its quantity comes to its value at the end. comes, goes:
    the last value before it comes to zero there, whose sign is its side, and the first that is not
    zero; 0 without one. fades: whether it counts as zero at the end, and has only decayed. within:
    whether its phase goes on at the end, a corner of a law.
    """

    times: Array
    u: Array
    named: bool
    comes: float
    goes: float
    fades: bool
    within: bool

    @property
    def end(self) -> float:
        """Its last instant [s]."""
        return float(self.times[-1])

    @property
    def moves(self) -> bool:
        """Whether its quantity leaves zero: a hop may be smaller than what counts."""
        return self.named or self.goes != 0.0


def _pieces(scene: Scene, record: Trajectory, event: Event) -> tuple[list[_Piece], float]:
    """Each piece of u, which falls to zero at the event, and the size that counts as zero."""
    names, pieces = _names(scene, event), list[_Piece]()
    u = event.falling(observe(scene, record, event.quantity))
    small = still(scene, record, event.quantity)
    parts = [*smooth_pieces(record, u, scene.corners())]
    numbers = [*(number for number, *_ in parts[1:]), len(record.ended)]
    for (number, times, values), then in zip(parts, numbers, strict=True):
        named = any(name in names for name in record.ended[number:then])
        clear = np.flatnonzero(np.abs(values) > small)
        last = int(clear[-1] if len(clear) else np.argmax(np.abs(values)))
        ends = len(clear) > 0 and last < len(values) - 1
        fades = not named and ends and _decays(times[last:], values[last:])
        comes = float(values[last]) if named or (ends and not fades) else 0.0
        goes = float(values[clear[0]]) if len(clear) else 0.0
        pieces.append(_Piece(times, values, named, comes, goes, fades, number == then))
    return pieces, small


def _decays(times: Array, u: Array) -> bool:
    """Whether u (N,), small from its second row on, has had far more time than it needs to zero."""
    needed = (times[1] - times[0]) * u[0] / (u[0] - u[1])
    return bool(times[-1] - times[0] > FLAT * needed)


_WORDS = {
    "gap": ("lands", "tightens"),
    "slip": ("stops",),
    "normal": ("opens",),
    "force": ("slackens",),
}
"""By a field, the mechanism's words for what happens where it falls to zero."""


def _names(scene: Scene, event: Event) -> set[str]:
    """The mechanism's names for what ends a phase where the event's quantity comes to its value.

    They say that it does, and not from which side: a slip, or a spring's force, has two.
    """
    part, _, field = event.quantity.rpartition(".")
    names = set[str]()
    if event.value == 0.0:
        names = {f"{part} {word}" for word in _WORDS.get(field, ())}
    limit = scene.forces.get(part)
    if isinstance(limit, Limit):
        if field in limit.sides and event.value == 0.0:
            names.add(f"{part}.{field} leaves")
        for side, (_, at) in limit.sides.items():
            if field == limit.measured and at == event.value:
                names |= {f"{part} tightens", f"{part}.{side} strikes"}
    return names


def _happens(event: Event, before: _Piece, after: _Piece) -> bool:
    """Whether the event is where one piece ends and the next begins."""
    if event.crosses:
        return before.comes > 0.0 and not (before.within and after.goes > 0.0)
    if event.rule == "stays zero":
        return before.moves and not before.fades and not after.moves
    return not before.moves and after.moves


@dataclass(frozen=True)
class Known:
    """The reference's side of an event, by which an engine's is read.

    share: as `reading` says. happened, jumps: when [s] it happens, and when its quantity jumps
    across the value, as `jumped` says.
    """

    share: float = 0.0
    happened: tuple[float, ...] | None = None
    jumps: tuple[float, ...] = ()


def jumped(scene: Scene, record: Trajectory, event: Event) -> Array:
    """When [s] the event's quantity jumps down across its value, which is no such event.

    As a velocity does in an impact, or a force that is switched off: an engine takes a step or
    more for it, in which it passes the value.
    """
    pieces, small = _pieces(scene, record, event)
    times = [
        before.end
        for before, after in pairwise(pieces if event.crosses else ())
        if before.u[-1] > small >= after.u[0] and not _happens(event, before, after)
    ]
    return np.array(times, float)


def engine_events(
    scene: Scene, record: Trajectory, event: Event, known: Known | None = None
) -> Array:
    """Times (K,) [s] of the event, from every step of an engine.

    An engine that creeps or trembles above the known share is read by the least larger one with
    which the event happens as often as in the reference. Raises KeyError where the record does not
    hold the quantity.
    """
    known = known or Known()
    times, u = record.times, event.falling(observe(scene, record, event.quantity))
    small = still(scene, record, event.quantity)
    shares = known.share, *(share for share in reversed(SHARES) if share > known.share > 0.0)
    readings = (_read(times, u, event, replace(known, share=share), small) for share in shares)
    first = next(readings)
    if known.happened is None or len(first) == len(known.happened):
        return first
    return next((other for other in readings if len(other) == len(known.happened)), first)


def _read(times: Array, u: Array, event: Event, known: Known, small: float) -> Array:
    """Times (K,) [s] of the event, from u (N,) at steps; small: as `falls` says."""
    ends = rests(times, u, known.share or LOW) if known.share or not event.crosses else []
    if event.crosses:
        return _without_jumps(_falls_and_stops(times, u, ends, small), known)
    sides = (start if event.rule == "leaves zero" else stop for stop, start in ends)
    return np.array([t for t in sides if t is not None], float)


def _without_jumps(times: Array, known: Known) -> Array:
    """The times without the nearest to each jump of the reference, if no event of it is nearer."""
    for jump in known.jumps if len(times) else ():
        nearest_to_it = int(np.argmin(np.abs(times - jump)))
        others = np.abs(np.array(known.happened or (np.inf,)) - times[nearest_to_it])
        if abs(times[nearest_to_it] - jump) < np.min(others):
            times = np.delete(times, nearest_to_it)
    return times


def _falls_and_stops(times: Array, u: Array, ends: Sequence[Rest], small: float) -> Array:
    """When u (N,) falls to zero, also where it rests there: what it then is only trembles.

    A rate that friction stops is 1e-5 of itself, then 1e-10, and somewhen of the other sign.
    """
    at_rest = np.zeros(len(u), bool)
    for stop, start in ends:
        begin, end = times[0] if stop is None else stop, times[-1] if start is None else start
        at_rest |= (begin <= times) & (times <= end)
    fallen = falls(times, np.where(at_rest, 0.0, u), small)
    for stop in (stop for stop, _ in ends if stop is not None):
        fallen[np.abs(fallen - stop) <= STEPS * (times[1] - times[0])] = stop
    return np.unique(fallen)


def reading(scene: Scene, record: Trajectory, event: Event, happened: Array, step: float) -> Known:
    """How an engine's steps so large [s] are read, given when the event happens in the reference.

    The share is the largest with which they tell each of the reference's own events within a step;
    2 % where none does. It is 0 where nothing rests, or none of them reads what also falls to zero:
    what only decays to zero does not fall to it.
    """
    jumps = jumped(scene, record, event).tolist()
    known = Known(0.0, (*happened.tolist(),), (*jumps,))
    if event.crosses and not _comes_to_rest(scene, record, event):
        return known
    times, u = _at_steps(scene, record, event, step)
    small = still(scene, record, event.quantity)
    for share in SHARES:
        read = _read(times, u, event, replace(known, share=share), small)
        if len(read) == len(happened) and np.all(np.abs(read - happened) <= step):
            return replace(known, share=share)
    return known if event.crosses else replace(known, share=LOW)


def _comes_to_rest(scene: Scene, record: Trajectory, event: Event) -> bool:
    """Whether a rate falls to zero in the reference and stays there."""
    if table(scene)[event.quantity].unit not in ("m/s", "rad/s"):
        return False
    pieces, _ = _pieces(scene, record, event)
    return any(before.comes > 0.0 and not after.moves for before, after in pairwise(pieces))


def _at_steps(scene: Scene, record: Trajectory, event: Event, step: float) -> tuple[Array, Array]:
    """Times (N,) of steps so large [s], and the reference's u (N,) there, by splines."""
    from scipy.interpolate import make_interp_spline

    begin, end = float(record.times[0]), float(record.times[-1])
    count = int((end - begin) / step + WHOLE)
    times = np.minimum(begin + step * np.arange(count + 1, dtype=np.float64), end)
    u = np.zeros_like(times)
    for piece in _pieces(scene, record, event)[0]:
        at = piece.times
        inside = slice(*np.searchsorted(times, [at[0], np.nextafter(at[-1], np.inf)]).tolist())
        # An event on a sample leaves rows that are an ulp apart: no curve goes through both.
        apart = np.append(True, np.diff(at) > CLOSE * np.max(np.diff(at)))
        at, values = at[apart], piece.u[apart]
        odd = min(AROUND, len(at)) // 2 * 2 - 1
        u[inside] = make_interp_spline(at, values, k=odd)(times[inside])
    return times, u


def falls(times: Array, u: Array, small: float = 0.0) -> Array:
    """When u (N,) falls to zero: where it changes its sign, or comes to zero and turns back.

    An impact may turn u back before any step sees it at zero: then it is the zero of what went
    before, if that has one within the next step, and u then rises or is zero, up to `small`. What
    rests on zero trembles around it, so u has to come off between two falls, as `_off` says.
    """
    now, after = u[:-1], u[1:]
    before, then = np.append(-np.inf, u[:-2]), np.append(u[2:], np.inf)
    through = (now > 0) & (after <= 0)
    turned = (after <= small) | ((2 * now <= before) & (then > after))
    turned &= (now > small) & (after > 0)
    largest, last = float(np.max(np.abs(u))), 0
    zeros: list[float] = []
    for i in np.flatnonzero(through | turned).tolist():
        zero = _of_curve(times, u, i)
        if zero is None and through[i]:
            zero = float(times[i] + (times[i + 1] - times[i]) * u[i] / (u[i] - u[i + 1]))
        if zero is not None:
            zeros += [zero] if _off(u[last : i + 1], largest) else []
            last = i + 1
    return np.array(zeros, float)


def _off(u: Array, largest: float) -> bool:
    """Whether u exceeds 2 % of the largest value, or for six steps 1e-4 of it: a small bounce."""
    return bool(np.any(u > LOW * largest)) or int(np.sum(u > SMALL * largest)) >= STEPS


def certain_events(
    scene: Scene, record: Trajectory, event: Event, known: Known, step: float
) -> NDArray[np.int64]:
    """Which of the reference's events steps of this size [s] tell for sure.

    Those which are read from the reference itself at such steps, of what passes at twice as large:
    a ball that comes to rest bounces ever lower, and what lasts a few steps may be seen in an
    engine's motion or not.
    """
    happened = np.array(known.happened or ())
    if not len(happened):
        return np.arange(0)
    times, u = _at_steps(scene, record, event, step * (SURE if event.crosses else 1))
    small = still(scene, record, event.quantity)
    times_read = _read(times, u, event, known, small)[: len(happened)]
    partners = nearest(times_read, happened)
    return partners[np.abs(times_read - happened[partners]) <= STEPS * step]


def nearest(times: Array, wanted: Array) -> NDArray[np.int64]:
    """For each of some times (n,) its partner among the wanted (K ≥ n,), in order.

    All of them together are as near as can be.
    """
    from scipy.optimize import linear_sum_assignment

    _, partners = linear_sum_assignment(np.abs(times[:, None] - wanted))
    return np.sort(partners)


def _of_curve(times: Array, u: Array, i: int) -> float | None:
    """The first zero after step i and within the next, of the curve through the steps up to it.

    What happens then, as an impact or the end of a force, spoils a curve to the steps behind, and
    already the line to the next.
    """
    if i < CURVE - 1:
        return None
    h = float(times[i + 1] - times[i])
    rows = slice(i - CURVE + 1, i + 1)
    roots = np.roots(np.polyfit((times[rows] - times[i]) / h, u[rows], CURVE - 1))
    zeros = np.real(roots[np.abs(np.imag(roots)) < TREMBLE])
    inside = zeros[(zeros > 0.0) & (zeros <= 1.0 + TREMBLE)]
    return float(times[i]) + h * float(np.min(inside)) if len(inside) else None


def unreached(case: Case, reference: Trajectory) -> list[Mistake]:
    """A mistake for every event that the reference does not know.

    A contact that starts above the floor may be named and not land in time: that no engine lets it
    land earlier is a claim too, and only a bound on its time, or on what is then, compares nothing.
    """
    mistakes: list[Mistake] = []
    for name, event in case.events.items():
        assert reference.record is not None  # of a case with events
        if len(reference_events(case.scene, reference.record, event)):
            continue
        places: list[tuple[str, ...]] = [("events", name)]
        if _lands_later(case.scene, reference, event):
            bounds = (b for b in case.allow if b == f"{name}.time" or at_event(b, (name,)))
            places = [("allow", bound) for bound in bounds]
        what = f"never happens in {case.duration:g} s: nothing is compared"
        mistakes += [case.mistake(place, what) for place in places]
    return mistakes


def limit_of(case: Case, reference: Trajectory, event: Event) -> float | None:
    """The time [s] before which the event happens without end; None if it does not.

    It is what piles up, or happens between what does, as apexes between bounces. Where it is not
    seen up to the last of a pile, it is known by this: all that follows is too small to be seen.
    What stays zero does not happen without end.
    """
    record = reference.record
    if record is None or not event.crosses:
        return None
    u = event.falling(observe(case.scene, record, event.quantity))
    small = still(case.scene, record, event.quantity)
    times, named = reference_events(case.scene, record, event), _names(case.scene, event)
    for pile in reference.endless:
        beside = BESIDE * float(pile[-1] - pile[-2])
        mine = times[(times >= pile[0] - beside) & (times <= pile[-1] + beside)]
        if not len(mine):
            continue
        then = pile[pile >= mine[-1] - beside][0]
        after = u[(record.times > then + beside) & (record.times < pile[-1])]
        unseen = not named and len(mine) > 1 and bool(np.all(np.abs(after) <= small))
        if unseen or mine[-1] > pile[-2] + beside:
            return float(pile[-1])
    return None


def below_resolution(case: Case, reference: Trajectory, event: Event) -> float | None:
    """The first time [s] at which it ends a hop that is too small to be seen; None without one."""
    if reference.record is None or not event.crosses:
        return None
    pieces, _ = _pieces(case.scene, reference.record, event)
    return next((piece.end for piece in pieces if piece.named and not piece.goes), None)


def tangential(case: Case, record: Trajectory) -> Iterator[Mistake]:
    """A mistake for every event of which rounding says whether it happens."""
    for name, event in case.events.items():
        pieces, small = _pieces(case.scene, record, event)
        came = pieces[-1].comes
        if {"stays zero": abs(came), "leaves zero": 0.0}.get(event.rule, came) > AT_ONCE * small:
            what = (
                f"comes at the last instant, {case.duration:g} s: whether it still happens is "
                "rounding; take another duration"
            )
            yield case.mistake(("events", name), what)
        for t in _touches(pieces, small) if event.crosses else ():
            what = (
                f"{event.quantity} comes to {event.value:g} at t = {t:.6g} s and turns back, "
                f"within {small:.1e}: whether it gets there is rounding; give another value"
            )
            yield case.mistake(("events", name), what)


def _touches(pieces: Sequence[_Piece], small: float) -> Iterator[float]:
    """Times [s] at which u comes to zero in a phase and turns back."""
    for piece in pieces:
        yield from (t for t, curve in passing(piece.times, piece.u, small) if curve is None)
    for before, after in pairwise(pieces):
        if before.within and before.comes * after.goes > 0.0:
            yield before.end


def _lands_later(scene: Scene, reference: Trajectory, event: Event) -> bool:
    part, _, field = event.quantity.rpartition(".")
    touches = part in (*scene.contacts, *scene.pairs)
    above = touches and field == "gap" and event.rule == "falls to zero"
    return above and bool(np.all(observe(scene, reference, event.quantity) > 0.0))
