"""Inner states of forces as activations, whose rates MuJoCo asks our callback for at every stage.

So they are integrated as places and velocities are, to the same order.
"""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

import mujoco

from ....cases.scene import Scene
from ....cases.scene.forces.force import Force
from ....cases.trajectory import Array
from ...point_forces import living
from .points import Points

Rate = Callable[[mujoco.MjModel, mujoco.MjData, int], float]


def activation(model: mujoco.MjModel, force: Force) -> int:
    """Where the inner state of a force stands among the activations."""
    return int(model.actuator_actadr[model.actuator(force.name).id])


def activations(scene: Scene, model: mujoco.MjModel, act: Array) -> dict[str, Array]:
    """The inner states (N,) by quantity, of all activations (N, ·)."""
    return {name: act[:, activation(model, f)] for name, f in scene.inner().items()}


def rated(scene: Scene, model: mujoco.MjModel) -> AbstractContextManager[None]:
    """The scene's inner states have their rates, while they are wanted."""
    return acting(_rates(scene, model) if scene.inner() else None)


@contextmanager
def acting(rate: Rate | None) -> Iterator[None]:
    """A callback is one for the whole process, compiling included: whose it was gets it back."""
    before = mujoco.get_mjcb_act_dyn()
    mujoco.set_mjcb_act_dyn(rate)
    try:
        yield
    finally:
        mujoco.set_mjcb_act_dyn(before)


def _rates(scene: Scene, model: mujoco.MjModel) -> Rate:
    laws = {
        int(model.actuator(f.name).id): (f, living(scene, f), activation(model, f))
        for f in scene.inner().values()
    }
    points: dict[int, Points] = {}
    known: mujoco.MjData | None = None

    def rate(model: mujoco.MjModel, data: mujoco.MjData, actuator: int) -> float:
        nonlocal known
        if data is not known:
            known = data
            points.update({i: Points(scene, model, data, f) for i, (f, _, _) in laws.items()})
        _, law, place = laws[actuator]
        return law.rate(points[actuator].places(), data.act.item(place))

    return rate
