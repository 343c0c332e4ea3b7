"""The explicit accelerations of every mode against the chapter's formalisms, along its motion.

All of it is asked at one state at a time: no error of an integrator is in it. What leaves the
multipliers out is asked at a state beside the motion: it costs many times as much.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from ...cases.scene.frame import SPACE
from ...cases.trajectory import Trajectory
from ..formalisms import appell, chaplygin, energy, lagrange, lagrangian, newton_euler, voronets
from ..formalisms.dependent import dependent
from ..formalisms.lagrange import constraint_rows, derivative, rate_matrix
from ..integrators.now import reached
from ..mechanism.forces.action import NoDirection
from ..mechanism.modes.mechanism import Mechanism
from ..mechanism.modes.mode import Multibody
from ..mechanism.modes.spatial_mode import SpatialMultibody
from ..motion.bodies import Answer
from ..system import Array, Mode
from .agreement import Check, gravest, worst
from .reaction_check import reactions, rounding_error, unexplained

LAW = 1e-12  # of the largest term: the laws are algebra, only rounding may differ
DRIFT = 10  # roundings a step: more than that is no drift, but another drive
SMALL = 1e-3  # of the largest force of a motion: below ε/LAW = 2e-4 of it its ulp alone is LAW
SOME = 8  # samples: a force that is zero at one of them is none at the others
BESIDE = 1  # state of a mode beside its motion; the tests draw a hundred
OF_MULTIPLIERS = 0.1  # of what reduced equations lose: masses are not multiplied with each other
SINGULAR = 1e8  # condition of equations that have lost half of their digits: they are not asked
ELIMINATED = {
    "Voronets (2.66)": voronets.accelerations,
    "Chaplygin (2.67)": chaplygin.accelerations,
    "Appell (2.80)": appell.accelerations,
}


@dataclass(frozen=True)
class Scale:
    """The scale of a motion: its bodies in maximal coordinates, and how fast each coordinate is."""

    base: Multibody
    speeds: Array  # (n,) m/s or rad/s
    duration: float = math.inf  # s
    drift: float = 0.0  # what a rate that is integrated may be off its drive by, as a share

    def largest(self, mode: Mode, t: float, q: Array, v: Array) -> tuple[float, float]:
        """The largest acceleration that one force gives alone, and the power [W] it could have.

        A mechanism that lies still has no power but rounding's: forces, also those that hold it,
        times the speed of the whole motion is what that is small against.
        """
        place = self.base.place(mode.poses(t, q, v))
        forces = self.base.largest(t, *place)
        return self.base.terms(t, *place)[0], worst((forces + self._held(t, *place)) * self.speeds)

    def _held(self, t: float, q: Array, v: Array) -> Array:
        """(n,) Forces of what holds the mode; 0 where a slack spring has no direction."""
        try:
            multipliers = self.base.solve(t, q, v)[1]
        except NoDirection:
            return np.zeros(len(v))
        return np.abs(multipliers @ self.base.f_a(t, q))

    def largest_alone(self, mode: Mode, t: float, q: Array, v: Array) -> float:
        """The largest acceleration that one force gives alone, or a turn in space: ω × J ω is one.

        What spins evenly is not accelerated, and what says so is a sum of such terms.
        """
        return max(
            self.base.terms(t, *self.base.place(mode.poses(t, q, v)))[0],
            self.turn(mode, t, q, v) ** 2,
            self.least,
        )

    @property
    def least(self) -> float:
        """The acceleration that would change the motion's speeds in its time, as real forces do."""
        return worst(self.speeds) / self.duration

    def turn(self, mode: Mode, t: float, q: Array, v: Array) -> float:
        """Largest angular speed [rad/s] of a body in space; in the plane the axes do not turn."""
        rates = self.base.place(mode.poses(t, q, v))[1]
        spatial = isinstance(self.base, SpatialMultibody)
        return worst(np.abs(rates[self.base.where.turning])) if spatial else 0.0

    def idle(self, mode: Mode, t: float, q: Array, n: int) -> Array:
        """(n,) Largest value of each rate alone that moves no body faster than the motion does."""
        with np.errstate(divide="ignore"):
            rates = np.min(self.speeds / self._of_each(mode, t, q, n), axis=1)
        return np.where(np.isfinite(rates), rates, 1.0)

    def turned(self, mode: Mode, t: float, q: Array, n: int) -> Array:
        """(n,) Change of each coordinate alone that turns a body of space by 45°."""
        if not isinstance(self.base, SpatialMultibody):
            return np.full(n, math.inf)
        turns = self._of_each(mode, t, q, n)[:, self.base.where.turning]
        with np.errstate(divide="ignore"):
            return math.pi / 4 / np.max(turns, axis=1, initial=0.0)

    def _of_each(self, mode: Mode, t: float, q: Array, n: int) -> Array:
        """(n, ·) how fast the bodies are by each rate of 1 alone."""
        still = self.base.where.velocities(mode.poses(t, q, np.zeros(n)))
        return np.abs([self.base.where.velocities(mode.poses(t, q, e)) - still for e in np.eye(n)])

    def axes_keep_sense(self, mode: Mode, t: float, q: Array, v: Array, there: Array) -> bool:
        """Whether no body of space turns so far from q that axes which a joint holds may flip.

        Rows of right angles hold of both ways in which two axes are in line.
        """
        if not isinstance(self.base, SpatialMultibody):
            return True
        turning = [body.name for body in self.base.where.scene.bodies.values() if body.turns]
        both = [mode.poses(t, at, v) for at in (q, there)]
        a, b = ([poses[name][SPACE.attitude] for name in turning] for poses in both)
        return all(abs(np.dot(x, y)) > EIGHTH for x, y in zip(a, b, strict=True))

    def largest_acceleration(self, mode: Mode, times: Array, y: Array) -> float:
        """The largest acceleration at some samples of a motion, or that one force gives alone.

        A force may be 0 at one instant, but for its rounding.
        """
        some = np.unique(np.linspace(0, len(times) - 1, SOME).astype(int)).tolist()
        states = ((float(times[k]), *mode.parted(y[k])) for k in some)
        return worst(
            max(worst(np.abs(mode.accelerations(t, q, v))), self.largest_alone(mode, t, q, v))
            for t, q, v in states
        )


