"""Physics read back from pymunk's own objects, for the equal-physics audit."""

from pymunk.vec2d import Vec2d

from ..callbacks.force import numbers
from ..model.world import World


def measured(world: World) -> dict[str, float]:
    """Masses, inertias, friction, springs, gravity, energy and momentum of the present state."""
    x, y = world.space.gravity
    held = {"gravity.x": x, "gravity.y": y}
    for name, body in world.bodies.items():
        held[f"{name}.mass"] = body.mass
        if world.scene.bodies[name].turns:
            held[f"{name}.inertia"] = body.moment
    for name, wheel in world.touching.items():
        plane = world.planes[world.scene.touching[name].plane.name]
        held[f"{name}.friction"] = wheel.friction * plane.friction
    for name, (touching, touched) in world.pairs.items():
        held[f"{name}.friction"] = touching.friction * touched.friction
    for name, brake in world.brakes.items():
        friction = world.scene.joints[name].dry_friction
        assert friction is not None
        if friction.kinetic.forward == friction.kinetic.backward:  # the engine holds one number
            held[f"{name}.friction_forward"] = brake.max_force
            held[f"{name}.friction_backward"] = brake.max_force
    held |= numbers(world)
    bodies = world.bodies.values()
    # pymunk's kinetic_energy is m v² + J ω², twice the textbook's
    held["energy.kinetic"] = sum(body.kinetic_energy for body in bodies) / 2
    momenta = [body.mass * body.velocity for body in bodies]
    total = sum(momenta, Vec2d(0.0, 0.0))
    return held | {"momentum.x": total.x, "momentum.y": total.y}
