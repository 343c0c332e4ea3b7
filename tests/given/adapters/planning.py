"""The engines that are installed, their plans one way at a time, and one run of a scene."""

from collections.abc import Iterator, Mapping
from dataclasses import astuple, fields, is_dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from textmech import engines
from textmech.cases.case import Case
from textmech.cases.scene import Scene, Viscous
from textmech.cases.scene.forces.force import of_kind
from textmech.cases.scene.frame import PLANE
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Engine, Plan, Realised, Refusal, Start
from textmech.engines.foot_contact import strides
from textmech.engines.point_forces import LIVING, TOLD
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import assembled

from ..scenes import SHIPPED as EVERY
from ..scenes import typed

CASES = {name: case for name, case in EVERY.items() if case.scene.frame is PLANE}
"""The shipped cases in the plane, which every engine builds."""

NAMES = engines.names()
"""The engines found by their entry points."""
SETTINGS = [engines.make(name, setting) for name in NAMES for setting in engines.settings(name)]
"""Each engine with each setting it offers."""
TUNED = {name: engines.make(name, "tuned") for name in NAMES}
SHIPPED = {name: engines.make(name, "shipped") for name in NAMES}

SPATIAL = {"mujoco"}
"""The engines that have space."""


def builds(engine: Engine, scene: Scene) -> bool:
    """Whether the engine has all that shipped scenes are made of, but edges."""
    thrown = any(limit.back for limit in scene.limits())  # which pymunk has nothing for
    pulled = any(rate.endswith(".speed") for rate in scene.drives)  # no motor along a line
    return engine.name in SPATIAL or (scene.frame is PLANE and not thrown and not pulled)


def kinds(part: Any, where: str = "") -> Iterator[str]:
    """What a scene is made of: each kind of element, what each says and leaves out, each choice."""
    if is_dataclass(part):
        yield type(part).__name__
        for field in fields(part):
            yield from kinds(getattr(part, field.name), f"{type(part).__name__}.{field.name}")
    elif isinstance(part, Mapping):
        for one in part.values():
            yield from kinds(one, where)
    elif isinstance(part, tuple | list) and any(map(is_dataclass, part)):
        for one in part:
            yield from kinds(one, where)
    elif isinstance(part, str | bool) and where.rpartition(".")[2] not in NAMED:
        yield f"{where} {part}"
    else:
        yield f"{where} {'none' if part is None or part == () or part == 0 else 'some'}"


NAMED = ("name", "body", "point", "at", "touched")
"""Fields that are what a user has called something."""


def covering() -> list[str]:
    """The fewest shipped cases, about, that have all kinds there are: those with most new first."""
    left = {name: set(kinds(case.scene)) for name, case in EVERY.items()}
    found: list[str] = []
    while any(left.values()):
        best = max(left, key=lambda name: len(left[name]))
        found.append(best)
        covered = left.pop(best)
        left = {name: new - covered for name, new in left.items()}
    return sorted(found)


COVERING = covering()
"""What a test of engines asks where every shipped case would tell it nothing more: the rows of all
of them are made in the same session, with their audits and certificates."""
PAIRS = [(name, e) for name in COVERING for e in SETTINGS if builds(e, EVERY[name].scene)]
"""Each of them with each engine that builds it."""


def damps(engine: Engine, scene: Scene) -> list[Viscous]:
    """The viscous slides that an engine damps by itself: those alike both ways.

    MuJoCo by three powers of the speed, pymunk by the first, of the one body of a shipped scene.
    """
    powers = (1, 2, 3) if engine.name == "mujoco" else (1,) if len(scene.bodies) == 1 else ()
    slides = of_kind(Viscous, scene.forces.values())
    return [f for f in slides if f.exponent in powers if len({*astuple(f.coefficient)}) == 1]


def own(engine: Engine, scene: Scene) -> bool:
    """Whether an engine has something of its own for all of a scene."""
    told = {name for name, force in scene.forces.items() if type(force) in TOLD | LIVING}
    told |= {spring.name for spring in scene.one_sided() if engine.name == "pymunk"}
    alone = not scene.constraints and not strides(scene)
    return alone and not told - {force.name for force in damps(engine, scene)}


def way_of(engine: Engine, scene: Scene) -> Realised:
    """How a tuned engine runs it."""
    if own(engine, scene):
        return "native"
    return "driver" if strides(scene) else "law"


NATIVE = [(name, e) for name, e in PAIRS if own(e, EVERY[name].scene)]
"""Those that the engine runs by itself."""
HELD = [(n, e) for n, e in PAIRS if not own(e, EVERY[n].scene) and e.setting == "tuned"]
"""Those that it runs with our help, see `way_of`."""


def pair(part: str | Engine) -> str:
    """How each half of a pair is called."""
    return part if isinstance(part, str) else words(part)


def words(engine: Engine) -> str:
    """`mujoco.tuned`."""
    return f"{engine.name}.{engine.setting}"


def planned(engine: Engine, scene: Scene, start: Start, realised: Realised = "native") -> Plan:
    """The plan of one way."""
    (plan,) = [way for way in engine.plans(scene, start) if way.realised == realised]
    assert isinstance(plan, Plan), plan.because
    return plan


def refused(engine: Engine, scene: Scene, start: Start | None = None) -> str | None:
    """Why the scene is not built, from any start."""
    (*ways,) = engine.plans(scene, start or dict.fromkeys(scene.bodies, (0.0,) * 6))  # type: ignore[arg-type]
    return ways[0].because if isinstance(ways[0], Refusal) else None


def ways(engine: Engine, scene: Scene, start: Start) -> tuple[Realised, ...]:
    """In which ways the scene is run."""
    return tuple(way.realised for way in engine.plans(scene, start))


def moved(
    engine: Engine,
    scene: Scene,
    start: Start,
    times: Array,
    step: float,
    *,
    realised: Realised = "native",
    reactions: tuple[str, ...] = (),
    record: bool = False,
) -> Trajectory:
    """The engine's motion of the scene in one way."""
    plan = planned(engine, scene, start, realised)
    return engine.run(scene, start, times, step, plan, reactions=reactions, record=record)


def certified(folder: Path, text: str, tail: str) -> tuple[Case, Trajectory]:
    """The case of a file with this scene and tail, and its certified motion."""
    case = typed(folder, text, tail=tail)
    solution = solve(case)
    assert solution.holds
    return case, solution.trajectory


def apart(known: Trajectory, found: Trajectory) -> Array:
    """(6,) by column the largest difference of the states of all bodies."""
    both = [np.abs(found.states[body] - rows).max(axis=0) for body, rows in known.states.items()]
    return np.max(both, axis=0)


def every(motion: Trajectory) -> Trajectory:
    """The record of every step."""
    assert motion.record is not None
    return motion.record


@cache
def begun(name: str) -> tuple[Scene, Start]:
    """A shipped case's scene and its assembled start."""
    return EVERY[name].scene, assembled(EVERY[name])
