"""Forces that MuJoCo has no element for: by their laws, at every stage, in MuJoCo's callback.

It is asked when places and velocities of the stage are known, and puts forces on bodies, which
MuJoCo then counts as it counts any other.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager

import mujoco
import numpy as np

from ....cases.scene import GROUND, Anchor, Scene
from ....cases.scene.forces.force import Force
from ....cases.trajectory import Array
from ...point_forces import Exerted, Place, law_of, living
from ..model.force import lacking
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


# Inner states of forces as activations, whose rates MuJoCo asks our callback for at every stage.
#
# So they are integrated as places and velocities are, to the same order.


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


# The points at which a force acts: read at a stage, and told its forces there.


_SITE = int(mujoco.mjtObj.mjOBJ_SITE)

Read = Callable[[], Place]
Push = Callable[[tuple[float, float], Place], None]


class Points:
    """MuJoCo's arrays, fetched once."""

    def __init__(
        self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, force: Force
    ) -> None:
        self._ends = [_point(scene, model, data, anchor) for anchor in scene.ends(force)]

    def places(self) -> list[Place]:
        """Where they are, and how they move."""
        return [read() for read, _ in self._ends]

    def push(self, forces: Exerted, places: Sequence[Place]) -> None:
        """A force [N] at each, about the centre of mass of its body."""
        for (_, push), force, place in zip(self._ends, forces, places, strict=True):
            push(force, place)


def _point(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, anchor: Anchor
) -> tuple[Read, Push]:
    site = int(model.site(str(anchor)).id)
    body = int(model.site_bodyid[site])
    turns = anchor.body != GROUND and scene.bodies[anchor.body].turns
    at, axes = data.site_xpos[site], data.xmat[body]
    centre, wrench, moving = data.xipos[body], data.xfrc_applied[body], np.zeros(6)

    def read() -> Place:
        mujoco.mj_objectVelocity(model, data, _SITE, site, moving, 0)
        _, _, _, vx, vy, _ = moving.tolist()
        angle = math.atan2(axes.item(3), axes.item(0)) if turns else 0.0
        return Place(at.item(0), at.item(1), vx, vy, angle)

    def push(force: tuple[float, float], place: Place) -> None:
        fx, fy = force
        wrench[0] += fx
        wrench[1] += fy
        if turns:
            wrench[5] += (place.x - centre.item(0)) * fy - (place.y - centre.item(1)) * fx

    return (read, push) if body else (read, _nobody)


def _nobody(force: tuple[float, float], place: Place) -> None:
    """The ground bears anything."""
