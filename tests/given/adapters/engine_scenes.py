"""Scenes on which engines are tried, each with its start, and the bodies they are made of."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from textmech.cases.scene import (
    GROUND,
    Anchor,
    Body,
    Bounds,
    Contact,
    DryFriction,
    Force,
    GroundPoint,
    Joint,
    Push,
    Scene,
    Signal,
    Smooth,
    Spring,
    planar_joint,
)
from textmech.cases.scene.shape import bar, block, disk, particle
from textmech.engines.engine import Start

G = 9.80665  # m/s²
RADIUS = 0.3  # m
ROD = bar(name="rod", mass=1.0, length=1.0, points={})
BOX = block(name="box", mass=1.0, width=0.2, height=0.2, points={})
BOB = particle(name="bob", mass=1.0)
BLOCK = particle(name="block", mass=1.3)
WHEEL = disk(name="wheel", mass=1.3, radius=RADIUS, points={})
ROLLS = Contact("touch", Anchor("wheel", "center"), 0.5, 0.5, ideal="rolling")
ORIGIN = Anchor(GROUND, "O")
ODD_NAMES = (
    "floor", "ground_link", "groundhog", "start", "center", "x", "textmech", "space", "h", "world",
)  # fmt: skip
"""Of bodies: what the engines' files also use."""


def pin(name: str, a: str, b: str, kind: Any = "pin", **given: Any) -> Joint:
    """A joint between `body.point` and `body.point`."""
    (p, q), (r, s) = a.split("."), b.split(".")
    return planar_joint(name, kind, Anchor(p, q), Anchor(r, s), **given)


def machine(
    parts: Sequence[Body],
    joints: Sequence[Joint] = (),
    *,
    contacts: Sequence[Contact] = (),
    forces: Sequence[Force] = (),
) -> Scene:
    """Parts under gravity, with ground points O at the origin and Q 1 m to its right."""
    points = {"O": GroundPoint((0.0, 0.0)), "Q": GroundPoint((1.0, 0.0))}
    return Scene(
        (0.0, -G),
        points,
        {part.name: part for part in parts},
        {joint.name: joint for joint in joints},
        {contact.name: contact for contact in contacts},
        {force.name: force for force in forces},
    )


def with_bodies(scene: Scene, change: Callable[[Body], Body]) -> Scene:
    """The scene with every body changed."""
    return replace(scene, bodies={name: change(body) for name, body in scene.bodies.items()})


def with_forces(scene: Scene, kind: type, change: Callable[[Any], Any]) -> Scene:
    """The scene with every force of a kind changed."""
    changed = {n: change(f) if isinstance(f, kind) else f for n, f in scene.forces.items()}
    return replace(scene, forces=changed)


def shaken() -> tuple[Scene, Start]:
    """A mass on a rail between a fast sine and a spring, far from length 0 and its kink."""
    push = Push("push", Anchor("box", "center"), Signal("sine", (9.0, 1.0), 12.0, 0.4))
    coil = Spring("coil", ORIGIN, Anchor("box", "center"), 50.0, 1.8)
    slide = pin("rail", "ground.O", "box.center", "slide")
    return machine([BOX], [slide], forces=[push, coil]), {"box": (2.0, 0, 0, 0, 0, 0)}


def chain(n: int) -> tuple[Scene, Start]:
    """n bars hung from one pin, released horizontally."""
    parts = [bar(name=f"b{i}", mass=1.0, length=0.4, points={}) for i in range(n)]
    ends = ["ground.O", *(f"b{i}.end" for i in range(n))]
    joints = [pin(f"j{i}", ends[i], f"b{i}.start") for i in range(n)]
    return machine(parts, joints), {f"b{i}": (0.4 * i + 0.2, 0, 0, 0, 0, 0) for i in range(n)}


ALONG = (math.cos(0.3), math.sin(0.3))


