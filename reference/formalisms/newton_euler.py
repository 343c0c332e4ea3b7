"""The synthetic method: cut every body free, (2.23) for its centre and (2.27) for its spin.

The bodies move as `poses` says, the forces are `loads` and the unknown reactions at `cuts`;
energies play no part.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Array, Cut, Mode
from .derivative import along
from .lagrange import constraint_acceleration, constraint_rows
from .wrench import gyroscopic, inertial, none, rows, velocity, wrench


@dataclass(frozen=True)
class Balance:
    """Forces [N] or moments [N m]: the largest that stays unbalanced, and the largest there is.

    reactions: by quantity [N], those that leave the least.
    """

    unbalanced: float
    largest: float
    reactions: Mapping[str, float]

    def share(self, least: float = 0.0) -> float:
        """Returns the unbalanced part of the largest there is, or of as much [N, N m]."""
        return self.unbalanced / (max(self.largest, least) or 1.0)


@equation
def balance(system: Mode, t: float, q: Array, v: Array, a: Array) -> Balance:
    """(2.23) m r̈_c = F, (2.27) J ω̇ = M_c at accelerations a (n,), reactions by least squares."""
    turning = gyroscopic_moments(system, t, q, v)
    change = accelerated(system, t, q, v, a) + turning
    applied, reacting = load_forces(system, t, q, v), reaction_columns(system, t, q, v)
    unknown = least_squares(reacting, change - applied)
    # Loads one by one: a body at rest is one whose loads cancel, not one that has none. Nor is one
    # without moments one that does not turn.
    loads = system.loads(t, q, v)
    single = [abs(x) for load in loads for x in (*load.force, *np.ravel(load.moment))]
    parts = [abs(change).max(), abs(turning).max(), abs(reacting * unknown).max(initial=0.0)]
    terms = max(*parts, *single)
    unbalanced = change - applied - reacting @ unknown
    reactions = reactions_by_name(system, t, q, unknown)
    return Balance(float(abs(unbalanced).max()), float(terms), reactions)


@equation
def accelerations(system: Mode, t: float, q: Array, v: Array) -> tuple[Array, dict[str, float]]:
    """(2.23) m r̈_c = F, (2.27) J ω̇ = M_c, solved for v̇ (n,) and the reactions together.

    The body accelerations are affine in v̇. Where velocities are bound by f_a v = g, the rows
    f_a v̇ = ġ − ḟ_a v are appended.
    """
    n = len(v)
    still = accelerated(system, t, q, v, np.zeros(n))
    moving = [accelerated(system, t, q, v, e) - still for e in np.eye(n)]
    reacting = reaction_columns(system, t, q, v)
    bound = np.asarray(constraint_rows(system, t, q, n), dtype=np.float64)
    matrix = np.vstack(
        [
            np.hstack([np.stack(moving, axis=1), -reacting]),
            np.hstack([bound, np.zeros((len(bound), reacting.shape[1]))]),
        ]
    )
    free = load_forces(system, t, q, v) - (still + gyroscopic_moments(system, t, q, v))
    needed = constraint_acceleration(system, t, q, v)
    unknown = least_squares(matrix, np.concatenate([free, needed]))
    return unknown[:n], reactions_by_name(system, t, q, unknown[n:])


def accelerated(system: Mode, t: float, q: Array, v: Array, a: Array) -> Array:
    """m r̈_c and J ω̇ of every body, by differentiating `poses` along q̇ and v̇ = a."""

    def velocities(t: object, q: Array, v: Array) -> Array:
        poses = system.poses(t, q, v)
        return np.array([velocity(poses[name]) for name in system.masses])

    rates = along(velocities, (t, q, v), (1.0, system.rates(t, q, v), a))
    masses = system.masses.values()
    return np.concatenate([inertial(*pair) for pair in zip(masses, rates, strict=True)])


def gyroscopic_moments(system: Mode, t: float, q: Array, v: Array) -> Array:
    """ω × (J ω) of every body, in the rows of `accelerated`."""
    poses = system.poses(t, q, v)
    return rows(
        system, {name: gyroscopic(mass, poses[name]) for name, mass in system.masses.items()}
    )


def load_forces(system: Mode, t: float, q: Array, v: Array) -> Array:
    """F and M_c of the applied forces, in the rows of `accelerated`."""
    poses = system.poses(t, q, v)
    total = {name: none(poses[name]) for name in system.masses}
    for load in system.loads(t, q, v):
        total[load.body] += wrench(load.at, poses[load.body], load.force, load.moment)
    return rows(system, total)


def reaction_columns(system: Mode, t: float, q: Array, v: Array) -> Array:
    """F and M_c of a unit of each unknown reaction, one column each: + on body b, − on body a."""
    poses = system.poses(t, q, v)
    nothing = {name: none(poses[name]) for name in system.masses}
    columns = [np.zeros((len(rows(system, nothing)), 0))]  # a free body has no reactions
    for cut in system.cuts(t, q):
        zero = (0.0,) * len(cut.at)
        units: list[Any] = [(direction, 0.0) for direction in cut.directions]
        units += [(zero, 1.0)] if cut.moment else []
        units += [(zero, moment) for moment in cut.moments]
        for force, moment in units:
            column = dict(nothing)
            column[cut.b] = column[cut.b] + wrench(cut.at, poses[cut.b], force, moment)
            if cut.a is not None:
                column[cut.a] = column[cut.a] - wrench(cut.at, poses[cut.a], force, moment)
            columns.append(rows(system, column)[:, None])
    return np.hstack(columns)


def least_squares(matrix: Array, right: Array) -> Array:
    """The unknowns; raises ValueError where the equations leave some of them open."""
    solution: Any
    solution, _, rank, _ = np.linalg.lstsq(matrix, right, rcond=None)
    if rank < matrix.shape[1]:
        raise ValueError("the free-cut equations leave some reactions undetermined")
    return solution


def reactions_by_name(system: Mode, t: float, q: Array, values: Array) -> dict[str, float]:
    """Reactions by quantity, in the order of the cuts."""
    cuts: list[Cut] = system.cuts(t, q)
    names = [name for cut in cuts for name in cut.names]
    return dict(zip(names, values.tolist(), strict=True))
