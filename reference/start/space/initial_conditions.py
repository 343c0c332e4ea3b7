"""Equations of the start in space that a case gives: each a residual and its row of velocities.

Places and attitudes of bodies and points, and coordinates of joints.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ....cases.case import Case, Placement
from ....cases.scene import GROUND, Anchor, chain
from ....cases.scene.counting import counted
from ....cases.scene.joint import Freedom, Joint
from ....cases.scene.rotation import UPRIGHT, about, inverse, matrix, product, turned
from ...mechanism.kinematics.space.attitude import skew
from ...mechanism.modes.space.mode import SpatialMultibody
from ...system import Array

PLACES = ("x", "y", "z")
SPEEDS = ("vx", "vy", "vz")
SPINS = ("omega_1", "omega_2", "omega_3")


@dataclass(frozen=True)
class Equation:
    """residual = 0 [m or rad], and its change with the velocities (n,); named for messages."""

    name: str
    residual: float
    row: Array


class Given:
    """The equations of one placement map (`initial` or `near`) at one q."""

    def __init__(self, case: Case, mode: SpatialMultibody) -> None:
        self.case, self.scene, self.mode = case, mode.scene, mode
        self.n = mode.where.size

    def places(self, placements: Mapping[str, Placement], q: Array) -> Iterator[Equation]:
        """Yields the equations of given positions."""
        for name, placement in placements.items():
            if name in self.scene.joints:
                yield from self._joint(self.scene.joints[name], placement, q)
                continue
            at = self.mode.where.columns[name]
            for i, field in enumerate(PLACES):
                if field in placement.given:
                    row = np.zeros(self.n)
                    row[at.r_dot + i] = 1.0
                    yield Equation(f"{name}.{field}", q[at.r + i] - placement.given[field], row)
            if placement.attitude is not None and at.attitude is not None and at.omega is not None:
                apart = _between(placement.attitude, q[at.attitude : at.attitude + 4])
                for i in range(3):
                    row = np.zeros(self.n)
                    row[at.omega + i] = 1.0
                    yield Equation(f"{name}.attitude", apart[i], row)
            for point, place in placement.points.items():
                yield from self._placed(Anchor(name, point), place, q)

    def _placed(self, anchor: Anchor, place: tuple[float, ...], q: Array) -> Iterator[Equation]:
        rows, r = self.point(anchor, q)
        for i, axis in enumerate("xyz"):
            yield Equation(f"{anchor}.{axis}", float(r[i] - place[i]), rows[i])

    def point(self, anchor: Anchor, q: Array) -> tuple[Array, Array]:
        """(3, n) the rows of a point's velocity, and its place (3,)."""
        bodies = self.mode.layout.bodies(q, np.zeros(self.n))
        points = self.mode.layout.attached([anchor])
        at = self.mode.where.columns[anchor.body]
        rows = np.zeros((3, self.n))
        rows[:, at.r_dot : at.r_dot + 3] = np.eye(3)
        if at.omega is not None:
            R = bodies.R[self.mode.layout.numbers[anchor.body]]
            rows[:, at.omega : at.omega + 3] = -R @ skew(points.x)[0]
        return rows, points.at(0.0, bodies).r[0]

    def _joint(self, joint: Joint, placement: Placement, q: Array) -> Iterator[Equation]:
        given = {freedom.name for freedom in joint.named} & placement.given.keys()
        for freedom, value, row in self.coordinates(joint, q) if given else ():
            if freedom.name and freedom.name in placement.given:
                off = value - placement.given[freedom.name]
                if freedom.kind == "turn":
                    off = float(np.remainder(off + np.pi, 2 * np.pi) - np.pi)
                yield Equation(f"{joint.name}.{freedom.name}", off, row)
        if placement.attitude is not None:
            apart = _between(placement.attitude, self.attitude(joint.name, q))
            for i, row in enumerate(self.relative(joint, q)):
                yield Equation(f"{joint.name}.attitude", apart[i], row)

    def attitude(self, part: str, q: Array) -> Array:
        """(4,) of a body; of a joint, of its second part against its first."""
        if part not in self.scene.joints:
            return attitude(self.mode, part, q)
        joint = self.scene.joints[part]
        a, b = (attitude(self.mode, at.body, q) for at in (joint.a, joint.b))
        return product(inverse(a), b)

    def relative(self, joint: Joint, q: Array) -> Array:
        """(3, n) ω of the second part against the first, in the axes of the second."""
        rows = np.zeros((3, self.n))
        a, b = (self.mode.where.columns.get(at.body) for at in (joint.a, joint.b))
        R_a, R_b = (matrix(attitude(self.mode, at.body, q)) for at in (joint.a, joint.b))
        if b is not None and b.omega is not None:
            rows[:, b.omega : b.omega + 3] = np.eye(3)
        if a is not None and a.omega is not None:
            rows[:, a.omega : a.omega + 3] = -R_b.T @ R_a
        return rows

    def coordinates(self, joint: Joint, q: Array) -> list[tuple[Freedom, float, Array]]:
        """Each freedom but a ball with its value [m or rad] and the row of its rate (n,)."""
        found: list[tuple[Freedom, float, Array]] = []
        a, b = (attitude(self.mode, at.body, q) for at in (joint.a, joint.b))
        R_a, R_b = matrix(a), matrix(b)
        if joint.shifts:
            found += self._shifts(joint, q, R_a)
        if joint.turns and joint.turns[0].kind == "turn":
            axes = [freedom.axis for freedom in joint.turns]
            still = np.zeros((1, 3))
            ways = chain.turned_by(axes, a[None], still, b[None], still)
            angles = counted(ways, np.zeros(1), joint.begun).angles
            columns, so_far = [], np.array(UPRIGHT)
            for axis, angle in zip(axes, angles[0], strict=True):
                columns.append(turned(so_far, axis))
                so_far = product(so_far, np.array(about(axis, float(angle))))
            duals = np.linalg.pinv(np.array(columns).T) @ R_a.T @ R_b  # in the axes of b
            rows = duals @ self.relative(joint, q)
            found += list(zip(joint.turns, angles[0].tolist(), rows, strict=True))
        return found

    def _shifts(self, joint: Joint, q: Array, R_a: Array) -> list[tuple[Freedom, float, Array]]:
        axes = np.array([freedom.axis for freedom in joint.shifts])
        rows_a, r_a = self.end(joint.a, q)
        rows_b, r_b = self.end(joint.b, q)
        d, rows = R_a.T @ (r_b - r_a), R_a.T @ (rows_b - rows_a)
        at = self.mode.where.columns.get(joint.a.body)
        if at is not None and at.omega is not None:
            rows[:, at.omega : at.omega + 3] += skew(d[None])[0]
        solve = np.linalg.pinv(axes.T)
        return list(zip(joint.shifts, (solve @ d).tolist(), solve @ rows, strict=True))

    def named(self, joint: Joint, q: Array) -> Iterator[Equation]:
        """The rates of its freedoms that have names; the residual is what the ground's points do.

        Against a point that moves the rate of a shift is another one than against the ground.
        """
        axes = np.array([freedom.axis for freedom in joint.shifts]).reshape(-1, 3)
        a, b = (self._driven(at) for at in (joint.a, joint.b))
        back = matrix(attitude(self.mode, joint.a.body, q)).T
        ground = np.linalg.pinv(axes.T) @ back @ (b - a) if len(axes) else np.zeros(0)
        moved = dict(zip((freedom.name for freedom in joint.shifts), ground.tolist(), strict=True))
        for freedom, _, row in self.coordinates(joint, q):
            if freedom.name:
                own = moved.get(freedom.name, 0.0)
                yield Equation(f"{joint.name}.{freedom.rate}", own, row)

    def _driven(self, anchor: Anchor) -> Array:
        """(3,) the velocity of a point of the ground; a body's stands in its rows."""
        if anchor.body != GROUND:
            return np.zeros(3)
        return np.array(self.scene.points[anchor.point].state(0.0)[3:])

    def end(self, anchor: Anchor, q: Array) -> tuple[Array, Array]:
        """As `point`; of the ground the rows are zero."""
        if anchor.body != GROUND:
            return self.point(anchor, q)
        return np.zeros((3, self.n)), np.array(self.scene.points[anchor.point].state(0.0)[:3])

    def rates(self, placements: Mapping[str, Placement], q: Array) -> Iterator[Equation]:
        """Yields the equations of given velocities: row · v = the residual's opposite."""
        for name, placement in placements.items():
            given = placement.given
            if name in self.scene.joints:
                joint = self.scene.joints[name]
                for equation in self.named(joint, q):
                    rate = equation.name.rpartition(".")[2]
                    if rate in given:
                        yield replace(equation, residual=equation.residual - given[rate])
                for i, row in enumerate(self.relative(joint, q)):
                    if SPINS[i] in given:
                        yield Equation(f"{name}.{SPINS[i]}", -given[SPINS[i]], row)
                continue
            at = self.mode.where.columns[name]
            for fields, begin in ((SPEEDS, at.r_dot), (SPINS, at.omega)):
                for i, field in enumerate(fields):
                    if field in given and begin is not None:
                        row = np.zeros(self.n)
                        row[begin + i] = 1.0
                        yield Equation(f"{name}.{field}", -given[field], row)


def attitude(mode: SpatialMultibody, body: str, q: Array) -> Array:
    """(4,) of a body, or of what has no attitude of its own: the ground's."""
    at = mode.where.columns.get(body)
    if at is None or at.attitude is None:
        return np.array(UPRIGHT)
    return q[at.attitude : at.attitude + 4] / np.linalg.norm(q[at.attitude : at.attitude + 4])


def _between(wanted: tuple[float, ...], q: Array) -> Array:
    """(3,) [rad] the turn from one attitude to the other, in the axes of q."""
    d = product(inverse(np.array(wanted)), q / np.linalg.norm(q))
    half = float(np.linalg.norm(d[1:]))
    angle = 2 * np.arctan2(half, abs(d[0])) * (1.0 if d[0] >= 0 else -1.0)
    return d[1:] * (angle / half if half > 1e-12 else 2.0 * (1.0 if d[0] >= 0 else -1.0))
