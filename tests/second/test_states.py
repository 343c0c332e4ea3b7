"""Claims about states: what follows from places, rates and accelerations, a second time.

How a seed draws states is not said, so those that the reference drew are taken as they are: each
body's place and rate, and its angular acceleration. What else is asked of them is computed here.
"""

from typing import Any

import numpy as np
import pytest

from second import both, size
from second.equations import Row, Solved, applied, mass
from second.instant import Now
from second.model import Model
from second.moving import Array
from second.quantities import asked

BAR = 1e-10  # of the largest value: algebra alone, at some numbers of 1e4 beside ones of 1
CLAIMS = [name for name, case in both.EVERY.items() if case.states is not None]
ACCELERATIONS = {"ax", "ay", "az", "alpha_x", "alpha_y", "alpha_z"}
GIVEN = {"planar_bodies": {"box.P.ax", "box.P.ay"}}
"""Accelerations that only they tell of: nothing is left to compare."""

UNSIGNED = {"held.theta_torque"}
"""Of a middle axis: both of its directions lead to the attitude, and the angles are not told."""


def instants(model: Model, told: both.Answer) -> list[Now]:
    """The states that the reference drew."""
    states = told.solution.trajectory.states
    found = []
    for i in range(len(next(iter(states.values())))):
        x, u = model.layout.rest(), np.zeros(model.n)
        for name, b in model.bodies.items():
            row = np.asarray(states[name])[i]
            k = model.layout.near_by
            model.layout.of(x, b)[:] = row[:k]
            c, w = b.columns
            n = c.stop - c.start
            u[c], u[w] = row[k : k + n], row[k + n :]
        now = Now(model, 0.0, x, u, np.zeros(model.turns), np.zeros(0))
        if model.layout.space:  # ω stands in body axes there
            for name, b in model.bodies.items():
                u[b.columns[1]] = now.poses[name].R @ u[b.columns[1]]
        found.append(Now(model, 0.0, x, u, angles(now), np.zeros(0)))
    return found


def angles(now: Now) -> Array:
    """Of three hinges in a row the first angle, on which the middle axis depends.

    That axis is perpendicular to the last one, as it lies, and to the first.
    """
    turned = np.zeros(now.model.turns)
    for name, j in now.model.joints.items():
        if len(j.hinges) == 3:
            one, two, last = j.hinges
            held = now.held[name]
            middle = np.cross(held.first.R.T @ held.second.R @ last, one)
            middle = middle * np.sign(np.cross(last, one) @ two)
            angle = np.arctan2(middle @ np.cross(one, two), middle @ two)
            turned[now.model.angles[name].start] = angle
    return turned


def accelerations(now: Now, known: dict[str, float]) -> tuple[Array, list[Row]]:
    """All accelerations, from the rows of the joints and from those that the reference tells."""
    rows = [Row(*row) for row in now.rows()]
    A = [row.length.J for row in rows]
    b = [-row.length.b for row in rows]
    for name, value in known.items():
        part, _, what = name.rpartition(".")
        axis = "xyz".index(what[-1])
        if what.startswith("alpha"):
            A.append(now.poses[part].Jw[axis])
            b.append(value)
        else:
            P = now.point(part if "." in part else f"{part}.center")
            A.append(P.J[axis])
            b.append(value - P.b[axis])
    return np.linalg.lstsq(np.array(A).reshape(-1, now.n), np.array(b), rcond=1e-12)[0], rows


def needed(now: Now, a: Array, rows: list[Row]) -> Solved:
    """What every row and every freedom needs for these accelerations."""
    freedoms = [
        Row(joint, name, l) for joint, of in now.coordinates.items() for name, l in of.items()
    ]
    every = [*rows, *freedoms]
    A = np.array([row.length.J for row in every]).reshape(-1, now.n)
    forces = np.linalg.lstsq(A.T, mass(now) @ a - applied(now), rcond=1e-12)[0]
    return Solved(a, forces, every)


def masses(now: Now) -> Array:
    """The mass matrix of the joints' coordinates."""
    rows = [row for *_, row in now.rows()]
    freedoms = [l for of in now.coordinates.values() for l in of.values()]
    A = np.array([l.J for l in [*rows, *freedoms]])
    unit = np.vstack([np.zeros((len(rows), len(freedoms))), np.eye(len(freedoms))])
    N = np.linalg.lstsq(A, unit, rcond=1e-12)[0]
    return N.T @ mass(now) @ N


def value(now: Now, solved: Solved, name: str) -> Any:
    """A quantity of one state."""
    if name == "mass_matrix":
        return masses(now).ravel()
    part, _, what = name.partition(".")
    for ending in ("_torque", "_force", "torque"):
        if part in now.model.joints and what.endswith(ending):
            return solved.of(part, what.removesuffix(ending) or "angle")
    return asked(now, solved, name, {})


@pytest.mark.slow
@pytest.mark.parametrize("name", CLAIMS)
def test_what_follows_from_a_state_is_the_same(name: str) -> None:
    case, told = both.reread(name), both.stored(name)
    model = Model(case["scene"])
    reactions = told.solution.trajectory.reactions
    known = {q: v for q, v in reactions.items() if q.split(".")[-1] in ACCELERATIONS}
    seen: dict[str, list[Any]] = {q: [] for q in case["allow"]}
    for i, now in enumerate(instants(model, told)):
        a, rows = accelerations(now, {q: float(v[i]) for q, v in known.items()})
        solved = needed(now, a, rows)
        for q, values in seen.items():
            values.append(value(now, solved, q))
    apart = {}
    for q, values in seen.items():
        if q in GIVEN.get(name, ()):
            continue
        one, other = both.answered(told, q), np.array(values)
        other = other.ravel() if q == "mass_matrix" else other
        if q in UNSIGNED:
            one, other = np.abs(one), np.abs(other)
        parts = size.apart(one, other) / max(1.0, float(np.max(np.abs(one))))
        if not parts < BAR:
            apart[q] = parts
    assert apart == {}
