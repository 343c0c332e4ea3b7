"""The equations of a kinematic tree from its numbers, body after body from the ground outwards.

A second answer to a compiled model: it sees plain arrays, and no engine.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...cases.tree import Kind, Link, Places, Tree, TreeJoint
from ..coverage import equation
from ..system import Array


@dataclass(frozen=True)
class Frame:
    """A frame on its way, in ground axes: where it is, and how it moves.

    r (3,), E (3, 3) whose columns are its axes; ω (3,), and J_r, J_ω (3, n) with ṙ = J_r v and
    ω = J_ω v; a and α (3,): r̈ and ω̇ where v̇ = 0.
    """

    r: Array
    E: Array
    omega: Array
    J_r: Array
    J_omega: Array
    a: Array
    alpha: Array

    @equation
    def at(self, x: Array) -> "Frame":
        """(2.6), (2.7) ṙ + ω × x, r̈ + ω̇ × x + ω × (ω × x), at a point x (3,) [m] beside r."""
        turning = np.cross(self.omega, np.cross(self.omega, x))
        return replace(
            self,
            r=self.r + x,
            J_r=self.J_r + np.cross(self.J_omega, x, axis=0),
            a=self.a + np.cross(self.alpha, x) + turning,
        )

    def turned(self, J: Array, v: Array, R: Array) -> "Frame":
        """Turned by R (3, 3) in its own axes, at J v, J (3, n), of axes that it carries."""
        rate = J @ v
        alpha = self.alpha + np.cross(self.omega, rate)
        omega, J_omega = self.omega + rate, self.J_omega + J
        return replace(self, E=self.E @ R, omega=omega, J_omega=J_omega, alpha=alpha)

    def shifted(self, u: Array, s: float, J: Array, v: Array) -> "Frame":
        """Shifted by s [m] along u (3,), which it carries, at the rate J v, J (3, n)."""
        carried = self.at(u * s)
        coriolis = 2 * np.cross(self.omega, J @ v)
        return replace(carried, J_r=carried.J_r + J, a=carried.a + coriolis)


def rotation(q: Array) -> Array:
    """(3, 3): the axes of a unit quaternion (w, x, y, z), as columns; its length plays no part."""
    w, x, y, z = np.asarray(q) / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def about(axis: Array, angle: float) -> Array:
    """(3, 3): the turn by an angle [rad] about a unit vector."""
    return rotation(np.array([np.cos(angle / 2), *(np.sin(angle / 2) * np.asarray(axis))]))


@equation
def frames(tree: Tree, q: Array, v: Array) -> list[Frame]:
    """(2.8)–(2.12) R_k and E_k of each body's origin and axes, as functions of q, and rates."""
    still = np.zeros((3, tree.n))
    ground = Frame(np.zeros(3), np.eye(3), np.zeros(3), still, still, np.zeros(3), np.zeros(3))
    links: list[Frame] = []
    for link in tree.links:
        parent = ground if link.parent < 0 else links[link.parent]
        frame = replace(parent.at(parent.E @ link.place), E=parent.E @ rotation(link.attitude))
        for joint in link.joints:
            frame = MOVES[joint.kind](frame, joint, q, v)
        links.append(frame)
    return links


def _freed(frame: Frame, joint: TreeJoint, q: Array, v: Array) -> Frame:
    n, k = len(v), joint.v
    E = rotation(q[joint.q + 3 : joint.q + 7])
    placed = Frame(
        np.array(q[joint.q : joint.q + 3]), np.eye(3), np.zeros(3), _columns(np.eye(3), k, n),
        np.zeros((3, n)), np.zeros(3), np.zeros(3),
    )  # fmt: skip
    return placed.turned(_columns(E, k + 3, n), v, E)


def _slid(frame: Frame, joint: TreeJoint, q: Array, v: Array) -> Frame:
    u = frame.E @ joint.axis
    return frame.shifted(u, q[joint.q] - joint.zero, _columns(u[:, None], joint.v, len(v)), v)


def _balled(frame: Frame, joint: TreeJoint, q: Array, v: Array) -> Frame:
    R = rotation(q[joint.q : joint.q + 4])
    return _hung(frame, joint, _columns(frame.E @ R, joint.v, len(v)), v, R)


