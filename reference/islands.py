"""A case in islands: what nothing joins is solved and certified apart, and put together again.

Together they would be one dense problem, in which the fastest sets the steps of all. Whether they
are islands is checked: the whole scene is asked beside them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..cases.case import Case
from ..cases.fields.kind import RESERVED
from ..cases.scene import Scene
from ..cases.scene.frame import SPACE
from ..cases.scene.islands import solved_scenes
from ..cases.scene.quantity import table
from ..cases.trajectory import Array, Trajectory
from .certificate.agreement import Check, gravest, worst
from .certificate.errors import ERROR
from .certificate.reaction_check import AGREE, condition, rounding_error
from .mechanism.kinematics.coordinates import Coordinates
from .mechanism.kinematics.spatial_coordinates import SpatialCoordinates
from .mechanism.modes.mode import Multibody
from .mechanism.modes.spatial_mode import SpatialMultibody
from .system import Pose

ASKED, SEED = 3, 3  # samples at which the whole scene is asked, at any rates


@dataclass(frozen=True)
class Island:
    """A part of a case, solved by itself; base: what holds in all modes of its mechanism."""

    case: Case
    motion: Trajectory
    checks: tuple[Check, ...]
    base: Multibody


def parts(case: Case) -> tuple[Case, ...]:
    """The case of each island; the case itself where all hangs or is looked at together."""
    scenes = solved_scenes(case.scene, case.system, case.events)
    if len(scenes) == 1:
        return (case,)
    corners = (*case.scene.corners(),)
    return tuple(_part(case, scene, corners) for scene in scenes)


def _part(case: Case, scene: Scene, corners: tuple[float, ...]) -> Case:
    mine, known = {element.name for element in scene.elements()}, table(scene)
    return replace(
        case,
        scene=scene,
        initial={name: start for name, start in case.initial.items() if name in mine},
        near={name: guess for name, guess in case.near.items() if name in mine},
        allow={name: bar for name, bar in case.allow.items() if name in known},
        corners=corners,
    )


def together(case: Case, islands: Sequence[Island]) -> tuple[Trajectory, tuple[Check, ...]]:
    """The joined motion; of each check the gravest, errors of sums summed, and their isolation."""
    motion = joined(case, islands, case.times)
    checks: dict[str, list[Check]] = {}
    for check in (check for island in islands for check in island.checks):
        checks.setdefault(check.name, []).append(check)
    bases = [island.base for island in islands]
    return motion, (*(_of_all(each) for each in checks.values()), _isolation(case, motion, bases))


def joined(case: Case, islands: Sequence[Island], times: Array) -> Trajectory:
    """Returns the motion of all islands at the times."""
    motions = [island.motion for island in islands]
    states = {name: rows for motion in motions for name, rows in motion.states.items()}
    return Trajectory(
        times,
        {name: states[name] for name in case.scene.bodies},
        {name: values for motion in motions for name, values in motion.reactions.items()},
        switches=np.unique(np.concatenate([motion.switches for motion in motions])),
        blows=np.unique(np.concatenate([motion.blows for motion in motions])),
        near={name: turns for motion in motions for name, turns in motion.near.items()},
        fastest=max(motion.fastest for motion in motions),
    )


def _of_all(checks: Sequence[Check]) -> Check:
    part = checks[0].name.removeprefix(ERROR).partition(".")[0]
    if not (checks[0].name.startswith(ERROR) and part in RESERVED):
        return gravest(checks)
    certified = sum(check.certified or 0.0 for check in checks)
    return replace(
        checks[0], difference=sum(check.difference for check in checks), certified=certified
    )


def _isolation(case: Case, motion: Trajectory, islands: Sequence[Multibody]) -> Check:
    """Checks that each island alone has the accelerations that it has in the whole scene.

    At any rates, because a damper between two islands at rest does nothing.
    """
    random, whole = np.random.default_rng(SEED), _whole(case, _state(motion, 0))
    errors, bound = [0.0], AGREE
    for i in np.linspace(0, len(motion.times) - 1, ASKED).astype(int).tolist():
        t, poses = float(motion.times[i]), _state(motion, i)
        q, v = whole.place(poses)
        rates = (worst(np.abs(v)) or 1.0) * random.uniform(-1.0, 1.0, len(v))
        poses |= whole.poses(t, q, rates)
        whole_rates = _accelerations(whole, t, poses)
        for base in islands:
            own, place = _accelerations(base, t, poses), base.place(poses)
            size = max(base.terms(t, *place)[0], *(worst(np.abs(a)) for a in own.values())) or 1.0
            errors += [worst(np.abs(whole_rates[name] - a)) / size for name, a in own.items()]
            bound = max(bound, rounding_error(condition(base.f_a(t, place[0]), base)))
    return Check("each island by itself", worst(errors), bound)


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
