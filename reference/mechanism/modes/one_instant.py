"""Blows at several contacts at one instant: decided where they lead to one velocity in any order.

Newton's law of each contact, v⁺ = −e v⁻, may be asked of all at once or of one after the other.
Rigid bodies do not say which, and most often the velocities differ. They do not where the blow of
one leaves the others as fast as they were, as of a ball that strikes floor and wall. And contacts
that a symmetry exchanges, as the corners of a block that falls flat, have no order: they strike as
one.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations, product

import numpy as np

from ...system import Array
from .blow import ROUNDING, SAME, Condition, Meeting
from .impact import NoImpact, impact

MOST = 4  # contacts: of so many there are 24 orders, and 384 symmetries to ask
LEAST = 100  # blows in one order: two that have not parted by then pile up
ALIKE = 1e-9  # of the largest: what rows and velocities of mirrored contacts leave by rounding


def undivided(
    M: Array, joints: Sequence[Condition], meetings: Sequence[Meeting], v: Array, *, plastic: bool
) -> Array | None:
    """q̇⁺ (n,), if it is the same however the blows follow each other; else None.

    meetings: all that touches; what strikes, or may be struck by another's blow, says so. plastic:
    whether nothing is thrown back.
    """
    struck = [k for k, meeting in enumerate(meetings) if meeting.strikes]
    if len(struck) > MOST:
        return None
    problem = _Problem(M, joints, meetings, plastic)
    groups = problem.groups(struck, v)
    try:
        velocities = [problem.struck(struck, v)]
        velocities += [problem.in_turn(order, v) for order in permutations(groups)]
    except NoImpact:
        return None
    first, *others = velocities
    small = SAME * float(np.max(np.abs(v)))
    alike = all(np.max(np.abs(first - other)) <= small for other in others)
    return first if alike and (len(groups) == len(struck) or problem.stays(first, small)) else None


@dataclass(frozen=True)
class _Problem:
    M: Array
    joints: Sequence[Condition]
    meetings: Sequence[Meeting]
    plastic: bool

    def struck(self, some: Sequence[int], v: Array) -> Array:
        """q̇⁺ of one blow at these of those that strike, by the law of each. Raises NoImpact."""
        small = ROUNDING * float(np.max(np.abs(v)))
        part = []
        for k, meeting in enumerate(self.meetings):
            speed = meeting.normal.rate(v)
            if meeting.strikes and (k not in some or speed > small):
                continue
            e = 0.0 if self.plastic or not meeting.strikes else meeting.element.restitution
            strikes = speed < -small
            after = meeting.normal.g - (e * speed if strikes else 0.0)
            part.append(replace(meeting, after=after, strikes=strikes))
        return impact(self.M, self.joints, part, v)[0].v

    def in_turn(self, groups: Sequence[Sequence[int]], v: Array) -> Array:
        """q̇⁺ once none approaches, the first of the groups that does struck first."""
        for _ in range(LEAST):
            small = ROUNDING * float(np.max(np.abs(v)))
            comes = (g for g in groups if any(self._rate(k, v) < -small for k in g))
            if (group := next(comes, None)) is None:
                return v
            v = self.struck(group, v)
        raise NoImpact("blows go on")

    def _rate(self, k: int, v: Array) -> float:
        return self.meetings[k].normal.rate(v)

    def groups(self, struck: Sequence[int], v: Array) -> list[tuple[int, ...]]:
        """The contacts that strike, in groups that symmetries exchange, if what rests stays so."""
        groups = {k: {k} for k in struck}
        for symmetry in self._symmetries(struck, v):
            for k, other in zip(struck, symmetry, strict=True):
                if groups[k] is not groups[other]:
                    groups[k] |= groups[other]
                    for member in groups[k]:
                        groups[member] = groups[k]
        return sorted({tuple(sorted(group)) for group in groups.values()})

    def stays(self, v: Array, small: float) -> bool:
        """Whether what rests neither opens nor slips, so that it held as joints do."""
        rests = [m for m in self.meetings if not m.strikes]
        return all(abs(row.rate(v)) <= small for m in rests for row in _rows(m))

    def _symmetries(self, struck: Sequence[int], v: Array) -> Iterator[tuple[int, ...]]:
        """Yields which contact takes each one's place, where nothing tells them apart.

        Impulses follow from how each row's moves the others, f M⁻¹ fᵀ, and from their rates; a
        mirror turns slips round.
        """
        n = len(struck)
        moves, rates = self._delassus([self.meetings[k] for k in struck], v)
        size = np.sqrt(np.outer(np.diag(moves), np.diag(moves)))
        fast = float(np.max(np.abs(v)))
        elements = [self.meetings[k].element for k in struck]
        traits = [(e.restitution, e.kinetic, e.frictionless, e.rest, e.slips) for e in elements]
        for order in permutations(range(n)):
            if order == tuple(range(n)) or [traits[k] for k in order] != traits:
                continue
            places = [*order, *(n + k for k in order)]
            for signs in product((1.0, -1.0), repeat=n):
                turned = np.array([*np.ones(n), *signs])
                there = moves[np.ix_(places, places)] * np.outer(turned, turned)
                error = np.max(np.abs(rates[places] * turned - rates), initial=0.0)
                if np.all(np.abs(there - moves) <= ALIKE * size) and error <= ALIKE * fast:
                    yield tuple(struck[k] for k in order)
                    break

    def _delassus(self, struck: Sequence[Meeting], v: Array) -> tuple[Array, Array]:
        """f M⁻¹ fᵀ (2 n, 2 n) of normals and slips beside what holds, and their rates."""
        none = Condition(np.zeros(len(v)), 0.0)
        slips = [none if m.element.frictionless else m.tangent for m in struck]
        rows = [*(m.normal for m in struck), *slips]
        root = np.sqrt(self.M)
        f = np.array([row.f for row in rows]) / root
        rests = [row for m in self.meetings if not m.strikes for row in _rows(m)]
        if held := [*self.joints, *rests]:
            known = np.array([row.f for row in held]) / root
            f = f - f @ np.linalg.pinv(known) @ known
        return f @ f.T, np.array([row.rate(v) for row in rows])


def _rows(rests: Meeting) -> list[Condition]:
    """The rows that hold in a contact that rests: its normal's, and if it rubs its slip's."""
    return [rests.normal] if rests.element.frictionless else [rests.normal, rests.tangent]