def laws(
    answer: Answer, generated: Mechanism, times: Array, marched: Trajectory, error: float
) -> Iterator[Check]:
    """The laws of every mode along its own part of the motion; the worst of each.

    marched: the motion of the bodies at every step. error: of its size, how far another integrator
    is from it: so much a rate may have drifted.
    """
    checks: dict[str, list[Check]] = {}
    followed, written = answer.followed, answer.system is not generated
    drift = max(DRIFT * float(np.finfo(float).eps) * followed.steps, error)
    scale = Scale(generated.base, _speeds(generated.base, marched), float(np.ptp(times)), drift)
    for name in dict.fromkeys(followed.modes):
        mine, mode = np.array(followed.modes) == name, answer.system.modes[name]
        part = times[mine], followed.y[mine]
        for check in (
            *of_mode(mode, scale, *part, written=written),
            *eliminated(mode, scale, *part),
        ):
            checks.setdefault(check.name, []).append(check)
    yield from map(gravest, checks.values())


def _speeds(base: Multibody, marched: Trajectory) -> Array:
    """(n,) Scale of each speed: the largest of its kind, and at least size/duration.

    At any step: a motion may be sampled where nothing moves.
    """
    frame = base.where.scene.frame
    states = np.concatenate(list(marched.states.values()))
    bodies = base.where.scene.bodies.values()  # one may stay with its centre at the origin
    lengths = [worst(np.abs(states[:, frame.place]).ravel())]
    lengths += [abs(x) for body in bodies for point in body.points.values() for x in point]
    lengths += [body.radius or 0.0 for body in bodies]
    kinds = {False: (frame.velocity, worst(lengths) or 1.0), True: (frame.spin, 1.0)}
    duration = float(np.ptp(marched.times))
    fastest = {
        turns: max(worst(np.abs(states[:, columns]).ravel()), through / duration)
        for turns, (columns, through) in kinds.items()
    }
    return np.array([fastest[turns] for turns in base.where.turning.tolist()])


