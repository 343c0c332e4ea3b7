"""Joint coordinates in space, from the attitudes of both parts: shifts, then up to three turns."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..trajectory import Array
from .rotation import UPRIGHT, Vector3, inverse, product, turned

ROUNDING = 3 * float(np.finfo(float).eps)  # of three numbers each


def orthonormal(vectors: Sequence[Sequence[float]]) -> list[Array]:
    """Orthonormal vectors with the same span, by Gram and Schmidt."""
    basis: list[Array] = []
    for vector in vectors:
        rest = np.asarray(vector, dtype=float)
        for unit in basis:
            rest = rest - (rest @ unit) * unit
        basis.append(rest / np.linalg.norm(rest))
    return basis


def orthogonal_complement(vectors: Sequence[Sequence[float]]) -> list[Array]:
    """Orthonormal basis of the orthogonal complement of the given vectors."""
    basis = orthonormal(vectors)
    complement: list[Array] = []
    for _ in range(3 - len(basis)):
        rests = [e - sum((e @ u) * u for u in (*basis, *complement)) for e in np.eye(3)]
        best = max(rests, key=lambda rest: float(rest @ rest))
        complement.append(best / np.linalg.norm(best))
    return complement


def shift_coordinates(
    axes: Sequence[Vector3], d: Array, d_dot: Array, q: Array, omega: Array
) -> tuple[Array, Array]:
    """(N, K) each: how far a point is along axes of the first part, and how fast.

    d, d_dot (N, 3): from the first point to the second, in ground axes; q, omega: of the first.
    """
    if not axes:
        return np.zeros((len(d), 0)), np.zeros((len(d), 0))
    back = inverse(q)
    local = turned(back, d)
    rate = turned(back, d_dot) - np.cross(omega, local)
    solve = np.linalg.pinv(np.array(axes, dtype=float).T)
    return local @ solve.T, rate @ solve.T


@dataclass(frozen=True)
class Turns:
    """(N, K) each: the angles [rad] of successive turns, but for whole turns, and their rates.

    free (N,): of three turns the volume of their axes, 0 at gimbal lock, else 1. aside (N,): how
    fast [rad/s] three turns pass gimbal lock beside it, the first one's rate times free. missed
    (N,): how far the cosine of the middle turn is beyond ±1, where three about skew axes
    cannot make the attitude.
    """

    angles: Array
    rates: Array
    free: Array
    aside: Array = field(default_factory=lambda: np.zeros(1))
    missed: Array = field(default_factory=lambda: np.zeros(1))

    def near(self, expected: Array) -> Array:
        """(N, K) the angles, with the whole turns that bring them nearest to what is expected."""
        return self.angles + math.tau * np.round((expected - self.angles) / math.tau)


def turn_solutions(
    axes: Sequence[Vector3], q_a: Array, omega_a: Array, q_b: Array, omega_b: Array
) -> list[Turns]:
    """The ways in which up to three successive turns make the attitude of b against a: one or two.

    Each axis stands in the axes that the turns before it leave. Three turns make an attitude in two
    ways, which meet at gimbal lock; first the one whose middle turn is nearer to zero.
    """
    n = len(q_a)
    if not axes:
        return [Turns(np.zeros((n, 0)), np.zeros((n, 0)), np.ones(n))]
    between = product(inverse(q_a), q_b)
    relative = turned(between, omega_b) - omega_a  # ω of b against a, in the axes of a
    own = [np.asarray(axis, dtype=float) for axis in axes]
    missed = np.maximum(np.abs(_cosine(own, between)) - 1.0, 0.0) if len(own) > 2 else np.zeros(n)
    return [_turns(own, angles, relative, missed) for angles in _angles(own, between)]


def _turns(axes: Sequence[Array], angles: Array, relative: Array, missed: Array) -> Turns:
    """With θ̇ of ω = Σ θ̇ n, each axis n as the turns before it leave it."""
    columns, so_far = [], np.tile(UPRIGHT, (len(angles), 1))
    for axis, angle in zip(axes, angles.T, strict=True):
        columns.append(turned(so_far, axis))
        so_far = product(so_far, _turn(axis, angle))
    # At gimbal lock the least rates of all: two axes are one there, but for rounding.
    n = np.stack(columns, axis=-1)
    rates = (np.linalg.pinv(n, rcond=ROUNDING) @ relative[:, :, None])[:, :, 0]
    free = np.abs(np.linalg.det(n)) if len(axes) == n.shape[1] else np.ones(len(angles))
    return Turns(angles, rates, free, np.abs(rates[:, 0]) * free, missed)


def _angles(axes: Sequence[Array], between: Array) -> list[Array]:
    """(N, K) of one, two or three turns that make the quaternion between the parts, in all ways."""
    if len(axes) == 1:
        return [twist(between, axes[0])[:, None]]
    if len(axes) == 2:
        # Only the first turn moves the second axis, and only the second what is held in b.
        first = _swing(axes[0], axes[1], turned(between, axes[1]))
        rest = product(_turn(axes[0], -first), between)
        return [np.column_stack([first, twist(rest, axes[1])])]
    return _three(axes, between)


def _three(axes: Sequence[Array], between: Array) -> list[Array]:
    """The middle turn from how the last axis stands to the first; then as with two."""
    a, b, c = axes
    last = turned(between, c)  # the third axis, in the axes of the first part
    phase = math.atan2(a @ np.cross(b, c), a @ c - (a @ b) * (b @ c))
    beta = np.arccos(np.clip(_cosine(axes, between), -1.0, 1.0))
    solutions = []
    for middle in (phase + beta, phase - beta):
        middle = np.remainder(middle + math.pi, math.tau) - math.pi
        tilted = turned(_turn(b, middle), c)
        first = _swing(a, tilted, last)
        rest = product(_turn(b, -middle), product(_turn(a, -first), between))
        solutions.append(np.column_stack([first, middle, twist(rest, c)]))
    nearer = (np.abs(solutions[0][:, 1]) <= np.abs(solutions[1][:, 1]))[:, None]
    return [np.where(nearer, *solutions), np.where(nearer, *reversed(solutions))]


def _cosine(axes: Sequence[Array], between: Array) -> Array:
    """(N,) cos(β − phase) of the middle one of three turns: a · (turn of b by β) c = a · last.

    A cos β + B sin β + C; of skew axes beyond ±1 where they cannot make the attitude.
    """
    a, b, c = axes
    along = (a @ b) * (b @ c)
    size = math.hypot(a @ c - along, a @ np.cross(b, c))
    return (turned(between, c) @ a - along) / size


def _turn(axis: Array, angle: Array) -> Array:
    """(N, 4) about one axis by angles (N,)."""
    unit = axis / np.linalg.norm(axis)
    return np.column_stack([np.cos(angle / 2), np.sin(angle / 2)[:, None] * unit])


def twist(q: Array, axis: Array) -> Array:
    """(N,) [rad] the angle of a turn about an axis; of any other attitude its part about it."""
    unit = axis / np.linalg.norm(axis)
    angle = 2 * np.arctan2(q[:, 1:] @ unit, q[:, 0])
    return np.remainder(angle + math.pi, math.tau) - math.pi


def _swing(axis: Array, before: Array, after: Array) -> Array:
    """(N,) [rad] the turn about the axis that brings a vector, (3,) or (N, 3), to (N, 3)."""
    flat = before - (before @ axis)[..., None] * axis
    across = np.cross(axis, flat)
    return np.arctan2(np.sum(after * across, axis=1), np.sum(after * flat, axis=1))
