"""The numbers that hold joints together: sweeps as the scene needs them, and the bias of a gap.

With error_bias = 0 a step closes the whole gap, as SHAKE does, and is of second order; it is stable
if ρ^iterations < 1/2, see sweeps.py. Where that takes more sweeps than anybody waits for, a step
closes the share β of the gap, which is stable if ρ^iterations < 1 / (1 + β).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ....cases.scene import Scene
from ...engine import Choice, Start
from ..model.contact import is_tip
from ..model.edge import count
from ..model.solver_contraction import halving
from ..stepping.run import placed, stepper

ENOUGH = 10  # halvings in a step: 1e-3 of an error is left, and what was cached rings for 3 steps
COLD = 30  # halvings of what starts from nothing: 1e-9 of it is left
LEAST = 30  # sweeps, which cost little beside the rest of a step
MOST = 3000  # sweeps in a step: 0.1 ms for each joint
FEWEST = 4  # halvings at the worst pose met, below which a later one may be unstable
COLDEST = 100_000  # sweeps in each of the first steps
SMALLEST = 1e-300  # of error_bias: a double below is 0, which is the other recipe


@dataclass(frozen=True)
class Holding:
    """The numbers that hold a scene's joints. halving: sweeps that halve an error of theirs.

    impacts: whether something may strike the floor, where cached impulses are of no use.
    """

    halving: float
    impacts: bool

    @property
    def biased(self) -> bool:
        """Whether only a share of each gap can be closed."""
        return FEWEST * self.halving > MOST

    def choices(self, step: float) -> Sequence[Choice]:
        """The numbers for a step [s], which error_bias follows where only a share is closed."""
        enough = (COLD if self.impacts else ENOUGH) * self.halving
        sweeps = Choice("space.iterations", min(MOST, max(LEAST, math.ceil(enough))), self._because)
        first = Choice(
            "start.iterations",
            min(COLDEST, max(sweeps.value, math.ceil(COLD * self.halving))),
            "the first steps have no impulses to begin with, and what they leave rings on",
        )
        return [self._bias(step), sweeps, first]

    @property
    def _because(self) -> str:
        halve = f"an error of the joints is halved by {self.halving:.3g} sweeps at the worst pose"
        if self.impacts:
            return f"{halve}; {COLD} halvings for impacts, which begin from nothing"
        return f"{halve}; below, error_bias = 0 is unstable at any step; {ENOUGH} halvings do"

    def _bias(self, step: float) -> Choice:
        if not self.biased:
            because = (
                "the whole gap is closed in one step, as in SHAKE: second order; the default "
                "closes 6.3 h of it, and takes kinetic energy of first order with it"
            )
            return Choice("constraint.error_bias", 0.0, because)
        share = min(1.0, 2 ** (MOST / (FEWEST * self.halving)) - 1)
        bias = max(SMALLEST, (1 - share) ** (1 / step))
        part = f"{1 - bias**step:.2g} of a gap"
        because = f"with {MOST} sweeps a step can close {part}, and stays stable"
        return Choice("constraint.error_bias", bias, because)


def holding(scene: Scene, start: Start) -> Holding | None:
    """By a rehearsal; None where no two rows are solved one after the other."""
    contacts = [*scene.touching.values(), *scene.pairs.values()]
    tips = bool(scene.pairs) or any(is_tip(scene, c) for c in scene.touching.values())
    held = bool(scene.joints) or any(scene.limits())
    if not held and not tips and len(contacts) < 2 and count(scene) < 2:
        return None
    impacts = any(contact.switches for contact in contacts) or any(scene.limits())
    return Holding(most_halving(scene, start), impacts)


# Which poses a scene passes, as far as a setting has to know them before the run.


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
