"""Motions of linked bodies that an engine's mutants must spoil: their errors at one step."""

import numpy as np

from textmech.cases.scene import Scene
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import ANGLE, Array, Trajectory
from textmech.engines.engine import Engine, Start
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import follow
from textmech.reference.system import Only

from ..adapters.engine_scenes import chain, on_a_swing
from ..adapters.planning import moved


def generated(scene: Scene, poses: Start, times: Array) -> Trajectory:
    """The reference's motion from poses that fit."""
    q, v = [], []
    for body in scene.bodies.values():
        x, y, angle, vx, vy, omega = poses[body.name]
        q += [x, y, angle] if body.turns else [x, y]
        v += [vx, vy, omega] if body.turns else [vx, vy]
    alone = Only(Multibody(scene, (np.array(q), np.array(v))))
    return Answer(alone, follow(alone, times)).trajectory(times)


def swing_error(engine: Engine, kind: str) -> tuple[float, float]:
    """Of `on_a_swing`, over 1 s at 1e-3 s: the rod's angle [rad] and the hinge's force [N]."""
    scene, start = on_a_swing(kind)
    times = np.linspace(0.0, 1.0, 26)
    exact = generated(scene, start, times)
    run = moved(engine, scene, start, times, 1e-3, reactions=("hinge.force",))
    angle = run.states["rod"][:, ANGLE] - exact.states["rod"][:, ANGLE]
    force = run.reactions["hinge.force"] - observe(scene, exact, "hinge.force")
    return float(np.abs(angle).max()), float(np.abs(force).max())


def energy_drift(engine: Engine, n: int) -> float:
    """J, of a chain of n bars over 0.8 s at 2e-4 s."""
    scene, start = chain(n)
    run = moved(engine, scene, start, np.linspace(0.0, 0.8, 6), 2e-4)
    energy = observe(scene, run, "energy.total")
    return float(np.abs(energy - energy[0]).max())
