"""The engines that are installed, their plans one way at a time, and one run of a scene."""

from functools import cache

from textmech import engines
from textmech.cases.frame import PLANE
from textmech.cases.scene import Scene
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Engine, Plan, Realised, Refusal, Start
from textmech.reports.trial.start import assembled

from .scenes import SHIPPED as EVERY

CASES = {name: case for name, case in EVERY.items() if case.scene.frame is PLANE}
"""The shipped cases in the plane; those in space have tests of their own (test_space.py)."""
NATIVE = {name: case for name, case in CASES.items() if not case.scene.constraints}
"""Those that engines run by themselves: no engine has an edge."""

NAMES = engines.names()
"""The engines found by their entry points."""
SETTINGS = [engines.make(name, setting) for name in NAMES for setting in engines.settings(name)]
"""Each engine with each setting it offers."""
TUNED = {name: engines.make(name, "tuned") for name in NAMES}
SHIPPED = {name: engines.make(name, "shipped") for name in NAMES}


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


def every(motion: Trajectory) -> Trajectory:
    """The record of every step."""
    assert motion.record is not None
    return motion.record


@cache
def begun(name: str) -> tuple[Scene, Start]:
    """A shipped case's scene and its assembled start."""
    return CASES[name].scene, assembled(CASES[name])