def of_mode(mode: Mode, scale: Scale, times: Array, y: Array, *, written: bool) -> Iterator[Check]:
    """Checks accelerations, power and reactions by Lagrange and Newton-Euler along the motion.

    Differences are relative to the largest term: of the accelerations and powers themselves, or of
    those that each force alone would give, since at rest the forces cancel but for rounding.
    """
    bound = len(mode.f_a(0.0, mode.parted(y[0])[0])) > 0
    sizes, powers, derived, balances, unbalanced, forces = [], [], [], [], [], []
    drifted: list[float] = []  # the power of what holds, on what a rate is off: judged as drift
    by_lagrangian: list[float] = []  # of the Lagrangian, where there is a V and nothing binds
    for t, row in zip(times.tolist(), y, strict=True):
        reached(t)
        q, v = mode.parted(row)
        a = mode.accelerations(t, q, v)
        alone = scale.largest(mode, t, q, v)
        turn = scale.turn(mode, t, q, v)  # momenta turn with their bodies, also where T stays
        sizes += [worst(np.abs(a)), alone[0], turn**2, scale.least]
        p = lagrange.momentum(mode, t, q, mode.rates(t, q, v))
        if (N := lagrange.rate_matrix(mode, t, q, v)) is not None:
            p = N.T @ p
        terms = energy.power_terms(mode, t, q, v)
        powers += [float(np.sum(np.abs(p * a))), worst(np.abs(terms)), alone[1]]
        powers.append(float(np.sum(np.abs(p * v))) * turn)
        if bound:
            by_rows, forces_b = lagrange.multipliers(mode, t, q, v)
            derived.append(worst(np.abs(by_rows - a)))
            slip = np.asarray(mode.f_a(t, q), float) @ v - mode.g(t, q)
            drifted.append(abs(float(forces_b @ slip)))
        else:
            derived.append(worst(np.abs(lagrange.accelerations(mode, t, q, v) - a)))
            if lagrange.of_potential(mode, t, q, mode.rates(t, q, v)).any():
                by_lagrangian.append(worst(np.abs(lagrangian.unbalanced(mode, t, q, v, a))))
        balances.append(abs(float(np.sum(terms))))
        if written:
            unbalanced.append(newton_euler.balance(mode, t, q, v, a))
            forces.append(_other_forces(mode, unbalanced[-1].reactions, t, q, v))
    size, power = worst(sizes) or 1.0, worst(powers) or 1.0
    by = "Lagrange with multipliers (2.60)" if bound else "Lagrange (2.44)"
    rounding = max(LAW, OF_MULTIPLIERS * _rounding(mode, 1.0))
    error = worst(derived) / size
    if bound and error > rounding:
        at = int(np.argmax(derived))
        rounding = max(rounding, _held_together(mode, float(times[at]), *mode.parted(y[at])))
    yield Check(f"accelerations by {by}", error, rounding)
    if by_lagrangian:
        yield Check("Lagrangian (2.51), (2.52)", worst(by_lagrangian) / size, LAW)
    beside = min(_drift_bound(worst(drifted) / power), max(LAW, scale.drift))
    yield Check("power balance (2.51)", worst(balances) / power, beside)
    if written:
        least = SMALL * worst(balance.largest for balance in unbalanced)
        error = worst(balance.share(least) for balance in unbalanced)
        yield Check("Newton-Euler balance (2.23), (2.27)", error, LAW)
    known = [error for error in forces if error is not None]
    if known:  # a system need not know its reactions
        yield Check("reactions by Newton-Euler", worst(known), LAW)


