"""The implicit integrator: Radau IIA of any order, for stiff equations.

E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.8.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import lapack
from .march import EPS, Integration, IntegrationError, Slope, Vector, integrate, rms, sizes
from .radau import Collocation, radau_table

Matrix = NDArray[np.float64]
Jacobian = Callable[[float, Vector], Matrix]

ITERATIONS = 15  # slower than this, a new Jacobian or a smaller step is the better bargain
SLOW = 0.01  # contraction of the iteration beyond which the next step gets a new Jacobian
MANY = 200  # columns: such a Jacobian costs as much as some thirty iterations
PATIENT = 0.1  # and so does not pay before this contraction, where they are twice as many
ROUNDING = 100.0 * EPS  # corrections this small that no longer shrink are rounding
BESIDE = 1e4  # times what it is or becomes in the step: more is no small part of it
FAR = 3.0  # do not extrapolate the stages to a step this many times longer than the last
NEAR = 1e-12  # nor to one as much shorter: its nodes are the last one's end but for rounding


def difference_jacobian(f: Slope, t: float, y: Vector, slope: Vector, size: Vector) -> Matrix:
    """Forward differences; half the digits are plenty for an iteration that corrects itself."""
    columns = []
    for i, step in enumerate(math.sqrt(EPS) * size):
        moved = y.copy()
        moved[i] += step
        columns.append((f(t, moved) - slope) / (moved[i] - y[i]))
    return np.array(columns).T


class Radau:
    """One equation bound to the method, with the Jacobian and its factors while they serve."""

    def __init__(
        self, f: Slope, tolerance: float, table: Collocation, jacobian: Jacobian | None = None
    ) -> None:
        if not 0.0 < tolerance < 1.0:
            raise ValueError("the tolerance must lie between 0 and 1")
        stages = len(table.c)
        self.f, self.jacobian, self.table = f, jacobian, table
        self.tolerance = max(tolerance, 4.0 * EPS)
        self.power = 1.0 / (stages + 1)
        # The estimate is of order s but the step of order 2s - 1: where nothing is stiff, an
        # estimate of tolerance to the power (s + 1) / 2s means a step good to the tolerance.
        # The 0.1 is Hairer's margin.
        self._goal = 0.1 * self.tolerance ** ((stages + 1) / (2 * stages))
        self.evaluations = 0
        self._from: Vector | None = None
        self._slope = np.zeros(0)
        self._start = 0.0
        self._last: tuple[float, Matrix] | None = None  # step and increments of the last success
        self._tried: tuple[float, Matrix] | None = None
        self._jacobian: Matrix | None = None
        self._fresh = False
        self._contraction = 0.0
        self._factored = 0.0  # step the factors below belong to
        self._stages = stage_factors(table, np.zeros((1, 1)))
        self._error_factors = Factors(np.eye(1))

    def begin(self, t: float, y: Vector) -> Vector:
        """Slope at the start; a step accepted before it becomes the one to extrapolate from."""
        self._from, self._start = y, t
        self._slope = np.array(self.f(t, y), dtype=np.float64)
        self.evaluations += 1
        self._last = self._tried
        self._fresh = False
        return self._slope

    def attempt(self, t: float, y: Vector, h: float, peak: Vector) -> Vector:
        """Solve for the stages, with a new Jacobian where the old one fails."""
        if y is not self._from:
            self.begin(t, y)
        slow = SLOW if len(y) < MANY else PATIENT
        if self._jacobian is None or (self._contraction > slow and not self._fresh):
            self._differentiate(t, y, h, peak)
        while True:
            z = self._solve(t, y, h, peak)
            if z is not None:
                self._tried = (h, z)
                return z[-1]
            if self._fresh:
                self._tried = None
                return np.full_like(y, math.nan)
            self._differentiate(t, y, h, peak)

    def _differentiate(self, t: float, y: Vector, h: float, peak: Vector) -> None:
        if self.jacobian is None:
            size = sizes(peak, self.tolerance)
            # A state at rest at the origin has no size of its own to take a small part of.
            size = size if size.max() > 1e-200 else np.ones_like(y)
            # A place of 1e-10 m beside a turn of 1e12 rad/s: a part of the latter is no small step.
            own = np.maximum(peak, h * np.abs(self._slope))
            size = np.where(own > 0.0, np.minimum(size, BESIDE * own), size)
            self._jacobian = difference_jacobian(self.f, t, y, self._slope, size)
            self.evaluations += len(y)
        else:
            self._jacobian = np.asarray(self.jacobian(t, y), dtype=np.float64)
        self._fresh, self._factored = True, 0.0

    def _factor(self, h: float) -> None:
        """Factors of the stage equations and of the filter of the error estimate."""
        assert self._jacobian is not None
        # Within a thousandth the old factors still contract as fast as an older Jacobian would.
        if self._factored and abs(h / self._factored - 1.0) < 1e-3:
            return
        scaled = h * self._jacobian
        self._stages = stage_factors(self.table, scaled)
        self._error_factors = Factors(np.eye(len(scaled)) - self.table.gamma * scaled)
        self._factored = h

    def _guess(self, h: float, n: int) -> Matrix:
        """Stage increments from the last step's polynomial, continued; zero where that is wild."""
        if self._last is None or not NEAR < h / self._last[0] < FAR:
            return np.zeros((len(self.table.c), n))
        length, z = self._last
        return self.table.continued(h / length) @ z - z[-1]

    def _solve(self, t: float, y: Vector, h: float, peak: Vector) -> Matrix | None:
        """Simplified Newton iteration on the stage increments; None if it does not contract."""
        self._factor(h)
        a, moments = self.table.a, [t + c * h for c in self.table.c.tolist()]
        z = self._guess(h, len(y))
        before = math.inf
        for turn in range(ITERATIONS):
            slopes = np.array([self.f(at, row) for at, row in zip(moments, y + z, strict=True)])
            self.evaluations += len(moments)
            change = self._stages.solve(h * (a @ slopes) - z)
            z += change
            size = sizes(np.maximum(peak, np.abs(z).max(axis=0)), self.tolerance)
            now = rms(change / size)
            rate = now / before if before > 0.0 else 0.0
            if turn:
                self._contraction = rate
            # What is still missing is about rate / (1 - rate) times the last correction.  A tenth
            # of the tolerance keeps it out of the step's own error.
            if now == 0.0 or (turn and now * rate <= 0.1 * self.tolerance * (1.0 - rate)):
                return z
            if not (now < math.inf and (rate < 1.0 or now <= ROUNDING)):
                return None
            if rate >= 0.5 and now <= ROUNDING:
                return z
            before = now
        return None

    def error(self, size: Vector) -> float:
        """The larger of two judgements: the embedded estimate, and the step's own stiff error.

        The estimate is filtered, so that a stiff component does not count with the error of a mere
        interpolation, and it may be as large as `_goal`, the step being s - 1 orders better.
        In a stiff component it is not, and there the tolerance itself must hold.  The measure is
        the last Taylor term the stages resolve, which leaves out any distance from the smooth
        solution that the start of the step has inherited: that decays and is no error of this step.
        """
        if self._tried is None or self._from is None:
            return math.inf
        (h, z), table = self._tried, self.table
        stiff = self._error_factors.solve(table.leading @ z)
        for _ in range(len(z)):  # each turn brings a factor h J to what is not stiff
            stiff = stiff - self._error_factors.solve(stiff)
        rest = table.error @ z
        raw = self._error_factors.solve(table.gamma * h * self._slope + rest)
        estimate = rms(raw / size)
        if estimate > self._goal:
            # A second filtering, as at the start a stiff transient makes the first far too large.
            slope = self.f(self._start, self._from + raw)
            self.evaluations += 1
            raw = self._error_factors.solve(table.gamma * h * slope + rest)
            estimate = rms(raw / size)
        return max(estimate / self._goal, rms(stiff / size) / self.tolerance)


