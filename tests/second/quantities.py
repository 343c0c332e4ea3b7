"""Quantities of a motion: each word of the README's two tables, read from one instant."""

import math
from typing import Any

import numpy as np

from second import contacts
from second.equations import Solved
from second.instant import Now
from second.moving import Array

AXES = ("x", "y", "z")
TENSOR = {"11": (0, 0), "22": (1, 1), "33": (2, 2), "12": (0, 1), "13": (0, 2), "23": (1, 2)}


def asked(now: Now, solved: Solved, name: str, beside: dict[str, Any]) -> Any:
    """The value of a quantity; beside: works so far, and the instant of the start."""
    part, _, rest = name.partition(".")
    m = now.model
    if part == "energy":
        return energy(now)[rest]
    if part == "momentum":
        return momentum(now)[rest]
    if rest == "work":
        return beside["works"][part]
    if part in m.bodies:
        return of_body(now, solved, part, rest)
    if part in m.joints:
        return of_joint(now, solved, part, rest)
    if part in m.constraints:
        return of_edge(now, solved, part, rest)
    if part in m.contacts:
        return of_contact(now, solved, part, rest, beside)
    return of_force(now, solved, part, rest)


def energy(now: Now) -> dict[str, float]:
    """The energies: potential is that of gravity, from the origin, and of springs."""
    m = now.model
    kinetic = potential = 0.0
    for name, b in m.bodies.items():
        pose = now.poses[name]
        w = pose.R.T @ pose.w
        kinetic += b.mass * (pose.center.v @ pose.center.v) / 2 + w @ b.inertia @ w / 2
        potential -= b.mass * (m.gravity @ pose.center.p)
    potential += sum(effect.stored for effect in now.effects.values())
    return {"kinetic": kinetic, "potential": potential, "total": kinetic + potential}


def momentum(now: Now) -> dict[str, float]:
    """Momentum, and its moment about the origin."""
    p, L = np.zeros(3), np.zeros(3)
    for name, b in now.model.bodies.items():
        pose = now.poses[name]
        p += b.mass * pose.center.v
        L += b.mass * np.cross(pose.center.p, pose.center.v)
        L += pose.R @ b.inertia @ pose.R.T @ pose.w
    found = {axis: p[i] for i, axis in enumerate(AXES)}
    return found | {f"angular_{a}": L[i] for i, a in enumerate(AXES)} | {"angular": L[2]}


def of_vectors(p: Array, v: Array, a: Array, rest: str) -> float:
    """A component of a place, a velocity or an acceleration."""
    if rest == "speed":
        return math.sqrt(v @ v)
    if rest in AXES:
        return p[AXES.index(rest)]
    return (v if rest[0] == "v" else a)[AXES.index(rest[1])]


def of_body(now: Now, solved: Solved, name: str, rest: str) -> Any:
    """Of a body or one of its points."""
    b, pose = now.model.bodies[name], now.poses[name]
    if "." in rest:
        point, rest = rest.split(".")
        P = pose.point(b.points[point])
        return of_vectors(P.p, P.v, P.J @ solved.a + P.b, rest)
    if rest == "attitude":
        return pose.R
    if rest == "angle":
        return now.model.layout.of(now.x, b)[2]
    if rest == "omega":
        return pose.w[2]
    if rest == "alpha":
        return (pose.Jw @ solved.a)[2]
    if rest.startswith("alpha_"):
        return (pose.Jw @ solved.a)[AXES.index(rest[-1])]
    if rest.startswith("omega_"):
        return (pose.R.T @ pose.w)[int(rest[-1]) - 1]
    if rest == "inertia":
        return b.inertia[2, 2]
    if rest.startswith("inertia_"):
        return b.inertia[TENSOR[rest[-2:]]]
    P = pose.center
    return of_vectors(P.p, P.v, P.J @ solved.a + P.b, rest)


def exerted(now: Now, solved: Solved, name: str) -> tuple[Array, Array]:
    """What a joint's rows and drives exert on its second part: force, and moment about its point.

    Of a turn also what a torsion spring, a damper and a motor do about it.
    """
    m, j, held = now.model, now.model.joints[name], now.held[name]
    Q = np.zeros(now.n)
    for f, row in zip(solved.forces, solved.rows, strict=True):
        if row.owner == name:
            Q += f * row.length.J
    for force, told in m.forces.items():
        words = [told.get(k) for k in ("torsion", "torsion_damper", "motor")]
        if any(str(w).split(".")[0] == name for w in words if w is not None):
            for thing, amount in now.effects[force].on:
                Q += amount * thing.J
    part, sign = (j.parts[1], 1) if j.parts[1] != "ground" else (j.parts[0], -1)
    b = m.bodies[part]
    c, w = b.columns
    F, M = np.zeros(3), np.zeros(3)
    F[: c.stop - c.start] = Q[c]
    M[3 - (w.stop - w.start) :] = Q[w]
    return sign * F, sign * (M - np.cross(held.point.p - now.poses[part].center.p, F))


