"""The rates at the start: those given, those that follow from them, and all others zero."""

from typing import Any

import numpy as np

from second import contacts
from second.instant import Now
from second.moving import Array

SPEEDS = ("vx", "vy", "vz")
RANK = 1e-9  # below that a rate follows from those before it


def rates(now: Now, initial: dict[str, Any]) -> Array:
    """The rates that are given, then those that follow, and all others zero."""
    W, w = [], []

    def add(J: Array, value: float) -> None:
        W.append(J)
        w.append(value)

    for *_, l in now.rows():
        add(l.J, -l.v)  # at zero rates l.v is what moves by itself
    for part, says in initial.items():
        given(now, part, says, add)
    u, *_ = np.linalg.lstsq(np.array(W).reshape(-1, now.n), np.array(w), rcond=RANK)
    for J, value in [*places_given(now, initial), *((J, 0.0) for J in np.eye(now.n))]:
        A = np.array([*W, J])
        if np.linalg.matrix_rank(A, tol=RANK) > np.linalg.matrix_rank(A[:-1], tol=RANK):
            add(J, value)
            u, *_ = np.linalg.lstsq(np.array(W), np.array(w), rcond=RANK)
    return u


def places_given(now: Now, initial: dict[str, Any]) -> list[tuple[Array, float]]:
    """The rows of the joints' coordinates whose places are given, at rest: these rates come first.

    Against a point of the ground that moves, rest is another rate of the body.
    """
    return [
        (l.J, -l.v)
        for part, says in initial.items()
        if part in now.model.joints
        for name, l in now.coordinates[part].items()
        if name in says
    ]


def given(now: Now, part: str, says: dict[str, Any], add: Any) -> None:
    """The rates that the file gives of a body, a joint or an edge."""
    m = now.model
    if part in m.constraints:
        if "speed" in says:
            add(now.edge(m.constraints[part])["speed"].J, says["speed"])
        return
    if part in m.joints:
        j, held = m.joints[part], now.held[part]
        for name, rate in zip(j.names, j.rates, strict=True):
            if rate in says:
                l = now.coordinates[part][name]
                add(l.J, says[rate] - l.v)
        if j.free and "omega" in says:
            w = held.second.R @ np.asarray(says["omega"])
            for row, value in zip(held.second.Jw - held.first.Jw, w, strict=True):
                add(row, value)
        return
    pose = now.poses[part]
    for row, name in zip(pose.center.J, SPEEDS, strict=True):
        if name in says:
            add(row, says[name])
    if "omega" in says:
        w = np.asarray(says["omega"])
        if m.layout.space:
            for row, value in zip(pose.Jw, pose.R @ w, strict=True):
                add(row, value)
        else:
            add(pose.Jw[2], float(w))
    stands = on(m, part, says)
    for c in stands:
        gap, slip = contacts.touching(c, now)
        add(gap.J, 0.0)
        if isinstance(says["on"], str):
            add(slip.J, 0.0)


def on(model: Any, part: str, says: dict[str, Any]) -> list[Any]:
    """The contacts of the points with which a body stands."""
    names = says.get("on", [])
    names = [names] if isinstance(names, str) else names
    found = []
    for name in names:
        c = next(c for c in model.contacts.values() if c.first in (part, f"{part}.{name}"))
        found.append(type(c)(c.name, f"{part}.{name}", *list(vars(c).values())[2:]))
    return found
