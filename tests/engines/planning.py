"""An engine's plans, as the suite takes them: one way at a time, or why there is none."""

from textmech.cases.scene import Scene
from textmech.engines.engine import Engine, Plan, Realised, Refusal, Start


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
