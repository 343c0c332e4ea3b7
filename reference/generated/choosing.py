"""Which mode comes next: of all that the elements may do, what agrees with every law."""

import itertools
from collections.abc import Sequence

import numpy as np

from ..system import Array
from .contact import row
from .element import Element, State, sign, sliding
from .mode import SingularPose
from .modes import Modes
from .sharing import one_slip

DEPENDENT = 1e-13  # of the largest of f M⁻¹ fᵀ: its factors fail at some 1e-16
APART = 1e-6  # of γ: what is left out by that is off by its root, 3e-7

After = tuple[str, Array, Array]
"""A mode's name, q and v with which it begins."""
Options = tuple[State, ...]
"""What one element may do, the likeliest first."""


class Undetermined(Exception):
    """A motion that the friction law does not determine, from `time` on."""

    def __init__(self, part: str, what: str, time: float) -> None:
        super().__init__(what)
        self.part, self.time = part, time


def painleve(part: str, which: str, t: float) -> Undetermined:
    """No motion satisfies the law, or two do."""
    what = (
        f"with this friction the motion is not determined: at t = {t:.4g} s {which} "
        "satisfies the law (Painlevé's paradox)"
    )
    return Undetermined(part, what, t)


def closed(element: Element, slip: float) -> Options:
    """What a contact on the floor or a slide may do at this slip [m/s]."""
    if element.only:
        return (element.only,)
    if element.frictionless:
        return ("slides +", *opening(element))
    return (*((sliding(slip),) if slip and element.slips else element.rest), *opening(element))


def opening(element: Element) -> Options:
    """What a contact on the floor may also do: leave it."""
    return () if element.normal is None else ("open",)


def staying(modes: Modes, mode: str) -> list[Options]:
    """What the elements may do that nothing happens to."""
    found: list[Options] = []
    for e, state in zip(modes.elements, modes.states[mode], strict=True):
        opens = opening(e) if state != "open" else ()
        rests = state == "sticks" and not e.only
        found.append((*(e.rest if rests else (state,)), *opens))
    return found


def settled(modes: Modes, choices: Sequence[Options], t: float, q: Array, v: Array) -> After:
    """The mode among the choices in which all forces and motions agree, and its state.

    Raises Undetermined where there is none, or where a contact could as well open as stay, or rub
    one way as the other.
    """
    found: list[tuple[State, ...]] = []
    for states in itertools.product(*choices):
        if not one_slip(modes.elements, states):
            continue
        after = _projected(modes, states, t, q, v)
        try:
            if _agrees(modes, states, choices, t, *after):
                found.append(states)
        except SingularPose as error:
            if not found:  # else one that is likelier needs nothing of it
                raise Undetermined(_blamed(modes, choices), str(error), t) from error
    if not found:
        raise painleve(_blamed(modes, choices), "no motion", t)
    for other in found[1:]:
        for e, one, two in zip(modes.elements, found[0], other, strict=True):
            if (one == "open") != (two == "open") and not _grazes(modes, e, found[0], t, q, v):
                raise painleve(e.name, f"both staying on and leaving the {e.plane}", t)
            if sign(one) * sign(two) < 0:  # at rest, held by the others whichever way it rubs
                raise Undetermined(e.name, str(SingularPose(e.name)), t)
    return modes.name(found[0]), *_projected(modes, found[0], t, q, v)


def _agrees(
    modes: Modes,
    states: tuple[State, ...],
    choices: Sequence[Options],
    t: float,
    q: Array,
    v: Array,
) -> bool:
    """Whether the forces are within the laws, and what may move moves the way it should.

    Raises SingularPose where the forces are not determined.
    """
    mode, small = modes.name(states), modes.small(t, q, v)
    try:
        forces = modes.forces(mode, t, q, v)
    except SingularPose:
        if _contradicts(modes, mode, t, q, v):
            return False
        raise
    for e, state, choice in zip(modes.elements, states, choices, strict=True):
        if e.normal is not None:
            if state == "open":
                if len(choice) > 1 and modes.change(e.normal, mode, t, q, v) < -small:
                    return False
                continue
            if forces[e.push] < -small * float(np.max(modes.M)):
                return False
        if state == "sticks" and e.slips and min(e.margins(forces)) < 0.0:
            return False
        s = sign(state) if "sticks" in choice else 0
        if s and s * modes.change(e.tangent, mode, t, q, v) < -small:
            return False
    return True


def _contradicts(modes: Modes, mode: str, t: float, q: Array, v: Array) -> bool:
    """Whether of f_a q̈ᵃ = γ rows that depend on each other ask for different accelerations.

    At a dead centre a rocker turns back: the others turn it, so that it cannot stick there. Of what
    rests they ask the same, and do not say who holds it.
    """
    f, _, gamma = modes[mode].rows(t, q, v)
    left = gamma - f @ _nearest(modes.M, f, gamma, dependent=DEPENDENT)
    return bool(np.max(np.abs(left)) > APART * np.max(np.abs(gamma)))


def _grazes(
    modes: Modes, e: Element, states: tuple[State, ...], t: float, q: Array, v: Array
) -> bool:
    """Whether the floor neither pushes nor is left: both answers are the same motion."""
    forces = modes.forces(modes.name(states), t, q, v)
    return abs(forces[e.push]) <= modes.small(t, q, v) * float(np.max(modes.M))


def _projected(
    modes: Modes, states: tuple[State, ...], t: float, q: Array, v: Array
) -> tuple[Array, Array]:
    """The nearest q (in M) on the floor and v that meets the rows: what sticks is at rest."""
    mode = modes[modes.name(states)]
    pairs = zip(modes.elements, states, strict=True)
    closed = [e.normal for e, s in pairs if e.normal is not None and s != "open"]
    if closed:
        gaps = np.concatenate([modes.base.f(t, q), [p.f(t, q.tolist())[0] for p in closed]])
        f = np.vstack([modes.base.f_a(t, q), *(row(p, t, q, v)[0] for p in closed)])
        if len(gaps) == len(f):  # rolling is known as a rate only
            q = placed(modes.M, f, gaps, q)
    f, g = mode.f_a(t, q), mode.g(t, q)
    return q, v - _nearest(modes.M, f, f @ v - g) if len(f) else v


def placed(M: Array, f: Array, gaps: Array, q: Array) -> Array:
    """The nearest q (in M) without the gaps; inner states, behind the coordinates, stay."""
    n = len(M)
    return np.append(q[:n] - _nearest(M, f, gaps), q[n:])


def _nearest(M: Array, f: Array, residual: Array, *, dependent: float | None = None) -> Array:
    by_mass = f / M
    return by_mass.T @ np.linalg.lstsq(f @ by_mass.T, residual, rcond=dependent)[0]


def _blamed(modes: Modes, choices: Sequence[Options]) -> str:
    """The element to blame: the first that is not simply open."""
    pairs = zip(modes.elements, choices, strict=True)
    return next((e.name for e, c in pairs if c != ("open",)), modes.elements[0].name)
