"""Any scene as a Mode, in maximal coordinates with multipliers (2.60)."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ....cases.scene import GROUND, Anchor
from ...system import Array, Mass, Mode, Pose, Vector
from ..constraints.constraint import Constraint, residuals, row, tracked
from ..constraints.constraint_solver import Holding
from ..constraints.contact import Braking, Coulomb
from ..constraints.equation_table import G, Rows, Table, span
from ..constraints.factorization import Dependent, Held
from ..constraints.joint_constraints import constraints
from ..forces.action import NoDirection, actions
from ..forces.ingredients import Ingredients
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

    q and v hold the coordinates of each body in the scene's order (a particle has no attitude), q
    the inner states of forces behind them. `held` are constraints beside those of the scene,
    `braking` and `coulomb` what slides with dry friction. `shared`: what sticks by several points
    of a body. `slack`: the springs that do not act. `base`: a mode of the scene whose coordinates,
    constraints and table this one shares.
    """

    where: Any  # the scene's coordinates, in the plane or in space

    def __init__(
        self,
        scene: Any,
        start: tuple[Array, Array],
        *,
        held: Sequence[Constraint] = (),
        braking: Sequence[Braking] = (),
        coulomb: Sequence[Coulomb] = (),
        shared: Sequence[Shared] = (),
        slack: Collection[str] = (),
        base: "Multibody | None" = None,
    ) -> None:
        self.scene, self._start = scene, start
        self.where = self._laid_out(scene) if base is None else base.where
        self.coordinates = (*self.where.names, *self.where.inner)
        self.masses = {b.name: Mass(b.mass, self.where.inertia(b)) for b in scene.bodies.values()}
        self._M = np.array(self.where.masses)
        self.permanent: list[Constraint] = (
            constraints(scene, self.where, start[0].tolist()) if base is None else base.permanent
        )
        self._constraints = [*self.permanent, *held]
        self.owners = [c.part for c in self._constraints for _ in range(c.size)]
        self._r = len(self.owners)
        acting = actions([f for f in scene.forces.values() if f.name not in slack])
        self.ingredients = Ingredients(self.where, acting)
        self._lined = [action.name for action in acting if action.line]
        self._slack = slack
        self._read(self._written(actions(list(scene.forces.values())), base))
        self._braking, self._shared = braking, shared
        places = np.cumsum([0, *(c.size for c in self._constraints)]).tolist()
        self._coulomb = [(places[self._constraints.index(law.normal)], law) for law in coulomb]
        self._weight = np.zeros(len(self._M))
        for name, at in self.where.slots.items():
            for i, g in enumerate(scene.gravity):
                self._weight[at.r_dot + i] = scene.bodies[name].mass * g
        self._prepare()

    def _laid_out(self, scene: Any) -> Any:
        return Coordinates(scene)

    def _written(self, forces: Sequence[Any], base: "Multibody | None") -> Table:
        """The table of all that acts and holds; that of the base, if it has it all."""
        if base is not None and base.table.has(self._constraints):
            return base.table
        return Table(self.where, self._constraints, [*forces, *self._beside()])

    def _beside(self) -> Sequence[Any]:
        """The loads on bodies beside those of the scene's forces."""
        return ()

    def widen(self, more: Sequence[Constraint]) -> None:
        """Writes constraints into its table that other modes hold, who share it."""
        self._read(Table(self.where, [*self._constraints, *more], self.table.forces))
        self._prepare()

    def _read(self, table: Table) -> None:
        """Takes the numbers of what holds in it and of what is at work from a table."""
        self.table, self._rows = table, Rows(table, self._constraints)
        self._forces = {
            force.name: table.size + i
            for i, force in enumerate(table.forces)
            if force.name not in self._slack
        }
        self._at_work = span(np.array(list(self._forces.values()), np.intp))

    def _prepare(self) -> None:
        """Prepares the solver of its equations."""
        masses = [mass.m for mass in self.masses.values()]
        self._turns = TURNS if max(masses) > UNEVEN * min(masses) else min(TURNS, 1)
        self.holding = Holding(self._rows, self._M, self._coulomb)

    def start(self) -> tuple[Array, Array]:
        """The assembled start."""
        return self._start

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.5), (2.6) q̇ of the bodies; inner states have their own."""
        rates = self.where.rates(q, v)
        if not self.where.inner:
            return rates
        return np.concatenate([rates, self._inner_rates(t, q, v)])

    def _inner_rates(self, t: Any, q: Vector, v: Vector) -> list[Any]:
        return self.ingredients.rate(t, q, v)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) M v̇ = Q + λ_b f_aᵇ with f_aᵇ v̇ᵃ = γᵇ, (n,)."""
        return self.solve(t, q, v)[0]

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: the force of the first part on the second, by quantity."""
        return self.reactions_from(t, q, v, self.solve(t, q, v)[1].tolist())

    def reactions_from(
        self, t: float, q: Array, v: Array, multipliers: Sequence[float]
    ) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ of given multipliers (r,), by quantity."""
        numbers, of_floor = q.tolist(), ("normal", "tangent")
        forces = {f"{name}.{way}": 0.0 for name in self.scene.pressed for way in of_floor}
        _add(forces, self._exerted(t, numbers, multipliers))
        for brake in self._braking:
            _add(forces, brake.along.reactions(t, numbers, [brake.force(t, q, v)]))
        for at, law in self._coulomb:
            _add(forces, law.tangent.reactions(t, numbers, [law.factor * multipliers[at]]))
        idle = [f"{joint.name}.torque" for joint in self.scene.joints.values() if not joint.turns]
        idle += [force for limit in self.scene.limits() for force in limit.reactions()]
        forces = dict.fromkeys(idle, 0.0) | forces  # particles take no moment, ropes may be slack
        for shared in self._shared:
            forces |= shared.divided(forces)
        for contact in self.scene.contacts.values():
            for way in of_floor if contact.tips else ():
                each = (forces[f"{point.name}.{way}"] for point in contact.each())
                forces[f"{contact.name}.{way}"] = sum(each)
        return forces

    def _exerted(self, t: float, q: Sequence[float], multipliers: Any) -> dict[str, float]:
        """(2.60) λ_b f_aᵇ of its own rows."""
        pairs = zip(self._rows.places.tolist(), multipliers, strict=True)
        return self.table.reactions(t, q, dict(pairs))

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
        return _at_rest(held, a, free, multipliers), multipliers

    def applied(self, t: float, q: Array, v: Array) -> Array:
        """(2.23), (2.60) Q: weights, forces and the friction of slides that move, (n,).

        Raises NoDirection for a spring that passes through zero length: its force would jump.
        """
        Q = self._weight
        if self._forces:
            Q = Q + self.table.numbers(t, q, v)[self._at_work, :G].sum(axis=0)
            if self._lined and np.isnan(Q).any():
                for name in self._short(t, q, v):  # of none where a force is beyond all numbers
                    raise NoDirection(name)
        for brake in self._braking:
            Q = Q + brake.force(t, q, v) * row(brake.along, t, q, v)[0]
        return Q

    def _short(self, t: float, q: Array, v: Array) -> Iterator[str]:
        numbers = self.table.numbers(t, q, v)
        yield from (name for name in self._lined if np.isnan(numbers[self._forces[name]]).any())

    def _held(self, t: float, q: Array, v: Array) -> Held:
        """The rows at a state, with their factors."""
        try:
            return self.holding.at(t, q, v)
        except Dependent as dependent:
            raise SingularPose(self.owners[dependent.row]) from dependent

    def rows(self, t: Any, q: Vector, v: Vector) -> tuple[Vector, Vector, Vector]:
        """(2.15) f_a (r, n) and g (r,), and γ (r,) of f_a v̇ᵃ = γ."""
        return self._rows(t, q, v)

    def forces(self, t: float, q: Array, v: Array) -> dict[str, Array]:
        """(2.50) The generalized force (n,) of each force element by itself, by name."""
        numbers = self.table.numbers(t, q, v)
        return {name: numbers[at, :G] for name, at in self._forces.items()}

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
        """The largest force [N] or moment [N m] along each coordinate that comes from one force.

        One along a line without length has no direction, and no part in it: it may be slack.
        """
        each = [self._weight, *self.forces(t, q, v).values()]
        return np.max(np.nan_to_num(np.abs(each), nan=0.0), axis=0)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k, E_k: the coordinates themselves."""
        inner = {name: (q[place],) for name, place in self.where.inner.items()}
        return self.where.poses(q, v) | inner

    def place(self, poses: Mapping[str, Pose]) -> tuple[Array, Array]:
        """q and v of given poses: how another system's motion is read in these coordinates."""
        return self.where.place(poses)

    def driven_point(self, name: str, t: float) -> tuple[float, ...]:
        """Place and velocity of a point of the ground that moves."""
        q, v = self._start[0], np.zeros(len(self._M))
        point = tracked(Anchor(GROUND, name), self.where)
        return *point.places(t, q.tolist()), *(-point.alone.rows(t, q, v)[1]).tolist()

    def without_direction(self, t: float, q: Array, within: float) -> str | None:
        """The first force along a line that is shorter than that [m]."""
        lengths = self.ingredients.lengths(t, q)
        return next((name for name, length in lengths if length < within), None)

    # The ingredients: the same mechanism from its energies and residuals alone.

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ Σ m ṙ_c² + ½ Σ ω·J ω [J] of the rates q̇ (m,) or (m, K)."""
        return self.where.T(q, v)

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −Σ m g·r_c + Σ ½ c (λ − λ₀)² [J]."""
        energy = self.ingredients.U(t, q)
        for name, at in self.where.slots.items():
            for i, g in enumerate(self.scene.gravity):
                energy = energy - self.masses[name].m * g * q[at.r + i]
        return energy

    def V(self, t: Any, q: Vector, v: Vector) -> Any:
        """V = Σ ½ e B (y ẋ − x ẏ) [J] as (2.48) has it."""
        return self.ingredients.V(t, q, v)

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = Σ ½ d λ̇² [W], λ̇ = Δ·Δ̇/λ."""
        return 0.0 * v[0] + self.ingredients.D(t, q, v)

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q_a = Σ F·∂r/∂qᵃ of pushes, torques and dry friction, (n,)."""
        Q = self.ingredients.Q4(t, q, v)
        for brake in self._braking:
            Q = Q + brake.force(t, q, v) * row(brake.along, t, q, v)[0]
        if self._coulomb:
            multipliers = self.solve(t, q, v)[1]
            for at, law in self._coulomb:
                Q = Q + law.factor * multipliers[at] * row(law.tangent, t, q, v)[0]
        return Q

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.10), (2.14) the residuals of all that is holonomic, (≤ r,)."""
        return np.array(residuals(self.table, self._constraints, t, q.tolist()))

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.55) the rows f_aᵇ, (r, n)."""
        return self.rows(t, q, self._at_rest(q))[0]

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) the right side f_aᵇ q̇ᵃ = gᵇ of driven points, (r,)."""
        return self.rows(t, q, self._at_rest(q))[1]

    def _at_rest(self, q: Vector) -> Vector:
        return np.zeros(len(self._M), q.dtype)


def _add(total: dict[str, float], more: Mapping[str, float]) -> None:
    """A slide's force across it and its friction along it make one force."""
    for name, value in more.items():
        total[name] = total.get(name, 0.0) + value


def _at_rest(held: Held, a: Array, free: Array, multipliers: Array) -> Array:
    """Accelerations, and zero where forces cancel to rounding: what is held rests.

    Otherwise a body that sticks at the origin would tremble by 1e-17, which is no size for a step.
    The forces may all be multipliers: of a block between two that stick to it.
    """
    small = CANCELS * max(map(abs, free.tolist()))
    if min(map(abs, a.tolist())) > small:  # as nearly always, and told without arrays
        return a
    size = np.abs(a)
    if ((size <= small) & (size > 0.0)).any():
        a[size <= CANCELS * (np.abs(free) + held.acceleration_sizes(multipliers))] = 0.0
    return a
