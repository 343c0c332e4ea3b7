"""Which mode comes next: of all that the elements may do, what agrees with every law."""

from collections.abc import Sequence

import numpy as np

from ...system import Array
from ..constraints.constraint import row
from ..constraints.leeway import FITS
from .element import Element, State, sign, sliding
from .loose import DEPENDENT, rank
from .mode import SingularPose
from .modes import Modes
from .possible_ways import Options, possible_ways

STILL = 1e-12  # of the largest velocity: what a projection or an assembly leaves of a zero rate
YIELDS = 1e-8  # of the forces: where events are located a margin is 0 to some 1e-10 of them

After = tuple[str, Array, Array]
"""A mode's name, q and v with which it begins."""


class Undetermined(Exception):
    """A motion that the friction law does not determine, from `time` on."""

    def __init__(self, part: str, what: str, time: float) -> None:
        super().__init__(what)
        self.part, self.time = part, time


def painleve(elements: Sequence[Element], part: str, which: str, t: float) -> Undetermined:
    """The error where no motion satisfies the law, or two do."""
    what = (
        f"with this friction the motion is not determined: at t = {t:.4g} s {which} "
        "satisfies the law (Painlevé's paradox)"
    )
    if all(e.frictionless or not e.slips or e.slip is None for e in elements):  # ropes, stops
        what = f"the motion is not determined: at t = {t:.4g} s {which} satisfies the law"
    return Undetermined(part, what, t)


def closed(element: Element, slip: float) -> Options:
    """States that a contact on the floor or a slide may take at this slip [m/s]."""
    if element.only:
        return (element.only,)
    if element.frictionless:
        return ("slides +", *opening(element))
    return (*((sliding(slip),) if slip and element.slips else element.rest), *opening(element))


def opening(element: Element) -> Options:
    """The state to which a contact on the floor may also change: open; none of other elements."""
    return () if element.normal is None else ("open",)


def staying(modes: Modes, mode: str) -> list[Options]:
    """For each element without an event: the states it may take next."""
    options: list[Options] = []
    for e, state in zip(modes.elements, modes.states[mode], strict=True):
        opens = opening(e) if state != "open" else ()
        rests = state == "sticks" and not e.only
        options.append((*(e.rest if rests else (state,)), *opens))
    return options


def yielding(
    modes: Modes, mode: str, choices: Sequence[Options], t: float, q: Array, v: Array
) -> list[Options]:
    """The choices where the last forces that hold a mode are gone: all that is at its bound slips.

    Of forces that are not determined those that hold are at several bounds at once.
    """
    forces, options = modes.forces(mode, t, q, v), list(choices)
    size = YIELDS * max(map(abs, forces.values()), default=0.0)
    for i, (e, state) in enumerate(zip(modes.elements, modes.states[mode], strict=True)):
        if state == "sticks" and e.slips and len(options[i]) > 1:
            forward, backward = e.margins(forces)
            if min(forward, backward) <= size:
                options[i] = (sliding(backward - forward), *opening(e))
    return options


def settled(
    modes: Modes,
    choices: Sequence[Options],
    t: float,
    q: Array,
    v: Array,
) -> After:
    """The mode among the choices in which all forces and motions agree, and its state.

    Raises Undetermined where there is none, or where a contact could as well open as stay, or rub
    one way as the other.
    """
    likeliest = _projected(modes, tuple(choice[0] for choice in choices), t, q, v)
    rests = _rests(modes, choices, t, *likeliest)
    candidates: list[After] = [likeliest] if rests else []
    singular: SingularPose | None = None
    for states in possible_ways(modes, likeliest, choices, t, rests=rests):
        after = _projected(modes, states, t, q, v)
        try:
            if candidates and modes.loose(candidates[0][0]) and modes.loose(after[0]):
                continue
            if _agrees(modes, choices, t, *after):
                candidates.append(after)
        except SingularPose as error:
            singular = singular or error  # one that agrees needs nothing of it
    if not candidates and singular:
        raise Undetermined(_culprit(modes, choices), str(singular), t) from singular
    if not candidates:
        raise painleve(modes.elements, _culprit(modes, choices), "no motion", t)
    first, *others = candidates
    for other in others:
        pairs = (modes.states[mode] for mode, _, _ in (first, other))
        for e, a, b in zip(modes.elements, *pairs, strict=True):
            if (a == "open") != (b == "open") and not _alike(modes, first, other, t):
                raise painleve(
                    modes.elements, e.name, f"both staying on and leaving the {e.plane}", t
                )
            # At rest, held by the others whichever way it rubs; where nothing presses, it does not.
            if sign(a) * sign(b) < 0 and not _exert_alike(modes, first, other, t):
                raise Undetermined(e.name, str(SingularPose(e.name)), t)
    return first