def on_a_swing(kind: str) -> tuple[Scene, Start]:
    """A block that slides on a turning rod, or is welded to it: turned, its point off centre."""
    rod = bar(name="rod", mass=1.1, length=0.9, points={"P": (0.1, 0.07)})
    box = block(name="box", mass=0.6, width=0.2, height=0.1, points={"Q": (0.03, -0.04)})
    hinge = pin("hinge", "ground.O", "rod.start")
    rail = pin("rail", "rod.P", "box.Q", kind, along=ALONG, angle=0.5)
    coil = Spring("coil", Anchor("rod", "end"), Anchor("box", "center"), 40.0, 0.3)
    scene = machine([rod, box], [hinge, rail], forces=[coil] if kind == "slide" else [])
    a, omega, slip = -0.4, 1.5, 0.3 if kind == "slide" else 0.0

    def state(x: float, y: float, angle: float, slip: float) -> tuple[float, ...]:
        """Of a point (x, y) of the rod that slips along the rail, in ground axes."""
        cos, sin = math.cos(a), math.sin(a)
        x, y = cos * x - sin * y, sin * x + cos * y
        ux, uy = cos * ALONG[0] - sin * ALONG[1], sin * ALONG[0] + cos * ALONG[1]
        return (x, y, angle, -omega * y + slip * ux, omega * x + slip * uy, omega)

    cos, sin = math.cos(0.5), math.sin(0.5)
    center = 0.45 + 0.1 - (cos * 0.03 + sin * 0.04), 0.07 - (sin * 0.03 - cos * 0.04)
    return scene, {"rod": state(0.45, 0.0, a, 0.0), "box": state(*center, a + 0.5, slip)}  # type: ignore[dict-item]


def in_a_slot() -> tuple[Scene, Start]:
    """A rod that hangs from a slot of the ground by its end, and swings."""
    rod = replace(ROD, points={**ROD.points, "P": (-0.4, 0.05)})
    guide = pin("guide", "ground.O", "rod.P", "slot", along=(0.8, 0.6))
    cos, sin = math.cos(-1.0), math.sin(-1.0)
    x, y = 0.4 * cos + 0.05 * sin, 0.4 * sin - 0.05 * cos
    return machine([rod], [guide]), {"rod": (x, y, -1.0, 0.0, 0.0, 0.0)}


# On the floor


def touching(
    body: str, kinetic: float, *, static: float | None = None,
    restitution: float = 0.0, point: str = "center",
) -> Contact:  # fmt: skip
    """A contact named `touch` of the body's centre, or after its point."""
    name = "touch" if point == "center" else f"touch_{point}"
    return Contact(name, Anchor(body, point), static or kinetic, kinetic, restitution)


def incline(body: Body, *contacts: Contact, slope: float = 0.0) -> Scene:
    """A body on the floor, which falls to the right by `slope` [rad]."""
    gravity = (G * math.sin(slope), -G * math.cos(slope))
    return Scene(gravity, {}, {body.name: body}, {}, {c.name: c for c in contacts}, {})


def thrown(v: float) -> Start:
    """The block with a speed [m/s] to the right."""
    return {"block": (0.0, 0.0, 0.0, v, 0.0, 0.0)}


def launched(v: float, omega: float = 0.0, *, height: float = 0.0) -> Start:
    """The wheel with a speed [m/s] and a spin [rad/s], `height` [m] above the floor."""
    return {"wheel": (0.0, RADIUS + height, 0.0, v, 0.0, omega)}


def leaning(length: float, angle: float) -> Start:
    """The rod at rest with its start on the floor, at an angle [rad] to it."""
    x, y = length / 2 * math.cos(angle), length / 2 * math.sin(angle)
    return {"rod": (x, y, angle, 0.0, 0.0, 0.0)}


# Dry friction on a slide: Examples 2.3 and 2.4

SIX, THREE = Bounds(6.0, 6.0), Bounds(3.0, 3.0)  # N
GROWING = Push("pull", Anchor("block", "center"), Signal("ramp", (-1.0, 0.0)))
DRAWN = Spring("pull", Anchor("block", "center"), Anchor(GROUND, "hook"), 2.0, 10.0)
"""By a hook that leaves with 2 m/s: −2 x + 4 t."""
RESTS = thrown(0.0)


def guided(
    force: Force | None, static: Bounds = SIX, kinetic: Bounds = THREE, smooth: Smooth | None = None
) -> Scene:
    """A block of 1 kg on a slide with dry friction, and a force."""
    dry = DryFriction(static, kinetic, smooth)
    guide = pin("guide", "ground.O", "block.center", "slide", dry_friction=dry)
    hook = {"hook": GroundPoint((10.0, 0.0), (2.0, 0.0))} if force is DRAWN else {}
    points = {"O": GroundPoint((0.0, 0.0)), **hook}
    forces = {force.name: force} if force else {}
    return Scene(
        (0.0, -G), points, {"block": replace(BLOCK, mass=1.0)}, {"guide": guide}, {}, forces
    )
