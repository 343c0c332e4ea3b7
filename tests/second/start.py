"""How a motion starts: poses and rates from what a file gives."""

from typing import Any

import numpy as np

from second import contacts
from second.bodies import three
from second.geometry import turn
from second.instant import Now
from second.moving import Array

# The rates at the start: those given, those that follow from them, and all others zero.

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


# The start: places by Newton's method from what the file gives.

PLACES = ("x", "y", "z")
SAME = 1e-11  # to which Newton goes on
EXACT = 1e-14  # where nothing is left to search, as of an open chain that is hung by its angles


def attitude(told: Any) -> Array:
    """The matrix of a turn, or of some turns one after the other."""
    R = np.eye(3)
    for each in told if isinstance(told, list) else [told]:
        R = R @ turn(each["axis"], each["angle"])
    return R


def small_turn(R: Array) -> Array:
    """The rotation vector of a matrix, by its skew part and its angle."""
    w = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    s, c = np.linalg.norm(w), (np.trace(R) - 1) / 2
    if s < 1e-12:
        if c > 0:
            return w
        values, vectors = np.linalg.eigh(R + R.T)
        return np.pi * vectors[:, int(np.argmax(values))]
    return w * np.arctan2(s, c) / s


class Start:
    """The search for a start: unknown are the places of all bodies, and angles in space."""

    def __init__(self, model: Any, initial: dict[str, Any], near: dict[str, Any]) -> None:
        self.model, self.initial, self.near = model, initial, near
        self.x = model.layout.rest()
        self.turned = np.zeros(model.turns)

    def now(self, u: Array | None = None) -> Now:
        """The instant that is reached."""
        m = self.model
        u = np.zeros(m.n) if u is None else u
        return Now(m, 0.0, self.x, u, self.turned, np.zeros(len(m.inner)))

    def guess(self) -> None:
        """Begins at what is given or near, and hangs each body on the one before it."""
        m, told = self.model, {}
        for part in (*self.initial, *self.near):
            told[part] = {**self.near.get(part, {}), **self.initial.get(part, {})}
        placed = {"ground"}
        for name, b in m.bodies.items():
            says = told.get(name, {})
            mine = m.layout.of(self.x, b)
            mine[:2] = says.get("x", 0.0), says.get("y", 0.0)
            if not m.layout.space:
                mine[2] = says.get("angle", 0.0)
                continue
            mine[2] = says.get("z", 0.0)
            if "attitude" in says:
                self.lay(name, attitude(says["attitude"]))
                placed.add(name)
        for j in m.joints.values():
            says = told.get(j.name, {})
            for i, name in enumerate(j.names[len(j.slides) :] if m.layout.space else ()):
                self.turned[m.angles[j.name].start + i] = says.get(name, 0.0)
        for _ in m.joints:
            for j in m.joints.values():
                self.hang(j, told.get(j.name, {}), told, placed)

    def lay(self, name: str, R: Array) -> None:
        """Turns a body to an attitude."""
        mine = self.model.layout.of(self.x, self.model.bodies[name])
        mine[3:] = quaternion(R)

    def hang(self, j: Any, says: dict[str, Any], told: dict[str, Any], placed: set[str]) -> None:
        """Places the second part of a joint where its coordinates put it, if only the first is."""
        m = self.model
        first, second = j.parts
        if second in placed or first not in placed or j.kind == "distance":
            return
        placed.add(second)
        b, poses = m.bodies[second], self.now().poses
        A = poses[first]
        if m.layout.space:
            self.lay(second, A.R @ self.leads(j, says))
        elif ("angle" not in told.get(second, {}) and first != "ground") or "angle" in says:
            a = 0.0 if first == "ground" else m.layout.of(self.x, m.bodies[first])[2]
            if "angle" not in told.get(second, {}):
                m.layout.of(self.x, b)[2] = a + says.get("angle", j.angle)
        now = self.now()
        shift = sum((says.get(n, 0.0) * e for n, e in zip(j.names, j.slides, strict=False)),
                    np.zeros(3))  # fmt: skip
        ends = [now.point(end).p for end in j.ends]
        move = ends[0] + A.R @ shift - ends[1]
        for i, place in enumerate(PLACES[: 3 if m.layout.space else 2]):
            if place not in told.get(second, {}):
                m.layout.of(self.x, b)[i] += move[i]

    def leads(self, j: Any, says: dict[str, Any]) -> Array:
        """In space: the turn from a joint's first part to its second."""
        if j.free:
            return attitude(says["attitude"]) if "attitude" in says else np.eye(3)
        R = np.eye(3)
        for e, angle in zip(j.hinges, self.turned[self.model.angles[j.name]], strict=True):
            R = R @ turn(e, angle)
        return R

    def errors(self) -> Array:
        """What is not yet as the joints, the contacts and the file say."""
        m, now = self.model, self.now()
        found: list[float] = []
        for name, held in now.held.items():
            j = m.joints[name]
            if j.kind == "distance" and j.length is None:
                continue
            found += [row.p for row in held.rows(self.x)]
            if m.layout.space and j.turns and (j.hinges or not j.free):
                R = held.first.R @ self.leads(j, {})
                found += list(small_turn(held.second.R @ R.T))
        for name, c in m.contacts.items():
            if m.layout.space:
                found.append(contacts.in_space(c, now)[2].p)
            elif c.ideal == "rolling":
                found.append(contacts.touching(m.contacts[name], now)[0].p)
        for part, says in self.initial.items():
            found += self.given(now, part, says)
        return np.array(found)

    def given(self, now: Now, part: str, says: dict[str, Any]) -> list[float]:
        """What is not yet as the file gives it of one body or joint."""
        m = self.model
        if part in m.joints:
            found = []
            for name, l in now.coordinates[part].items():
                if name in says:
                    found.append(l.p - says[name])
            if "attitude" in says:
                R = now.held[part].first.R @ attitude(says["attitude"])
                found += list(small_turn(now.held[part].second.R @ R.T))
            return found
        if part not in m.bodies:
            return []
        b, pose = m.bodies[part], now.poses[part]
        c = pose.center.p
        found = [c[i] - says[name] for i, name in enumerate(PLACES) if name in says]
        if "angle" in says:
            found.append(m.layout.of(self.x, b)[2] - says["angle"])
        if "attitude" in says:
            found += list(small_turn(pose.R @ attitude(says["attitude"]).T))
        for name, s in b.points.items():
            if name in says:
                away = pose.point(s).p - three(says[name])
                found += list(away[: 3 if m.layout.space else 2])
        if "from" in says:
            a, l = says["direction"], says["length"]
            goal = now.point(says["from"]).p + l * np.array([np.cos(a), np.sin(a), 0.0])
            found += list((c - goal)[:2])
        for c_on in on(m, part, says):
            found.append(contacts.touching(c_on, now)[0].p)
        return found

    def places(self) -> None:
        """Newton's method, with the derivative by central differences."""
        m, h = self.model, 1e-6
        for _ in range(60):
            e = self.errors()
            if np.max(np.abs(e), initial=0.0) < EXACT:
                return
            x, turned = self.x.copy(), self.turned.copy()
            size = m.n + m.turns
            D = np.zeros((len(e), size))

            def put(z: Array, x: Array = x, turned: Array = turned) -> None:
                self.x, self.turned = m.layout.moved(x, z[: m.n]), turned + z[m.n :]

            for i in range(size):
                sides = []
                for sign in (1, -1):
                    put(sign * h * np.eye(size)[i])
                    sides.append(self.errors())
                D[:, i] = (sides[0] - sides[1]) / (2 * h)
            step = np.linalg.lstsq(D, -e, rcond=1e-9)[0] if len(e) else np.zeros(size)
            length = float(np.max(np.abs(step), initial=0.0))
            put(step * min(1.0, 0.5 / length if length else 1.0))
            if length < SAME:
                return
        raise ArithmeticError("no start was found")


def quaternion(R: Array) -> Array:
    """A quaternion of a rotation matrix."""
    w = small_turn(R)
    a = float(np.linalg.norm(w))
    return np.concatenate([[np.cos(a / 2)], 0.5 * np.sinc(a / 2 / np.pi) * w])


def start(model: Any, initial: dict[str, Any], near: dict[str, Any]) -> tuple[Array, Array, Array]:
    """Places, rates and turned angles at the start."""
    search = Start(model, initial, near)
    search.guess()
    search.places()
    now = search.now()
    for name, j in model.joints.items():
        if j.kind == "distance" and j.length is None:
            way = now.held[name].way.p
            model.joints[name] = type(j)(**{**vars(j), "length": float(np.sqrt(way @ way))})
    for told in model.constraints.values():
        if "height" in told:
            model.heights[told["edge"]] = float(now.point(told["edge"]).p[2])
    now = search.now()
    return search.x, rates(now, initial), search.turned
