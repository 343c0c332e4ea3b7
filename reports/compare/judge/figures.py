"""Plain numbers of one run, as a person asks for them: how fast it loses energy, sinks, creeps.

What the reference itself loses, or slips, is no part of them.
"""

from collections.abc import Iterator

import numpy as np

from ....cases.scene import Scene
from ....cases.scene.observe import observe
from ....cases.scene.quantity import table
from ....cases.trajectory import Array, Trajectory
from ..trial.trial import Trial
from .contact_figures import creep, depth, friction, restitution
from .figure import Plain

RESTS = 1e-12  # J: what has less kinetic energy all along has none to lose


def plain(trial: Trial) -> list[Plain]:
    """Plain numbers of the trial's engine at its judged step: one run, with every step looked at.

    Raises Diverged.
    """
    scene, plan = trial.case.scene, trial.plan
    touching = (*scene.contacts, *scene.pairs)
    asked = [f"{name}.{field}" for name in touching for field in ("normal", "tangent")]
    wanted = tuple(name for name in asked if name in table(scene) and name not in plan.withheld)
    motion = trial.engine.run(
        scene, trial.start, trial.case.times, trial.step, plan, reactions=wanted, record=True
    )
    return list(numbers(scene, trial.reference, motion))


def numbers(scene: Scene, reference: Trajectory, motion: Trajectory) -> Iterator[Plain]:
    """Plain numbers of a motion at the reference's samples; impacts and depths in its record."""
    yield from _energy(scene, reference, motion)
    yield from _gap(scene, motion)
    for contact in (*scene.contacts.values(), *scene.pairs.values()):
        yield from depth(scene, contact, motion)
        yield from restitution(scene, contact, reference, motion)
        yield from friction(scene, contact, reference, motion)
    for name in (*scene.contacts, *scene.pairs, *scene.joints):
        if f"{name}.slip" in table(scene):
            yield from creep(scene, name, reference, motion)


def _energy(scene: Scene, reference: Trajectory, motion: Trajectory) -> Iterator[Plain]:
    """Yields the energy lost or gained per second, in % of the reference's largest kinetic energy.

    It is the slope of the line through 0 that fits best.
    """
    size = float(np.max(observe(scene, reference, "energy.kinetic")))
    if size <= RESTS:
        return
    try:
        lost = _gain(scene, reference) - _gain(scene, motion)
    except KeyError:  # the inner state of a muscle that the producer does not tell
        return
    t = motion.times
    rate = 100 * float(t @ lost) / float(t @ t) / size
    yield Plain("energy lost" if rate >= 0 else "energy gained", abs(rate), "% a second")


def _gain(scene: Scene, trajectory: Trajectory) -> Array:
    energy = observe(scene, trajectory, "energy.total")
    return energy - energy[0]


def _gap(scene: Scene, motion: Trajectory) -> Iterator[Plain]:
    """The widest of the joints."""
    gaps = {
        name: float(np.max(np.abs(observe(scene, motion, f"{name}.gap"))))
        for name in scene.joints
        if f"{name}.gap" in table(scene)
    }
    if gaps:
        worst = max(gaps, key=lambda name: gaps[name])
        yield Plain(f"gap of {worst}", gaps[worst], "m")
