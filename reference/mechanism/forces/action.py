"""Force elements as the reference knows them, in the plane and in space: a class a kind.

A kind says what it exerts on which points, and beside that, derived by itself, its potential U
(2.45), its generalized potential V (2.48), its dissipation D (2.46) or its generalized force Q₄
(2.50). All are formulas, written down once for a scene; where a law has branches it is a function
that they call.
"""

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ....cases.scene import CENTER, Anchor, Bounds, Limit, Scene
from ....cases.scene.forces.drag import Drag, Viscous
from ....cases.scene.forces.force import (
    Couple,
    Damper,
    Force,
    LinearMuscle,
    Magnetic,
    Motor,
    Muscle,
    Push,
    Spring,
    Torque,
    Torsion,
    TorsionDamper,
    of_kind,
)
from ...coverage import Numbered, equation
from ...laws.force import hill, linear, torsion, torsion_damper
from ...laws.friction import power_law
from ..kinematics.frame import Vec, back, carried
from ..kinematics.kinematics import Kinematics, Part, Point
from .turning import Turn, turn_of

SHORT = 1e-9  # of its own length: a motion that comes so close would not miss zero but by rounding
MEETING = 16 * sys.float_info.epsilon  # of the ends' places: a few roundings of a sum of products
NOISE = 1e-12  # of the speed at the start: what is left of one that falls to zero, or less

Load = tuple[Part, Vec | None, Vec | None]
"""A part, a force on it in ground axes, and a moment about its centre of mass in body axes."""


class NoDirection(ArithmeticError):
    """A spring with a length of its own whose ends are at the same place."""


@dataclass(frozen=True)
class Action(Numbered):
    """A force element by its formulas; one that has no U, V, D or Q₄ says nothing of them."""

    force: Force

    @property
    def line(self) -> bool:
        """Whether it has no direction where its two ends meet."""
        return False

    @property
    def name(self) -> str:
        """The element's."""
        return self.force.name

    @property
    def inner(self) -> str:
        """The quantity that is its inner state; "" of what has none."""
        return self.force.inner

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.50) What it exerts, on each part."""
        raise NotImplementedError

    def U(self, k: Kinematics) -> Any:
        """(2.45) its share of U [J]."""
        return 0.0

    def V(self, k: Kinematics) -> Any:
        """(2.48) its share of V [J]."""
        return 0.0

    def D(self, k: Kinematics) -> Any:
        """(2.46) its share of D [W]."""
        return 0.0

    def Q4(self, k: Kinematics) -> list[Load]:
        """(2.50) what it exerts, of what has no U, no V and no D."""
        return []

    def rate(self, k: Kinematics) -> Any:
        """The rate of its inner state."""
        return 0.0

    def length(self, k: Kinematics) -> Any:
        """λ [m] of what is a line."""
        raise NotImplementedError

    def moment(self, k: Kinematics) -> Vec | None:
        """The moment on the second part of the joint it is about, in ground axes."""
        return None


@equation
def pushed(k: Kinematics, p: Point, F: Vec) -> Load:
    """(2.50) A force at a point: F, and d × F, which in body axes is `own` × Rᵀ F."""
    return p.part, F, k.frame.wedge(p.own, back(p.part.R, F))


def pulled(k: Kinematics, a: Point, b: Point, F: Vec) -> list[Load]:
    """F on the first end, its opposite on the second."""
    return [pushed(k, a, F), pushed(k, b, -F)]


# Along the line of two points: Δ = r_b − r_a, λ = √(Δ·Δ).


@dataclass(frozen=True)
class Lined(Action):
    """Something between two points, `a` and `b`."""

    force: Any

    @property
    def line(self) -> bool:
        return True

    def ends(self, k: Kinematics) -> tuple[Point, Point]:
        """Both points."""
        return k.point(self.force.a), k.point(self.force.b)

    def gap(self, k: Kinematics) -> Vec:
        """Δ [m]."""
        a, b = self.ends(k)
        return b.r - a.r

    def gap_dot(self, k: Kinematics) -> Vec:
        """Δ̇ [m/s]."""
        a, b = self.ends(k)
        return b.r_dot - a.r_dot

    def length(self, k: Kinematics) -> Any:
        """λ [m]."""
        d = self.gap(k)
        return (d @ d) ** 0.5

    def directed(self, k: Kinematics, least: float = 0.0) -> Any:
        """λ [m] of what acts along Δ; nan where it is no longer than that, and has no direction."""
        d = self.gap(k)
        return k.tape.call(Long(least**2), d @ d)


@dataclass(frozen=True)
class Sprung(Lined):
    """A spring; one without a length of its own needs no direction."""

    force: Spring

    @property
    def line(self) -> bool:
        return self.force.rest_length > 0.0

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.82) c (λ − λ₀) along Δ on the first end: stretched, it pulls."""
        d, force = self.gap(k), self.force
        if force.rest_length == 0.0:
            return pulled(k, *self.ends(k), d * force.stiffness)
        length = self.directed(k, SHORT * force.rest_length)
        return pulled(
            k, *self.ends(k), d * (force.stiffness * (length - force.rest_length) / length)
        )

    def U(self, k: Kinematics) -> Any:
        """(2.45) ½ c (λ − λ₀)²; ½ c λ² has a derivative at λ = 0 too."""
        if self.force.rest_length == 0.0:
            d = self.gap(k)
            return 0.5 * self.force.stiffness * (d @ d)
        return 0.5 * self.force.stiffness * (self.length(k) - self.force.rest_length) ** 2


