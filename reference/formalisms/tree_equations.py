"""The equations of a kinematic tree from its numbers, body after body from the ground outwards.

A second answer to a compiled model: it sees plain arrays, and no engine.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...cases.tree import Kind, Motor, Tree, TreeJoint
from ..coverage import equation
from ..system import Array


@dataclass(frozen=True)
class Axes:
    """How the velocities move what they carry: by w (n, 3) each turns it, by s (n, 3) shifts it.

    A point x of a body has ẋ = Σ v_k (w_k × x + s_k) over those k that carry the body: s_k is how
    fast what moves with v_k passes the origin. p (n, 3): a point that the turn leaves at rest.
    """

    w: Array
    p: Array
    t: Array  # (n, 3): how fast p is shifted

    @property
    @equation
    def s(self) -> Array:
        """(2.7) ṙ + ω × x, of the origin."""
        return self.t - cross(self.w, self.p)


def cross(a: Array, b: Array) -> Array:
    """(N, 3): a × b, row by row; np.cross takes several times as long."""
    return a[:, NEXT] * b[:, AFTER] - a[:, AFTER] * b[:, NEXT]


NEXT, AFTER = [1, 2, 0], [2, 0, 1]


def rotation(q: Array) -> Array:
    """(3, 3): the axes of a unit quaternion (w, x, y, z), as columns; its length plays no part."""
    w, x, y, z = np.asarray(q).tolist()
    n = 2.0 / (w * w + x * x + y * y + z * z)
    return np.array(
        [
            [1 - n * (y * y + z * z), n * (x * y - w * z), n * (x * z + w * y)],
            [n * (x * y + w * z), 1 - n * (x * x + z * z), n * (y * z - w * x)],
            [n * (x * z - w * y), n * (y * z + w * x), 1 - n * (x * x + y * y)],
        ]
    )


def about(axis: Array, angle: float) -> Array:
    """(3, 3): the turn by an angle [rad] about a unit vector."""
    sine, (x, y, z) = math.sin(angle / 2), axis.tolist()
    return rotation(np.array([math.cos(angle / 2), sine * x, sine * y, sine * z]))


Placed = tuple[Array, Array]
"""Where a frame is, r (3,), and its axes, the columns of E (3, 3); both in ground axes."""


@equation
def placed(tree: Tree, q: Array) -> tuple[list[Placed], Axes]:
    """(2.8)–(2.12) R_k and E_k of each body's origin and axes, as functions of q; the axes."""
    axes = Axes(*(np.zeros((tree.n, 3)) for _ in range(3)))
    links: list[Placed] = []
    for link in tree.links:
        r, E = (np.zeros(3), np.eye(3)) if link.parent < 0 else links[link.parent]
        frame = r + E @ link.place, E @ rotation(link.attitude)
        for joint in link.joints:
            frame = MOVES[joint.kind](frame, joint, q, axes)
        links.append(frame)
    return links, axes


def _free_frame(frame: Placed, joint: TreeJoint, q: Array, axes: Axes) -> Placed:
    r, E = q[joint.q : joint.q + 3], rotation(q[joint.q + 3 : joint.q + 7])
    k = joint.v
    axes.t[k : k + 3], axes.w[k + 3 : k + 6], axes.p[k + 3 : k + 6] = np.eye(3), E.T, r
    return r, E


def _slide_frame(frame: Placed, joint: TreeJoint, q: Array, axes: Axes) -> Placed:
    r, E = frame
    u = axes.t[joint.v] = E @ joint.axis
    return r + u * (q[joint.q] - joint.zero), E


def _ball_frame(frame: Placed, joint: TreeJoint, q: Array, axes: Axes) -> Placed:
    return _turned_frame(frame, joint, rotation(q[joint.q : joint.q + 4]), np.eye(3), axes)


def _hinge_frame(frame: Placed, joint: TreeJoint, q: Array, axes: Axes) -> Placed:
    turn = about(joint.axis, float(q[joint.q]) - joint.zero)
    return _turned_frame(frame, joint, turn, joint.axis[None], axes)


def _turned_frame(frame: Placed, joint: TreeJoint, R: Array, turns: Array, axes: Axes) -> Placed:
    """The frame turned by R about the anchor; its rates turn it about the axes (k, 3)."""
    (r, E), at = frame, slice(joint.v, joint.v + len(turns))
    anchor, hung = r + E @ joint.anchor, E @ R
    axes.p[at], axes.w[at] = anchor, turns @ hung.T
    return anchor - hung @ joint.anchor, hung


