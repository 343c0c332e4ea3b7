"""Linear drag as `space.damping`: v ← v exp(−h d/m), of all bodies alike, and of their turning too.

So pymunk has it where each body is slowed by the same d/m, and nothing turns.
"""

import math
from collections.abc import Sequence

from ....cases.scene import CENTER, GROUND, Anchor, Body, Couple, Drag, Scene, Torque, Viscous
from ....cases.scene.forces.force import of
from ...engine import Start

ALIKE = 1e-12  # of a rate d/m: what rounding of its numbers leaves
FASTEST = 700.0  # 1/s: exp(−700) is near the least double

Slowing = Drag | Viscous


def slowing(scene: Scene) -> list[Slowing]:
    """The forces that slow by a power of the speed, in the order of the scene."""
    return [*of(Drag, scene.forces.values()), *of(Viscous, scene.forces.values())]


def rate(scene: Scene) -> float:
    """d/m [1/s], alike of all bodies where `not_alike` tells nothing; 0 of no such force."""
    return max(_rates(scene).values(), default=0.0) if slowing(scene) else 0.0


def numbers(scene: Scene, damping: float) -> dict[str, float]:
    """The coefficients that the space's `damping` holds, by quantity."""
    found: dict[str, float] = {}
    for force in slowing(scene):
        names = ("coefficient",) if isinstance(force, Drag) else ("forward", "backward")
        body = scene.bodies[_slowed(scene, force) or ""]
        if sum(_slowed(scene, other) == body.name for other in slowing(scene)) == 1:
            held = -math.log(damping) * body.mass
            found |= {f"{force.name}.{name}": held for name in names}
    return found


def not_alike(scene: Scene, start: Start) -> tuple[str, str] | None:
    """The first of these forces that `space.damping` is not, by its name, and why; or None."""
    for force in slowing(scene):
        if why := _unlike(scene, force):
            return force.name, f"engine: {why}"
    rates = _rates(scene)
    for force in slowing(scene):
        least, most = min(rates, key=rates.__getitem__), max(rates, key=rates.__getitem__)
        if rates[most] - rates[least] > ALIKE * rates[most]:
            what = f"{most} loses {rates[most]:g} 1/s and {least} {rates[least]:g}"
            return force.name, f"engine: pymunk's space.damping slows all bodies alike: {what}"
        if rates[most] > FASTEST:
            return (
                force.name,
                f"engine: pymunk's space.damping has no number for {rates[most]:g} 1/s",
            )
        for body in scene.bodies.values():
            if not _stays_unturned(scene, body, start):
                what = f"slows turning too, as that of {body.name}"
                return force.name, f"engine: pymunk's space.damping {what}"
    return None


def _unlike(scene: Scene, force: Slowing) -> str:
    """Why a force slows no body as a whole by its speed, or nothing."""
    if force.exponent != 1.0:
        return "pymunk has no friction by a power of the speed"
    slows = "pymunk's space.damping slows"
    if isinstance(force, Viscous):
        if force.coefficient.forward != force.coefficient.backward:
            return f"{slows} alike both ways, and {force.name} does not"
        return "" if _slowed(scene, force) else f"{slows} against the ground, where no slide turns"
    if force.along is not None:
        return f"{slows} alike in all directions, and {force.name} does not"
    if force.at.point != CENTER:
        return f"{slows} a body as a whole, and {force.name} a point beside its centre"
    return ""


def _slowed(scene: Scene, force: Slowing) -> str | None:
    """The body whose centre it slows against the ground; None where it is no such force."""
    if isinstance(force, Drag):
        return force.at.body
    joint = scene.joints[force.joint]
    still = [e for e in joint.refers() if e.body == GROUND and not scene.points[e.point].driven]
    moving = [e.body for e in joint.refers() if e.body != GROUND]
    return moving[0] if still and moving and not joint.turns else None


def _rates(scene: Scene) -> dict[str, float]:
    """d/m [1/s] of each body."""
    found = dict.fromkeys(scene.bodies, 0.0)
    for force in slowing(scene):
        d = force.coefficient if isinstance(force, Drag) else force.coefficient.forward
        if body := _slowed(scene, force):
            found[body] += d / scene.bodies[body].mass
    return found


def _stays_unturned(scene: Scene, body: Body, start: Start) -> bool:
    """Whether it is held at an angle, or starts without a turn and nothing turns it."""
    joints = [joint for joint in scene.joints.values() if body.name in _bodies(joint.refers())]
    if not body.turns or any(not j.turns and GROUND in _bodies(j.refers()) for j in joints):
        return True
    twists = [*of(Torque, scene.forces.values()), *of(Couple, scene.forces.values())]
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
