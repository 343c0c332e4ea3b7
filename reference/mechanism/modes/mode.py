"""Any planar scene as a Mode, in maximal coordinates with multipliers (2.60)."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np

from ....cases.scene import Scene
from ...system import Array, Mass, Mode, Pose, Vector
from ..constraints.constraint import Constraint, assembled, residuals
from ..constraints.constraint_solver import Holding
from ..constraints.contact import Braking, Coulomb, row
from ..constraints.factorization import Dependent, Held
from ..constraints.joint_constraints import constraints
from ..forces.action import (
    act,
    dissipation,
    ends_meet,
    generalized_potential,
    inner_rate,
    other,
    potential,
)
from ..kinematics.coordinates import Coordinates
from .shared_friction import Shared

TURNS = 2  # of refinement, each with the digits of the first solution: 10 of 16 may be lost
UNEVEN = 1e3  # the heaviest mass beside the lightest: up to that one turn is enough
CANCELS = 1e-15  # of one of two accelerations: what is left of them is their rounding


class SingularPose(ArithmeticError):
    """Where the constraints depend on each other: no single reaction, no single motion."""

    def __init__(self, part: str) -> None:
        super().__init__(f"what {part} holds is held by the others already")


class Multibody(Mode):
    """Newton's and Euler's equations of all bodies, held together by multipliers.

    q holds x, y, angle of each body in the scene's order (a particle has no angle). `held` are
    constraints beside those of the joints, `braking` and `coulomb` what slides with dry friction.
    `shared`: what sticks by several points of a body. `slack`: the springs that do not act.
    """

    def __init__(
        self,
        scene: Scene,
        start: tuple[Array, Array],
        *,
        held: Sequence[Constraint] = (),
        braking: Sequence[Braking] = (),
        coulomb: Sequence[Coulomb] = (),
        shared: Sequence[Shared] = (),
        slack: Collection[str] = (),
    ) -> None:
        self.scene = scene
        self._forces = [f for f in scene.forces.values() if f.name not in slack]
        self.where = Coordinates(scene)
        self.coordinates = (*self.where.names, *self.where.inner)
        self.masses = {
            b.name: Mass(b.mass, b.moment if b.turns else None) for b in scene.bodies.values()
        }
        self._start = start
        self._M = np.array(self.where.masses)
        self._constraints = [*constraints(scene, self.where, start[0].tolist()), *held]
        self._owners = [c.part for c in self._constraints for _ in range(c.size)]
        self._r = len(self._owners)
        masses = [mass.m for mass in self.masses.values()]
        self._turns = TURNS if max(masses) > UNEVEN * min(masses) else min(TURNS, 1)
        self._braking, self._shared = braking, shared
        places = np.cumsum([0, *(c.size for c in self._constraints)]).tolist()
        self._coulomb = [(places[self._constraints.index(law.normal)], law) for law in coulomb]
        rows = assembled(self._constraints, self.where)
        self.holding = Holding(rows, self._M, self._coulomb)
        self._residuals = residuals(self._constraints, self.where)
        self._weight = np.zeros(len(self._M))
        for body in scene.bodies.values():
            xy, _ = self.where.columns[body.name]
            self._weight[xy : xy + 2] = body.mass * np.asarray(scene.gravity)

    def start(self) -> tuple[Array, Array]:
        """The assembled start."""
        return self._start

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """q̇ = v of the bodies; inner states have their own."""
        if not self.where.inner:
            return v
        own = [inner_rate(f, self.where, t, q.tolist()) for f in self.scene.inner().values()]
        return np.concatenate([v, own])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) M q̈ = Q + λ_b f_aᵇ with f_aᵇ q̈ᵃ = γᵇ, (n,)."""
        return self.solve(t, q, v)[0]

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: the force of the first part on the second, by quantity."""
        return self.told(t, q, v, self.solve(t, q, v)[1].tolist())

    def told(self, t: float, q: Array, v: Array, multipliers: Sequence[float]) -> dict[str, float]:
        """(2.60) The same of given multipliers (r,)."""
        at, numbers, of_floor = 0, q.tolist(), ("normal", "tangent")
        found = {f"{name}.{way}": 0.0 for name in self.scene.pressed for way in of_floor}
        for c in self._constraints:
            _add(found, c.reactions(t, numbers, multipliers[at : at + c.size]))
            at += c.size
        for brake in self._braking:
            _add(found, brake.along.reactions(t, numbers, [brake.force(t, q, v)]))
        for at, law in self._coulomb:
            _add(found, law.tangent.reactions(t, numbers, [law.factor * multipliers[at]]))
        idle = [f"{joint.name}.torque" for joint in self.scene.joints.values() if not joint.turns]
        idle += self.scene.limits()
        found = dict.fromkeys(idle, 0.0) | found  # a particle takes no moment, a rope may be slack
        for shared in self._shared:
            found |= shared.divided(found)
        for contact in self.scene.contacts.values():
            for way in of_floor if contact.tips else ():
                each = (found[f"{point.name}.{way}"] for point in contact.each())
                found[f"{contact.name}.{way}"] = sum(each)
        return found

    def solve(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        """(2.60) q̈ (n,) and the multipliers (r,), those of `held` last.

        A bob on a light rod: its weight divided by the rod's mass is an acceleration whose rounding
        is larger than the rod's own.  What the rows leave of f_a q̈ᵃ = γ is solved for again, which
        gives back the digits (refinement): it is the nearest q̈, in M, that meets the rows.
        """
        held, free = self._held(t, q, v), self.applied(t, q, v) / self._M
        if not self._r:
            return free, np.zeros(0)
        multipliers = held.solve(held.gamma - held.along(free))
        a = free + held.pulled(multipliers)
        for _ in range(self._turns):
            change = held.solve(held.gamma - held.along(a))
            a, multipliers = a + held.pulled(change), multipliers + change
        return _at_rest(a, free), multipliers

    def applied(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) Q: weights, forces and the friction of slides that move, (n,)."""
        numbers, rates = q.tolist(), v.tolist()
        Q = self._weight.copy()
        for force in self._forces:
            act(force, self.where, t, numbers, rates, Q)
        for brake in self._braking:
            Q += brake.force(t, q, v) * row(brake.along, t, q, v)[0]
        return Q

    def _held(self, t: float, q: Array, v: Array) -> Held:
        """The rows at a state, with their factors."""
        try:
            return self.holding.at(t, q, v)
        except Dependent as dependent:
            raise SingularPose(self._owners[dependent.row]) from dependent

    def rows(self, t: Any, q: Vector, v: Vector) -> tuple[Vector, Vector, Vector]:
        """(2.15) f_a (r, n) and g (r,), and γ (r,) of f_a q̈ᵃ = γ."""
        return self.holding.rows(t, q, v)

    def terms(self, t: float, q: Array, v: Array) -> tuple[float, float]:
        """The largest acceleration [m/s² or rad/s²] and power [W] that one force gives alone.

        The power is that of a force along the velocity: what hangs trembles across its weight.
        """
        largest, turning = self.largest(t, q, v), self.where.turning
        powers = [
            np.max(largest[kind], initial=0.0) * np.max(np.abs(v[kind]), initial=0.0)
            for kind in (turning, ~turning)
        ]
        return float(np.max(largest / self._M)), float(np.max(powers))

    def largest(self, t: float, q: Array, v: Array) -> Array:
        """The largest force [N] or moment [N m] along each coordinate that comes from one force."""
        found = [self._weight]
        for force in self._forces:
            Q = np.zeros(len(self._M))
            act(force, self.where, t, q.tolist(), v.tolist(), Q)
            found.append(Q)
        return np.max(np.abs(found), axis=0)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k, E_k: the coordinates themselves."""
        inner = {name: (q[place],) for name, place in self.where.inner.items()}
        return self.where.poses(q, v) | inner

    def place(self, poses: Mapping[str, Pose]) -> tuple[Array, Array]:
        """q and v of given poses: how another system's motion is read in these coordinates."""
        return self.where.place(poses)

    def without_direction(self, t: float, q: Array, within: float) -> str | None:
        """The first force along a line that is shorter than that [m]."""
        here = t, q.tolist(), within
        meet = (f.name for f in self._forces if ends_meet(f, self.where, *here))
        return next(meet, None)

    # The ingredients: the same mechanism from its energies and residuals alone.

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ Σ m ṙ_c² + ½ Σ J ω² [J]."""
        v = v[: len(self._M)]
        return 0.5 * self._M.dot(v * v)

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −Σ m g·r_c + Σ ½ c (λ − λ₀)² [J]."""
        energy = -np.sum(self._weight * q[: len(self._M)])
        for force in self._forces:
            energy = energy + potential(force, self.where, t, q.tolist())
        return energy

    def V(self, t: Any, q: Vector, v: Vector) -> Any:
        """V = Σ ½ e B (y ẋ − x ẏ) [J] as (2.48) has it."""
        return sum((generalized_potential(f, self.where, t, q, v) for f in self._forces), 0.0)

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = Σ ½ d λ̇² [W], λ̇ = Δ·Δ̇/λ."""
        power = 0.0 * v[0]
        for force in self._forces:
            power = power + dissipation(force, self.where, t, q.tolist(), v.tolist())
        return power

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q_a = Σ F·∂r/∂qᵃ of pushes, torques and dry friction, (n,)."""
        Q = np.zeros(len(self._M), np.result_type(q, v, t))
        for force in self._forces:
            other(force, self.where, t, q.tolist(), v.tolist(), Q)
        for brake in self._braking:
            Q += brake.force(t, q, v) * row(brake.along, t, q, v)[0]
        if self._coulomb:
            multipliers = self.solve(t, q, v)[1]
            for at, law in self._coulomb:
                Q += law.factor * multipliers[at] * row(law.tangent, t, q, v)[0]
        return Q

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.10), (2.14) the residuals of all joints and contacts, (r,)."""
        return self._residuals(t, q)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.55) the rows f_aᵇ, (r, n)."""
        return self.rows(t, q, q[: len(self._M)])[0]

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) the right side f_aᵇ q̇ᵃ = gᵇ of driven points, (r,)."""
        return self.rows(t, q, q[: len(self._M)])[1]


def _add(found: dict[str, float], more: Mapping[str, float]) -> None:
    """A slide's force across it and its friction along it make one force."""
    for name, value in more.items():
        found[name] = found.get(name, 0.0) + value


def _at_rest(a: Array, free: Array) -> Array:
    """Accelerations, and zero where forces cancel to rounding: what is held rests.

    Otherwise a body that sticks at the origin would tremble by 1e-17, which is no size for a step.
    """
    a[np.abs(a) <= CANCELS * np.abs(free)] = 0.0
    return a
