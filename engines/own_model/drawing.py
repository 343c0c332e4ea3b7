"""A model as it is drawn: the outlines of its bodies, and where they are and move in states."""

from collections.abc import Callable, Mapping

import mujoco
import numpy as np
from scipy.spatial import ConvexHull, QhullError

from ...cases.trajectory import Array
from .model import OwnModel, displaced, joint_moves
from .quantities import label

GEOM = mujoco.mjtGeom
SHOWN = 3  # groups of geoms: by custom those above hold what collides and is not to be seen
CORNERS = 24  # of a circle
FEW = 24  # corners of a mesh's outline at most
ALONG = ((0, 1), (0, 2), (1, 2))
"""The planes in which a round body is drawn: by two of its axes."""

Line = Array
"""(N, 3) [m] places on a body, in its axes, that are joined."""


def outlines(model: mujoco.MjModel) -> dict[str, list[Line]]:
    """Returns by body's name the lines that draw its geoms; a plane has none.

    A body without any is drawn as the box of its inertia; one without mass, too, has no line.
    """
    drawing: dict[str, list[Line]] = {}
    for body in range(model.nbody):
        first = int(model.body_geomadr[body])
        geoms = range(first, first + int(model.body_geomnum[body]))
        visible = [geom for geom in geoms if model.geom_group[geom] < SHOWN] or geoms
        lines = [line for geom in visible for line in _geom(model, geom)]
        if lines or body:
            drawing[label(model, mujoco.mjtObj.mjOBJ_BODY, body)] = lines or _mass_box(model, body)
    return drawing


def floors(model: mujoco.MjModel) -> list[Array]:
    """Returns of each plane on the ground (3, 3): a place on it [m], and two axes."""
    planes = np.flatnonzero((model.geom_type == GEOM.mjGEOM_PLANE) & (model.geom_bodyid == 0))
    return [np.stack([model.geom_pos[k], *_axes(model.geom_quat[k]).T[:2]]) for k in planes]


def pivots(model: mujoco.MjModel) -> list[tuple[str, Array]]:
    """Returns of each joint that only turns its body's name, and its place (3,) [m] on that."""
    turning = np.isin(model.jnt_type, (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_BALL))
    body = mujoco.mjtObj.mjOBJ_BODY
    return [
        (label(model, body, int(model.jnt_bodyid[k])), model.jnt_pos[k])
        for k in np.flatnonzero(turning)
    ]


def refined(own: OwnModel, times: Array, y: Array, parts: int) -> tuple[Array, Array]:
    """Interpolates a motion: times and y (N, k), with each interval cut into so many parts.

    Between two samples each joint moves as the cubic through both with both rates, so that none
    opens.
    """
    m = own.model
    q, v = y[:, : m.nq], y[:, m.nq : m.nq + m.nv]
    h, by = np.diff(times)[:, None], joint_moves(m, q[:-1], q[1:])
    rows, finer = [y[:1]], [times[:1]]
    for k, s in enumerate([np.arange(1, parts + 1)[:, None] / parts] * len(by)):
        rates = by[k] / h[k]
        steps = s * s * (3 - 2 * s) * by[k]
        steps += h[k] * (s * (1 - s) ** 2 * v[k] - s * s * (1 - s) * v[k + 1])
        rate = 6 * s * (1 - s) * rates + (1 - s) * (1 - 3 * s) * v[k] + s * (3 * s - 2) * v[k + 1]
        coordinates = np.array([displaced(m, q[k], step) for step in steps])
        rest = y[k, m.nq + m.nv :] + s * (y[k + 1] - y[k])[m.nq + m.nv :]
        rows.append(np.hstack([coordinates, rate, rest]))
        finer.append(times[k] + h[k] * s[:, 0])
    return np.concatenate(finer), np.concatenate(rows)


def states(own: OwnModel, y: Array) -> dict[str, Array]:
    """Returns by body's name (N, 13): r, quaternion, ṙ in ground axes, ω in body axes.

    y (N, m + n + a): (qpos, qvel, act).
    """
    m, data = own.model, own.start()
    rows = np.empty((m.nbody, len(y), 13))
    rate = np.empty(6)
    for k, sample in enumerate(y):
        data.qpos[:], data.qvel[:] = sample[: m.nq], sample[m.nq : m.nq + m.nv]
        mujoco.mj_kinematics(m, data)
        mujoco.mj_comPos(m, data)
        mujoco.mj_comVel(m, data)
        for body in range(m.nbody):
            mujoco.mj_objectVelocity(m, data, mujoco.mjtObj.mjOBJ_XBODY, body, rate, 0)
            spin = data.xmat[body].reshape(3, 3).T @ rate[:3]
            rows[body, k] = [*data.xpos[body], *data.xquat[body], *rate[3:], *spin]
    return {label(m, mujoco.mjtObj.mjOBJ_BODY, body): rows[body] for body in range(m.nbody)}