def _hinged(frame: Frame, joint: TreeJoint, q: Array, v: Array) -> Frame:
    J = _columns((frame.E @ joint.axis)[:, None], joint.v, len(v))
    return _hung(frame, joint, J, v, about(joint.axis, q[joint.q] - joint.zero))


def _hung(frame: Frame, joint: TreeJoint, J: Array, v: Array, R: Array) -> Frame:
    hung = frame.at(frame.E @ joint.anchor).turned(J, v, R)
    return hung.at(-hung.E @ joint.anchor)


MOVES: Mapping[Kind, Callable[[Frame, TreeJoint, Array, Array], Frame]] = {
    "free": _freed, "slide": _slid, "ball": _balled, "hinge": _hinged,
}  # fmt: skip
"""By a joint's kind the frame that it makes of the one before it."""


def _columns(J: Array, first: int, n: int) -> Array:
    wide = np.zeros((3, n))
    wide[:, first : first + J.shape[1]] = J
    return wide


@dataclass(frozen=True)
class Moving:
    """A body's frame in its centre of mass, and its inertia (3, 3) [kg m²] in ground axes."""

    link: Link
    centre: Frame
    J: Array


def moving(tree: Tree, q: Array, v: Array) -> list[Moving]:
    """The bodies that have mass, at q (m,) and v (n,)."""
    return [
        Moving(link, frame.at(frame.E @ link.centre), frame.E @ link.J @ frame.E.T)
        for link, frame in zip(tree.links, frames(tree, q, v), strict=True)
        if link.mass or np.any(link.J)
    ]


@equation
def mass_matrix(tree: Tree, bodies: Sequence[Moving]) -> Array:
    """(2.54) M (n, n) of T = ½ Σ m ṙ_c² + ω·J ω = ½ vᵀ M v, and the armatures."""
    M = np.diag(tree.armature).astype(np.float64)
    for body in bodies:
        at = body.centre
        M += body.link.mass * at.J_r.T @ at.J_r + at.J_omega.T @ body.J @ at.J_omega
    for line in tree.lines:
        M += line.armature * np.outer(line.coefficients, line.coefficients)
    return M


@equation
def bias(tree: Tree, bodies: Sequence[Moving]) -> Array:
    """(2.23) m r̈_c − m g, (2.33) J ω̇ + ω × J ω where v̇ = 0, of all bodies: (n,) [N, N m].

    The equations of motion are M v̇ + this = all other forces.
    """
    forces = np.zeros(tree.n)
    for body in bodies:
        force, moment = _needed(tree, body)
        forces += body.centre.J_r.T @ force + body.centre.J_omega.T @ moment
    return forces


def _needed(tree: Tree, body: Moving) -> tuple[Array, Array]:
    at = body.centre
    turning = np.cross(at.omega, body.J @ at.omega)
    return body.link.mass * (at.a - tree.gravity), body.J @ at.alpha + turning


def size_of_bias(tree: Tree, bodies: Sequence[Moving], M: Array) -> Array:
    """(n,) [N, N m]: the largest that `bias` could be with bodies that so move, whatever cancels.

    J_rᵀ F of one body is at most √(m J_r²) √(F²/m), and so is the sum of all (Cauchy–Schwarz).
    """
    square = 0.0
    for body in bodies:
        force, moment = _needed(tree, body)
        square += float(force @ force) / body.link.mass if body.link.mass else 0.0
        square += float(moment @ np.linalg.pinv(body.J) @ moment)
    return np.sqrt(np.diag(M) * square)


@dataclass(frozen=True)
class Term:
    """Forces (n,) [N, N m], and their size (n,): the largest number that cancels in them."""

    forces: Array
    size: Array

    def __add__(self, other: "Term") -> "Term":
        return Term(self.forces + other.forces, self.size + other.size)


