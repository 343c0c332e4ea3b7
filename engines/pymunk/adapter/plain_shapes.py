"""Whether a scene is built with the shapes that users have, and what is not read of it."""

from collections.abc import Mapping

from ....cases.scene import Scene
from ...engine import Plan, Start
from ...plain_shapes import as_built, unsuited, with_box

ONE_SUM = "adapter: shapes: what planes exert on a shape is read as one force"

OURS = "a point that touches is a circle of 0.1 m that is kept above it"


def refused(scene: Scene, shape: str, options: Mapping[str, object]) -> str | None:
    """Why the scene is not built so, as a `Refusal` says it; None: it is."""
    if options.get("reflects"):
        return "adapter: shapes: tips that reflect cannot be pasted"
    return unsuited(scene, shape)


def planned(plan: Plan, scene: Scene, start: Start, shape: str) -> Plan:
    """The plan with what is built, and what is not read."""
    several = scene.contacts if len(scene.contacts) > 1 else ()
    together = {f"{name}.{field}": ONE_SUM for name in several for field in ("normal", "tangent")}
    return as_built(plan, words(scene, start, shape), together)


def words(scene: Scene, start: Start, shape: str) -> str:
    """`block is a Poly of 0.2 × 0.1 m`, `ball is a Circle of radius 0.1 m`."""
    (body,) = with_box(scene, start, shape)[0].bodies.values()
    if body.radius is not None:
        return f"{body.name} is a Circle of radius {body.radius:g} m"
    assert body.size is not None  # else it is unsuited
    return f"{body.name} is a Poly of {body.size[0]:g} × {body.size[1]:g} m"
