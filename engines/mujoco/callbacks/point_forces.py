"""Forces that MuJoCo has no element for: by their laws, at every stage, in MuJoCo's callback.

It is asked when places and velocities of the stage are known, and puts forces on bodies, which
MuJoCo then counts as it counts any other.
"""

from collections.abc import Callable, Sequence

import mujoco

from ....cases.scene import Scene
from ....cases.scene.forces.force import Force
from ...point_forces import Exerted, Place, law_of, living
from ..model.force import lacking
from .inner_state import activation
from .points import Points
from .signal import Control, bound

Exerts = Callable[[float, Sequence[Place]], Exerted]


def point_force_callbacks(scene: Scene, model: mujoco.MjModel) -> list[Control]:
    """One callback for all of them, or none."""
    forces = [force for force, _ in lacking(scene)]
    if not forces:
        return []

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        pushed = data.xfrc_applied
        laws = [(_law(scene, model, data, f), Points(scene, model, data, f)) for f in forces]

        def apply() -> None:
            pushed[:] = 0.0
            t = data.time
            for law, points in laws:
                places = points.places()
                points.push(law(t, places), places)

        return apply

    return [bound(bind)]


def _law(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, force: Force) -> Exerts:
    if not force.inner:
        return law_of(scene, force)
    law, act, place = living(scene, force), data.act, activation(model, force)
    return lambda t, points: law.exerts(points, act.item(place))
