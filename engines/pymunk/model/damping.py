"""Linear drag as `space.damping`: v ← v exp(−h d/m), of all bodies alike, and of their turning too.

So pymunk has it where each body is slowed by the same d/m, and nothing turns.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ....cases.scene import CENTER, GROUND, Anchor, Body, Couple, Drag, Scene, Torque, Viscous
from ....cases.scene.forces.force import of_kind
from ...engine import Start

ALIKE = 1e-12  # of a rate d/m: what rounding of its numbers leaves
FASTEST = 700.0  # 1/s: exp(−700) is near the least double


@dataclass(frozen=True)
class Slowing:
    """A force that slows by a power of the speed.

    body: whose centre it slows against the ground; d: its coefficient [kg/s], alike both ways where
    `unlike` says nothing: else why it slows no body as a whole by its speed.
    """

    name: str
    body: str | None
    d: float
    numbers: tuple[str, ...]  # the names of its coefficients, as they are read back
    unlike: str


def slowing(scene: Scene) -> list[Slowing]:
    """The forces that slow by a power of the speed."""
    drags = (_drag(force) for force in of_kind(Drag, scene.forces.values()))
    return [*drags, *(_viscous(scene, force) for force in of_kind(Viscous, scene.forces.values()))]


SLOWS = "pymunk's space.damping slows"
A_POWER = "pymunk has no friction by a power of the speed"


def _drag(force: Drag) -> Slowing:
    unlike = ""
    if force.exponent != 1.0:
        unlike = A_POWER
    elif force.along is not None:
        unlike = f"{SLOWS} alike in all directions, and {force.name} does not"
    elif force.at.point != CENTER:
        unlike = f"{SLOWS} a body as a whole, and {force.name} a point beside its centre"
    return Slowing(force.name, force.at.body, force.coefficient, ("coefficient",), unlike)


def _viscous(scene: Scene, force: Viscous) -> Slowing:
    joint, d = scene.joints[force.joint], force.coefficient
    still = [e for e in joint.refers() if e.body == GROUND and not scene.points[e.point].driven]
    moving = [e.body for e in joint.refers() if e.body != GROUND]
    body = moving[0] if still and moving and not joint.turns else None
    unlike = ""
    if force.exponent != 1.0:
        unlike = A_POWER
    elif d.forward != d.backward:
        unlike = f"{SLOWS} alike both ways, and {force.name} does not"
    elif body is None:
        unlike = f"{SLOWS} against the ground, where no slide turns"
    return Slowing(force.name, body, d.forward, ("forward", "backward"), unlike)


def rate(scene: Scene) -> float:
    """d/m [1/s], alike of all bodies where `not_alike` tells nothing; 0 of no such force."""
    return max(_rates(scene).values(), default=0.0) if slowing(scene) else 0.0


def numbers(scene: Scene, damping: float) -> dict[str, float]:
    """The coefficients that the space's `damping` holds, by quantity."""
    forces, coefficients = slowing(scene), dict[str, float]()
    for force in forces:
        body = scene.bodies[force.body or ""]
        if sum(other.body == force.body for other in forces) == 1:
            d = -math.log(damping) * body.mass
            coefficients |= {f"{force.name}.{name}": d for name in force.numbers}
    return coefficients


def not_alike(scene: Scene, start: Start) -> tuple[str, str] | None:
    """The first of these forces that `space.damping` is not, by its name, and why; or None."""
    for force in slowing(scene):
        if force.unlike:
            return force.name, f"engine: {force.unlike}"
    rates = _rates(scene)
    for force in slowing(scene):
        least, most = min(rates, key=rates.__getitem__), max(rates, key=rates.__getitem__)
        if rates[most] - rates[least] > ALIKE * rates[most]:
            what = f"{most} loses {rates[most]:g} 1/s and {least} {rates[least]:g}"
            return force.name, f"engine: {SLOWS} all bodies alike: {what}"
        if rates[most] > FASTEST:
            why = f"pymunk's space.damping has no number for {rates[most]:g} 1/s"
            return force.name, f"engine: {why}"
        for body in scene.bodies.values():
            if not _stays_unturned(scene, body, start):
                return force.name, f"engine: {SLOWS} turning too, as that of {body.name}"
    return None


def _rates(scene: Scene) -> dict[str, float]:
    """d/m [1/s] of each body."""
    rates = dict.fromkeys(scene.bodies, 0.0)
    for force in slowing(scene):
        if force.body:
            rates[force.body] += force.d / scene.bodies[force.body].mass
    return rates


def _stays_unturned(scene: Scene, body: Body, start: Start) -> bool:
    """Whether it is held at an angle, or starts without a turn and nothing turns it."""
    joints = [joint for joint in scene.joints.values() if body.name in _bodies(joint.refers())]
    if not body.turns or any(not j.turns and GROUND in _bodies(j.refers()) for j in joints):
        return True
    twists = [*of_kind(Torque, scene.forces.values()), *of_kind(Couple, scene.forces.values())]
    touching = (*twists, *scene.contacts.values(), *scene.pairs.values())
    touching = (*joints, *touching, *scene.constraints.values())
    beside = any(
        end.point != CENTER
        for force in scene.forces.values()
        for end in scene.ends(force)
        if end.body == body.name
    )
    turned = any(body.name in _bodies(part.refers()) for part in touching)
    return body.name in start and start[body.name][5] == 0.0 and not (turned or beside)


def _bodies(ends: Sequence[Anchor]) -> list[str]:
    return [end.body for end in ends]