MOVES: Mapping[Kind, Callable[[Placed, TreeJoint, Array, Axes], Placed]] = {
    "free": _free_frame, "slide": _slide_frame, "ball": _ball_frame, "hinge": _hinge_frame,
}  # fmt: skip
"""By a joint's kind the frame that it makes of the one before it; it notes its axes."""


@dataclass(frozen=True)
class Moving:
    """The B bodies that have mass, as they move at v (n,): of their centres of mass, and turning.

    mass (B,), J (B, 3, 3) [kg m²] in ground axes, omega (B, 3); J_r, J_omega (B, 3, n) with
    ṙ = J_r v and ω = J_ω v; a and alpha (B, 3): r̈ and ω̇ where v̇ = 0. lifted (B,): the share of
    their weight that is compensated.
    """

    mass: Array
    J: Array
    omega: Array
    J_r: Array
    J_omega: Array
    a: Array
    alpha: Array
    lifted: Array


@equation
def moving(tree: Tree, q: Array, v: Array) -> Moving:
    """(2.6), (2.7) ṙ + ω × x and its rate r̈ + ω̇ × x + ω × (ω × x) of all bodies, by v (n,)."""
    frames, axes = placed(tree, q)
    heavy = [k for k, link in enumerate(tree.links) if link.mass or np.any(link.J)]
    links = [tree.links[k] for k in heavy]
    carried = tree.carried[heavy]
    E = np.array([frames[k][1] for k in heavy]).reshape(-1, 3, 3)
    r = np.array([frames[k][0] + frames[k][1] @ tree.links[k].centre for k in heavy])
    r = r.reshape(-1, 3)
    w, s, v = axes.w, axes.s, v[:, None]
    turning, passing = tree.before @ (w * v), tree.before @ (s * v)  # of what carries each axis
    w_rate = cross(turning, w)
    p_rate = cross(turning, axes.p) + passing
    s_rate = cross(turning, axes.t) - cross(w_rate, axes.p) - cross(w, p_rate)
    omega, alpha = carried @ (w * v), carried @ (w_rate * v)
    r_rate = cross(omega, r) + carried @ (s * v)
    J = np.array([link.J for link in links]).reshape(-1, 3, 3)
    columns = carried[:, None, :]
    return Moving(
        np.array([link.mass for link in links]),
        E @ J @ E.transpose(0, 2, 1),
        omega,
        columns * (s.T - _skew(r) @ w.T),
        columns * w.T,
        cross(alpha, r) + cross(omega, r_rate) + carried @ (s_rate * v),
        alpha,
        np.array([link.lifted for link in links]),
    )


def _skew(r: Array) -> Array:
    """(B, 3, 3): r × as matrices."""
    x, y, z = r.T
    zero = np.zeros_like(x)
    return np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)


def _project(J: Array, vectors: Array) -> Array:
    """(n,): Σ Jᵀ F over all bodies, J (B, 3, n), F (B, 3)."""
    return J.reshape(-1, J.shape[2]).T @ vectors.ravel()


@equation
def mass_matrix(tree: Tree, bodies: Moving) -> Array:
    """(2.54) M (n, n) of T = ½ Σ m ṙ_c² + ω·J ω = ½ vᵀ M v, and the armatures."""
    shifts = (np.sqrt(bodies.mass)[:, None, None] * bodies.J_r).reshape(-1, tree.n)
    turns = bodies.J_omega.reshape(-1, tree.n)
    M = shifts.T @ shifts + turns.T @ (bodies.J @ bodies.J_omega).reshape(-1, tree.n)
    for line in tree.lines:
        M += line.armature * np.outer(line.coefficients, line.coefficients)
    return M + np.diag(tree.armature)


@equation
def bias(tree: Tree, bodies: Moving) -> Array:
    """(2.23) m r̈_c − m g, (2.33) J ω̇ + ω × J ω where v̇ = 0, of all bodies: (n,) [N, N m].

    The equations of motion are M v̇ + this = all other forces.
    """
    forces, moments = _needed(tree, bodies)
    return _project(bodies.J_r, forces) + _project(bodies.J_omega, moments)


