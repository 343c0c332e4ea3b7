"""The start at which MuJoCo's soft floor carries what lies on it.

Put exactly on the floor, a disk is not in contact: it falls free for a step, and the settling
that follows is an error of first order, and wrong forces. So every point that touches is started
as deep as keeps its height from accelerating, which is the textbook's contact; and what sticks
creeps from the start as fast as MuJoCo's friction needs to hold it.
"""

from collections.abc import Callable, Sequence
from itertools import combinations

import mujoco
import numpy as np

from ....cases.scene import Contact, Pair, Scene
from ....cases.scene.motion import Motion
from ....cases.trajectory import Array, Trajectory
from ...engine import Start
from ..model.contact import lies, meet
from ..model.planes import touching
from ..model.tree import called, spanning_tree
from .point_forces import point_force_callbacks
from .signal import signals

# Motion of touching points in MuJoCo at given depths in a plane or a body, and given creeps.


UPRIGHT = 1e3  # times as ready to sink as to turn: a start leans by less than a thousandth of that


class Floor:
    """The start of a scene's points on planes and bodies, and what they do beside it.

    `depths` [m] and `creeps` [m/s] are (contacts,) each, those with planes first.
    """

    def __init__(
        self,
        scene: Scene,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        contacts: Sequence[Contact],
        pairs: Sequence[Pair] = (),
    ) -> None:
        self.model, self.data = model, data
        self._touching = [
            *(OnPlane(scene, model, data, contact) for contact in contacts),
            *(OnBody(scene, model, data, pair) for pair in pairs),
        ]
        mujoco.mj_forward(model, data)
        self._qpos, self._qvel = data.qpos.copy(), data.qvel.copy()
        count = len(self._touching)
        self.depths, self.creeps = np.zeros(count), np.zeros(count)
        self.heights = [touching.height for touching in self._touching]
        along, up = np.stack([touching.rows() for touching in self._touching], axis=1)
        self.slips = along @ self._qvel
        self._sinks = -self._ways(up, _falling(scene, model))
        self._creeps = self._ways(along, [])

    def _ways(self, rows: Array, upright: list[int]) -> Array:
        """(nv, contacts): the least motion that moves one point by 1 and keeps all loops closed.

        Least by the kinetic energy it would have, W⁻¹ Jᵀ (J W⁻¹ Jᵀ)⁻¹ with W the mass matrix; but
        what is free to sink upright does, for what leans at the start moves in another way.
        """
        model, data, points = self.model, self.data, len(rows)
        if data.ne:
            rows = np.vstack([rows, data.efc_J.reshape(-1, model.nv)[: data.ne]])
        given, lift = np.zeros_like(rows), np.zeros((len(upright), model.nv))
        mujoco.mj_solveM(model, data, given, np.ascontiguousarray(rows))
        mujoco.mj_solveM(model, data, lift, np.eye(model.nv)[upright])
        for dof, moved in zip(upright, lift, strict=True):
            given[:, dof] += UPRIGHT * moved[dof] * rows[:, dof]
        return given.T @ np.linalg.pinv(rows @ given.T)[:, :points]

    def place(self) -> None:
        """Puts the data there; a hinge or a slide has one number, so they add up."""
        self.data.qpos[:] = self._qpos + self._sinks @ self.depths
        self.data.qvel[:] = self._qvel + self._creeps @ self.creeps

    def acceleration(self, i: int) -> tuple[float, float]:
        """Accelerations [m/s²] at contact i: how its slip grows, and how its height does."""
        self._look()
        return self._touching[i].acceleration()

    def accelerations(self) -> Array:
        """(2, contacts): of all that touches."""
        self._look()
        return np.transpose([touching.acceleration() for touching in self._touching])

    def _look(self) -> None:
        self.place()
        mujoco.mj_forward(self.model, self.data)
        mujoco.mj_rnePostConstraint(self.model, self.data)


def _falling(scene: Scene, model: mujoco.MjModel) -> list[int]:
    """The numbers of the rates with which free bodies move without turning."""
    free = [branch.body for branch in spanning_tree(scene).branches if branch.joint is None]
    return [int(model.joint(f"{body}.{axis}").dofadr[0]) for body in free for axis in ("x", "y")]


