"""Impacts on the floor: velocities that jump while the places stay.

(2.60) integrated over the instant: M (q̇⁺ − q̇⁻) = Λ_b f_aᵇ. Joints and sticking contacts hold, the
floor gives back the part `restitution` of the normal velocity, and friction is an impulse of
Coulomb's law (2.87): within the cone it stops the slip, else it is μ times the normal impulse and
against the slip that is left. (Routh's friction turns where the slip does, within the blow.)

All ways are asked in which the contacts may do that (`blow`), so that nothing depends on their
order. Most often one velocity keeps the laws and creates no energy. Several do where a disk may as
well stay wedged in a groove as roll out of it: then rigid bodies do not say which.
"""

from collections.abc import Sequence

import numpy as np

from ...integrators.budget import tries
from ...system import Array
from .blow import SAME, Blow, Condition, Meeting, blow
from .element import State
from .shared_friction import undecided, ways

GAIN = 1e-9  # of the kinetic energy: more is no rounding


class NoImpact(ArithmeticError):
    """Where Coulomb's law and the restitution have no answer, or one that creates energy."""


class Several(NoImpact):
    """Where Coulomb's law and the restitution have several answers."""


def impact(
    M: Array, joints: Sequence[Condition], meetings: Sequence[Meeting], v: Array
) -> tuple[Blow, tuple[State, ...]]:
    """Returns the blow, and what each of the contacts does after it.

    Raises NoImpact, and Several of them.
    """
    elements, choices = [meeting.element for meeting in meetings], _choices(meetings)
    driven, small = _driven(joints, meetings), SAME * float(np.max(np.abs(v)))
    blows: list[tuple[Blow, tuple[State, ...]]] = []
    gains = False
    for states in tries(ways(elements, choices), undecided(elements, choices)):
        way = blow(M, joints, meetings, v, states)
        if way is None:
            continue
        if M @ way.v**2 > (1 + GAIN) * (M @ v**2) and not driven:
            gains = True
            continue
        # Of the ways to one velocity the first holds the most: what takes no part may also be open.
        same = [
            k
            for k, (known, _) in enumerate(blows)
            if not (way.loose or known.loose) and np.max(np.abs(known.v - way.v)) <= small
        ]
        if not same:
            blows.append((way, states))
        elif blows[same[0]][0].shared and _lets_go(blows[same[0]][1], states):
            blows[same[0]] = way, states
    if not blows:
        raise NoImpact("the impact would create energy" if gains else _impossible(joints, meetings))
    (first, states), *others = blows
    if others or first.loose:
        raise Several(_ambiguous(meetings, [states for _, states in blows]))
    return first, states


def _impossible(joints: Sequence[Condition], meetings: Sequence[Meeting]) -> str:
    """Why there is no impulse, in words."""
    if any(m.element.slip is not None and not m.element.frictionless for m in meetings):
        return "no impulse satisfies the friction law"
    if _driven(joints, meetings):
        return "no impulse stops it: it is driven, and a drive does not give way"
    return "no impulse satisfies it and what holds the bodies"


def _driven(joints: Sequence[Condition], meetings: Sequence[Meeting]) -> bool:
    """Whether something that moves by itself takes part, and may give energy."""
    return any(row.g for row in (*joints, *(meeting.normal for meeting in meetings)))


def _choices(meetings: Sequence[Meeting]) -> Sequence[tuple[State, ...]]:
    """Sticking first; what the blow of another contact throws up may also leave the floor.

    Be it that it rested there, or that it strikes too: a tall block that falls flat on a rough
    floor, as it moves, may be stopped by its leading corner alone.
    """
    sliding: tuple[State, ...] = ("slides +",)
    rests = [sliding if m.element.frictionless else m.element.rest for m in meetings]
    alone = len(meetings) == 1
    return [
        rest if alone and m.strikes else (*rest, "open")
        for m, rest in zip(meetings, rests, strict=True)
    ]


def _lets_go(known: Sequence[State], states: Sequence[State]) -> bool:
    """Whether only ropes and stops take no part here that could have one: they are not pulled."""
    pairs = [(a, b) for a, b in zip(known, states, strict=True) if a != b]
    return all(pair == ("acts", "open") for pair in pairs)


def _ambiguous(meetings: Sequence[Meeting], alternatives: Sequence[Sequence[State]]) -> str:
    """`…: left sticks, right sticks as well as left sticks, right open`."""
    names = [m.element.name for m in meetings]
    each = (
        ", ".join(f"{name} {state}" for name, state in zip(names, states, strict=True))
        for states in alternatives[:2]
    )
    many = ", with any of many velocities" if len(alternatives) == 1 else ""
    return (
        "rigid bodies do not say what the blow does, the law of friction is kept by "
        f"{' as well as '.join(each)}{many}"
    )