def _lifted(tree: Tree, bodies: Sequence[Moving], coordinates: Array | bool) -> Term:
    """The weight that is compensated, in some of the coordinates."""
    forces, size = np.zeros(tree.n), np.zeros(tree.n)
    for body in bodies:
        weight = body.link.lifted * body.link.mass * tree.gravity
        forces -= body.centre.J_r.T @ weight
        size += np.linalg.norm(weight) * np.linalg.norm(body.centre.J_r, axis=0)
    return Term(np.where(coordinates, forces, 0.0), np.where(coordinates, size, 0.0))


@equation
def passive(tree: Tree, q: Array, v: Array, bodies: Sequence[Moving]) -> Term:
    """(2.45), (2.47) −c (q − q₀), −d q̇ of joints and lines, and compensated weight."""
    forces = _exact(-tree.damping * v)
    for joint, stiffness, rest in tree.springs:
        forces += _spring(joint, stiffness, rest, q, len(v))
    for line in tree.lines:
        (length, rate), (long, fast) = _length(line.coefficients, line.places, q, v)
        pull = line.stiffness * (np.clip(length, *line.spring) - length) - line.damping * rate
        size = line.stiffness * (long + abs(pull)) + line.damping * fast
        forces += Term(line.coefficients * pull, abs(line.coefficients) * size)
    by_motors = tree.weight_by_motors
    return forces + _lifted(tree, bodies, True if by_motors is None else np.logical_not(by_motors))


def _exact(forces: Array) -> Term:
    return Term(forces, np.abs(forces))


def _spring(joint: TreeJoint, stiffness: float, rest: Array, q: Array, n: int) -> Term:
    """A joint's spring; a ball's pulls along the axis of the turn from its rest."""
    forces, size = np.zeros(n), np.zeros(n)
    shifts = {"free": 3, "ball": 0}.get(joint.kind, 1)
    at, now = slice(joint.v, joint.v + shifts), q[joint.q : joint.q + shifts]
    forces[at], size[at] = rest[:shifts] - now, np.abs(rest[:shifts]) + np.abs(now)
    if joint.kind in ("free", "ball"):
        turn = slice(joint.v + shifts, joint.v + shifts + 3)
        first = joint.q + shifts
        forces[turn] = -_turn(rest[shifts : shifts + 4], q[first : first + 4])
        size[turn] = 1.0  # rad: a quaternion's numbers are rounded as 1 is
    return Term(stiffness * forces, stiffness * size)


def _turn(a: Array, b: Array) -> Array:
    """(3,) [rad]: the turn from the attitude a to b, along its axis, in the axes of b."""
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    w = float(a @ b)
    x = a[0] * b[1:] - b[0] * a[1:] - np.cross(a[1:], b[1:])
    sine = float(np.linalg.norm(x))
    if not sine:
        return np.zeros(3)
    angle = 2 * np.arctan2(sine, w)
    return x / sine * (angle - 2 * np.pi if angle > np.pi else angle)


def _length(J: Array, places: Places, q: Array, v: Array) -> tuple[tuple[float, float], ...]:
    """Returns ℓ = Σ J q and its rate, and the sums of the absolute terms of both."""
    shares, rates = J * q[places], J * v
    sums = float(shares.sum()), float(rates.sum())
    return sums, (float(np.abs(shares).sum()), float(np.abs(rates).sum()))


def driven(tree: Tree, q: Array, v: Array, u: Array, bodies: Sequence[Moving]) -> Term:
    """The forces of the motors at controls u, each clamped, with the weight that they lift.

    What a joint takes of all of them together is clamped last.
    """
    forces = _exact(np.zeros(tree.n))
    for motor in tree.motors:
        lengths, sizes = _length(motor.moments, motor.places, q, v)
        state, large = np.array([1.0, *lengths]), np.array([1.0, *sizes])
        control = np.clip(u[motor.u], *motor.control)
        free = np.dot(motor.gain, state) * control + np.dot(motor.bias, state)
        size = np.dot(np.abs(motor.gain), large) * abs(control) + np.dot(np.abs(motor.bias), large)
        forces += Term(motor.moments * np.clip(free, *motor.force), np.abs(motor.moments) * size)
    if tree.weight_by_motors is not None:
        forces += _lifted(tree, bodies, tree.weight_by_motors)
    if tree.clamped is None:
        return forces
    return Term(np.clip(forces.forces, *tree.clamped.T), forces.size)
