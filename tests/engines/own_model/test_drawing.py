"""A user's model as it is drawn: where its geoms are, by MuJoCo, and how it moves in between."""

from typing import Any

import mujoco as native
import numpy as np
import pytest
from given.otherwise import otherwise
from scipy.spatial.transform import Rotation

from textmech.cases.trajectory import Array
from textmech.engines.own_model import drawing
from textmech.engines.own_model.drawing import floors, outlines, pivots, states
from textmech.engines.own_model.model import OwnModel, compiled_text

mujoco: Any = native  # whose functions no type checker sees
BODIES = """
<mujoco>
  <worldbody>
    <geom name="ramp" type="plane" size="5 5 .1" pos="0 0 -1" euler="0 20 0"/>
    <body name="box" pos="0.1 0.2 1" euler="10 20 30">
      <freejoint/>
      <geom type="box" size=".1 .2 .3" pos=".03 .02 .01" euler="40 0 10"/>
      <body name="arm" pos="0.3 0 0.1" euler="0 50 0">
        <joint name="swing" axis="0 1 0" pos="0 0 .05"/>
        <geom type="box" size=".05 .02 .2" pos="0 0 -.2" quat="1 .2 .3 .4"/>
        <body name="bare" pos="0 .1 -.4">
          <joint name="push" type="slide" axis="1 0 0"/>
          <joint name="wrist" type="ball" pos=".01 0 0"/>
          <inertial pos=".02 0 0" mass="2" diaginertia=".004 .003 .002" euler="0 0 30"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.fixture(scope="module")
def own() -> OwnModel:
    return compiled_text(BODIES, "bodies")


def drawn(own: OwnModel, count: int = 5) -> Array:
    """Some states y (N, m + n): all coordinates and rates by chance."""
    random, m = np.random.default_rng(3), own.model
    y = random.uniform(-1.0, 1.0, (count, m.nq + m.nv))
    for first in (3, m.nq - 4):  # quaternions
        y[:, first : first + 4] /= np.linalg.norm(y[:, first : first + 4], axis=1, keepdims=True)
    return y


def corners(own: OwnModel, y: Array, body: str, module: Any = drawing) -> Array:
    """(N, 8, 3) the corners of the first geom of a body, where its outline stands in our states."""
    places = np.unique(np.concatenate(module.outlines(own.model)[body]).round(12), axis=0)
    rows = module.states(own, y)[body]
    turns = Rotation.from_quat(rows[:, [4, 5, 6, 3]])  # scipy has the scalar last
    return rows[:, None, :3] + np.stack([turn.apply(places) for turn in turns])


def off(own: OwnModel, module: Any = drawing) -> float:
    """How far [m] a drawn corner is from the nearest that MuJoCo's geom has in that state."""
    m, data, y = own.model, mujoco.MjData(own.model), drawn(own)
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    worst = 0.0
    for geom, body in ((1, "box"), (2, "arm")):
        for row, ours in zip(y, corners(own, y, body, module), strict=True):
            data.qpos[:] = row[: m.nq]
            mujoco.mj_forward(m, data)
            R = data.geom_xmat[geom].reshape(3, 3)
            theirs = data.geom_xpos[geom] + signs * m.geom_size[geom] @ R.T
            apart = np.linalg.norm(ours[:, None] - theirs[None], axis=2)
            worst = max(worst, float(apart.min(axis=1).max()), float(apart.min(axis=0).max()))
    return worst


@pytest.mark.mutant("a model's drawing with {named}")
@pytest.mark.parametrize(
    ("named", "was", "now"),
    [
        ("a body at its parent's place", "*data.xpos[body]", "*data.xpos[m.body_parentid[body]]"),
        ("a quaternion turned back", "*data.xquat[body]", "*(data.xquat[body] * (1, -1, -1, -1))"),
        ("a quaternion's scalar last", "*data.xquat[body]", "*np.roll(data.xquat[body], -1)"),
        ("a geom at its body's origin", "m.geom_pos[geom] + line", "line"),
        ("a geom that is not turned", "line @ R.T for line in SHAPES", "line for line in SHAPES"),
    ],
)
def test_a_corner_is_drawn_where_mujoco_has_it(
    own: OwnModel, named: str, was: str, now: str
) -> None:
    assert off(own) < 1e-9
    assert off(own, otherwise(drawing, was, now)) > 0.01


def rates(own: OwnModel, module: Any = drawing) -> float:
    """By how much [m/s, rad/s] the rates of all states differ from those of places nearby."""
    h, y, m = 1e-6, drawn(own), own.model
    moved = y.copy()
    for row in moved:
        mujoco.mj_integratePos(m, row[: m.nq], row[m.nq :], h)
    before, after = module.states(own, y), states(own, moved)
    worst = 0.0
    for body, rows in before.items():
        velocity = (after[body][:, :3] - rows[:, :3]) / h
        one, other = (Rotation.from_quat(s[:, [4, 5, 6, 3]]) for s in (rows, after[body]))
        spin = (one.inv() * other).as_rotvec() / h  # in the axes of the body
        worst = max(worst, float(np.abs(np.hstack([velocity, spin]) - rows[:, 7:]).max()))
    return worst


