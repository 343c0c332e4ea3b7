"""A start in space: attitudes, turns of joints, and which solutions of their rows are assemblies.

Rows say which directions are at right angles. That holds of a joint turned over, too.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ...cases.case import Case, Placement
from ...cases.scene import GROUND, Scene, chain
from ...cases.scene.counting import counted
from ...cases.scene.frame import SPACE
from ...cases.scene.joint import Joint
from ...cases.scene.rotation import (
    UPRIGHT,
    about,
    angle_between,
    inverse,
    matrix,
    product,
    turned,
)
from ..mechanism.kinematics.spatial_coordinates import SpatialCoordinates
from ..system import Array
from . import messages
from .closure import Closure, Coordinate, Equation, joined
from .messages import DEGREES
from .search import NEAR, SAME, least_of, rank
from .spatial_guess import laid_out, off_by, together

SPINS = ("omega_1", "omega_2", "omega_3")
UP, STILL = np.array([UPRIGHT]), np.zeros((1, 3))
LOCKED = 1e-5  # sine: below, rounding moves the turns about either axis by more than 1e-11
REACHED = 1e-6  # rad: near gimbal lock half of the digits of an angle are lost
ALIKE = 0.5  # between the cosine of a held axis, 1, and those of its joint turned over, 0 and -1


class SpatialClosure(Closure):
    """q = r and a unit quaternion of each body."""

    seeds = 40  # starts from which other assemblies are looked for
    attitude_word = "attitude"
    where: SpatialCoordinates

    def __init__(self, case: Case) -> None:
        super().__init__(case, SpatialCoordinates(case.scene))

    def attitude_of(self, placement: Placement) -> Sequence[float] | None:
        """Returns the quaternion that a placement gives."""
        return placement.attitude

    def turned(self, wanted: Sequence[float], q: Array, at: int) -> Sequence[float]:
        """Returns the turn (3,) [rad] from one attitude to the other, in the axes of q."""
        return _turn_between(wanted, q[at : at + 4]).tolist()

    def turns(self, joint: Joint, q: Array) -> Iterator[Coordinate]:
        """Yields the turns of a joint about axes; a ball has none."""
        if not joint.turns or joint.turns[0].kind != "turn":
            return
        a, b = (self.attitude(at.body, q) for at in joint.refers())
        axes = [freedom.axis for freedom in joint.turns]
        ways = chain.turn_solutions(axes, a[None], STILL, b[None], STILL)
        angles = counted(ways, np.zeros(1), joint.begun).angles[0].tolist()
        columns, so_far = [], np.array(UPRIGHT)
        for axis, angle in zip(axes, angles, strict=True):
            columns.append(turned(so_far, axis))
            so_far = product(so_far, np.array(about(axis, angle)))
        duals = np.linalg.pinv(np.array(columns).T) @ matrix(a).T @ matrix(b)  # in the axes of b
        rows = duals @ self.relative(joint, q)
        for freedom, angle, row in zip(joint.turns, angles, rows, strict=True):
            yield Coordinate(freedom, angle, row, 0.0)

    def relative(self, joint: Joint, q: Array) -> Array:
        """(3, n) ω of the second part against the first, in the axes of the second."""
        rows = np.zeros((3, self.n))
        a, b = (self.where.slots.get(at.body) for at in joint.refers())
        R_a, R_b = (matrix(self.attitude(at.body, q)) for at in joint.refers())
        if b is not None and b.omega is not None:
            rows[:, b.omega : b.omega + 3] = np.eye(3)
        if a is not None and a.omega is not None:
            rows[:, a.omega : a.omega + 3] = -R_b.T @ R_a
        return rows

    def attitude(self, part: str, q: Array) -> Array:
        """(4,) of a body; of a joint, of its second part against its first; else the ground's."""
        if part in self.scene.joints:
            a, b = (self.attitude(at.body, q) for at in self.scene.joints[part].refers())
            return product(inverse(a), b)
        at = self.where.slots.get(part)
        if at is None or at.attitude is None:
            return np.array(UPRIGHT)
        e = q[at.attitude : at.attitude + 4]
        return e / np.linalg.norm(e)

    def equations_by_word(
        self, placements: Mapping[str, Placement], q: Array
    ) -> Iterator[Equation]:
        """Yields the attitudes that placements give of joints."""
        for name, placement in placements.items():
            if name in self.scene.joints and placement.attitude is not None:
                apart = _turn_between(placement.attitude, self.attitude(name, q)).tolist()
                rows = self.relative(self.scene.joints[name], q)
                for off, row in zip(apart, rows, strict=True):
                    yield Equation(f"{name}.attitude", off, row, angular=True)

    def rates_by_word(self, q: Array) -> Iterator[Equation]:
        """Yields the ω that the case gives of balls."""
        for name, placement in self.case.initial.items():
            if name not in self.scene.joints:
                continue
            for word, row in zip(SPINS, self.relative(self.scene.joints[name], q), strict=True):
                if word in placement.given:
                    yield Equation(f"{name}.{word}", -placement.given[word], row, angular=True)

    def resting(self, q: Array) -> Iterator[Equation]:
        """Yields the rates of all joints, of the second part against the first."""
        for joint in self.scene.joints.values():
            yield from self.rates(joint, q).values()

    def moved(self, q: Array, change: Array) -> Array:
        """q after a small move (n,); quaternions keep the length 1."""
        q = q + self.where.rates(q, change)
        for at in self.where.attitudes:
            q[at] /= np.linalg.norm(q[at])
        return q

    def settled(self, q: Array) -> Array:
        """q: attitudes count no turns."""
        return q

    def difference(self, a: Array, b: Array) -> float:
        """The largest difference of places, and of attitudes, which no sign of theirs changes."""
        first, second = (self.where.poses(q, np.zeros(self.n)) for q in (a, b))
        far = 0.0
        for name in first:
            p, s = np.array(first[name][:7], float), np.array(second[name][:7], float)
            turned_by = 2 * np.arccos(min(1.0, abs(float(p[3:] @ s[3:]))))
            far = max(far, float(np.max(np.abs(p[:3] - s[:3]))) / self.size, turned_by)
        return far

    # Guesses.

    def guess(self) -> Array:
        """Returns the first guess: along joints, from what is given and else what is near."""
        return self._laid_out(self.case.near, {})

    def several(self) -> bool:
        """Whether there may be several ways: a loop, or a chain that more than its root holds.

        Its root is the ground, or a body that is placed by itself.
        """
        own = {name: p for name, p in self.case.initial.items() if self._is_placed(p)}
        if closes(self.scene) or self.scene.contacts or any(p.points for p in own.values()):
            return True
        return any(len(roots & {GROUND, *own}) > 1 for roots in chains(self.scene))

    def _is_placed(self, placement: Placement) -> bool:
        """Whether it says where a body is, be it by one number."""
        placed = placement.points or placement.attitude is not None
        return bool(placed) or any(axis in placement.given for axis in SPACE.axes)

    def beside_near(self, count: int) -> Iterator[Array]:
        """Yields guesses with what is near, ever less so, and the turns of joints anywhere."""
        rng = np.random.default_rng(seed=1)
        for k in range(count):
            near = off_by(self.scene, self.case.near, k / count * NEAR, self.size, rng)
            yield self._laid_out(near, self._turns_anywhere(rng))

    def anywhere(self) -> Iterator[Array]:
        """Yields guesses with the turns of joints anywhere."""
        rng = np.random.default_rng(seed=1)  # any: the same starts in every run
        for _ in range(self.seeds):
            yield self._laid_out({}, self._turns_anywhere(rng))

    def _laid_out(
        self, near: Mapping[str, Placement], seeds: Mapping[str, Mapping[str, float]]
    ) -> Array:
        placements = together(self.case.initial, near) if near else self.case.initial
        return self.with_given(laid_out(self.where, placements, seeds))

    def _turns_anywhere(self, rng: np.random.Generator) -> dict[str, dict[str, float]]:
        return {
            joint.name: {
                freedom.name or f"#{i}": float(rng.uniform(-np.pi, np.pi))
                for i, freedom in enumerate(joint.freedoms)
                if freedom.kind == "turn"
            }
            for joint in self.scene.joints.values()
        }

    # Which solutions are ways to assemble, and which of these is meant.

    def refuse_words(self) -> None:
        """Raises CaseError for three turns, of which the first and the last are about one axis."""
        for name, placement in self.case.initial.items():
            joint = self.scene.joints.get(name)
            if joint is None or len(joint.turns) < 3:
                continue
            first, middle, last = joint.turns
            angle = placement.given.get(middle.name)
            if angle is None:
                continue
            there = turned(np.array(about(middle.axis, angle)), last.axis)
            if abs(float(np.dot(np.cross(first.axis, middle.axis), there))) < LOCKED:
                raise messages.locked(self.case, joint, angle)

    def is_assembly(self, q: Array) -> bool:
        """Whether each joint's axes point the same way: rows of right angles hold of both."""
        for joint in self.scene.joints.values():
            bodies = [self.scene.bodies[e.body] for e in joint.refers() if e.body != GROUND]
            if len(joint.turns) > 1 or not joint.holds_attitude or not all(b.turns for b in bodies):
                continue
            a, b = (matrix(self.attitude(end.body, q)) for end in joint.refers())
            axes = np.array([turn.axis for turn in joint.turns] or np.eye(3))
            if np.min(np.sum((axes @ a.T) * (axes @ b.T), axis=1)) < ALIKE:
                return False
        return True

    def preferred(self, ways: list[Array]) -> list[Array]:
        """Returns the ways whose turns are within gimbal lock where nothing says the middle one.

        Of ways that differ in turns without a name alone, as of a rod that hangs on a universal
        joint turned over, that in which these turns are least.
        """
        if len(ways) > 1:
            ways = least_of(ways, [self._past_lock(q) for q in ways], SAME)
        if self.case.near and len(ways) > 1 and self._differ_most(ways)[1] < SAME:
            return least_of(ways, [self._unnamed(q) for q in ways], SAME)
        return ways

    def _past_lock(self, q: Array) -> int:
        """How many joints have their middle turn of three past gimbal lock, and no word says so.

        Three turns make an attitude in two ways: with a last turn of 0 it is another one past it.
        """
        count = 0
        for joint in self.scene.joints.values():
            if len(joint.turns) < 3:
                continue
            middle = joint.turns[1].name
            words = (self.case.initial.get(joint.name), self.case.near.get(joint.name))
            if any(said is not None and middle in said.given for said in words):
                continue
            made = self.attitude(joint.name, q)[None]
            axes = [turn.axis for turn in joint.turns]
            first, *_ = chain.turn_solutions(axes, UP, STILL, made, STILL)
            _, turn, _ = self.turns(joint, q)
            count += abs(math.remainder(turn.value - float(first.angles[0, 1]), math.tau)) > REACHED
        return count

    def _unnamed(self, q: Array) -> float:
        """The largest turn [rad] of a joint that has turns without a name."""
        joints = self.scene.joints.values()
        loose = (joint.name for joint in joints if any(not turn.name for turn in joint.turns))
        made = (self.attitude(name, q) for name in loose)
        return max((float(angle_between(np.array(UPRIGHT), e)) for e in made), default=0.0)

    def refuse_turns(self, q: Array) -> None:
        """Raises CaseError for three turns about skew axes that make no attitude such as this."""
        for joint in self.scene.joints.values():
            if len(joint.turns) < 3:
                continue
            made = np.array(UPRIGHT)
            for c in self.turns(joint, q):
                made = product(made, np.array(about(c.freedom.axis, c.value)))
            a, b = (self.attitude(end.body, q) for end in joint.refers())
            if angle_between(product(a, made), b) > REACHED:
                raise messages.unreached(self.case, joint)

    # In which words.

    def distinguishing(self, ways: list[Array]) -> str:
        """The joint's coordinate in which ways differ most, or the body whose attitude does."""
        name, apart = self._differ_most(ways)
        if apart >= SAME:
            return name
        far = {
            body: max(
                float(angle_between(self.attitude(body, ways[0]), self.attitude(body, q)))
                for q in ways
            )
            for body in self.scene.bodies
        }
        return f"{max(far, key=far.__getitem__)}.attitude"

    def _differ_most(self, ways: list[Array]) -> tuple[str, float]:
        """The named coordinate in which ways differ most, and by how much, in rad or sizes."""
        differences: dict[str, float] = {}
        for joint in self.scene.joints.values():
            for first, *others in zip(*(self.coordinates(joint, q) for q in ways), strict=True):
                if first.freedom.name:
                    off = [first.value - c.value for c in others]
                    shift = first.freedom.kind == "shift"
                    differences[f"{joint.name}.{first.freedom.name}"] = max(
                        abs(x) / self.size if shift else abs(math.remainder(x, math.tau))
                        for x in off
                    )
        name = max(differences, key=differences.__getitem__, default="")
        return name, differences.get(name, 0.0)

    def shown(self, q: Array, name: str) -> str:
        """Returns the value of a coordinate as a file has it, or an attitude."""
        part, _, field = name.partition(".")
        return _text(self.attitude(part, q)) if field == "attitude" else super().shown(q, name)

    def open_names(self, q: Array, loose: Array, small: float) -> list[str]:
        """The coordinates that change by more than `small` along the directions `loose` (k, n).

        Of joints first, then of bodies that none holds, then of others as far as these tell less.
        """
        joints = {name: rows for name, rows in self._of_joints(q) if _change(loose, rows) > small}
        held = {end.body for joint in self.scene.joints.values() for end in joint.refers()}
        free = self._open_places(loose, small)
        ways = {**joints, **{name: rows for name, rows in free.items() if _body(name) not in held}}
        for name, rows in sorted(free.items(), key=lambda item: not item[0].endswith(".attitude")):
            if _rank(loose, [*ways.values(), rows]) > _rank(loose, [*ways.values()]):
                ways[name] = rows
        return [*ways]

    def _of_joints(self, q: Array) -> Iterator[tuple[str, Array]]:
        """Yields the coordinates of joints by name, with their rows in units of the size.

        Not of a ball whose one part has an attitude that is given: the other's is easier to say.
        """
        for joint in self.scene.joints.values():
            for c in self.coordinates(joint, q):
                if c.freedom.name:
                    yield f"{joint.name}.{c.freedom.name}", c.row[None] * self.units
            ends = [self.where.slots[end.body] for end in joint.refers() if end.body != GROUND]
            if any(f.kind == "ball" for f in joint.freedoms) and not any(
                at.attitude in self.given for at in ends
            ):
                yield f"{joint.name}.attitude", self.relative(joint, q) * self.units

    def _open_places(self, loose: Array, small: float) -> dict[str, Array]:
        """The open coordinates of bodies, with their rows."""
        places = {"vx": "x", "vy": "y", "vz": "z"}
        rows: dict[str, list[Array]] = {}
        for row, name in zip(np.eye(self.n), self.where.rate_names, strict=True):
            body, _, rate = name.partition(".")
            rows.setdefault(f"{body}.{places.get(rate, 'attitude')}", []).append(row)
        stacked = {name: np.array(several) for name, several in rows.items()}
        return {
            name: several for name, several in stacked.items() if _change(loose, several) > small
        }


