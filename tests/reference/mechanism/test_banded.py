"""Long chains and trees: the multipliers by their band are those of the full matrix."""

from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from given import random_machines, random_scenes
from given.engine_scenes import chain

from textmech.cases.scene import Anchor, Scene, planar_joint
from textmech.reference.formalisms import lagrange
from textmech.reference.mechanism.constraints.constraint_solver import band
from textmech.reference.mechanism.constraints.equation_table import Rows, Table
from textmech.reference.mechanism.constraints.joint_constraints import constraints
from textmech.reference.mechanism.kinematics.coordinates import Coordinates
from textmech.reference.mechanism.modes.mode import Multibody, SingularPose
from textmech.reference.system import Array

EXACT = 1e-11  # of the largest: the condition of long chains is up to 1e4


def shuffled(scene: Scene, seed: int = 1) -> Scene:
    """The same joints in another order."""
    names = np.random.default_rng(seed).permutation(list(scene.joints)).tolist()
    return replace(scene, joints={name: scene.joints[name] for name in names})


def ring(n: int) -> Scene:
    """A chain with a slide from its last bar to the ground: a loop."""
    scene, _ = chain(n)
    end = planar_joint(
        "end", "slide", Anchor(f"b{n - 1}", "end"), Anchor("ground", "O"), (0.6, 0.8)
    )
    return replace(scene, joints={**scene.joints, "end": end})


def assembled(scene: Scene, where: Coordinates) -> Rows:
    parts = constraints(scene, where)
    return Rows(Table(where, parts), parts)


HUB = Anchor("b0", "end")
SCENES = {
    "chain": chain(20)[0],
    "shuffled": shuffled(chain(20)[0]),
    "ring": ring(20),
    "tree": random_machines.mechanism(random_machines.tree(3, count=16, driven=True)).scene,
}


State = tuple[Multibody, float, Array, Array]


def made(name: str) -> State:
    """A mechanism, and any state of it."""
    scene = SCENES[name]
    n = len(Coordinates(scene).names)
    mechanism = Multibody(scene, (np.zeros(n), np.zeros(n)))
    return mechanism, *random_scenes.state(np.random.default_rng(4), mechanism)


@pytest.fixture(params=SCENES)
def found(request: pytest.FixtureRequest) -> State:
    return made(request.param)


def difference(found: State) -> float:
    """Of the accelerations and multipliers by the band and by (2.60) as one matrix, relative."""
    mechanism, t, q, v = found
    pairs = zip(mechanism.solve(t, q, v), lagrange.multipliers(mechanism, t, q, v), strict=True)
    return max(float(np.abs(a - b).max() / np.abs(b).max()) for a, b in pairs)


def test_the_band_gives_what_the_whole_matrix_gives(found: State):
    assert band(found[0].holding.rows, np.array(found[0].where.masses)) is not None
    assert difference(found) < EXACT


def test_entries_are_those_of_the_rows(found: State):
    """What is computed for the band alone, and what `rows` gives to everybody else."""
    mechanism, t, q, v = found
    f, g, gamma = mechanism.rows(t, q, v)
    entries, same = mechanism.holding.rows.entries(t, q, v)
    row, column = mechanism.holding.rows.pattern
    written = np.zeros_like(f)
    written[row, column] = entries
    np.testing.assert_array_equal(written, f)
    np.testing.assert_array_equal(same, gamma)
    assert len(g) == len(f)


def test_the_order_in_which_joints_are_written_does_not_matter():
    widths = []
    for name in ("chain", "shuffled"):
        where = Coordinates(SCENES[name])
        rows = assembled(SCENES[name], where)
        widths.append(band(rows, np.array(where.masses)).width)  # type: ignore[union-attr]
    assert widths[0] == 3  # two rows of a joint, and the two of the next
    assert widths[1] <= 5


def test_a_star_is_no_band():
    """Forty joints on one body: each of their rows meets all others."""
    scene = SCENES["chain"]
    joints = {
        f"j{i}": planar_joint(f"j{i}", "pin", HUB, Anchor(f"b{i}", "start")) for i in range(1, 20)
    }
    star = replace(scene, joints=joints)
    where = Coordinates(star)
    assert band(assembled(star, where), np.array(where.masses)) is None


def test_the_joint_that_holds_nothing_is_named():
    """Of the ground to itself: its rows are zero, exactly."""
    scene = SCENES["shuffled"]
    ground = Anchor("ground", "O")
    joints = {"idle": planar_joint("idle", "pin", ground, ground), **scene.joints}
    mechanism, t, q, v = made("shuffled")
    idle = Multibody(replace(scene, joints=joints), mechanism.start())
    with pytest.raises(SingularPose, match="what idle holds"):
        idle.solve(t, q, v)


@pytest.mark.mutant("band of the equations with {lost!r} beside its place")
@pytest.mark.parametrize("lost", ["one", "two", "at"])
def test_a_mistake_in_the_band_is_seen(lost: str):
    """Each entry beside the right one, or each product beside its place."""
    found = made("shuffled")
    held = found[0].holding.band
    assert held is not None
    found[0].holding.band = replace(held, **{lost: np.roll(getattr(held, lost), 1)})
    with suppress(SingularPose):
        assert difference(found) > 1e-6


def test_work_grows_with_the_length():
    """Twice the bars are twice the products, and the band is no wider: r steps, not r³."""
    lengths = {n: (np.zeros(3 * n), np.zeros(3 * n)) for n in (20, 40)}
    short, long = (Multibody(chain(n)[0], start).holding.band for n, start in lengths.items())
    assert short is not None
    assert long is not None
    assert len(long.one) < 2.1 * len(short.one)
    assert long.width == short.width
