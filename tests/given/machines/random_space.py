"""Random machines in space: joints and forces of every kind, loops, what rolls, blades, drives."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from textmech.cases.scene import CENTER, GROUND, Anchor, Damper, Push, Signal, Spring, Torque
from textmech.cases.scene import solid as shape
from textmech.cases.scene.body import Body
from textmech.cases.scene.constraint import Edge
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Freedom, Joint
from textmech.reference.system import Array

from ..adapters.engine_space import particle, rigid, unit, vector
from .space_machine import Machine, T
from .spatial_motions import turn

REGULAR = 0.05  # smallest singular value of the rows: nearer to singular, forces grow large


def solid(made: Machine) -> Body:
    """With a tensor whose axes are nobody's."""
    A = made.rng.normal(size=(3, 3))
    S = 0.02 * A @ A.T + 0.01 * np.eye(3)  # tr(S) − S has mass everywhere
    return rigid(f"b{len(made.bodies)}", made.number(0.5, 2.0), np.trace(S) * np.eye(3) - S)


def any_body(made: Machine) -> Body:
    """A solid, a slender bar, or a particle."""
    name, mass = f"b{len(made.bodies)}", made.number(0.5, 2.0)
    kind = made.rng.choice(["solid", "solid", "solid", "bar", "particle"])
    if kind == "bar":
        return shape.bar(name=name, mass=mass, length=made.number(0.5, 1.0), points={})
    return particle(name, mass) if kind == "particle" else solid(made)


def freedoms(made: Machine, kind: str) -> Sequence[Freedom]:
    """What a joint of the kind leaves, about and along any axes."""
    axes = [unit(made.axis()) for _ in range(5)]
    turns = [Freedom.turn(axes[i], f"phi{i}") for i in range(3)]
    shifts = [Freedom.shift(axes[3 + i], f"s{i}") for i in range(2)]
    some = [*shifts[: made.rng.integers(1, 3)], *turns[: made.rng.integers(1, 4)]]
    found: dict[str, list[Freedom]] = {
        "hinge": [Freedom.turn(axes[0], "angle")], "ball": [Freedom("ball")],
        "universal": turns[:2], "slide": [Freedom.shift(axes[3], "shift")], "weld": [],
        "freedoms": some,
    }  # fmt: skip
    return found[kind]


KINDS = ("hinge", "hinge", "ball", "universal", "slide", "weld", "freedoms", "freedoms")


def hang(made: Machine, body: Body) -> None:
    """The body on any part, by any joint: where its freedoms take it."""
    parent, name = made.part(), f"j{len(made.joints)}"
    kind: Any = "hinge" if body.shape == "bar" else made.rng.choice(KINDS)
    free, at = freedoms(made, kind), made.near(parent)
    a, R, place = made.anchor(parent, at), made.poses[parent][1], at
    for freedom in free:
        if freedom.kind == "shift":
            place = place + made.number(-0.5, 0.5) * made.poses[parent][1] @ freedom.axis
        else:
            R = R @ (
                made.turn() if freedom.kind == "ball"
                else turn(freedom.axis, made.number(-1.2, 1.2))
            )  # fmt: skip
    made.bodies[body.name] = body
    arm = made.vector(0.4) if body.turns else np.zeros(3)
    made.poses[body.name] = place - arm, R if body.turns else np.eye(3)
    made.joints[name] = Joint(name, kind, a, made.anchor(body.name, place), (*free,), frame=SPACE)


def close(made: Machine) -> None:
    """The last body that turns and any part, by a joint that leaves them where they are."""
    b = [name for name, body in made.bodies.items() if body.turns][-1]
    a, place, name = made.part(b), made.near(b), f"j{len(made.joints)}"
    R: Array = made.poses[a][1].T @ made.poses[b][1]
    apart = Rotation.from_matrix(R).as_rotvec()
    some = ["ball", "universal", "hinge", "freedoms"] if apart.any() else ["ball"]
    kind: Any = made.rng.choice(some)
    free: Sequence[Freedom] = freedoms(made, kind)
    if kind == "hinge":  # about the axis of the turn that leads from one to the other
        free = (replace(free[0], axis=unit(apart)),)
    elif kind == "universal":  # n₁·n₂ is what it is where all axes are parallel
        across = np.cross((R - np.eye(3)).T @ free[0].axis, made.axis())
        free = (free[0], replace(free[1], axis=unit(across)))
    start = place
    if kind == "freedoms":
        s = free[0]
        free = (s, *(Freedom.turn(unit(made.axis()), f"phi{i}") for i in range(3)))
        start = place - made.number(-0.5, 0.5) * made.poses[a][1] @ s.axis
    ends = made.anchor(a, start), made.anchor(b, place)
    made.joints[name] = Joint(name, kind, *ends, (*free,), frame=SPACE)