def _needed(tree: Tree, bodies: Moving) -> tuple[Array, Array]:
    turning = cross(bodies.omega, _times(bodies.J, bodies.omega))
    forces = bodies.mass[:, None] * (bodies.a - tree.gravity)
    return forces, _times(bodies.J, bodies.alpha) + turning


def _times(matrices: Array, vectors: Array) -> Array:
    return (matrices @ vectors[:, :, None])[:, :, 0]


def size_of_bias(tree: Tree, bodies: Moving, M: Array) -> Array:
    """(n,) [N, N m]: the largest that `bias` could be with bodies that so move, whatever cancels.

    J_rᵀ F of one body is at most √(m J_r²) √(F²/m), and so is the sum of all (Cauchy–Schwarz).
    """
    forces, moments = _needed(tree, bodies)
    heavy = bodies.mass > 0.0
    square = float(((forces[heavy] ** 2).sum(axis=1) / bodies.mass[heavy]).sum())
    inverse: Array = np.linalg.pinv(bodies.J).astype(np.float64)
    square += float((moments * _times(inverse, moments)).sum())
    return np.sqrt(np.diag(M) * square)


@dataclass(frozen=True)
class Term:
    """Forces (n,) [N, N m], and their size (n,): the largest number that cancels in them."""

    forces: Array
    size: Array

    def __add__(self, other: "Term") -> "Term":
        return Term(self.forces + other.forces, self.size + other.size)


def _lifted(tree: Tree, bodies: Moving, coordinates: Array | bool) -> Term:
    """The weight that is compensated, in some of the coordinates."""
    weights = (bodies.lifted * bodies.mass)[:, None] * tree.gravity
    size = np.linalg.norm(weights, axis=1) @ np.linalg.norm(bodies.J_r, axis=1)
    forces = -_project(bodies.J_r, weights)
    return Term(np.where(coordinates, forces, 0.0), np.where(coordinates, size, 0.0))


@equation
def passive(tree: Tree, q: Array, v: Array, bodies: Moving) -> Term:
    """(2.45), (2.47) −c (q − q₀), −d q̇ of joints and lines, and compensated weight."""
    forces = _exact(-tree.damping * v)
    for joint, stiffness, rest in tree.springs:
        forces += _spring(joint, stiffness, rest, q, len(v))
    for line in tree.lines:
        lengths, sizes = _lengths(tree, line.coefficients[None], q, v)
        (length, rate), (long, fast) = lengths[0].tolist(), sizes[0].tolist()
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


def _lengths(tree: Tree, J: Array, q: Array, v: Array) -> tuple[Array, Array]:
    """Returns (k, 2) ℓ = Σ J q and ℓ̇, and the sums of the absolute terms of both; J (k, n)."""
    terms = np.stack([J * q[tree.places], J * v], axis=1)
    return terms.sum(axis=2), np.abs(terms).sum(axis=2)


def driven(tree: Tree, q: Array, v: Array, u: Array, bodies: Moving) -> Term:
    """The forces of the motors at controls u, each clamped, with the weight that they lift.

    What a joint takes of all of them together is clamped last.
    """
    forces = _exact(np.zeros(tree.n))
    if tree.motors:
        gear, gains, biases, low, high, weak, strong = _motor_arrays(tree.motors)
        lengths, sizes = (np.insert(of, 0, 1.0, axis=1) for of in _lengths(tree, gear, q, v))
        control = np.clip(u[[motor.u for motor in tree.motors]], low, high)
        free = (gains * lengths).sum(axis=1) * control + (biases * lengths).sum(axis=1)
        size = (abs(gains) * sizes).sum(axis=1) * abs(control) + (abs(biases) * sizes).sum(axis=1)
        forces = Term(np.clip(free, weak, strong) @ gear, size @ abs(gear))
    if tree.weight_by_motors is not None:
        forces += _lifted(tree, bodies, tree.weight_by_motors)
    if tree.clamped is None:
        return forces
    return Term(np.clip(forces.forces, *tree.clamped.T), forces.size)


def _motor_arrays(motors: Sequence[Motor]) -> tuple[Array, ...]:
    """Returns of all motors: moments (k, n), gain and bias (k, 3), limits of control and force."""
    rows = ((x.moments, x.gain, x.bias, *x.control, *x.force) for x in motors)
    return tuple(np.array(column) for column in zip(*rows, strict=True))