# Points that touch in MuJoCo at a start: how they move with all rates, how gap and slip grow.


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
        """Accelerations [m/s²] of the lowest point: how its slip grows, and how its height does."""
        found = np.zeros(6)
        mujoco.mj_objectAcceleration(self._model, self._data, _GEOM, self._geom, found, 0)
        real = found[3:] + self._gravity  # MuJoCo counts what holds as −g
        along = float(self._along @ real)
        return along + self._radius * float(found[2]), float(self._normal @ real)


class OnBody:
    """A point or rim of a body that touches another body."""

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
        (x, y), (nx, ny) = self._pair.place(motion)[0], self._pair.normal_and_gap(motion)[0][0]
        place = np.array([x, y, 0.0])
        each = np.zeros((2, 3, self._model.nv))
        for found, body in zip(each, self._bodies.values(), strict=True):
            mujoco.mj_jac(self._model, self._data, found, None, place, body)
        moves = each[0] - each[1]
        return np.array([ny * moves[0] - nx * moves[1], nx * moves[0] + ny * moves[1]])

    def acceleration(self) -> tuple[float, float]:
        """[m/s²] how its slip grows, and how fast the gap does ever more."""
        slip, parting = self._pair.slip_and_gap_rate(self._motion([-_SOON, _SOON]))
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


_DEEPEST = 1.0  # m, of a point; a disk could be as deep as its radius
_SETTLED = 1e-12  # of a depth: points that share a load have found it
_ALL_AT_ONCE = (1, 4)  # sweeps before which Newton may try: he knows not what carries
_SWEEPS = 100  # at most: each takes a third or more of the error, as two ends of one bar do
_NEARLY = 1e-3  # of a depth: slow sweeps came as near; those that ran round stayed farther off
_FEW = 3  # contacts that rub: of so many each choice may be tried
_STICKS = 10  # steps of the slip's growth: friction is damped by about 1/h, and holds or does not
_MOST = 1000  # steps to a zero: where friction gives way the slip jumps, and each only halves
_STILL = 1e-9  # m/s: what slips less is meant to stick
_ROUNDING = 1e-15  # of a creep: so little does not change it, and looks as if friction gave way


def settle(
    scene: Scene, model: mujoco.MjModel, data: mujoco.MjData, start: Start
) -> dict[str, float]:
    """Depth [m] of each contact that is closed, by name; afterwards the data starts there."""
    contacts = [c for c in touching(scene).values() if lies(scene, c, start)]
    pairs = [pair for pair in scene.pairs.values() if meet(scene, pair, start)]
    both: list[Contact | Pair] = [*contacts, *pairs]
    if not both:
        return {}
    with signals(scene, point_force_callbacks(scene, model)):
        floor = Floor(scene, model, data, contacts, pairs)
        deepest = [scene.bodies[contact.body].radius or _DEEPEST for contact in both]
        rubs = [i for i, contact in enumerate(both) if contact.friction]
        rubs = [] if model.opt.noslip_iterations else rubs
        if _swept(floor, deepest, rubs) > _NEARLY and len(rubs) <= _FEW:
            _chosen(floor, deepest, rubs)
    mujoco.mj_resetDataKeyframe(model, data, 0)  # the run must not inherit a warm start
    floor.place()
    return dict(zip([c.name for c in both], floor.depths.tolist(), strict=True))


def _swept(floor: Floor, deepest: Sequence[float], creeps: Sequence[int]) -> float:
    """Settles depths and these creeps one after the other, or all at once.

    Returns by how much of the largest depth the last sweep has still moved one; 0: settled.
    """
    moved = 0.0
    for sweep in range(_SWEEPS):  # Gauss and Seidel
        if len(deepest) > 2 and sweep in _ALL_AT_ONCE and together(floor):
            return 0.0
        before = floor.depths.copy()
        for i, most in enumerate(deepest):
            _sink(floor, i, most)
            if i in creeps:
                _creep(floor, i)
        moved = float(np.max(np.abs(floor.depths - before)))
        if moved <= _SETTLED * np.max(floor.depths):
            return 0.0
    return moved / float(np.max(floor.depths) or 1.0)