@pytest.mark.mutant("a model's spins in ground axes")
def test_rates_are_those_of_the_places(own: OwnModel) -> None:
    assert rates(own) < 1e-4
    assert rates(own, otherwise(drawing, ".T @ rate[:3]", " @ rate[:3]")) > 0.1


def test_no_moving_body_is_invisible(own: OwnModel) -> None:
    """One without a geom is a box as hard to turn; without a mass, too, it has no line at all."""
    lines = outlines(own.model)
    assert set(lines) == {"box", "arm", "bare"}
    assert all(lines.values())
    still = '<body name="mark" pos="0 0 1"/></worldbody>'
    marked = compiled_text(BODIES.replace("</worldbody>", still), "bodies")
    assert outlines(marked.model)["mark"] == []


def moments(own: OwnModel, module: Any = drawing) -> Array:
    """(3,) the moments of inertia of the box that the bare body is drawn as."""
    m, body = own.model, 3
    places = np.unique(np.concatenate(module.outlines(m)["bare"]).round(9), axis=0)
    axes = Rotation.from_quat(m.body_iquat[body][[1, 2, 3, 0]])
    a, b, c = np.ptp(axes.inv().apply(places - m.body_ipos[body]), axis=0)
    return m.body_mass[body] / 12 * np.array([b * b + c * c, a * a + c * c, a * a + b * b])


@pytest.mark.mutant("a bare body's box twice as large")
def test_a_bare_body_is_the_box_of_its_inertia(own: OwnModel) -> None:
    assert moments(own) == pytest.approx(own.model.body_inertia[3], rel=1e-6)
    twice = otherwise(drawing, "np.maximum(1.5 *", "np.maximum(6.0 *")
    assert moments(own, twice) != pytest.approx(own.model.body_inertia[3], rel=0.1)


def test_a_box_of_an_inertia_out_of_proportion_is_no_larger_than_what_it_joins() -> None:
    odd = BODIES.replace('mass="2" diaginertia=".004 .003 .002"', 'mass="1e-4" diaginertia="1 1 1"')
    lines = outlines(compiled_text(odd, "odd").model)["bare"]
    assert np.ptp(np.concatenate(lines), axis=0).max() < 1.0


def opens(own: OwnModel, module: Any = drawing) -> float:
    """How far [m] the pivot of the arm opens between two samples, seen from both of its bodies."""
    y, m = drawn(own, 3), own.model
    y[1:, 3:7] = y[0, 3:7]
    _, finer = module.refined(own, np.array([0.0, 0.1, 0.2]), y, 4)
    moves, worst = states(own, finer), 0.0
    ours, theirs = moves["arm"], moves["box"]
    for arm, box in zip(ours, theirs, strict=True):
        at = [
            rows[:3] + Rotation.from_quat(rows[[4, 5, 6, 3]]).apply(place)
            for rows, place in ((arm, m.jnt_pos[1]), (box, pivot(own)))
        ]
        worst = max(worst, float(np.linalg.norm(at[0] - at[1])))
    return worst


def pivot(own: OwnModel) -> Array:
    """(3,) [m] the arm's pivot on the box."""
    m = own.model
    turn = Rotation.from_quat(m.body_quat[2][[1, 2, 3, 0]])
    return m.body_pos[2] + turn.apply(m.jnt_pos[1])


def test_no_joint_opens_between_samples(own: OwnModel) -> None:
    assert opens(own) < 1e-9


def quarter(module: Any = drawing) -> list[float]:
    """Angle and rate of a hinge at 1.5 s, a quarter between two samples of φ = t³ − t."""
    own = compiled_text(
        "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1'/></body></worldbody>"
        "</mujoco>",
        "hinge",
    )
    t = np.array([0.0, 1.0, 3.0])
    y = np.stack([t**3 - t, 3 * t**2 - 1], axis=1)
    times, finer = module.refined(own, t, y, 4)
    assert times.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0]
    assert finer[::4] == pytest.approx(y)
    return finer[5].tolist()


@pytest.mark.mutant("straight lines between a model's samples")
def test_between_samples_a_cubic_is_itself() -> None:
    assert quarter() == pytest.approx([1.875, 5.75])
    straight = otherwise(drawing, "s * s * (3 - 2 * s) * by[k]", "s * by[k]")
    assert quarter(straight)[0] != pytest.approx(1.875, abs=0.1)


def test_a_tilted_plane_and_the_pivots_are_where_the_file_has_them(own: OwnModel) -> None:
    ((at, across, along),) = floors(own.model)
    assert at.tolist() == [0.0, 0.0, -1.0]
    tilt = np.radians(20.0)
    assert across == pytest.approx([np.cos(tilt), 0.0, -np.sin(tilt)])
    assert along == pytest.approx([0.0, 1.0, 0.0])
    found = [(body, place.tolist()) for body, place in pivots(own.model)]
    assert found == [("arm", [0.0, 0.0, 0.05]), ("bare", [0.01, 0.0, 0.0])]


def test_a_body_called_as_one_without_a_name_is_drawn_too() -> None:
    twins = """<mujoco><worldbody><body><freejoint/><geom size=".1"/></body>
        <body name="body 1" pos="1 0 0"><freejoint/><geom type="box" size=".1 .1 .1"/></body>
        </worldbody></mujoco>"""
    assert [*outlines(compiled_text(twins, "twins").model)] == ["body 1", "'body 1'"]
