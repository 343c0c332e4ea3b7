"""Which poses a scene passes, as far as a setting has to know them before the run."""

import math

import numpy as np

from ...cases.scene import Scene
from ..engine import Start
from .run import placed, stepper
from .sweeps import halving

SECONDS, POSES = 1.0, 20  # measured: machines need up to 6 × the sweeps of their start within 1 s
STEP = 2e-3  # s
# Its own bias closes 1.2 % of a gap in such a step: with it so many sweeps hold what needs 5000.
NUMBERS = {"space.iterations": 100, "slot.across": True}


def most_halving(scene: Scene, start: Start) -> float:
    """The most sweeps that halve an error, at the start and along a rough motion from there.

    The run's own start and steps are not touched by it.
    """
    world = placed(scene, start, STEP, NUMBERS, "native")
    run = stepper(world, STEP, NUMBERS, "native")
    most = halving(world)
    for _ in range(POSES):
        run(round(SECONDS / POSES / STEP))
        poses = [(*body.position, body.angle) for body in world.bodies.values()]
        if not np.isfinite(poses).all():
            break  # a spring too stiff for such a step: the start has to do
        most = max(most, halving(world))
    return math.ceil(most)