@dataclass(frozen=True)
class Long:
    """λ of λ²; nan where it is too short for a direction."""

    least: float

    def __call__(self, squared: Any) -> Any:
        return squared**0.5 if squared.real > self.least else math.nan


@dataclass(frozen=True)
class Along:
    """a/λ² of what is along a line, by λ²; where its ends meet, what `meeting` is.

    So near they meet that no more than rounding of their places is between them: squares: a sum of
    squares of these.
    """

    rounding: float

    def __call__(self, squared: Any, squares: Any, a: Any, meeting: Any) -> Any:
        return a / squared if squared.real > self.rounding**2 * squares.real else meeting


@dataclass(frozen=True)
class Damped(Lined):
    """A viscous damper.

    Where its ends meet they part, or have come, along Δ̇: there the line has its direction, λ̇ Δ/λ
    is Δ̇, and so is nothing of what does not move.
    """

    force: Damper

    @property
    def line(self) -> bool:
        return False

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.47) d λ̇ along Δ on the first end, λ̇ = Δ·Δ̇/λ."""
        d, rate = self.gap(k), self.gap_dot(k)
        along = [self._along(k, (d @ rate) * x, v) for x, v in zip(d, rate, strict=True)]
        return pulled(k, *self.ends(k), Vec(along) * self.force.damping)

    def D(self, k: Kinematics) -> Any:
        """(2.46) ½ d λ̇²."""
        d, rate = self.gap(k), self.gap_dot(k)
        return 0.5 * self.force.damping * self._along(k, (d @ rate) ** 2, rate @ rate)

    def _along(self, k: Kinematics, a: Any, meeting: Any) -> Any:
        a_end, b_end = self.ends(k)
        places = (a_end.r, b_end.r, a_end.part.r, b_end.part.r)
        d = self.gap(k)
        return k.tape.call(Along(MEETING), d @ d, sum((r @ r for r in places), 0.0), a, meeting)


@dataclass(frozen=True)
class Contracted(Lined):
    """A muscle; u is the length that contracts, its inner state."""

    force: Muscle | LinearMuscle

    def shortening(self, F: Any) -> Any:
        """How fast [m/s] what contracts shortens under a force."""
        raise NotImplementedError

    def _series(self, k: Kinematics) -> Any:
        """c_s (λ − u) [N]."""
        u = k.q[k.where.inner[f"{self.name}.{self.force.inner}"]]
        return self.force.series_stiffness * (self.length(k) - u)

    def loads(self, k: Kinematics) -> list[Load]:
        """c_s (λ − u) + c_p (λ − λ₀) along Δ on the first end."""
        length = self.directed(k, SHORT * self.force.begins)
        beside = self.force.parallel_stiffness * (length - self.force.rest_length)
        return pulled(k, *self.ends(k), self.gap(k) * ((self._series(k) + beside) / length))

    def U(self, k: Kinematics) -> Any:
        """(2.45) ½ c_s (λ − u)² + ½ c_p (λ − λ₀)² [J]."""
        series = self._series(k) / self.force.series_stiffness
        beside = self.length(k) - self.force.rest_length
        energy = self.force.series_stiffness * series * series
        return 0.5 * (energy + self.force.parallel_stiffness * beside * beside)

    def rate(self, k: Kinematics) -> Any:
        """u̇ [m/s], by the force in series."""
        return -self.shortening(self._series(k))


@dataclass(frozen=True)
class HillContracted(Contracted):
    """Hill's muscle."""

    force: Muscle

    def shortening(self, F: Any) -> Any:
        """b (F₀ − F)/(F + a)."""
        return hill(self.force.isometric, self.force.hill_a, self.force.hill_b, F)


