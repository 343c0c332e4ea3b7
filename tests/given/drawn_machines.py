"""Machines that hypothesis draws, and the same machine turned or in other units."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from hypothesis import strategies as st

from textmech.cases.scene import (
    GROUND,
    Body,
    Damper,
    Force,
    GroundPoint,
    Joint,
    Push,
    Scene,
    Spring,
    Torque,
    Vector,
)

from .random_machines import Build, chain, tree

SEEDS = st.integers(0, 10_000)
TREES = st.builds(tree, SEEDS, count=st.integers(2, 5), driven=st.booleans())
LOOPS = st.builds(chain, SEEDS, driven=st.booleans())
MACHINES = TREES | LOOPS


@dataclass(frozen=True)
class Units:
    """How many of the new units of length, mass and time one old one is."""

    length: float
    mass: float
    time: float

    @property
    def force(self) -> float:
        return self.mass * self.length / self.time**2


TENS = st.integers(-3, 3).map(lambda e: 10.0**e)
UNITS = st.builds(Units, TENS, TENS, TENS)


def turned(v: Vector, turn: float) -> Vector:
    """A vector, turned counter-clockwise [rad]."""
    cos, sin = math.cos(turn), math.sin(turn)
    return cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]


def turned_scene(build: Build, turn: float) -> Scene:
    """The machine with its ground, its gravity and all that points somewhere, turned as a whole."""

    def joint(j: Joint) -> Joint:
        # the ground and a particle keep their axes, so what stands in them is turned by hand
        fixed = not build.turns(j.a.body) or j.a.body == GROUND
        first, second = (float(end.body == GROUND) for end in (j.a, j.b))
        left = tuple(
            replace(f, axis=turned(f.axis, turn)) if fixed and f.kind == "shift" else f
            for f in j.freedoms
        )
        return replace(j, freedoms=left, angle=j.angle + (first - second) * turn)

    def force(f: Force) -> Force:
        if isinstance(f, Push):
            return replace(f, signal=replace(f.signal, amplitude=turned(f.signal.amplitude, turn)))  # type: ignore[arg-type]
        return f

    def point(p: GroundPoint) -> GroundPoint:
        return GroundPoint(turned(p.at, turn), turned(p.velocity, turn))

    scene = build.scene
    return replace(
        scene,
        gravity=turned(scene.gravity, turn),
        points={name: point(p) for name, p in scene.points.items()},
        joints={name: joint(j) for name, j in scene.joints.items()},
        forces={name: force(f) for name, f in scene.forces.items()},
    )


def in_units(build: Build, u: Units) -> Scene:
    """The machine with every number in other units."""

    def long(v: Vector, by: float = u.length) -> Vector:
        return v[0] * by, v[1] * by

    def body(b: Body) -> Body:
        inertia = tuple(J * u.mass * u.length**2 for J in b.inertia)
        points = {name: long(at) for name, at in b.points.items()}
        radius = None if b.radius is None else b.radius * u.length
        return replace(b, mass=b.mass * u.mass, inertia=inertia, points=points, radius=radius)

    def force(f: Force) -> Force:
        match f:
            case Spring():
                c, l0 = f.stiffness * u.force / u.length, f.rest_length * u.length
                return replace(f, stiffness=c, rest_length=l0)
            case Damper():
                return replace(f, damping=f.damping * u.force * u.time / u.length)
            case Push() | Torque():
                size = u.force if isinstance(f, Push) else u.force * u.length
                law, signal = f.signal.law, f.signal
                size /= u.time if law == "ramp" else 1.0
                amplitude = tuple(a * size for a in signal.amplitude)
                w = signal.angular_frequency / u.time
                return replace(f, signal=replace(signal, amplitude=amplitude, angular_frequency=w))
        raise AssertionError(f)

    scene, speed = build.scene, u.length / u.time
    points: Mapping[str, GroundPoint] = {
        name: GroundPoint(long(p.at), long(p.velocity, speed)) for name, p in scene.points.items()
    }
    return replace(
        scene,
        gravity=long(scene.gravity, speed / u.time),
        points=points,
        bodies={name: body(b) for name, b in scene.bodies.items()},
        forces={name: force(f) for name, f in scene.forces.items()},
    )
