"""A case in islands: what nothing joins is solved and certified apart, and put together again.

Together they would be one dense problem, in which the fastest sets the steps of all.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..cases.case import Case
from ..cases.fields.kind import RESERVED
from ..cases.scene import Scene
from ..cases.scene.islands import apart
from ..cases.scene.quantity import table
from ..cases.trajectory import Trajectory
from .certificate.agreement import Check, gravest
from .certificate.errors import ERROR
from .certificate.island_check import alone
from .mechanism.modes.mode import Multibody


@dataclass(frozen=True)
class Island:
    """A part of a case, solved by itself; base: what holds in all modes of its mechanism."""

    case: Case
    motion: Trajectory
    checks: tuple[Check, ...]
    base: Multibody


def parts(case: Case) -> tuple[Case, ...]:
    """The case of each island; the case itself where all hangs or is looked at together."""
    scenes = apart(case.scene, case.system, case.events)
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


def together(case: Case, found: Sequence[Island]) -> tuple[Trajectory, tuple[Check, ...]]:
    """The motion of all, and of each check the gravest; errors of sums are sums of errors."""
    motions = [island.motion for island in found]
    states = {name: rows for motion in motions for name, rows in motion.states.items()}
    motion = Trajectory(
        case.times,
        {name: states[name] for name in case.scene.bodies},
        {name: values for motion in motions for name, values in motion.reactions.items()},
        switches=np.unique(np.concatenate([motion.switches for motion in motions])),
        near={name: turns for motion in motions for name, turns in motion.near.items()},
        fastest=max(motion.fastest for motion in motions),
    )
    checks: dict[str, list[Check]] = {}
    for check in (check for island in found for check in island.checks):
        checks.setdefault(check.name, []).append(check)
    bases = [island.base for island in found]
    return motion, (*(_of_all(each) for each in checks.values()), alone(case, motion, bases))


def _of_all(checks: Sequence[Check]) -> Check:
    part = checks[0].name.removeprefix(ERROR).partition(".")[0]
    if not (checks[0].name.startswith(ERROR) and part in RESERVED):
        return gravest(checks)
    certified = sum(check.certified or 0.0 for check in checks)
    return replace(
        checks[0], difference=sum(check.difference for check in checks), certified=certified
    )
