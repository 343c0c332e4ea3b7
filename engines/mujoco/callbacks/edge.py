"""Edges, blades that do not slip sideways: their forces by our law at every RK4 stage.

MuJoCo has no such constraint. Without the edges it would accelerate by a₀ = M⁻¹ (all forces). A
point's velocity along a direction w is A v, A = wᵀJ with the point's Jacobian J; it changes by
A v̇ + w·J̇v + ẇ·v_P, and that has to be ṡ, the rate of the speed that is prescribed along w (0 where
none is). So the edges' forces are λ = (A M⁻¹ Aᵀ)⁻¹ (ṡ − A a₀ − w·J̇v − ẇ·v_P), each at its point
along w.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from ....cases.scene import Edge, Scene, Vector
from ....cases.scene.frame import PLANE
from ....cases.scene.rotation import Vector3
from ....cases.trajectory import Array
from ...signal import rate
from ..model.edge import edge_forces
from ..model.tree import called
from .signal import Control, bound
from .smooth import actuated

Way = Callable[[Array, Array], tuple[Array, Array]]
"""w and ẇ (3,) of a body with these axes (3, 3), as columns in ground axes, and this ω (3,)."""


@dataclass(frozen=True)
class Row:
    """A constraint row of an edge: its point, a direction, and how the speed along it changes."""

    body: int
    site: int
    way: Way
    change: Callable[[float], float]  # ṡ [m/s²] at a time [s]


def edges(scene: Scene, model: mujoco.MjModel) -> list[Control]:
    """One callback for all edges, for they may feel each other; or none."""
    rows = [_row(scene, model, edge, field) for edge, field in edge_forces(scene)]
    if not rows:
        return []

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        law = _Law(model, data, rows)
        return law.apply

    return [bound(bind)]


def _row(scene: Scene, model: mujoco.MjModel, edge: Edge, field: str) -> Row:
    body, site = model.body(called(edge.at.body)).id, model.site(str(edge.at)).id
    if field == "drive" and edge.speed is not None:
        return Row(body, site, _carried(edge.along), lambda t, law=edge.speed: rate(law, t)[0])
    if field == "normal":
        return Row(body, site, _upward, _still)
    way = _carried(edge.across) if scene.frame is PLANE else _leftward(edge.along)  # type: ignore[arg-type]
    return Row(body, site, way, _still)


def _still(t: float) -> float:
    """ṡ of what stays zero."""
    return 0.0


def _carried(way: Vector) -> Way:
    """A direction in the plane that the body carries: ẇ = ω × w."""
    x, y = way

    def turned(axes: Array, omega: Array) -> tuple[Array, Array]:
        w = x * axes[:, 0] + y * axes[:, 1]
        return w, np.array([-omega[2] * w[1], omega[2] * w[0], 0.0])

    return turned


def _leftward(along: Vector3) -> Way:
    """w is 90 degrees to the left of the blade's shadow h: ẇ = −ψ̇ h/|h|, with ψ̇ its turning."""

    def left(axes: Array, omega: Array) -> tuple[Array, Array]:
        x, y, z = axes @ along
        size = np.hypot(x, y)
        turning = omega[2] - z * (omega[0] * x + omega[1] * y) / size**2
        way = np.array([-y, x, 0.0]) / size
        return way, turning * np.array([-way[1], way[0], 0.0])

    return left


def _upward(axes: Array, omega: Array) -> tuple[Array, Array]:
    return np.array([0.0, 0.0, 1.0]), np.zeros(3)


class _Law:
    """MuJoCo's arrays, fetched once, and room for the law's own."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, rows: Sequence[Row]) -> None:
        self._model, self._data, self._rows = model, data, rows
        self._moves, self._turns = np.zeros((3, model.nv)), np.zeros((3, model.nv))
        self._drifts = np.zeros((3, model.nv))
        self._A, self._by_mass = np.zeros((len(rows), model.nv)), np.zeros((len(rows), model.nv))
        self._free = np.zeros((1, model.nv))

    def apply(self) -> None:
        """The forces at the present stage, as forces on bodies, and in `userdata` to be read."""
        model, data, A = self._model, self._data, self._A
        wanted, ways = np.zeros(len(self._rows)), np.zeros((len(self._rows), 3))
        for i, row in enumerate(self._rows):
            ways[i], wanted[i] = self._enter(i, row)
        forces = data.qfrc_passive - data.qfrc_bias + actuated(model, data)
        mujoco.mj_solveM(model, data, self._free, forces[None])
        mujoco.mj_solveM(model, data, self._by_mass, A)
        multipliers = np.linalg.solve(A @ self._by_mass.T, wanted - A @ self._free[0])
        data.userdata[:] = multipliers
        data.xfrc_applied[:] = 0.0
        for row, way, size in zip(self._rows, ways, multipliers.tolist(), strict=True):
            (fx, fy, fz), (x, y, z) = size * way, data.site_xpos[row.site] - data.xipos[row.body]
            moment = (y * fz - z * fy, z * fx - x * fz, x * fy - y * fx)
            data.xfrc_applied[row.body] += (fx, fy, fz, *moment)

    def _enter(self, i: int, row: Row) -> tuple[Array, float]:
        """Writes A of a row; its direction in ground axes, and what A v̇ has to be."""
        model, data, v = self._model, self._data, self._data.qvel
        place = data.site_xpos[row.site]
        mujoco.mj_jac(model, data, self._moves, self._turns, place, row.body)
        mujoco.mj_jacDot(model, data, self._drifts, None, place, row.body)
        way, turning = row.way(data.xmat[row.body].reshape(3, 3), self._turns @ v)
        self._A[i] = way @ self._moves
        drift = way @ (self._drifts @ v) + turning @ (self._moves @ v)
        return way, row.change(data.time) - float(drift)
