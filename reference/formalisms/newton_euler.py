"""The synthetic method: cut every body free, (2.23) for its centre and (2.27) for its spin.

The bodies move as `poses` says, the forces are `loads` and the unknown reactions at `cuts`;
energies play no part.
"""

from typing import Any

import numpy as np

from ..system import Array, Cut, Mode
from .derivative import along
from .lagrange import constraint_acceleration


def balance(system: Mode, t: float, q: Array, v: Array, a: Array) -> tuple[float, dict[str, float]]:
    """(2.23) m r̈_c = F, (2.27) J ω̇ = M_c at the accelerations a (n,), reactions by least squares.

    Answers the largest force [N] or moment [N m] that stays unbalanced, relative to the largest
    one there is, and the reactions [N] by quantity.
    """
    change = inertia_forces(system, t, q, v, a)
    applied, reacting = load_forces(system, t, q, v), reaction_columns(system, t, q, v)
    unknown = least_squares(reacting, change - applied)
    # Loads one by one: a body at rest is one whose loads cancel, not one that has none.
    loads = [abs(x) for load in system.loads(t, q, v) for x in (*load.force, load.moment)]
    terms = max([abs(change).max(), abs(reacting * unknown).max(initial=0.0), *loads])
    unbalanced = change - applied - reacting @ unknown
    return float(abs(unbalanced).max() / (terms or 1.0)), named(system, t, q, unknown)


def accelerations(system: Mode, t: float, q: Array, v: Array) -> tuple[Array, dict[str, float]]:
    """(2.23) m r̈_c = F, (2.27) J ω̇ = M_c, solved for q̈ (n,) and the reactions together.

    The body accelerations are affine in q̈. Where coordinates are bound by f_a q̇ᵃ = g, the
    rows f_a q̈ᵃ = ġ − ḟ_a q̇ᵃ are appended.
    """
    n = len(q)
    still = inertia_forces(system, t, q, v, np.zeros(n))
    moving = [inertia_forces(system, t, q, v, e) - still for e in np.eye(n)]
    reacting = reaction_columns(system, t, q, v)
    rows = np.asarray(system.f_a(t, q), dtype=np.float64)
    matrix = np.vstack(
        [
            np.hstack([np.stack(moving, axis=1), -reacting]),
            np.hstack([rows, np.zeros((len(rows), reacting.shape[1]))]),
        ]
    )
    free = load_forces(system, t, q, v) - still
    bound = constraint_acceleration(system, t, q, v)
    unknown = least_squares(matrix, np.concatenate([free, bound]))
    return unknown[:n], named(system, t, q, unknown[n:])


def inertia_forces(system: Mode, t: float, q: Array, v: Array, a: Array) -> Array:
    """m r̈_c (2 rows a body) and J ω̇ (1 row, not for particles), by differentiating `poses`."""
    names = list(system.masses)

    def velocities(t: object, q: Array, v: Array) -> Array:
        poses = system.poses(t, q, v)
        return np.array([poses[name][3:] for name in names])

    rates = along(velocities, (t, q, v), (1.0, v, a))
    rows: list[float] = []
    for mass, (x_ddot, y_ddot, omega_dot) in zip(system.masses.values(), rates, strict=True):
        rows += [mass.m * x_ddot, mass.m * y_ddot]
        rows += [] if mass.J is None else [mass.J * omega_dot]
    return np.array(rows)


def load_forces(system: Mode, t: float, q: Array, v: Array) -> Array:
    """F and M_c of the applied forces, in the rows of `inertia_forces`."""
    total: dict[str, Array] = {name: np.zeros(3) for name in system.masses}
    centres = _centres(system, t, q, v)
    for load in system.loads(t, q, v):
        total[load.body] += wrench(load.at, centres[load.body], load.force, load.moment)
    return _rows(system, total)


def reaction_columns(system: Mode, t: float, q: Array, v: Array) -> Array:
    """F and M_c of a unit of each unknown reaction, one column each: + on body b, − on body a."""
    centres = _centres(system, t, q, v)
    columns = []
    for cut in system.cuts(t, q):
        units = [(direction, 0.0) for direction in cut.directions]
        units += [((0.0, 0.0), 1.0)] if cut.moment else []
        for force, moment in units:
            column: dict[str, Array] = {name: np.zeros(3) for name in system.masses}
            column[cut.b] += wrench(cut.at, centres[cut.b], force, moment)
            if cut.a is not None:
                column[cut.a] -= wrench(cut.at, centres[cut.a], force, moment)
            columns.append(_rows(system, column))
    return np.stack(columns, axis=1)


def wrench(
    at: tuple[float, float], centre: tuple[float, float], force: tuple[float, float], moment: float
) -> Array:
    """(2.26) F, and M_c = x × F + M, as (3,)."""
    x, y = at[0] - centre[0], at[1] - centre[1]
    return np.array([force[0], force[1], x * force[1] - y * force[0] + moment])


def least_squares(matrix: Array, right: Array) -> Array:
    """The unknowns; raises ValueError where the equations leave some of them open."""
    solution: Any
    solution, _, rank, _ = np.linalg.lstsq(matrix, right, rcond=None)
    if rank < matrix.shape[1]:
        raise ValueError("the free-cut equations leave some reactions undetermined")
    return solution


def named(system: Mode, t: float, q: Array, values: Array) -> dict[str, float]:
    """Reactions by quantity, in the order of the cuts."""
    cuts: list[Cut] = system.cuts(t, q)
    names = [name for cut in cuts for name in cut.names]
    return dict(zip(names, values.tolist(), strict=True))


def _centres(system: Mode, t: float, q: Array, v: Array) -> dict[str, tuple[float, float]]:
    return {name: (pose[0], pose[1]) for name, pose in system.poses(t, q, v).items()}


def _rows(system: Mode, wrenches: dict[str, Array]) -> Array:
    """Stacked as in `inertia_forces`: a particle has no row of moments."""
    masses = system.masses.items()
    return np.concatenate([wrenches[name][: 2 if mass.J is None else 3] for name, mass in masses])
