"""The plainest loop that a user of pymunk would write: the yardstick of `make bench`.

Natively it is the script that `show` prints, run as it is. Of a law it is that script with the
force of the present instant, which is of first order.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from pymunk.body import Body
from pymunk.space import Space
from pymunk.vec2d import Vec2d

from textmech.cases.scene import GROUND, Anchor, Joint, Scene
from textmech.cases.scene.forces.force import Damper, Line
from textmech.engines.engine import Plan, Start
from textmech.engines.law import dry_friction, tension
from textmech.engines.pymunk import Pymunk
from textmech.engines.pymunk.adapter.plans import numbers_by_name
from textmech.engines.pymunk.adapter.script import before_each, building
from textmech.engines.pymunk.callbacks.cut import cuts
from textmech.engines.pymunk.callbacks.force import lacking
from textmech.engines.pymunk.model.damping import slowing
from textmech.engines.pymunk.stepping.run import COLD
from textmech.engines.pymunk.stepping.scene import build

from .plain import Begin, Plain


def plain(engine: Pymunk, scene: Scene, start: Start, step: float, plan: Plan) -> Begin | None:
    """`space.step(h)` in a Python loop, after the script's lines of `show`.

    pymunk cannot go back to a start, so every step builds its own space. None: nobody has written
    the loop.
    """
    law = plan.realised == "law"
    if law and not sayable(scene):
        return None
    if cuts(scene):
        return None  # the script cuts no step
    numbers = numbers_by_name(plan.choices(step))
    world = build(scene, start, numbers, plan.realised)
    if law:
        world.brakes.clear()  # the law's force is all the friction there is
    lines = [
        "import math",
        "import pymunk",
        *building(world, start, numbers),
        "def take(first, last):",
        "    for n in range(first, last):",
        *(f"    {line}" for line in before_each(world, numbers)),
        *(["        for act in acts:", "            act()"] if law else []),
        "        space.step(h)",
    ]
    script = compile("\n".join(lines), "<plain>", "exec")
    cold = numbers.get("start.iterations")

    def begin(h: float) -> Plain:
        names: dict[str, Any] = {"h": h}
        exec(script, names)
        if law:
            names["acts"] = list(acts(scene, names["space"], names["bodies"]))
        take = _warming(names["take"], names["space"], cold) if cold else names["take"]
        return Plain(_counting(take), lambda: _states(scene, names, numbers))

    return begin


Take = Callable[[int, int], None]
"""From one step to another."""


def _warming(take: Take, space: Space, cold: int) -> Take:
    """With more sweeps in the first steps; the script asks before each, which costs more."""
    usual = space.iterations

    def taken(first: int, last: int) -> None:
        middle = max(first, min(COLD, last))
        space.iterations = cold
        take(first, middle)
        space.iterations = usual
        take(middle, last)

    return taken


def _counting(take: Take) -> Callable[[int], None]:
    done = 0

    def counted(n: int) -> None:
        nonlocal done
        first, done = done, done + n
        take(first, done)

    return counted


def _states(scene: Scene, names: Mapping[str, Any], numbers: Mapping[str, Any]) -> Start:
    ahead = names["h"] / 2 if numbers.get("time.midpoint") else 0.0
    found = {}
    for name in scene.bodies:
        body = names["bodies"][name]
        (x, y), (vx, vy), omega = body.position, body.velocity, body.angular_velocity
        found[name] = (x + ahead * vx, y + ahead * vy, body.angle + ahead * omega, vx, vy, omega)
    return found


# Laws as the force of the present instant, which is of first order: what a user writes first.


Act = Callable[[], None]  # called before each step, after all other forces


def sayable(scene: Scene) -> bool:
    """Whether the law is one of those here, of slides; the smooth one is unstable as a force."""
    dry = [joint for joint in scene.joints.values() if joint.dry_friction]
    smooth = any(joint.dry_friction and joint.dry_friction.smooth for joint in dry)
    elsewhere = scene.pressed or lacking(scene, {}) or slowing(scene)
    return not elsewhere and not smooth and all(joint.shifts for joint in dry)


def acts(scene: Scene, space: Space, bodies: Mapping[str, Body]) -> Iterator[Act]:
    """Dampers first: friction holds against all other forces."""
    for damper in scene.dampers():
        yield _damper(scene, space, bodies, damper)
    for joint in scene.joints.values():
        if joint.dry_friction:
            yield _friction(scene, space, bodies, joint)


def _end(
    scene: Scene, space: Space, bodies: Mapping[str, Body], anchor: Anchor
) -> tuple[Body, tuple[float, float]]:
    """A line's end: its body, and the point in the body's axes."""
    if anchor.body != GROUND:
        return bodies[anchor.body], scene.bodies[anchor.body].points[anchor.point]
    if scene.points[anchor.point].driven:
        return bodies[str(anchor)], (0.0, 0.0)
    return space.static_body, scene.points[anchor.point].at


def _damper(scene: Scene, space: Space, bodies: Mapping[str, Body], damper: Damper) -> Act:
    """(2.47) d λ̇ at the present place and speed."""
    a, at_a = _end(scene, space, bodies, damper.a)
    b, at_b = _end(scene, space, bodies, damper.b)

    def act() -> None:
        pa, pb = a.local_to_world(at_a), b.local_to_world(at_b)
        along = (pb - pa).normalized()
        rate = along.dot(b.velocity_at_local_point(at_b) - a.velocity_at_local_point(at_a))
        pulled = damper.damping * rate * along
        a.apply_force_at_world_point(pulled, pa)
        b.apply_force_at_world_point(-pulled, pb)

    return act


def _friction(scene: Scene, space: Space, bodies: Mapping[str, Body], joint: Joint) -> Act:
    """(2.89) at the present place and speed, on a block alone on its slide."""
    friction, body = joint.dry_friction, bodies[joint.b.body]
    assert friction
    u, carried = Vec2d(*joint.along), Vec2d(*scene.points[joint.a.point].velocity)
    weight, begun = body.mass * space.gravity, u.dot(body.velocity - carried)
    sense = (begun > 0) - (begun < 0)
    lines = [
        (f, *(_end(scene, space, bodies, end) for end in _from(f, joint.b.body)))
        for f in scene.springs()
        if joint.b.body in (f.a.body, f.b.body)
    ]

    def applied() -> float:
        force = body.force + weight  # which pymunk adds up until the step
        for line, (_, here), (other, there) in lines:
            way = other.local_to_world(there) - body.local_to_world(here)
            force += tension(line, way.length, 0.0) * way.normalized()
        return u.dot(force)

    def act() -> None:
        nonlocal sense
        speed, pushed = u.dot(body.velocity - carried), applied()
        if sense * speed <= 0:
            sense, body.velocity, speed = 0, body.velocity - speed * u, 0.0
        force = dry_friction(friction, speed, pushed)
        if not sense and force != -pushed:
            sense = 1 if pushed > 0 else -1
        body.apply_force_at_world_point(force * u, body.position)

    return act


def _from(line: Line, body: str) -> tuple[Anchor, Anchor]:
    """The line's ends, the body's first."""
    return (line.a, line.b) if line.a.body == body else (line.b, line.a)