def of_joint(now: Now, solved: Solved, name: str, rest: str) -> float:
    """Of a joint: what it exerts, how far it is apart, its coordinates and drives."""
    m, j, held = now.model, now.model.joints[name], now.held[name]
    coordinates = now.coordinates[name]
    if rest in j.rates:
        return coordinates[j.names[j.rates.index(rest)]].v
    if rest in coordinates:
        return coordinates[rest].p
    for freedom, rate in zip(j.names, j.rates, strict=True):
        drives = {f"{freedom}_force", f"{freedom}_torque"}
        drives |= {"torque"} if rate == "omega" else {"drive"} if rate == "speed" else set()
        if rest in drives and f"{name}.{rate}" in m.drives:
            return solved.of(name, f"{name}.{rate}")
    if rest == "gap":
        if j.kind == "distance":
            return held.rows(now.x)[0].p
        gaps = [held.first.direction(e).p @ held.way.p for e in j.cross]
        return math.sqrt(sum(g * g for g in gaps))
    if rest == "slip":
        return next(iter(coordinates.values())).v
    if rest == "friction":
        return solved.of(name, "friction")
    F, M = exerted(now, solved, name)
    if rest == "force":
        return solved.of(name, "0") * -1 if j.kind == "distance" else math.sqrt(F @ F)
    if rest == "moment":
        return math.sqrt(M @ M)
    if rest == "torque":
        return M[2]
    return (F if rest[0] == "f" else M)[AXES.index(rest[1])]


def of_edge(now: Now, solved: Solved, name: str, rest: str) -> float:
    """Of an edge: what the ground exerts on it, and how its point moves."""
    if rest in ("force", "drive", "normal"):
        return solved.of(name, rest)
    row = now.edge(now.model.constraints[name])[rest]
    return row.p if rest == "gap" else row.v


def of_contact(now: Now, solved: Solved, name: str, rest: str, beside: dict[str, Any]) -> float:
    """Of a contact: what is exerted on the first body, its gap, its slip and its drift."""
    c = now.model.contacts[name]
    if now.model.layout.space:
        rows = contacts.in_space(c, now)
        if rest == "gap":
            return rows[2].p
        if rest == "slip":
            return math.hypot(rows[0].v, rows[1].v)
        F = np.array([solved.of(name, what) for what in ("fx", "fy", "normal")])
        if rest in ("along", "side"):
            t = contacts.track(c, now)
            return float(F @ (t if rest == "along" else np.cross(contacts.UP, t)))
        return F[("fx", "fy", "normal").index(rest)]
    if rest in ("normal", "tangent"):
        of_tips = sum(
            solved.of(row.owner, rest)
            for row in solved.rows
            if row.owner.startswith(f"{name}.") and row.what == rest
        )
        return solved.of(name, rest) + of_tips
    if not c.point and "tip0" in now.model.bodies[c.body].points:
        return of_spokes(now, solved, c, rest)
    gap, slip = contacts.touching(c, now)
    if rest == "drift":
        return drifted(now, c) - drifted(beside["start"], c)
    return gap.p if rest == "gap" else slip.v


def of_spokes(now: Now, solved: Solved, c: Any, rest: str) -> float:
    """Of spokes: the height of the lowest tip but that on which they stand, or the slip of that."""
    stands = next(
        (row.owner.split(".")[1] for row in solved.rows if row.owner.startswith(f"{c.name}.")), ""
    )
    if rest == "slip":
        return now.point(f"{c.first}.{stands}").v[0]
    tips = [p for p in now.model.bodies[c.first].points if p.startswith("tip") and p != stands]
    return min(float(now.point(f"{c.first}.{tip}").p[1]) for tip in tips)


def drifted(now: Now, c: Any) -> float:
    """The place of the point that touches along its plane, of a disk with R angle."""
    _, normal = now.model.planes[c.second.split(".")[1]]
    t = np.array([normal[1], -normal[0], 0.0]) / np.linalg.norm(normal)
    if c.point:
        return float(now.point(c.first).p @ t)
    b = now.model.bodies[c.body]
    return float(now.poses[c.body].center.p @ t) + b.radius * now.model.layout.of(now.x, b)[2]


def of_force(now: Now, solved: Solved, name: str, rest: str) -> float:
    """Of a force element."""
    told = now.model.forces[name]
    if "rope" in told:
        one, two = (now.point(end).p for end in told["rope"])
        l = float(np.linalg.norm(two - one))
        found = {"length": l, "gap": told["length"] - l, "force": solved.of(name, "normal")}
        return found[rest]
    if "stops" in told:
        if rest == "angle":
            return now.turn(told["stops"]).p
        return solved.of(f"{name}.low", "normal") - solved.of(f"{name}.high", "normal")
    return now.effects[name].told[rest]