@dataclass(frozen=True)
class LinearContracted(Contracted):
    """A muscle with a linear law."""

    force: LinearMuscle

    def shortening(self, F: Any) -> Any:
        """(F₀ − F)/b."""
        return linear(self.force.isometric, self.force.damping, F)


# On a point, a body, or two.


@dataclass(frozen=True)
class Pushed(Action):
    """A force at a point, by a law in time."""

    force: Push

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.50) F(t)."""
        force = self.force
        F = Vec(force.signal.amplitude) * k.signal(force.signal)
        return [pushed(k, k.point(force.at), F)]

    def Q4(self, k: Kinematics) -> list[Load]:
        """(2.50) F·∂r/∂qᵃ, with d × F of ground axes."""
        p = k.point(self.force.at)
        F = Vec(self.force.signal.amplitude) * k.signal(self.force.signal)
        return [(p.part, F, k.frame.into(p.part.R, k.frame.wedge(p.r - p.part.r, F)))]


@dataclass(frozen=True)
class Torqued(Action):
    """A torque on a body, by a law in time, in ground axes."""

    force: Torque

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.50) M(t)."""
        part, law = k.part(self.force.body), self.force.signal
        M = Vec(law.amplitude) * k.signal(law)
        return [(part, None, k.frame.into(part.R, M))]

    Q4 = loads


@dataclass(frozen=True)
class Coupled(Action):
    """A torque of one body on another in the plane: M on the second and −M on the first."""

    force: Couple

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.50) M·∂(φ₂ − φ₁)/∂qᵃ."""
        M = Vec(self.force.signal.amplitude) * k.signal(self.force.signal)
        return [(k.part(self.force.second), None, M), (k.part(self.force.first), None, -M)]

    Q4 = loads


@dataclass(frozen=True)
class Deflected(Action):
    """The force of a magnetic field along z on a charge in a body's centre, in the plane."""

    force: Magnetic

    def _centre(self, k: Kinematics) -> Point:
        return k.point(Anchor(self.force.body, CENTER))

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.49) F = e v × B, to the right of v for e B > 0."""
        centre, each = self._centre(k), self.force.charge * self.force.along_z
        x_dot, y_dot = centre.r_dot
        return [pushed(k, centre, Vec((each * y_dot, -(each * x_dot))))]

    def V(self, k: Kinematics) -> Any:
        """(2.49) V = ½ e B (y ẋ − x ẏ) [J]."""
        centre = self._centre(k)
        (x, y), (x_dot, y_dot) = centre.r, centre.r_dot
        return 0.5 * self.force.charge * self.force.along_z * (y * x_dot - x * y_dot)


# About a turn of a joint, between its two parts.


@dataclass(frozen=True)
class Turned(Action):
    """A torque M about a turn of a joint: the moment M m on the second part."""

    force: Torsion | TorsionDamper | Motor

    def turn(self, k: Kinematics) -> Turn:
        """The turn, at one state."""
        return turn_of(k, self.force)

    def M(self, k: Kinematics) -> Any:
        """The torque [N m]."""
        raise NotImplementedError

    def moment(self, k: Kinematics) -> Vec:
        """M m."""
        return self.turn(k).m * self.M(k)

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.50) M m on the second part, its opposite on the first."""
        return self.turn(k).couple(k, self.moment(k))