def eliminated(mode: Mode, scale: Scale, times: Array, y: Array) -> Iterator[Check]:
    """Checks the explicit accelerations against formalisms without multipliers, off the motion.

    Relative to the accelerations, or to what each force alone would give. The ingredients tell
    which apply: nothing is said of those that do not. Masses that differ by many powers of ten are
    multiplied with each other there, as multipliers need not: the bound tells what that loses.
    """
    errors: dict[str, list[float]] = {}
    bound, least = LAW, scale.largest_acceleration(mode, times, y)
    for t, q, v in states(mode, times, y, BESIDE, scale):
        by = dependent(mode, t, q, len(v))
        if by is None or not (condition := by.condition(t, q)) < SINGULAR:
            continue
        bound = max(bound, _rounding(mode, condition))
        a = mode.accelerations(t, q, v)
        size = worst([*np.abs(a), scale.largest_alone(mode, t, q, v), least]) or 1.0
        for name, accelerations in ELIMINATED.items():
            if (other := accelerations(mode, t, q, v)) is not None:
                errors.setdefault(name, []).append(worst(np.abs(other - a)) / size)
    for name, values in errors.items():
        yield Check(f"accelerations by {name}", worst(values), bound)


def _drift_bound(drift: float) -> float:
    """The larger of LAW and the next power of ten above twice the drift."""
    return max(LAW, 10.0 ** math.ceil(math.log10(2 * drift))) if drift > 0.0 else LAW


def _rounding(mode: Mode, condition: float) -> float:
    """Rounding error of reduced equations, a power of ten: 1e-10 if masses differ by a factor 1e4.

    The heaviest body rounds what the lightest adds to T, and their condition what follows of it;
    ten times that, since a right side is a sum of some ten terms.
    """
    masses = [mass.m for mass in mode.masses.values()]
    lost = max(condition, max(masses) / min(masses))
    return 10.0 ** math.ceil(math.log10(10 * np.finfo(float).eps * lost))


def _held_together(mode: Mode, t: float, q: Array, v: Array) -> float:
    """Rounding error where constraints nearly depend on each other: 1e-9 of 60 pins.

    By the condition of their rows, each of size 1, and not of their masses, which `_rounding` has:
    of chains of 40 to 100 bars measured six times ε and this condition. Nothing is said of rows
    that depend on each other.
    """
    rows = np.asarray(constraint_rows(mode, t, q, len(v)), dtype=np.float64)
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    condition = float(np.linalg.cond(rows / np.where(sizes > 0.0, sizes, 1.0))) ** 2
    return rounding_error(condition) if condition < SINGULAR else 0.0


def _other_forces(
    mode: Mode, cut_free: Mapping[str, float], t: float, q: Array, v: Array
) -> float | None:
    """Relative difference of reactions from Newton-Euler's; None of none, as sliding friction."""
    written = mode.reactions(t, q, v)
    if not cut_free.keys() & written.keys():
        return None
    size = worst(abs(force) for force in cut_free.values()) or 1.0
    error = worst(abs(cut_free[name] - written[name]) for name in written if name in cut_free)
    return unexplained(error / size, size, (reactions(mode), t, q, v))


# Random states beside a motion, such as the mode allows: what the motion itself never shows.
#
# A pendulum that swings in a plane never turns out of it. Places are moved along q̇ = N v, so
# that a unit quaternion stays one, and brought back to where f = 0 (2.14); then f_a v = g (2.15).


SEED = 8
FAR = 0.1  # of what the fastest of the motion would do in its time
SMALLER = 40  # halvings: after them the motion's own states are drawn, but for rounding
EIGHTH = math.cos(math.pi / 8)  # of half of 45°: two bodies turn by less than 90° to each other
CLOSED = 1e-13  # of the largest coordinate, or of 1: f is 0 but for rounding
TURNS = 60  # of the fixed point: it gains a digit in four, or the way is too long