def _chosen(floor: Floor, deepest: Sequence[float], rubs: Sequence[int]) -> None:
    """Settles with fewer that may stick: who slides off hangs on who does, and sweeps run round.

    What friction would hold by itself it does not where a slide elsewhere takes its load. As many
    stick as settle; if not even all that slide do, the bodies start on the floor and not in it.
    """
    for count in reversed(range(len(rubs))):
        for sticks in combinations(rubs, count):
            floor.depths[:], floor.creeps[:] = 0.0, 0.0
            if _swept(floor, deepest, sticks) <= _NEARLY:
                return
    floor.depths[:], floor.creeps[:] = 0.0, 0.0


def _sink(floor: Floor, i: int, deepest: float) -> None:
    """To where the point neither falls nor rises. Depth 0 is no contact; the least above it is."""
    from scipy.optimize import brentq

    def rise(depth: float) -> float:
        floor.depths[i] = depth
        return floor.acceleration(i)[1]

    shallow = deep = 4e-16 * max(abs(floor.heights[i]), 1.0)
    while rise(deep) < 0 and deep < deepest:
        deep *= 10
    carried = rise(shallow) < 0 < rise(deep)  # else it is lifted off, or pressed through the floor
    floor.depths[i] = brentq(rise, shallow, deep, xtol=shallow) if carried else 0.0


def _creep(floor: Floor, i: int) -> None:
    """As fast as makes friction hold a point that sticks; what friction cannot hold slides off."""
    before = floor.creeps[i]

    def slips(creep: float) -> float:
        floor.creeps[i] = creep
        return floor.acceleration(i)[0]

    floor.creeps[i] = 0.0
    if abs(floor.slips[i]) > _STILL or not floor.depths[i]:
        return
    now, h = slips(before), float(floor.model.opt.timestep)
    found = abs(now) * h <= _ROUNDING * abs(before)  # a zero no nearer than that: it is here
    floor.creeps[i] = before if found else _zero(slips, before, now, h)


def _zero(slips: Callable[[float], float], before: float, now: float, h: float) -> float:
    """The creep [m/s] at which the slip does not grow; 0 where friction cannot hold it."""
    from scipy.optimize import brentq

    reach = now * h
    while slips(before + reach) * now > 0:
        reach *= 2
        if abs(reach) > _STICKS * abs(now) * h:
            return 0.0
    xtol = 4e-16 * abs(reach)
    return float(brentq(slips, before, before + reach, xtol=xtol, maxiter=_MOST))


# Newton's method for all depths and creeps of a start at once, from where they nearly are.
#
# One after the other they settle as slowly as contacts share their load: blocks on blocks took a
# thousand evaluations of MuJoCo, and this takes fifty.


_TURNS = 12  # at most: each takes three digits or more, as the differences do
_NUDGE = 1e-4  # of a depth or a creep: MuJoCo's forces are nearly linear in both
_KNOWN = 1e-7  # of the largest slope: below it is what differences leave of none
_CONVERGED = 1e-10  # of the largest depth and creep: a place is a double, of which a depth is 1e-6


def together(floor: Floor) -> bool:
    """Settles what carries and what creeps already; False, and nothing changed, if it cannot."""
    before = floor.depths.copy(), floor.creeps.copy()
    deep, creeps = floor.depths > 0, floor.creeps != 0
    which = np.concatenate([creeps, deep])

    def left(x: Array) -> Array:
        floor.creeps[creeps], floor.depths[deep] = np.split(x, [np.count_nonzero(creeps)])
        return floor.accelerations().ravel()[which]

    x = np.concatenate([floor.creeps[creeps], floor.depths[deep]])
    sizes = np.concatenate(
        [
            np.full(np.count_nonzero(mask), _largest(values))
            for mask, values in ((creeps, floor.creeps), (deep, floor.depths))
        ]
    )
    for _ in range(_TURNS if np.any(deep) else 0):
        now = left(x)
        slopes = [(left(x + nudge) - now) / _NUDGE for nudge in _NUDGE * np.diag(sizes)]
        # Two corners of one block slip alike: of their creeps only a sum is known.
        step = sizes * np.linalg.lstsq(np.transpose(slopes), -now, rcond=_KNOWN)[0]
        x = x + step
        if np.any(x[np.count_nonzero(creeps) :] <= 0) or not np.isfinite(x).all():
            break
        if np.all(np.abs(step) <= _CONVERGED * sizes):
            left(x)
            return True
    floor.depths[:], floor.creeps[:] = before
    return False


def _largest(values: Array) -> float:
    return float(np.max(np.abs(values), initial=0.0))