def radau(
    f: Slope,
    times: ArrayLike,
    y0: ArrayLike,
    *,
    tolerance: float = 1e-13,
    stages: int = 5,
    jacobian: Jacobian | None = None,
    most: int = 1_000_000,
) -> Integration:
    """Integrate y' = f(t, y) through `times`, starting from `y0` at `times[0]`, stiff or not.

    `jacobian` is a function of t and y; without one, differences serve.
    """
    method = Radau(f, tolerance, radau_table(stages), jacobian)
    return integrate(method, times, y0, most=most)


def radau_step(
    f: Slope,
    t: float,
    y: Vector,
    h: float,
    *,
    table: Collocation | None = None,
    jacobian: Jacobian | None = None,
) -> Vector:
    """The state after one step of exactly `h`, the stages solved to rounding; 5 unless `table`."""
    method = Radau(f, 4.0 * EPS, table or radau_table(5), jacobian)
    increment = method.attempt(t, y, h, np.abs(y))
    if not np.isfinite(increment).all():
        raise IntegrationError("the stages of the step could not be solved", t)
    return y + increment


# The linear equations of an implicit step: all stages together, 1 − h A ⊗ J.


FEW = 64  # rows of all stages: their one matrix is solved with faster than several smaller ones


class Factors:
    """The LU factors of a matrix; straight from LAPACK, whose wrappers cost more than the work."""

    def __init__(self, matrix: Any) -> None:
        if matrix.dtype.kind == "c":
            factor, self._solve = lapack.zgetrf, lapack.zgetrs
        else:
            factor, self._solve = lapack.dgetrf, lapack.dgetrs
        self._lu, self._pivots, _ = factor(matrix)

    def solve(self, right: Any) -> Any:
        """The solution; not finite if the matrix was singular."""
        return self._solve(self._lu, self._pivots, right)[0]


class Whole:
    """1 − h A ⊗ J of all stages, as one matrix of s n rows: cheapest where these are few."""

    def __init__(self, table: Collocation, scaled: Matrix) -> None:
        rows = len(table.c) * len(scaled)
        blocks = np.multiply.outer(table.a, scaled).transpose(0, 2, 1, 3)
        self._factors = Factors(np.eye(rows) - blocks.reshape(rows, rows))

    def solve(self, right: Matrix) -> Matrix:
        """(s, n) for (s, n)."""
        return self._factors.solve(right.ravel()).reshape(right.shape)


class ByEigenvalues:
    """Solver of the equations of all stages: one matrix 1 − h λ J for each eigenvalue λ of A.

    One matrix of s n rows would cost s³ n³; these are s n³ in all, half of them by conjugation.
    """

    def __init__(self, table: Collocation, scaled: Matrix) -> None:
        identity = np.eye(len(scaled))
        self.table = table
        self.factors = [
            Factors(identity - (value if value.imag else value.real) * scaled)
            for value in table.values.tolist()
        ]

    def solve(self, right: Matrix) -> Matrix:
        """(s, n) for (s, n)."""
        rows = self.table.into @ right
        for k, (value, factors) in enumerate(zip(self.table.values, self.factors, strict=True)):
            rows[k] = factors.solve(rows[k] if value.imag else rows[k].real)
        return (self.table.back @ rows).real


def stage_factors(table: Collocation, scaled: Matrix) -> Whole | ByEigenvalues:
    """A solver of the equations of all stages together."""
    few = len(table.c) * len(scaled) <= FEW
    return Whole(table, scaled) if few else ByEigenvalues(table, scaled)
