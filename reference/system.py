"""A system that is followed: its modes, and the guards that lead from one to the next.

A mode answers with its explicit accelerations, derived by hand, and with its ingredients (T, U, V,
D, Q₄, constraints, free bodies), from which the chapter's formalisms derive them again without
sharing a line of algebra. Ingredients must accept complex arguments: derivatives are taken by the
complex step. A system is one mode, or several with the same coordinates: a disk that slides obeys
other equations than one that rolls.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .coverage import Numbered

Array = NDArray[np.float64]
Vector = NDArray[Any]  # real, or complex while a derivative is taken
Pose = tuple[Any, ...]
"""A body's state, as the columns of `cases.frame` have it: of the centre of mass x, y, angle, vx,
vy, omega; in space r, the unit quaternion (w, x, y, z) from body to ground axes, v in ground axes
and ω in body axes. Or (u,), an inner state of a force, by its quantity."""

MOVING = "moving"  # the mode of a system that has only one

# Where events pile up, as of a ball that bounces ever lower, the motion goes on from their limit:
# by Δ too early, with flights of d and less left out.  It rests then with the momentum that these
# would give it, and is off by g d Δ at most.
EARLY, LAST = 5e-7, 5e-8  # of the duration: Δ, or d where that is larger; shorter ones drown in ε
TOGETHER = 1e-12  # s, of a motion of a second or more: how well events are located, see `instant`


def instant(duration: float) -> float:
    """How close [s] two events of a motion are one: of a short one as small a part of its time."""
    return TOGETHER * min(1.0, duration)


@dataclass(frozen=True)
class Mass:
    """m [kg], and J [kg m²] about the centre of mass; J is None for a particle.

    In space J is (3, 3), in body axes (2.30).
    """

    m: float
    J: Any


@dataclass(frozen=True)
class Load:
    """An applied force [N] at a point of a free-cut body, and a moment [N m].

    All in ground axes; the moment is a vector in space.
    """

    body: str
    at: tuple[float, ...]
    force: tuple[float, ...]
    moment: float | tuple[float, ...] = 0.0


@dataclass(frozen=True)
class Cut:
    """Where bodies are cut free: unknown reactions along `directions` at a point.

    The reaction acts on body b, its opposite on body a (None is the ground). `names` are the
    quantities its components are observed as; `moment` adds an unknown reaction moment, or in space
    `moments` one about each of these directions: forces first, then moments. All in ground axes.
    """

    names: tuple[str, ...]
    a: str | None
    b: str
    at: tuple[float, ...]
    directions: tuple[tuple[float, ...], ...] = ((1.0, 0.0), (0.0, 1.0))
    moment: bool = False
    moments: tuple[tuple[float, ...], ...] = ()


class Mode(Numbered):
    """Defaults for a mechanism with coordinates q, velocities v (n,) and r constraints.

    q̇ = N(t, q) v + n₀(t, q); most have v = q̇.  A quaternion has four coordinates and three
    velocities, a sleigh may go with its forward velocity alone.  T is a function of all the rates
    q̇ (m,), as in the book; forces and constraints go with v: D is a function of v and gives the
    force −∂D/∂v, Q₄ (n,) does the power Q₄ · v, and rows f_a act on v.
    """

    coordinates: tuple[str, ...]
    masses: Mapping[str, Mass]
    stiff: bool = False  # whether an explicit integrator would creep
    undetermined: Sequence[str] = ()  # reactions of which equilibrium knows a sum only
    corners: Sequence[float] = ()  # as of a system, of a mode that is a whole system (`Only`)

    def start(self) -> tuple[Array, Array]:
        """q (n,) and v (n,) at t = 0, of a mode that is a whole system (`Only`)."""
        raise NotImplementedError

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """v̇ (n,), derived by hand: q̈, where v = q̇."""
        raise NotImplementedError

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """q̇ = N v + n₀ (m,), m coordinates; v itself unless a mode says otherwise."""
        return v

    def parted(self, y: Array) -> tuple[Array, Array]:
        """q (m,) and v (n,) of y = (q, v)."""
        m = len(self.coordinates)
        return y[:m], y[m:]

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k(q), E_k(q) and their rates, for each body by its name in the scene."""
        raise NotImplementedError

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """Reaction forces [N] by quantity, derived by hand (R_a = λ_b f_aᵇ in (2.60))."""
        return {}

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """q and v at time t by known functions, of a mode that is a whole system."""
        return None

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """Kinetic energy [J] of the rates q̇ (m,), here called v; of (m, K) at once (K,)."""
        raise NotImplementedError

    def U(self, t: Any, q: Vector) -> Any:
        """Potential energy [J] of the forces of class 1 (2.45)."""
        return 0.0

    def V(self, t: Any, q: Vector, v: Vector) -> Any:
        """Generalized potential [J] of the forces of class 3 (2.48), linear in the rates q̇ (m,).

        As T it is asked for (m, K) of them at once (K,).
        """
        return 0.0

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """Dissipation function [W] of the forces of class 2 (2.46), of v (n,)."""
        return 0.0

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """Generalized forces of class 4 (2.50), (n,): what does the power Q₄ · v."""
        return np.zeros(len(v))

    def f(self, t: Any, q: Vector) -> Vector:
        """Residuals (2.14) of the holonomic constraints, (≤ r,)."""
        return np.zeros(0)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """Rows (r, n) of the constraints (2.15), f_a v = g."""
        return np.zeros((0, len(q)))

    def g(self, t: Any, q: Vector) -> Vector:
        """Right side (r,) of the constraints (2.15), zero unless a part is driven."""
        return np.zeros(len(self.f_a(t, q)))

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """Applied forces on the free-cut bodies, for (2.23) and (2.27)."""
        raise NotImplementedError

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """Where the bodies are cut free, for (2.23) and (2.27): nowhere, if nothing holds them."""
        return []