def _geom(m: mujoco.MjModel, geom: int) -> list[Line]:
    """Returns the lines of a geom, in its body's axes; none of one that is no solid."""
    kind, R = GEOM(m.geom_type[geom]), _axes(m.geom_quat[geom])
    return [m.geom_pos[geom] + line @ R.T for line in SHAPES.get(kind, _no_lines)(m, geom)]


def _no_lines(_: mujoco.MjModel, __: int) -> list[Line]:
    return []


def _axes(quaternion: Array) -> Array:
    """(3, 3): in its columns the axes of an attitude."""
    R = np.zeros(9)
    mujoco.mju_quat2Mat(R, quaternion)
    return R.reshape(3, 3)


def _mass_box(m: mujoco.MjModel, body: int) -> list[Line]:
    """Returns the box of a body's mass and moments, J = ⅓ m (b² + c²) with half edges.

    It is no larger than what the body joins: it is a picture, not a measure.
    """
    if not m.body_mass[body]:
        return []
    J = m.body_inertia[body]
    half = np.sqrt(np.maximum(1.5 * (J.sum() - 2 * J) / m.body_mass[body], 0.0))
    children = np.flatnonzero(m.body_parentid == body)
    distances = np.linalg.norm([m.body_pos[body], m.body_ipos[body], *m.body_pos[children]], axis=1)
    if distances.any():
        half *= min(1.0, distances.max() / (np.linalg.norm(half) or 1.0))
    return [m.body_ipos[body] + line @ _axes(m.body_iquat[body]).T for line in _cuboid(half)]


def _ring(a: int, b: int, corners: int = CORNERS) -> Line:
    turns = np.linspace(0.0, 2 * np.pi, corners + 1)
    ring = np.zeros((len(turns), 3))
    ring[:, a], ring[:, b] = np.cos(turns), np.sin(turns)
    return ring


def _sphere(m: mujoco.MjModel, geom: int) -> list[Line]:
    return [m.geom_size[geom, 0] * _ring(*plane) for plane in ALONG]


def _ellipsoid(m: mujoco.MjModel, geom: int) -> list[Line]:
    return [m.geom_size[geom] * _ring(*plane) for plane in ALONG]


def _capsule(m: mujoco.MjModel, geom: int) -> list[Line]:
    radius, half = m.geom_size[geom, :2]
    rings = [radius * _ring(axis, 2) for axis in (0, 1)]
    return [ring + [0.0, 0.0, half] * np.sign(np.round(ring, 12)) for ring in rings]


def _cylinder(m: mujoco.MjModel, geom: int) -> list[Line]:
    radius, half = m.geom_size[geom, :2]
    ends = [radius * _ring(0, 1) + [0.0, 0.0, z] for z in (-half, half)]
    quarters = slice(0, CORNERS, CORNERS // 4)
    return [*ends, *np.stack(ends, axis=1)[quarters]]


def _box(m: mujoco.MjModel, geom: int) -> list[Line]:
    return _cuboid(m.geom_size[geom])


def _cuboid(half: Array) -> list[Line]:
    signs = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 1]])
    faces = [half * np.insert(signs, 2, z, axis=1) for z in (-1, 1)]
    return [*faces, *np.stack(faces, axis=1)[:4]]


def _mesh(m: mujoco.MjModel, geom: int) -> list[Line]:
    """Returns what is seen of its hull along each of its three axes."""
    mesh = m.geom_dataid[geom]
    first = m.mesh_vertadr[mesh]
    vertices = np.array(m.mesh_vert[first : first + m.mesh_vertnum[mesh]], dtype=np.float64)
    return [_outermost(vertices, plane) for plane in ALONG]


def _outermost(vertices: Array, plane: tuple[int, int]) -> Line:
    try:
        around = ConvexHull(vertices[:, plane]).vertices
    except QhullError:  # a flat mesh, along its plane
        across = np.ptp(vertices, axis=0).argmax()
        return vertices[[vertices[:, across].argmin(), vertices[:, across].argmax()]]
    kept = around[np.unique(np.linspace(0, len(around) - 1, FEW).round().astype(int))]
    return vertices[[*kept, kept[0]]]


SHAPES: Mapping[mujoco.mjtGeom, Callable[[mujoco.MjModel, int], list[Line]]] = {
    GEOM.mjGEOM_SPHERE: _sphere,
    GEOM.mjGEOM_ELLIPSOID: _ellipsoid,
    GEOM.mjGEOM_CAPSULE: _capsule,
    GEOM.mjGEOM_CYLINDER: _cylinder,
    GEOM.mjGEOM_BOX: _box,
    GEOM.mjGEOM_MESH: _mesh,
}
"""By a geom's type the lines that draw it, in its own axes."""
