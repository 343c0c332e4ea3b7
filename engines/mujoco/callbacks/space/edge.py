"""Edges in space: a blade that does not slip to its side, nor leave its height if that is kept."""

import mujoco
import numpy as np

from .....cases.scene import Scene
from .....cases.scene.constraint import Edge
from .....cases.scene.rotation import Vector3
from .....cases.trajectory import Array
from ...model.space.edge import edge_forces
from ...model.tree import called
from ..edge import Row, Way, holding, still
from ..signal import Control

UP = np.array([0.0, 0.0, 1.0])


def edges(scene: Scene, model: mujoco.MjModel) -> list[Control]:
    """One callback for all edges, or none."""
    return holding(model, [_row(model, edge, field) for edge, field in edge_forces(scene)])


def _row(model: mujoco.MjModel, edge: Edge, field: str) -> Row:
    body, site = model.body(called(edge.at.body)).id, model.site(str(edge.at)).id
    return Row(body, site, _upward if field == "normal" else _leftward(edge.along), still)


def _upward(axes: Array, omega: Array) -> tuple[Array, Array]:
    return UP, np.zeros(3)


def _leftward(along: Vector3) -> Way:
    """w is 90 degrees to the left of the blade's shadow h: ẇ = −ψ̇ h/|h|, with ψ̇ its turning."""

    def left(axes: Array, omega: Array) -> tuple[Array, Array]:
        x, y, z = axes @ along
        size = np.hypot(x, y)
        turning = omega[2] - z * (omega[0] * x + omega[1] * y) / size**2
        way = np.array([-y, x, 0.0]) / size
        return way, turning * np.array([-way[1], way[0], 0.0])

    return left
