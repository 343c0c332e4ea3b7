"""What touches in MuJoCo at a start: how it moves with all rates, and how its gap and slip grow."""

import mujoco
import numpy as np

from ....cases.scene import Contact, Scene
from ....cases.scene.motion import Motion
from ....cases.scene.pair import Pair
from ....cases.trajectory import Array, Trajectory
from ..tree import called

_GEOM, _BODY = int(mujoco.mjtObj.mjOBJ_GEOM), int(mujoco.mjtObj.mjOBJ_BODY)
_SOON = 1e-5  # s: over so long the growth of two rates is looked at; off by 1e-10 of it


class OnPlane:
    """A disk's rim or a point on a plane of the ground."""

    def __init__(
        self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, contact: Contact
    ) -> None:
        self._model, self._data = model, data
        self._gravity = model.opt.gravity
        self._geom = mujoco.mj_name2id(model, _GEOM, contact.name)
        self._radius = scene.bodies[contact.body].radius or 0.0
        self._along = np.array((*contact.plane.along, 0.0))
        self._normal = np.array((*contact.plane.normal, 0.0))
        self._plane = contact.plane

    @property
    def height(self) -> float:
        """[m] of its centre or point above the plane."""
        return float(self._plane.height(*self._data.geom_xpos[self._geom, :2]))

    def rows(self) -> Array:
        """(2, nv): how the lowest point moves along its plane and away from it."""
        found = np.zeros((3, self._model.nv))
        lowest = self._data.geom_xpos[self._geom] - self._radius * self._normal
        body = int(self._model.geom_bodyid[self._geom])
        mujoco.mj_jac(self._model, self._data, found, None, lowest, body)
        return np.array([self._along @ found, self._normal @ found])

    def acceleration(self) -> tuple[float, float]:
        """Of the lowest point [m/s²]: how its slip grows, and how its height does."""
        found = np.zeros(6)
        mujoco.mj_objectAcceleration(self._model, self._data, _GEOM, self._geom, found, 0)
        real = found[3:] + self._gravity  # MuJoCo counts what holds as −g
        along = float(self._along @ real)
        return along + self._radius * float(found[2]), float(self._normal @ real)


class OnBody:
    """What touches another body."""

    def __init__(
        self, scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, pair: Pair
    ) -> None:
        self._scene, self._model, self._data, self._pair = scene, model, data, pair
        self._bodies = {
            name: int(model.body(called(name)).id) for name in (pair.body, pair.touched)
        }

    @property
    def height(self) -> float:
        """[m] of its place: what rounding is relative to."""
        return float(np.max(np.abs(self._pair.place(self._motion([0.0])))))

    def rows(self) -> Array:
        """(2, nv): how it slips on the other body, and moves away from it."""
        motion = self._motion([0.0])
        (x, y), (nx, ny) = self._pair.place(motion)[0], self._pair.normal(motion)[0][0]
        place = np.array([x, y, 0.0])
        each = np.zeros((2, 3, self._model.nv))
        for found, body in zip(each, self._bodies.values(), strict=True):
            mujoco.mj_jac(self._model, self._data, found, None, place, body)
        moves = each[0] - each[1]
        return np.array([ny * moves[0] - nx * moves[1], nx * moves[0] + ny * moves[1]])

    def acceleration(self) -> tuple[float, float]:
        """[m/s²] how its slip grows, and how fast the gap does ever more."""
        slip, parting = self._pair.moves(self._motion([-_SOON, _SOON]))
        return float(np.diff(slip)[0]) / (2 * _SOON), float(np.diff(parting)[0]) / (2 * _SOON)

    def _motion(self, times: list[float]) -> Motion:
        """Both bodies a little before and after, as their accelerations have it."""
        t = np.array(times)[:, None]
        states: dict[str, Array] = {}
        for name, body in self._bodies.items():
            place, rate, growth = self._state(body)
            states[name] = np.hstack([place + rate * t + growth * t * t / 2, rate + growth * t])
        bodies = self._scene.bodies
        return Motion(bodies, self._scene.points, Trajectory(t[:, 0], states, {}))

    def _state(self, body: int) -> tuple[Array, Array, Array]:
        """x, y, angle of a body, and their first and second rates, (3,) each."""
        rate, growth = np.zeros(6), np.zeros(6)
        mujoco.mj_objectVelocity(self._model, self._data, _BODY, body, rate, 0)
        mujoco.mj_objectAcceleration(self._model, self._data, _BODY, body, growth, 0)
        growth[3:] += self._model.opt.gravity  # MuJoCo counts what holds as −g
        turned = self._data.xmat[body]
        x, y, _ = self._data.xipos[body]
        return (
            np.array([x, y, np.arctan2(turned[3], turned[0])]),
            rate[[3, 4, 2]],
            growth[[3, 4, 2]],
        )