def _rests(
    modes: Modes, choices: Sequence[Options], t: float, mode: str, q: Array, v: Array
) -> bool:
    """Whether nothing moves in a mode, nor is about to, and its forces are within the laws."""
    _, g, gamma = modes[mode].rows(t, q, v)
    if np.max(np.abs(np.append(v, g))) > modes.still(t, q, v, part=STILL):
        return False
    try:
        changes = np.append(modes[mode].accelerations(t, q, v), gamma)
        still = np.max(np.abs(changes)) <= modes.small(t, q, v)
        return bool(still) and _agrees(modes, choices, t, mode, q, v)
    except SingularPose:
        return False


def _agrees(
    modes: Modes, choices: Sequence[Options], t: float, mode: str, q: Array, v: Array
) -> bool:
    """Whether the forces are within the laws, and what may move moves the way it should.

    Raises SingularPose where the forces are not determined, and the motion neither.
    """
    small, loose = modes.small(t, q, v), modes.loose(mode)
    if modes.contradicts(mode, t, q, v):
        return False
    forces = modes.forces(mode, t, q, v)
    tolerance = FITS * max(map(abs, forces.values()), default=0.0) if loose else 0.0
    for e, state, choice in zip(modes.elements, modes.states[mode], choices, strict=True):
        if e.normal is not None:
            if state == "open":
                if len(choice) > 1 and modes.change(e.normal, mode, t, q, v) < -small:
                    return False
                continue
            if forces[e.push] < -small * float(np.max(modes.M)):
                return False
        if state == "sticks" and e.slips and min(e.margins(forces)) < -tolerance:
            return False
        s = sign(state) if "sticks" in choice else 0
        if s and s * modes.change(e.tangent, mode, t, q, v) < -small:
            return False
    return True


def _exert_alike(modes: Modes, first: After, second: After, t: float) -> bool:
    """Whether both answers are the same motion, by the same forces."""
    a, b = (modes.forces(mode, t, q, v) for mode, q, v in (first, second))
    room = modes.small(t, *first[1:]) * float(np.max(modes.M))
    return _alike(modes, first, second, t) and all(abs(a[name] - b[name]) <= room for name in a)


def _alike(modes: Modes, first: After, second: After, t: float) -> bool:
    """Whether both answers are the same motion: the floor neither pushes nor is left."""
    a, b = (modes[mode].accelerations(t, q, v) for mode, q, v in (first, second))
    return bool(np.max(np.abs(a - b)) <= modes.small(t, *first[1:]))


def _projected(modes: Modes, states: tuple[State, ...], t: float, q: Array, v: Array) -> After:
    """The mode, the nearest q (in M) on the floor and v that meets the rows: what sticks rests."""
    mode = modes[modes.name(states)]
    pairs = zip(modes.elements, states, strict=True)
    closed = [e.normal for e, s in pairs if e.normal is not None and s != "open"]
    if closed:
        gaps = np.concatenate([modes.base.f(t, q), [p.f(t, q.tolist())[0] for p in closed]])
        f = np.vstack([modes.base.f_a(t, q), *(row(p, t, q, v)[0] for p in closed)])
        if len(gaps) == len(f):  # rolling is known as a rate only
            q = placed(modes.M, f, gaps, q)
    f, g = mode.f_a(t, q), mode.g(t, q)
    v = v - _nearest(modes.M, f, f @ v - g) if len(f) else v
    return modes.named(states, t, q, v), q, v


def placed(M: Array, f: Array, gaps: Array, q: Array) -> Array:
    """The nearest q (in M) without the gaps; inner states, behind the coordinates, stay."""
    n = len(M)
    return np.append(q[:n] - _nearest(M, f, gaps), q[n:])


def _nearest(M: Array, f: Array, residual: Array) -> Array:
    """The smallest change (n,), in M, with f · change = residual; rows may depend on each other."""
    root = np.sqrt(M)
    sizes = np.linalg.norm(f / root, axis=1)
    sizes = np.where(sizes > 0.0, sizes, 1.0)
    rows = f / root / sizes[:, None]
    if rank(rows) < len(rows):
        return np.linalg.lstsq(rows, residual / sizes, rcond=DEPENDENT)[0] / root
    by_mass = f / M  # what comes to rest along a line does so exactly
    return by_mass.T @ np.linalg.lstsq(f @ by_mass.T, residual, rcond=None)[0]


def _culprit(modes: Modes, choices: Sequence[Options]) -> str:
    """The element to blame: the first that is not simply open."""
    pairs = zip(modes.elements, choices, strict=True)
    return next((e.name for e, c in pairs if c != ("open",)), modes.elements[0].name)
