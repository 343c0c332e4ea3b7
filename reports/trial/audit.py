"""The equal-physics audit: an engine must hold the case's numbers before it takes a step."""

from ...cases.observe import observe
from ...cases.scene import Scene
from ...cases.trajectory import Trajectory
from .trial import Trial

EQUAL = 1e-12  # relative: both sides hold the same doubles, up to a product or a sum


def expected(scene: Scene, start: Trajectory) -> dict[str, float]:
    """What `Engine.measure` should find, from the scene and the start."""
    numbers = {"gravity.x": scene.gravity[0], "gravity.y": scene.gravity[1]}
    for body in scene.bodies.values():
        numbers[f"{body.name}.mass"] = body.mass
        if body.inertia is not None:
            numbers[f"{body.name}.inertia"] = body.inertia
    for contact in scene.contacts.values():
        numbers[f"{contact.name}.friction"] = contact.friction
    for joint in scene.joints.values():
        if joint.dry_friction is not None:
            numbers[f"{joint.name}.friction_forward"] = joint.dry_friction.kinetic.forward
            numbers[f"{joint.name}.friction_backward"] = joint.dry_friction.kinetic.backward
    for spring in scene.springs():
        numbers[f"{spring.name}.stiffness"] = spring.stiffness
        numbers[f"{spring.name}.rest_length"] = spring.rest_length
    for damper in scene.dampers():
        numbers[f"{damper.name}.damping"] = damper.damping
    for name in ("energy.kinetic", "momentum.x", "momentum.y"):
        numbers[name] = float(observe(scene, start, name)[0])
    return numbers


def audit(trial: Trial) -> tuple[float, str]:
    """The largest relative difference, and what it is about; engines may not know everything."""
    wanted = expected(trial.case.scene, trial.reference)
    found = trial.engine.measure(trial.case.scene, trial.start)
    worst, because = 0.0, f"{len(found)} numbers read back"
    for name, value in found.items():
        difference = abs(value - wanted[name]) / max(abs(wanted[name]), 1.0)
        if not difference <= worst:  # NaN counts
            worst, because = difference, f"{name} is {value!r}, the case says {wanted[name]!r}"
    return worst, because