def _change(loose: Array, rows: Array) -> float:
    """Largest change along directions (k, n) of the quantity with these rows."""
    return float(np.max(np.abs(loose @ rows.T), initial=0.0))


def _rank(loose: Array, rows: Sequence[Array]) -> int:
    """Rank of all rows together along the directions (k, n)."""
    return rank(loose @ np.vstack(rows).T) if rows else 0


def _body(name: str) -> str:
    return name.partition(".")[0]


def closes(scene: Scene) -> bool:
    """Whether a joint joins what is joined already, be it on the ground or free of it."""
    return len(scene.joints) > 1 + len(scene.bodies) - len(chains(scene))


def chains(scene: Scene) -> list[set[str]]:
    """The bodies, and the ground, that joints hold together."""
    joints = scene.joints.values()
    return joined((GROUND, *scene.bodies), [{joint.a.body, joint.b.body} for joint in joints])


def _turn_between(wanted: Sequence[float], q: Array) -> Array:
    """(3,) Turn [rad] from one attitude to the other, in the axes of q."""
    d = product(inverse(np.array(wanted)), q / np.linalg.norm(q))
    half = float(np.linalg.norm(d[1:]))
    angle = 2 * np.arctan2(half, abs(d[0])) * (1.0 if d[0] >= 0 else -1.0)
    return d[1:] * (angle / half if half > 1e-12 else 2.0 * (1.0 if d[0] >= 0 else -1.0))


def _text(e: Array) -> str:
    """A unit quaternion as a file has it."""
    size = float(np.linalg.norm(e[1:]))
    axis = np.round(e[1:] / size, 4) + 0.0 if size else (0.0, 0.0, 1.0)  # no −0
    x, y, z = (f"{component:g}" for component in axis)
    angle = 2 * math.atan2(size, float(e[0])) * DEGREES
    return f"{{axis: [{x}, {y}, {z}], angle: {angle:.4g} deg}}"