@dataclass(frozen=True)
class Twisted(Turned):
    """A torsion spring."""

    force: Torsion

    def M(self, k: Kinematics) -> Any:
        """(2.45) −c (φ − φ₀)."""
        return torsion(self.force.stiffness, self.force.rest_angle, self.turn(k).angle)

    def U(self, k: Kinematics) -> Any:
        """(2.45) ½ c (φ − φ₀)²."""
        return 0.5 * self.force.stiffness * (self.turn(k).angle - self.force.rest_angle) ** 2


@dataclass(frozen=True)
class Braked(Turned):
    """A damper of a turn."""

    force: TorsionDamper

    def M(self, k: Kinematics) -> Any:
        """(2.47) −d φ̇."""
        return torsion_damper(self.force.damping, self.turn(k).rate)

    def D(self, k: Kinematics) -> Any:
        """(2.46) ½ d φ̇²."""
        return 0.5 * self.force.damping * self.turn(k).rate ** 2


@dataclass(frozen=True)
class Driven(Turned):
    """A motor, by a law in time."""

    force: Motor

    def M(self, k: Kinematics) -> Any:
        """M(t)."""
        return self.force.signal.amplitude[0] * k.signal(self.force.signal)

    def Q4(self, k: Kinematics) -> list[Load]:
        """(2.50) M ∂φ̇/∂ω of both parts."""
        turn = self.turn(k)
        return turn.couple(k, turn.gradient(k) * self.M(k))


# Viscous friction (2.85), (2.86): −d |v|^α against a velocity.


@dataclass(frozen=True)
class Dragged(Action):
    """Friction of a point: alike in all directions, or along an edge of its body and across it."""

    force: Drag

    def _ways(self, k: Kinematics) -> list[tuple[Bounds, Vec, Any]]:
        """The coefficients of each way along an edge, its direction, and the speed along it."""
        p, along = k.point(self.force.at), self.force.along
        assert along is not None
        u = k.carried(p.part, along).u
        both = (u, Vec((-u[1], u[0])))
        return [(d, e, e @ p.r_dot) for d, e in zip(self.force.ways, both, strict=True)]

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.83), (2.84), (2.85), (2.86) −d |v|^α v/|v|, or Σ −d_i |v_i|^α sign(v_i) e_i."""
        p, force = k.point(self.force.at), self.force
        if force.along is None:
            slowing = Slowing(force.coefficient, force.exponent)
            return [pushed(k, p, p.r_dot * k.tape.call(slowing, p.r_dot @ p.r_dot))]
        each = [e * k.tape.call(OneWay(d, force.exponent), s) for d, e, s in self._ways(k)]
        return [pushed(k, p, each[0] + each[1])]

    def D(self, k: Kinematics) -> Any:
        """(2.46) D = d |v|^{α+1}/(α + 1) [W], or the sum of both ways."""
        p, force = k.point(self.force.at), self.force
        if force.along is None:
            both = Bounds(force.coefficient, force.coefficient)
            return k.tape.call(Lost(both, force.exponent), p.r_dot @ p.r_dot, 1.0)
        losses = [k.tape.call(Lost(d, force.exponent), s * s, s) for d, _, s in self._ways(k)]
        return losses[0] + losses[1]


@dataclass(frozen=True)
class Slowed(Action):
    """Friction along a slide: the points part along u alone, so that their speed is u·Δ̇."""

    force: Viscous

    def _along(self, k: Kinematics) -> tuple[Point, Point, Vec, Any]:
        joint = k.scene.joints[self.force.joint]
        a, b = k.point(joint.a), k.point(joint.b)
        u = k.carried(a.part, joint.along).u
        return a, b, u, u @ (b.r_dot - a.r_dot)

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.86) −d |v|^α sign(v) along u on the second part."""
        a, b, u, speed = self._along(k)
        F = u * k.tape.call(OneWay(self.force.coefficient, self.force.exponent), speed)
        return pulled(k, b, a, F)

    def D(self, k: Kinematics) -> Any:
        """(2.46) D = d |v|^{α+1}/(α + 1) [W], d that of the way it goes."""
        speed = self._along(k)[3]
        lost = Lost(self.force.coefficient, self.force.exponent)
        return k.tape.call(lost, speed * speed, speed)


