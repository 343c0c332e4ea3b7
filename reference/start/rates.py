"""The rates at the start: what is given, and what the constraints make of it."""

from collections.abc import Iterable

import numpy as np

from ...cases.scene import GROUND, Scene
from ..system import Array
from . import messages, refusal
from .closure import RATES, Closure, silent
from .positions import undetermined
from .search import CLOSED, RANK, least, rank


def rates(closure: Closure, q: Array) -> Array:
    """v (n,) with f_a q̇ᵃ = g (2.15); what does not follow is zero.

    Raises CaseError if the given rates violate a constraint, or leave rates open that cannot all
    be zero: a bar on a bar that turns could keep its own rate or its neighbour's. So could a wheel
    whose angle is given against the arm: its own rate and the joint's are not both zero.
    """
    given = closure.numbers(closure.case.initial, RATES)
    v = np.zeros(closure.n)
    v[list(given)] = list(given.values())
    for bodies in mechanisms(closure.case.scene):
        columns = [i for i, name in enumerate(closure.where.names) if name.split(".")[0] in bodies]
        free = [i for i in columns if i not in given]
        v[columns] = _of_one(closure, q, v, columns, free)
        _said(closure, q, v / closure.units, free)
    return v


def _said(closure: Closure, q: Array, scaled: Array, free: list[int]) -> None:
    """Raises CaseError where a joint gives its place, and has a rate that nothing says."""
    rows = closure.rows([*closure.parts, *closure.gliding, *closure.still], q)
    for part in silent(closure.case, closure.where):
        row = closure.rows([part], q)
        open_ = rank(np.vstack([rows, row])[:, free], RANK) > rank(rows[:, free], RANK)
        if open_ and _open(row, np.zeros(1), scaled)[1]:
            raise messages.rate_unsaid(closure.case, part.part, angular=part.angular[0])


def _of_one(closure: Closure, q: Array, v: Array, columns: list[int], free: list[int]) -> Array:
    parts = [*closure.parts, *closure.gliding, *closure.still]
    rows, g = closure.linear(parts, q)
    owners = [c for c in parts for _ in range(c.size)]
    mine = np.any(rows[:, columns] != 0.0, axis=1)
    rows, g = rows[mine], g[mine]
    owners = [owner for owner, is_mine in zip(owners, mine, strict=True) if is_mine]
    scaled = v / closure.units  # in sizes and rad per second
    if not _open(rows, g, scaled)[1]:
        return v[columns]
    scaled[free] += least(rows[:, free], g - rows @ scaled)
    residual, violated = _open(rows, g, scaled)
    if violated:
        worst = owners[int(np.argmax(np.abs(residual)))]
        if any(worst is part for part in closure.still):
            raise messages.moves(closure.case, worst.part)
        raise messages.rates_violate(closure.case, worst.part)
    names = [_as_rate(closure.where.names[i]) for i in free]
    if loose := undetermined(rows[:, free], names, RANK):
        left = [i for i, name in zip(free, names, strict=True) if name not in loose]
        scaled[[i for i in free if i not in left]] = 0.0
        scaled[left] += least(rows[:, left], g - rows @ scaled)
        if _open(rows, g, scaled)[1]:
            raise refusal.open_ended(closure, loose, rank(rows[:, free], RANK), among=len(free))
    return (scaled * closure.units)[columns]


def _open(rows: Array, g: Array, v: Array) -> tuple[Array, bool]:
    """The residual of (2.15), and whether it is more than rounding."""
    residual = rows @ v - g
    scale = max(np.max(np.abs(rows * v), initial=0.0), np.max(np.abs(g), initial=0.0))
    return residual, bool(np.max(np.abs(residual), initial=0.0) > CLOSED * scale)


def mechanisms(scene: Scene) -> list[set[str]]:
    """The bodies that joints hold together, and what may stand on each other.

    What only shares the ground moves by itself.
    """
    held = [{joint.a.body, joint.b.body} - {GROUND} for joint in scene.joints.values()]
    touching = [{pair.body, pair.touched} for pair in scene.pairs.values()]
    return joined(scene.bodies, [*held, *touching])


def joined(names: Iterable[str], links: Iterable[set[str]]) -> list[set[str]]:
    """The names in groups: two of one link are in one."""
    groups = [{name} for name in names]
    for link in links:
        met = [group for group in groups if group & link]
        groups = [group for group in groups if not group & link] + [set().union(*met)]
    return groups


def _as_rate(name: str) -> str:
    body, _, field = name.rpartition(".")
    return f"{body}.{({'x': 'vx', 'y': 'vy', 'angle': 'omega'})[field]}"