def roll(made: Machine) -> None:
    """A disk or a sphere on the floor, tilted somehow but not flat."""
    name, R, radius = f"b{len(made.bodies)}", made.turn(), made.number(0.2, 0.5)
    r, axle = made.vector(1.0), unit(made.axis())
    while abs((R @ axle)[2]) > 0.9:
        axle = unit(made.axis())
    rim = bool(made.rng.integers(2))
    if rim:
        body = shape.disk(name=name, mass=1.3, radius=radius, axle=axle, points={})
    else:
        body = shape.sphere(name=name, mass=1.3, radius=radius, points={})
    up = (R @ axle)[2] if rim else 0.0
    r[2] = radius * np.sqrt(1 - up**2)
    made.bodies[name], made.poses[name] = body, (r, R)
    made.contacts["touch"] = spatial_contact("touch", Anchor(name, CENTER), 0.5, rim)


def push(made: Machine, *, driven: bool) -> None:
    """Forces of each kind, and a prescribed rate."""
    parts = [GROUND, *made.bodies]
    for kind in (Spring, Damper):
        one, other = made.rng.choice(parts, 2, replace=False)
        a, b = (made.anchor(str(part), made.near(str(part))) for part in (one, other))
        c = made.number(1.0, 40.0)
        force = Spring("spring", a, b, c, 0.4) if kind is Spring else Damper("damper", a, b, c)
        made.forces[force.name] = force
    for law in ("constant", "ramp", "sine"):
        at = str(made.rng.choice([*made.bodies]))
        anchor, numbers = made.anchor(at, made.near(at)), (abs(made.number(1.0, 5.0)), 0.7)
        made.forces[f"push_{law}"] = Push(
            f"push_{law}", anchor, Signal(law, vector(made.vector(5.0)), *numbers)
        )
        if made.bodies[at].turns:
            twist = Signal(law, vector(made.vector(2.0)), *numbers)
            made.forces[f"torque_{law}"] = Torque(f"torque_{law}", at, twist)
    rates = [
        f"{joint.name}.{rate}"
        for joint in made.joints.values()
        for rate, freedom in joint.rates.items()
        if all(made.bodies[b.body].turns for b in joint.refers() if b.body != GROUND)
        and (freedom.kind == "shift" or len(joint.turns) < 3)
    ]
    if driven and rates:
        law = Signal("sine", (made.number(0.5, 2.0),), made.number(1.0, 5.0), 0.4)
        made.drives[str(made.rng.choice(rates))] = law


def blade(made: Machine) -> None:
    """On the last body that turns; its height may be kept."""
    name = [name for name, body in made.bodies.items() if body.turns][-1]
    at = made.anchor(name, made.near(name))
    along, kept = unit(made.axis()), bool(made.rng.integers(2))
    edge = Edge("blade", at, along, kept=kept, frame=SPACE)
    made.constraints["blade"] = edge


def tree(made: Machine) -> None:
    """Two or three bodies, of which the first may be free."""
    if made.rng.random() < 0.3:
        made.bodies["b0"], made.poses["b0"] = solid(made), (made.vector(0.8), made.turn())
    else:
        hang(made, solid(made))
    for _ in range(made.rng.integers(1, 3)):
        hang(made, any_body(made))


def loop(made: Machine) -> None:
    """A tree whose last body is joined to another part once more."""
    tree(made)
    close(made)


def rolling(made: Machine) -> None:
    """What rolls, and something that hangs on it or on the ground."""
    roll(made)
    hang(made, any_body(made))


def bladed(made: Machine) -> None:
    """A tree with a blade."""
    tree(made)
    blade(made)


MAKES: dict[str, Callable[[Machine], None]] = {
    "tree": tree, "loop": loop, "rolling": rolling, "blade": bladed,
}  # fmt: skip


def machine(seed: int, kind: str, *, driven: bool = False, t: float = T) -> Machine:
    """The first of its seed whose rows are independent, and which can move."""
    rng = np.random.default_rng([seed, *kind.encode()])
    while True:
        made = Machine(kind, rng, t)
        MAKES[kind](made)
        push(made, driven=driven)
        rows = made.mode.rows(t, made.q, np.zeros(made.mode.where.size))[0]
        least = np.min(np.linalg.svd(rows, compute_uv=False), initial=1.0)
        if len(rows) < made.mode.where.size and least > REGULAR:
            return made
