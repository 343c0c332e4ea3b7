"""Bodies in space cut free: how their momenta change, and what forces on them would change it.

All from `poses` alone, in ground axes, by the complex step: no angular acceleration is written out.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from textmech.reference.formalisms.derivative import along
from textmech.reference.system import Array, Mode, Pose

from . import difference
from .spatial_laws import matrix as of_quaternion

Wrench = tuple[str, Any, Any, Any]
"""Body, point, force and moment, in ground axes."""


def matrix(pose: Pose) -> Any:
    """(3, 3) from body axes to ground axes; of a complex pose too."""
    return of_quaternion(pose[3:7])


def _moving(mode: Mode, t: Any, q: Any, v: Any) -> Iterator[tuple[str, Pose]]:
    """Each body with its pose; a spring that counts its turns has a state of its own beside."""
    poses = mode.poses(t, q, v)
    return ((body, poses[body]) for body in mode.masses)


def momenta(mode: Mode, t: Any, q: Any, v: Any) -> Any:
    """(bodies, 6): (2.22) p = m ṙ_c and (2.25) D_c = E ω J, in ground axes."""
    rows = []
    for body, pose in _moving(mode, t, q, v):
        spin = matrix(pose) @ (mode.masses[body].J @ np.array(pose[10:]))
        rows.append([*(mode.masses[body].m * np.array(pose[7:10])), *spin])
    return np.array(rows)


def change(mode: Mode, t: float, q: Array, v: Array, a: Array) -> Array:
    """(bodies, 6): (2.23) ṗ and (2.27) Ḋ_c at the accelerations a."""
    changed: Array = along(lambda t, q, v: momenta(mode, t, q, v), (t, q, v), (1.0, v, a))
    return changed


def total(mode: Mode, t: float, q: Array, v: Array, wrenches: Sequence[Wrench]) -> Array:
    """(bodies, 6): F and M_c of all wrenches together."""
    poses = mode.poses(t, q, v)
    sums = {body: np.zeros(6) for body in mode.masses}
    for body, at, force, moment in wrenches:
        arm = np.asarray(at) - poses[body][:3]
        sums[body] += [*np.asarray(force), *(np.cross(arm, force) + np.asarray(moment))]
    return np.array(list(sums.values()))


def turning(mode: Mode, t: float, q: Array, v: Array) -> float:
    """(2.1)–(2.6) How far `poses` is from moving as it says: ṙ = v, q̇ = ½ q∘ω, |q| = 1."""
    worst = 0.0
    for body, pose in _moving(mode, t, q, v):
        moved = along(lambda t, q, body=body: mode.poses(t, q, v)[body][:7], (t, q), (1.0, v))
        w, x = pose[3], np.array(pose[4:7])
        omega = np.array(pose[10:])
        spun = np.array([-x @ omega, *(w * omega + np.cross(x, omega))]) / 2
        worst = max(worst, abs(moved - [*pose[7:10], *spun]).max(), abs(w * w + x @ x - 1.0))
    return worst


def kinetic(mode: Mode, t: float, q: Array, v: Array) -> float:
    """(2.54) Σ ½ m ṙ_c² + ½ ωᵀ J ω of the poses."""
    found = 0.0
    for body, pose in _moving(mode, t, q, v):
        mass, omega = mode.masses[body], np.array(pose[10:])
        found += mass.m * np.sum(np.square(pose[7:10])) / 2 + omega @ mass.J @ omega / 2
    return float(found)


def moves(mode: Mode, states: Iterable[tuple[float, Array, Array]]) -> float:
    """`poses` moves as it says, and has the energy T: the largest relative violation."""
    worst = 0.0
    for t, q, v in states:
        worst = max(worst, turning(mode, t, q, v) / abs(v).max())
        worst = max(worst, difference(kinetic(mode, t, q, v), mode.T(t, q, v)))
    return worst


def force(reactions: Mapping[str, float], name: str, fields: str) -> Array:
    """(3,) of the reactions of one joint or contact, as "fx fy fz"; what is not named is zero."""
    return np.array([reactions.get(f"{name}.{field}", 0.0) for field in fields.split()])


def solved(mode: Mode, t: float, q: Array, v: Array, a: Array) -> tuple[float, Mapping[str, float]]:
    """(2.23), (2.27) What stays unbalanced by `loads` and `cuts`, and the reactions by name.

    The first is relative to the largest term.
    """
    loads = [(load.body, load.at, load.force, load.moment) for load in mode.loads(t, q, v)]
    wanted = change(mode, t, q, v, a) - total(mode, t, q, v, loads)
    names: list[str] = []
    columns = []
    for cut in mode.cuts(t, q):
        names += cut.names
        units = [(unit, np.zeros(3)) for unit in cut.directions]
        units += [(np.zeros(3), unit) for unit in cut.moments]
        for force, moment in units:
            sides = [(cut.b, cut.at, force, moment)]
            if cut.a is not None:
                sides.append((cut.a, cut.at, -np.asarray(force), -np.asarray(moment)))
            columns.append(total(mode, t, q, v, sides).ravel())
    matrix = np.array(columns).T
    found, _, rank, _ = np.linalg.lstsq(matrix, wanted.ravel(), rcond=None)
    assert rank == len(names), "some reactions are open"
    left = abs(matrix @ found - wanted.ravel()).max()
    largest = max(abs(matrix * found).max(), *(abs(np.array(load[2])).max() for load in loads))
    return float(left / largest), dict(zip(names, found.tolist(), strict=True))