def states(
    mode: Mode, times: Array, y: Array, count: int, scale: Scale | None = None
) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q (m,) and v (n,) that the mode allows, beside samples y (N, ·) of its motion.

    What never moves in the motion moves as the scale says, or 1 without one. A rotor's own turns
    keep no other coordinate near: each goes as far as it may by itself.
    """
    random = np.random.default_rng(SEED)
    states = [mode.parted(row) for row in y]
    fastest = np.max(np.abs([v for _, v in states]), axis=0, initial=0.0)
    first = float(times[0]), states[0][0], len(fastest)
    if not np.all(fastest > 0.0):
        idle = scale.idle(mode, *first) if scale else 1.0
        fastest = np.where(fastest > 0.0, fastest, idle)
    way = FAR * (float(times[-1] - times[0]) or 1.0) * fastest
    if scale:
        way = np.minimum(way, scale.turned(mode, *first))
    for _ in range(count):
        at = int(random.integers(len(times)))
        t, (q, v) = float(times[at]), states[at]
        turn, quick = random.uniform(-1.0, 1.0, (2, len(v)))
        for halved in 0.5 ** np.arange(SMALLER):
            place = _closed(mode, t, q, halved * turn * way)
            if place is not None and (scale is None or scale.axes_keep_sense(mode, t, q, v, place)):
                yield t, place, _bound(mode, t, place, v + halved * quick * fastest)
                break


def midpoint_step(mode: Mode, t: float, q: Array, way: Array) -> Array | None:
    """q of one step of the implicit midpoint rule along q̇ = N · way, None where it has none.

    The rule keeps the length of a quaternion, however long the step is.
    """
    if rate_matrix(mode, t, q, way) is None:
        return q + way
    there = q
    for _ in range(TURNS):
        middle, before = (q + there) / 2, there
        there = q + mode.rates(t, middle, way) - mode.rates(t, middle, 0.0 * way)
        if np.max(np.abs(there - before)) <= np.finfo(float).eps * np.max(np.abs(there)):
            return there
    return None


def _closed(mode: Mode, t: float, q: Array, way: Array) -> Array | None:
    """Where f = 0, by Newton's method from beside q; None if that does not get there."""
    try:
        place = midpoint_step(mode, t, q, way)
        for _ in range(TURNS):
            if place is None or not np.all(np.isfinite(place)):
                return None
            f = np.asarray(mode.f(t, place), dtype=np.float64)
            if np.max(np.abs(f), initial=0.0) <= CLOSED * max(1.0, float(np.max(np.abs(place)))):
                return place if _answers(mode, t, place, way) else None
            place = midpoint_step(mode, t, place, -np.linalg.pinv(_slopes(mode, t, place, way)) @ f)
    except (ArithmeticError, np.linalg.LinAlgError):
        pass  # such as a spring without length: another state will do
    return None


def _slopes(mode: Mode, t: float, q: Array, v: Array) -> Array:
    """∂f/∂q N, (·, n)."""
    N = rate_matrix(mode, t, q, v)
    ways = np.eye(len(q)) if N is None else N.T
    return np.stack([derivative(lambda q: mode.f(t, q), (q,), (way,)) for way in ways], axis=1)


def _answers(mode: Mode, t: float, q: Array, v: Array) -> bool:
    """Whether accelerations are finite there; an ArithmeticError of the mode is passed on."""
    return bool(np.all(np.isfinite(mode.accelerations(t, q, v))))


def _bound(mode: Mode, t: float, q: Array, v: Array) -> Array:
    """The nearest velocities that f_a v = g allows."""
    rows = np.asarray(constraint_rows(mode, t, q, len(v)), dtype=np.float64)
    return v - np.linalg.pinv(rows) @ (rows @ v - mode.g(t, q))
