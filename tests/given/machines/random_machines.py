"""Random machines whose poses come first, so that every loop closes, and rates that fit them.

Whatever an engine has wrong in an orientation, a sign or an order shows at once.
"""

import math
from dataclasses import dataclass, field, replace
from functools import cache, partial

import numpy as np

from textmech.cases.scene import (
    CENTER,
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
)
from textmech.cases.scene.shape import bar, block, disk, particle, rigid
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.system import Array

GRAVITY = (0.8, -9.7)  # not along an axis, so that no component can hide
REGULAR = 0.05  # smallest singular value of the rows: nearer to singular, forces grow large


@dataclass(eq=False)  # each is itself, so that answers to it can be kept
class Build:
    """A scene in the making: poses (x, y, angle) in the order of the bodies."""

    rng: np.random.Generator
    bodies: dict[str, Body] = field(default_factory=dict)
    points: dict[str, GroundPoint] = field(default_factory=dict)
    joints: dict[str, Joint] = field(default_factory=dict)
    contacts: dict[str, Contact] = field(default_factory=dict)
    forces: dict[str, Force] = field(default_factory=dict)
    poses: dict[str, tuple[float, float, float]] = field(default_factory=dict)

    @property
    def scene(self) -> Scene:
        return Scene(GRAVITY, self.points, self.bodies, self.joints, self.contacts, self.forces)

    def number(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def vector(self, size: float) -> tuple[float, float]:
        return self.number(-size, size), self.number(-size, size)

    def body(self, kinds: tuple[str, ...]) -> str:
        name, m = f"b{len(self.bodies)}", self.number(0.5, 2.0)
        kind = str(self.rng.choice(kinds))
        self.bodies[name] = {
            "bar": bar(name=name, mass=m, length=self.number(0.5, 1), points={}),
            "block": block(name=name, mass=m, width=0.7, height=self.number(0.3, 1), points={}),
            "disk": disk(name=name, mass=m, radius=self.number(0.3, 0.6), points={}),
            "rigid": rigid(name=name, mass=m, inertia=self.number(0.05, 0.3), points={}),
            "particle": particle(name=name, mass=m),
        }[kind]
        turn = self.number(-3, 3) if self.bodies[name].turns else 0.0
        self.poses[name] = (*self.vector(0.8), turn)
        return name

    def turns(self, part: str) -> bool:
        return part == GROUND or self.bodies[part].turns

    def near(self, part: str) -> tuple[float, float]:
        """Somewhere in the world where the part can have a point."""
        if part == GROUND:
            return self.vector(0.8)
        x, y, _ = self.poses[part]
        dx, dy = self.vector(0.4) if self.turns(part) else (0.0, 0.0)
        return x + dx, y + dy

    def anchor(self, part: str, at: tuple[float, float], *, driven: bool = False) -> Anchor:
        """A new named point of the part at a place in the world."""
        if part == GROUND:
            name = f"O{len(self.points)}"
            self.points[name] = GroundPoint(at, self.vector(0.5) if driven else (0.0, 0.0))
            return Anchor(GROUND, name)
        body = self.bodies[part]
        if not body.turns:
            return Anchor(part, CENTER)
        x, y, turn = self.poses[part]
        cos, sin = math.cos(turn), math.sin(turn)
        dx, dy = at[0] - x, at[1] - y
        name = f"P{len(body.points)}"
        local = (cos * dx + sin * dy, cos * dy - sin * dx)
        self.bodies[part] = replace(body, points={**body.points, name: local})
        return Anchor(part, name)

    def angle(self, part: str) -> float:
        return 0.0 if part == GROUND else self.poses[part][2]

    def join(self, kind: str, a: str, b: str, *, driven: bool = False) -> None:
        name = f"j{len(self.joints)}"
        loose = a if self.turns(a) and a != GROUND else b  # a particle's place decides for both
        at = (
            self.near(b if loose == a else a)
            if self.turns(a) and self.turns(b)
            else (self.near(b if not self.turns(b) else a))
        )
        along, place = (1.0, 0.0), at
        if kind == "slide":
            turn, shift = self.number(-3, 3), self.number(-0.5, 0.5)
            along = (math.cos(turn), math.sin(turn))
            turn += self.angle(a)
            there = (at[0] + shift * math.cos(turn), at[1] + shift * math.sin(turn))
            if self.turns(b) and b != GROUND:
                place = there
            else:
                at, place = (2 * at[0] - there[0], 2 * at[1] - there[1]), at
        held = self.angle(b) - self.angle(a) if kind != "pin" else 0.0
        ends = self.anchor(a, at, driven=driven), self.anchor(b, place, driven=driven)
        self.joints[name] = planar_joint(name, kind, *ends, along, held)  # type: ignore[arg-type]

    def somewhere(self, part: str) -> Anchor:
        return self.anchor(part, self.near(part))

    def load(self) -> None:
        """Two springs, a damper, and one push or torque of every law."""
        names = list(self.bodies)
        for i in range(3):
            a, b = self.rng.permutation([GROUND, *names])[:2].tolist()
            name, ends = f"line{i}", (self.somewhere(a), self.somewhere(b))
            if i < 2:
                self.forces[name] = Spring(name, *ends, self.number(5, 40), self.number(0.1, 0.6))
            else:
                self.forces[name] = Damper(name, *ends, self.number(0.5, 3))
        for law in ("constant", "ramp", "sine"):
            body = str(self.rng.choice(names))
            wave = (self.number(3, 30), self.number(-3, 3)) if law == "sine" else (0.0, 0.0)
            self.forces[f"push_{law}"] = Push(
                f"push_{law}", self.somewhere(body), Signal(law, self.vector(4), *wave)
            )
            if self.turns(body):
                self.forces[f"turn_{law}"] = Torque(
                    f"turn_{law}", body, Signal(law, (self.number(-2, 2),), *wave)
                )


def mechanism(build: Build) -> Multibody:
    """The scene with random rates, as near to them as the constraints allow."""
    q = [x for n, p in build.poses.items() for x in (p if build.turns(n) else p[:2])]
    still = Multibody(build.scene, (np.array(q), np.zeros(len(q))))
    v = build.rng.normal(size=len(q))
    rows, g = still.f_a(0.0, np.array(q)), still.g(0.0, np.array(q))
    v += np.linalg.lstsq(rows, g - rows @ v, rcond=None)[0] if len(rows) else 0.0
    return Multibody(build.scene, (np.array(q), v))


def regular(build: Build) -> bool:
    """Independent constraints, not nearly singular, and something left to move."""
    found = mechanism(build)
    rows = found.f_a(0.0, found.start()[0])
    if not len(rows):
        return True
    return len(rows) < rows.shape[1] and float(np.linalg.svd(rows)[1][-1]) > REGULAR


def loops(scene: Scene) -> int:
    """How many joints join what is joined already."""
    group, closing = {part: part for part in (GROUND, *scene.bodies)}, 0
    for joint in scene.joints.values():
        a, b = group[joint.a.body], group[joint.b.body]
        closing += a == b
        group = {part: a if head == b else head for part, head in group.items()}
    return closing


def tree(seed: int, *, count: int = 4, driven: bool = False) -> Build:
    """Bodies that hang on earlier ones, on the ground, on a driven point, or on nothing."""
    build = Build(np.random.default_rng(seed))
    for i in range(count):
        body = build.body(("bar", "block", "disk", "rigid", "particle"))
        parents = [GROUND, *list(build.bodies)[:-1]]
        parent = GROUND if i == 0 else str(build.rng.choice(parents))
        if i and build.rng.random() < 0.1:
            continue  # it flies
        kind = str(build.rng.choice(["pin", "pin", "slide", "weld"]))
        if kind == "slide" and not (build.turns(parent) and build.turns(body)):
            kind = "pin"
        if not build.turns(parent) and not build.turns(body):
            build.poses[body] = build.poses[parent]
        ends = (parent, body) if build.rng.random() < 0.5 else (body, parent)
        joints, bodies, points = dict(build.joints), dict(build.bodies), dict(build.points)
        build.join(kind, *ends, driven=driven and parent == GROUND)
        if not regular(build):  # a particle pinned to the ground, a body welded to it
            build.joints, build.bodies, build.points = joints, bodies, points
    build.load()
    return build


def chain(seed: int, *, driven: bool = False) -> Build:
    """A tree that one more pin closes."""
    for again in range(1000, 100_000, 1000):
        build = tree(seed + again, count=4, driven=driven)
        loose = [name for name in (GROUND, *build.bodies) if build.turns(name)]
        if len(loose) < 2:
            continue
        a, b = build.rng.permutation(loose)[:2].tolist()
        build.join("pin", a, b)
        if loops(build.scene) and regular(build):
            return build
    raise AssertionError(f"seed {seed} closes no loop")


def rolling(seed: int, *, wheels: int) -> Build:
    """Heavy wheels that roll, each with an eccentric pendulum, joined by a spring, and pushed."""
    build = Build(np.random.default_rng(seed))
    for i in range(wheels):
        name, radius = f"w{i}", build.number(0.3, 0.5)
        build.bodies[name] = disk(name=name, mass=build.number(4, 6), radius=radius, points={})
        build.poses[name] = (1.5 * i, radius, build.number(-3, 3))
        build.contacts[f"touch{i}"] = Contact(
            f"touch{i}", Anchor(name, "center"), 5.0, 5.0, ideal="rolling"
        )
        build.join("pin", *((name, build.body(("bar",))) if i else (build.body(("bar",)), name)))
    build.load()
    return build


@cache
def machines(count: int) -> list[Multibody]:
    """Returns trees, loops and pairs of rolling wheels, some of them on driven points."""
    builds = []
    for seed in range(count):
        make = partial((tree, chain)[seed % 2], driven=seed % 4 < 2)
        builds.append(make(seed) if seed % 3 else rolling(seed, wheels=2))
    return [mechanism(build) for build in builds]


def state(
    random: np.random.Generator, machine: Multibody, spread: float = 0.0
) -> tuple[float, Array, Array]:
    """Returns t, places about those of the start, and rates that meet the rows there."""
    n = len(machine.coordinates)
    t, q = random.uniform(0.0, 3.0), machine.start()[0] + spread * random.uniform(-1.0, 1.0, n)
    v, rows, g = random.uniform(-3.0, 3.0, n), machine.f_a(t, q), machine.g(t, q)
    return float(t), q, v - np.linalg.lstsq(rows, rows @ v - g)[0] if len(rows) else v
