"""Whether islands that are solved apart are islands: the whole scene, asked beside them."""

from collections.abc import Mapping, Sequence

import numpy as np

from ...cases.case import Case
from ...cases.scene.frame import SPACE
from ...cases.trajectory import Array, Trajectory
from ..mechanism.kinematics.coordinates import Coordinates
from ..mechanism.kinematics.spatial_coordinates import SpatialCoordinates
from ..mechanism.modes.mode import Multibody
from ..mechanism.modes.spatial_mode import SpatialMultibody
from ..system import Pose
from .agreement import Check, worst
from .reaction_check import AGREE, condition, lost

ASKED, SEED = 3, 3  # samples at which the whole scene is asked, at any rates


def alone(case: Case, motion: Trajectory, islands: Sequence[Multibody]) -> Check:
    """The accelerations of the whole scene, in which an island feels nothing of the others.

    At any rates, because a damper between two islands at rest does nothing.
    """
    random, whole = np.random.default_rng(SEED), _whole(case, _state(motion, 0))
    apart, bound = [0.0], AGREE
    for i in np.linspace(0, len(motion.times) - 1, ASKED).astype(int).tolist():
        t, poses = float(motion.times[i]), _state(motion, i)
        q, v = whole.place(poses)
        rates = (worst(np.abs(v)) or 1.0) * random.uniform(-1.0, 1.0, len(v))
        poses |= whole.poses(t, q, rates)
        felt = _accelerations(whole, t, poses)
        for base in islands:
            own, place = _accelerations(base, t, poses), base.place(poses)
            size = max(base.terms(t, *place)[0], *(worst(np.abs(a)) for a in own.values())) or 1.0
            apart += [worst(np.abs(felt[name] - a)) / size for name, a in own.items()]
            bound = max(bound, lost(condition(base.f_a(t, place[0]), base)))
    return Check("each island by itself", worst(apart), bound)


def _state(motion: Trajectory, i: int) -> dict[str, Pose]:
    """The poses of the bodies at a sample, and what else the mechanism may need."""
    beside = {name: (values[i],) for name, values in motion.reactions.items()}
    return {**beside, **{name: tuple(rows[i]) for name, rows in motion.states.items()}}


def _whole(case: Case, start: Mapping[str, Pose]) -> Multibody:
    if case.scene.frame is SPACE:
        return SpatialMultibody(case.scene, SpatialCoordinates(case.scene).place(start))
    return Multibody(case.scene, Coordinates(case.scene).place(start))


def _accelerations(base: Multibody, t: float, poses: Mapping[str, Pose]) -> dict[str, Array]:
    """The acceleration of each body by its name, as the rates in its pose."""
    q, v = base.place(poses)
    rates, frame = base.poses(t, q, base.accelerations(t, q, v)), base.scene.frame
    return {name: np.array(rates[name][frame.velocity.start :]) for name in base.scene.bodies}