@dataclass(frozen=True)
class Guard:
    """Where g(t, q, v) falls through zero the mode ends, and `then` gives the next and its state.

    event is the name of what happens there, or None for a change that nobody observes. A guard at
    zero when its mode begins has to rise first; if it falls at once, the mode ends at once.
    at_last: what `then` is in the limit, where falls without end pile up in a finite time, as those
    of a ball that bounces ever lower: it rests. None where there is no limit to go on from; what it
    answers is None where nothing keeps the laws yet, as what bounces besides has not come to rest.
    vain: whether it is none where `then` gives back what it was given, as a landing from a gap that
    has just opened by rounding. jumps: whether the motion is another one however little g falls: a
    blow has a speed by the root of its depth, and what holds may be more than what then brakes.
    rounds: of q, the size of g that is nothing but rounding: a step in which it is no more all
    along, as what flies on beside a floor without gravity, is none in which anything falls.
    """

    event: str | None
    g: Callable[[float, Array, Array], float]
    then: Callable[[float, Array, Array], tuple[str, Array, Array]]
    at_last: Callable[[float, Array, Array], tuple[str, Array, Array] | None] | None = None
    vain: bool = False
    jumps: bool = False
    rounds: Callable[[Array], float] = lambda q: 0.0


class System(Numbered):
    """Defaults for a system of several modes, all with the same coordinates and bodies."""

    modes: Mapping[str, Mode]
    longest: float | None = None  # no step [s] is longer: a guard may know more of time than q does
    blurred: float = 0.0  # s: how far apart answers have a stop that speeds fall to without slope
    corners: Sequence[float] = ()  # s: where what is given in time jumps or bends, steps end

    def start(self) -> tuple[str, Array, Array]:
        """The mode at t = 0, q (n,) and v (n,)."""
        raise NotImplementedError

    def guards(self, mode: str) -> Sequence[Guard]:
        """The guards that end the mode; of those that fall together, the first counts."""
        return ()

    def beyond(self, mode: str, t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
        """The mode after a corner at t, and its state: what acts may have jumped."""
        return mode, q, v

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """q and v at time t by known functions, where there are any."""
        return None

    def closed_events(self, until: float) -> list[tuple[str, float]] | None:
        """Names and times [s] of the events up to `until` by known functions, None if unknown."""
        return None

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """Why the mode cannot be at this state: friction, contact, tipping. None if it can."""
        return None


@dataclass(frozen=True)
class Only(System):
    """A smooth system: one mode, which states its own start, and nothing that ends it."""

    mode: Mode

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", {MOVING: self.mode})
        object.__setattr__(self, "corners", self.mode.corners)

    def start(self) -> tuple[str, Array, Array]:
        """As the mode states it."""
        return MOVING, *self.mode.start()

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """As the mode knows it."""
        return self.mode.closed_form(t)
