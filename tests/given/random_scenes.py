"""Random planar scenes, their mechanisms and states, for laws that hold for all of them."""

from collections.abc import Iterator

import numpy as np

from textmech.cases.scene import (
    GROUND,
    Anchor,
    Body,
    Contact,
    Damper,
    Force,
    GroundPoint,
    Joint,
    Push,
    Scene,
    Signal,
    Spring,
    Torque,
    planar_joint,
    shape,
)
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.system import Array

Random = np.random.Generator


def bodies(random: Random, count: int) -> dict[str, Body]:
    """Bars, blocks, disks, rigid bodies and particles in turn, with a point P off centre."""
    made = {}
    for i in range(count):
        name, m = f"b{i}", random.uniform(0.3, 3.0)
        length, other = random.uniform(0.2, 1.5, 2).tolist()
        points = {"P": tuple(random.uniform(-0.7, 0.7, 2).tolist())}
        kind = random.integers(5)
        if kind == 0:
            body = shape.bar(name=name, mass=m, length=length, points=points)
        elif kind == 1:
            body = shape.block(name=name, mass=m, width=length, height=other, points=points)
        elif kind == 2:
            body = shape.disk(name=name, mass=m, radius=length, points=points)
        elif kind == 3:
            body = shape.rigid(name=name, mass=m, inertia=other, points=points)
        else:
            body = shape.particle(name=name, mass=m)
        made[name] = body
    return made


def anchor(random: Random, scene_bodies: dict[str, Body], name: str) -> Anchor:
    """Any point of a body, or of the ground."""
    points = ["O", "hook"] if name == GROUND else sorted(scene_bodies[name].points)
    return Anchor(name, points[random.integers(len(points))])


def joint(random: Random, name: str, kind: str, a: Anchor, b: Anchor) -> Joint:
    """A joint with an odd direction and angle."""
    turn, angle = random.uniform(-3.0, 3.0, 2).tolist()
    along = (float(np.cos(turn)), float(np.sin(turn)))
    length = 1.3 if kind == "distance" else None
    return planar_joint(name, kind, a, b, along=along, angle=angle, length=length)  # type: ignore[arg-type]


def scene(random: Random, *, free: bool = False, loops: bool = True) -> Scene:
    """A tree of bodies, a loop where there is room for one, and forces of every kind.

    `free`: nothing is tied to the ground, and no force comes from outside.
    """
    made = bodies(random, int(random.integers(2, 5)))
    names = list(made)
    joints: dict[str, Joint] = {}
    for i, name in enumerate(names):
        parents = names[:i] + ([] if free else [GROUND])
        if not parents or random.random() < 0.15:  # some bodies are held by forces only
            continue
        a = anchor(random, made, parents[random.integers(len(parents))])
        kind = ("pin", "pin", "slide", "weld")[random.integers(4)]
        joints[f"j{i}"] = joint(random, f"j{i}", kind, a, anchor(random, made, name))
    if loops and len(names) > 2 and random.random() < 0.5:
        a, b = anchor(random, made, names[0]), anchor(random, made, names[-1])
        joints["loop"] = joint(random, "loop", ("pin", "slide")[random.integers(2)], a, b)
    return Scene(
        gravity=(0.0, 0.0) if free else (float(random.uniform(-4, 4)), -9.80665),
        points={"O": GroundPoint((0.1, -0.2)), "hook": GroundPoint((0.3, 0.8), (0.7, -0.4))},
        bodies=made,
        joints=joints,
        contacts={},
        forces={
            name: force
            for name, force in forces(random, made, free=free).items()
            if not isinstance(force, Spring | Damper)  # a line between joined points has no length
            or not any({force.a, force.b} == {j.a, j.b} for j in joints.values())
        },
    )


def forces(random: Random, made: dict[str, Body], *, free: bool) -> dict[str, Force]:
    """Two springs and two dampers; unless `free`, also a push and a torque of each law."""
    found: dict[str, Force] = {}
    names = list(made) + ([] if free else [GROUND])
    for i in range(2):
        for kind in ("spring", "damper"):
            first, second = random.choice(names, 2, replace=False).tolist()
            a, b = anchor(random, made, first), anchor(random, made, second)
            name, c = f"{kind}{i}", float(random.uniform(1.0, 40.0))
            found[name] = Spring(name, a, b, c, 0.4) if kind == "spring" else Damper(name, a, b, c)
    for law in () if free else ("constant", "ramp", "sine"):
        fx, fy, moment, w, phase = random.uniform(-5.0, 5.0, 5).tolist()
        at = anchor(random, made, list(made)[random.integers(len(made))])
        found[f"push_{law}"] = Push(f"push_{law}", at, Signal(law, (fx, fy), abs(w), phase))
        for body in [b for b in made.values() if b.turns][:1]:
            found[f"torque_{law}"] = Torque(
                f"torque_{law}", body.name, Signal(law, (moment,), abs(w), phase)
            )
    return found


def rolling(random: Random) -> Scene:
    """A disk that rolls on the floor, with a bar pinned to a point off its centre."""
    disk = shape.disk(name="b0", mass=1.3, radius=0.4, points={"P": (0.2, 0.1)})
    bar = shape.bar(name="b1", mass=0.6, length=0.9, points={})
    return Scene(
        gravity=(2.0, -9.0),
        points={},
        bodies={"b0": disk, "b1": bar},
        joints={"j1": joint(random, "j1", "pin", Anchor("b0", "P"), Anchor("b1", "start"))},
        contacts={"touch": Contact("touch", Anchor("b0", "center"), 0.5, 0.5, ideal="rolling")},
        forces={},
    )


def state(random: Random, mechanism: Multibody) -> tuple[float, Array, Array]:
    """Random t, q and v; the rates meet the constraints, the places need not."""
    n = len(mechanism.coordinates)
    t, q, v = random.uniform(0.0, 3.0), random.uniform(-2.0, 2.0, n), random.uniform(-3.0, 3.0, n)
    rows, g = mechanism.f_a(t, q), mechanism.g(t, q)
    if len(rows):
        v = v - np.linalg.lstsq(rows, rows @ v - g)[0]
    return float(t), q, v


def closed(mechanism: Multibody, t: float, q: Array) -> Array:
    """The places near q that close all joints, by Newton's method."""
    for _ in range(50):  # quadratic near the end, damped before
        f = mechanism.f(t, q)
        if not len(f) or np.max(np.abs(f)) < 1e-13:
            return q
        change = np.linalg.lstsq(mechanism.f_a(t, q), f)[0]
        q = q - change * min(1.0, 1.0 / np.max(np.abs(change)))
    raise AssertionError("the random scene does not close")


def mechanisms(count: int, seed: int = 1) -> Iterator[tuple[Multibody, Random]]:
    """Mechanisms of random scenes, independently constrained, and the generator of their states."""
    random = np.random.default_rng(seed)
    while count:
        made = rolling(random) if count % 10 == 0 else scene(random)
        n = sum(3 if b.turns else 2 for b in made.bodies.values())
        mechanism = Multibody(made, (np.zeros(n), np.zeros(n)))
        if independent(mechanism, random):
            count -= 1
            yield mechanism, random


def independent(mechanism: Multibody, random: Random) -> bool:
    """Whether no joint repeats another, by 1e-2: so that rounding grows by 1e4 at most."""
    rows = mechanism.f_a(0.0, random.uniform(-2.0, 2.0, len(mechanism.coordinates)))
    return not len(rows) or bool(np.linalg.svd(rows, compute_uv=False)[-1] > 1e-2)
