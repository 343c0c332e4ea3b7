"""Forces for which engines have no element, as Python functions: what they do at their points.

A law is made of its scene and its element once, and asked at every step or stage: with the time
and with the state of each point, in the order of `Scene.ends`, it answers with the force there.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from ..cases.fields.friction import Bounds
from ..cases.scene import Scene
from ..cases.scene.forces.drag import Drag, Viscous
from ..cases.scene.forces.element import Force
from ..cases.scene.forces.force import Magnetic
from ..cases.scene.forces.muscle import Contracting, LinearMuscle, Muscle
from .engine import Diverged


class Place(NamedTuple):
    """A point [m], its velocity [m/s], in ground axes, and how far its body is turned [rad]."""

    x: float
    y: float
    vx: float
    vy: float
    angle: float


Exerted = Sequence[tuple[float, float]]
"""The force [N] on each of the points."""
Law = Callable[[float, Sequence[Place]], Exerted]


def _drag(scene: Scene, force: Drag) -> Law:
    """(2.86) −d |v|^α v/|v|."""
    if force.along is not None:
        return _scrape(force, force.along)
    d, power = force.coefficient, (force.exponent - 1) / 2

    def law(t: float, points: Sequence[Place]) -> Exerted:
        _, _, vx, vy, _ = points[0]
        if vx == vy == 0.0:  # below 1 the power of the speed has no number there; the force is 0
            return ((0.0, 0.0),)
        size = -d * (vx * vx + vy * vy) ** power
        return ((size * vx, size * vy),)

    return law


def _scrape(force: Drag, edge: tuple[float, float]) -> Law:
    """(2.85) −d_i |v_i|^α sign(v_i) along an edge that turns with the body, and across it."""
    (a, b), (d, e), power = edge, force.ways, force.exponent

    def law(t: float, points: Sequence[Place]) -> Exerted:
        _, _, vx, vy, angle = points[0]
        cos, sin = math.cos(angle), math.sin(angle)
        ux, uy = cos * a - sin * b, sin * a + cos * b
        along, across = _braked(d, ux * vx + uy * vy, power), _braked(e, ux * vy - uy * vx, power)
        return ((along * ux - across * uy, along * uy + across * ux),)

    return law


def _braked(d: Bounds, speed: float, power: float) -> float:
    return -d.forward * speed**power if speed > 0 else d.backward * (-speed) ** power


def _viscous(scene: Scene, force: Viscous) -> Law:
    """(2.86) −d |v|^α sign(v) along the slide, on its second part."""
    x, y = scene.joints[force.joint].along
    d, power = force.coefficient, force.exponent

    def law(t: float, points: Sequence[Place]) -> Exerted:
        a, b = points
        cos, sin = math.cos(a.angle), math.sin(a.angle)
        ux, uy = cos * x - sin * y, sin * x + cos * y
        speed = ux * (b.vx - a.vx) + uy * (b.vy - a.vy)
        size = _braked(d, speed, power)
        return (-size * ux, -size * uy), (size * ux, size * uy)

    return law


def _magnetic(scene: Scene, force: Magnetic) -> Law:
    """(2.49) e v × B, B along z."""
    strength = force.charge * force.along_z

    def law(t: float, points: Sequence[Place]) -> Exerted:
        _, _, vx, vy, _ = points[0]
        return ((strength * vy, -strength * vx),)

    return law


@dataclass(frozen=True)
class Living:
    """A law with an inner state u: what u begins with, its rate and the forces, by the points."""

    begins: float
    rate: Callable[[Sequence[Place], float], float]
    exerts: Callable[[Sequence[Place], float], Exerted]


def _contracting(scene: Scene, force: Contracting) -> Living:
    """c_s (λ − u) of what contracts, and c_p (λ − λ₀) beside it."""
    series, beside, rest = force.series_stiffness, force.parallel_stiffness, force.rest_length
    shortening = SHORTENING[type(force)](force)

    def rate(points: Sequence[Place], u: float) -> float:
        a, b = points
        return -shortening(series * (math.hypot(b.x - a.x, b.y - a.y) - u))

    def exerts(points: Sequence[Place], u: float) -> Exerted:
        a, b = points
        x, y = b.x - a.x, b.y - a.y
        length = math.hypot(x, y)
        if length == 0.0:
            raise Diverged(f"{force.name} has no length, and so no direction")
        size = (series * (length - u) + beside * (length - rest)) / length
        return (size * x, size * y), (-size * x, -size * y)

    return Living(force.begins, rate, exerts)


def _hill(force: Muscle) -> Callable[[float], float]:
    """(F + a)(v + b) = (F₀ + a) b, solved for v. Raises Diverged for F ≤ −a, where it has none.

    There is another branch of the hyperbola, onto which a step that is too large would leap.
    """
    top, a, b = (force.isometric + force.hill_a) * force.hill_b, force.hill_a, force.hill_b

    def shortening(tension: float) -> float:
        if tension <= -a:
            raise Diverged(
                f"{force.name} is pressed by {-tension:.4g} N, and Hill's law holds above {-a:g} N"
            )
        return top / (tension + a) - b

    return shortening


def _linear(force: LinearMuscle) -> Callable[[float], float]:
    """F = F₀ − b v, solved for v."""
    return lambda tension: (force.isometric - tension) / force.damping


SHORTENING: dict[type[Contracting], Callable[[Any], Callable[[float], float]]] = {
    Muscle: _hill,
    LinearMuscle: _linear,
}
"""How fast what contracts shortens [m/s] under a force [N]."""
LIVING: dict[type[Force], Callable[[Scene, Any], Living]] = {
    Muscle: _contracting,
    LinearMuscle: _contracting,
}
TOLD: dict[type[Force], Callable[[Scene, Any], Law]] = {
    Drag: _drag,
    Viscous: _viscous,
    Magnetic: _magnetic,
}


def law_of(scene: Scene, force: Force) -> Law:
    """The law of a force of the scene: what it exerts at the points where it acts."""
    return TOLD[type(force)](scene, force)


def living(scene: Scene, force: Force) -> Living:
    """The law of a force with an inner state."""
    return LIVING[type(force)](scene, force)