@dataclass(frozen=True)
class Slowing:
    """(2.85) −d |v|^α/|v| of v·v; nothing at rest."""

    d: float
    alpha: float

    def __call__(self, squared: float) -> float:
        speed = squared**0.5
        return power_law(self.d, self.alpha, speed) / speed if speed else 0.0


@dataclass(frozen=True)
class OneWay:
    """(2.86) −d |v|^α sign(v), d that of the way it goes."""

    d: Bounds
    alpha: float

    def __call__(self, speed: float) -> float:
        return power_law(one_way(self.d, speed), self.alpha, speed)


@dataclass(frozen=True)
class Lost:
    """(2.46) d |v|^{α+1}/(α + 1) [W] of v²: a root needs no |v|, whose derivative would be lost.

    At rest it has no slope, which a complex step of less than 1 would only reach by its root.
    """

    d: Bounds
    alpha: float

    def __call__(self, squared: Any, way: Any) -> Any:
        if not squared.real > 0.0:
            return 0.0 * squared
        d = one_way(self.d, way)
        return d * squared ** ((self.alpha + 1.0) / 2.0) / (self.alpha + 1.0)


def one_way(d: Bounds, speed: Any) -> float:
    """d₊ or d₋, as it goes."""
    return d.forward if speed.real > 0.0 else d.backward


def blurred(scene: Scene, speed: float) -> float:
    """How long [s] slides take from NOISE to rest by (2.86): so well a stop is known, if α < 1.

    v^{1−α} = (1 − α) (d/m) (t_s − t), with the mass of all bodies.
    """
    m = sum(body.mass for body in scene.bodies.values())
    stops = [f for f in of_kind(Viscous, scene.forces.values()) if f.exponent < 1.0]
    times = [
        (NOISE * speed) ** (1.0 - f.exponent) * m / (d * (1.0 - f.exponent))
        for f in stops
        for d in (f.coefficient.forward, f.coefficient.backward)
        if d
    ]
    return max(times, default=0.0)


@dataclass(frozen=True)
class Gyroscopic(Numbered):
    """The moment beside those on a body in space, as Ḋ_c = J ω̇ + ω × J ω = M_c."""

    name: str

    def loads(self, k: Kinematics) -> list[Load]:
        """(2.27), (2.33) −ω × J ω, in body axes."""
        part, J = k.part(self.name), k.scene.bodies[self.name].tensor
        columns = tuple(Vec(column) for column in J.T.tolist())
        return [(part, None, -k.frame.cross(part.omega, carried(columns, part.omega)))]


@dataclass(frozen=True)
class Unilateral(Action):
    """It exerts something only where it ends, and is a constraint there."""

    force: Limit

    def loads(self, k: Kinematics) -> list[Load]:
        """Nothing."""
        return []


ACTIONS: dict[type[Force], type[Action]] = {
    Spring: Sprung,
    Damper: Damped,
    Push: Pushed,
    Torque: Torqued,
    Couple: Coupled,
    Torsion: Twisted,
    TorsionDamper: Braked,
    Motor: Driven,
    Drag: Dragged,
    Viscous: Slowed,
    Magnetic: Deflected,
    Muscle: HillContracted,
    LinearMuscle: LinearContracted,
}


def actions(forces: Sequence[Force]) -> list[Action]:
    """The formulas of each element, in order. Raises NotImplementedError of an unknown kind."""
    return [_action(force) for force in forces]


def _action(force: Force) -> Action:
    if isinstance(force, Limit):
        return Unilateral(force)
    if type(force) not in ACTIONS:
        raise NotImplementedError(f"{force.name} is not known to the reference")
    return ACTIONS[type(force)](force)
