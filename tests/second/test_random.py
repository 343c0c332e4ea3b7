"""Random scenes, and states that the reference drew, read a second time."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from second import answer, both, drawn_plane, drawn_space, drawn_switching, read
from second.equations import Row, Solved, applied, mass
from second.instant import Now
from second.model import Model
from second.motion import Motion
from second.moving import Array
from second.quantities import asked
from second.test_shipped import disagree

# Random scenes of every smooth word, typed to a file: both read it and move the same.

MOVES = 1e-3  # of its size, and 1e-6 in SI: a quantity that moves less is left out of a claim
EARLY = 2e-8  # s, 1e-7 of what a scene lasts: by so much may the time of an event differ
READ = ("x", "y", "z", "vx", "vy", "vz", "speed", "angle", "omega", "shift")
EVERY = 1e3  # what is allowed: nothing is claimed of an engine here
PLANE, SPACE, SWITCHING = range(20), range(14), range(4)
CORNER = 158  # an event in the step before a table's corner
MORE_PLANE, MORE_SPACE, MORE_SWITCHING = range(20, 60), range(14, 40), range(4, 40)


def moving(motion: Motion, case: dict[str, Any]) -> list[str]:
    """The quantities that move: of others the suite wants to be told that they stay."""
    found = []
    for name in case["allow"]:
        seen = answer.observed(motion, name)
        span = float(np.max(np.ptp(seen, axis=0)))
        if span > max(1e-6, MOVES * both.size(motion, name, seen)):
            found.append(name)
    return found


def passed(motion: Motion, names: list[str]) -> dict[str, Any]:
    """An event half way through what moves evenly, if something does."""
    for name in names:
        if name[0] in "bj" and name.rsplit(".", 1)[-1] in READ:
            seen: Array = answer.observed(motion, name)
            steps = np.diff(seen)
            middle = float(seen[len(seen) // 2]) + 0.3 * float(steps[len(seen) // 2])
            least = 1e-6 * float(np.max(np.abs(steps)))  # less is no motion, but rounding at rest
            if np.all(steps > least):
                return {"passes": {name: {"rises to": middle}}}
            if np.all(steps < -least):
                return {"passes": {name: {"falls to": middle}}}
    return {}


def compared(told: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Where the two answers to a file disagree."""
    (case,) = read.cases(told, "drawn").values()
    motion = answer.motion(case)
    wanted = moving(motion, case)
    if not wanted:
        told["rests"], wanted = True, case["allow"]
    told |= {"allow": {name: 1e9 if name.endswith("work") else EVERY for name in wanted}}
    told["events"] |= {} if "rests" in told else passed(motion, wanted)
    told["allow"] |= {f"{event}.time": EVERY for event in told["events"]}
    path = folder / "drawn.yaml"
    path.write_text(json.dumps(told, ensure_ascii=False), encoding="utf-8")
    (answered,) = both.solved(path).values()
    found: dict[str, Any] = disagree(motion, answered, wanted)
    for event, says in told["events"].items():
        mine, known = answer.times(motion, says), both.happened(answered, event)
        if len(mine) != len(known) or not np.allclose(mine, known, rtol=0, atol=EARLY):
            found[event] = (known, mine)
    return found


def seeds(normal: range, more: range) -> list[Any]:
    """Some of the normal test, and more of the whole one."""
    return [*normal, *(pytest.param(seed, marks=pytest.mark.slow) for seed in more)]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [*seeds(PLANE, MORE_PLANE), CORNER])
def test_a_random_scene_in_the_plane_moves_the_same(seed: int, tmp_path: Path) -> None:
    assert compared(drawn_plane.drawn(seed), tmp_path) == {}


@pytest.mark.slow
@pytest.mark.parametrize("seed", seeds(SPACE, MORE_SPACE))
def test_a_random_scene_in_space_moves_the_same(seed: int, tmp_path: Path) -> None:
    assert compared(drawn_space.drawn(seed), tmp_path) == {}


@pytest.mark.slow
@pytest.mark.parametrize("seed", seeds(SWITCHING, MORE_SWITCHING))
def test_a_random_scene_that_switches_moves_the_same(seed: int, tmp_path: Path) -> None:
    assert compared(drawn_switching.drawn(seed), tmp_path) == {}


# Claims about states: what follows from places, rates and accelerations, a second time.

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
        parts = both.apart(one, other) / max(1.0, float(np.max(np.abs(one))))
        if not parts < BAR:
            apart[q] = parts
    assert apart == {}
