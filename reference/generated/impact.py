"""Impacts on the floor: velocities that jump while the places stay.

(2.60) integrated over the instant: M (q̇⁺ − q̇⁻) = Λ_b f_aᵇ. Joints and sticking contacts hold, the
floor gives back the part `restitution` of the normal velocity, and friction is an impulse of
Coulomb's law (2.87): within the cone it stops the slip, else it is μ times the normal impulse.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..integrators.budget import tries
from ..system import Array
from .element import Element, State, sign
from .sharing import ways

CONE = 1e-12  # of the impulse: an impulse that needs all of the cone sticks
BLOW = 5  # evaluations: of solving for the impulses of a blow (measured 3–6)
ROUNDING = 1e-12  # of the velocities
TURNS = 2  # of refinement, as in a mode: light bodies beside heavy ones
GAIN = 1e-9  # of the kinetic energy: more is no rounding


class NoImpact(ArithmeticError):
    """Where Coulomb's law and the restitution have no answer, or one that creates energy."""


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


def impact(
    M: Array, joints: Sequence[Condition], meetings: Sequence[Meeting], v: Array
) -> tuple[Array, tuple[State, ...]]:
    """q̇⁺ (n,) and what each of the contacts does after it.

    Raises NoImpact.
    """
    elements, choices = [meeting.element for meeting in meetings], _choices(meetings)
    for states in tries(lambda: ways(elements, choices), BLOW, first=True):
        found = _tried(M, joints, meetings, v, states)
        if found is not None:
            if M @ found**2 > (1 + GAIN) * (M @ v**2) and not _driven(joints, meetings):
                raise NoImpact("the impact would create energy")
            return found, states
    raise NoImpact("no impulse satisfies the friction law")


def _driven(joints: Sequence[Condition], meetings: Sequence[Meeting]) -> bool:
    """Whether something that moves by itself takes part, and may give energy."""
    return any(row.g for row in (*joints, *(meeting.normal for meeting in meetings)))


def _choices(meetings: Sequence[Meeting]) -> Sequence[tuple[State, ...]]:
    """Sticking first; what only rests on the floor may also leave it."""
    rests = ((m.element.rest, m.strikes) for m in meetings)
    return [rest if strikes else (*rest, "open") for rest, strikes in rests]


def _tried(
    M: Array,
    joints: Sequence[Condition],
    meetings: Sequence[Meeting],
    v: Array,
    states: tuple[State, ...],
) -> Array | None:
    """q̇⁺ if the contacts do this, or None where that contradicts Coulomb's law."""
    rows: list[Array] = []
    columns: list[Array] = []
    after: list[float] = []
    normals: list[int | None] = []  # where each contact's normal row stands
    stuck: dict[tuple[str, str], int] = {}  # and the row of no slip of what sticks
    for joint in joints:
        rows.append(joint.f)
        columns.append(joint.f)
        after.append(joint.g)
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
            after.append(0.0)
    f, by_mass = np.array(rows), np.array(columns) / M
    v_after, impulse = v, np.zeros(len(f))
    try:
        for _ in range(1 + TURNS):
            more = np.linalg.solve(f @ by_mass.T, np.array(after) - f @ v_after)
            v_after, impulse = v_after + more @ by_mass, impulse + more
    except np.linalg.LinAlgError:
        return None
    small = ROUNDING * float(np.max(np.abs(v)))
    nothing = ROUNDING * float(np.max(np.abs(impulse), initial=0.0))
    for meeting, state, at in zip(meetings, states, normals, strict=True):
        if at is None:
            if meeting.normal.f @ v_after - meeting.normal.g < -small:
                return None
        elif impulse[at] < -nothing or sign(state) * (meeting.tangent.f @ v_after) < -small:
            return None
    return v_after if _held(meetings, normals, stuck, impulse, nothing) else None


def _held(
    meetings: Sequence[Meeting],
    normals: Sequence[int | None],
    stuck: Mapping[tuple[str, str], int],
    impulse: Array,
    nothing: float,
) -> bool:
    """(2.87) for impulses: what sticks is within the cone, the points of one body together.

    A contact that the impact does not concern gets an impulse of rounding, of either sign.
    """
    for mine, row in stuck.items():
        pairs = [(m.element, at) for m, at in zip(meetings, normals, strict=True)]
        cone = sum(
            e.kinetic * impulse[at] for e, at in pairs if at is not None and e.together == mine
        )
        if abs(impulse[row]) > (1 + CONE) * cone + nothing:
            return False
    return True
