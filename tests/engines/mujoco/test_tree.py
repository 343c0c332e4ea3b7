"""MuJoCo's tree of joints, which loops close, and the times of its steps."""

from dataclasses import replace

import numpy as np
import pytest
from given.engine_scenes import ODD_NAMES, ROD, machine, pin
from given.planning import TUNED, moved
from given.random_machines import chain, loops, tree

from textmech.cases.trajectory import Array
from textmech.engines.engine import Start
from textmech.engines.mujoco.model import tree as built
from textmech.engines.mujoco.model.tree import spanning_tree
from textmech.engines.mujoco.read.record import all_steps


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_a_tree_has_no_loop_and_a_chain_has_one(seed: int) -> None:
    for build in (tree(seed), tree(seed, driven=True), chain(seed)):
        assert len(spanning_tree(build.scene).loops) == loops(build.scene)


@pytest.mark.parametrize("name", ODD_NAMES)
def test_a_name_like_the_grounds_closes_nothing(name: str) -> None:
    hung = machine([replace(ROD, name=name)], [pin("A", "ground.O", f"{name}.start")])
    assert not spanning_tree(hung).loops


def test_times_are_products() -> None:
    assert all_steps(np.array([0.0, 0.3]), 0.1).tolist() == [0.0, 0.1, 0.2, 0.1 * 3]


ALONG = (0.6, 0.8)
BEGUN: dict[str, Start] = {
    "pin": {"rod": (0.3, -0.4, np.arctan2(-0.4, 0.3), 0.4, 0.3, 1.0)},
    "slide": {"rod": (0.5 + 0.06, 0.08, 0.0, 0.3, 0.4, 0.0)},
}
"""The rod's start is held: by a pin in O, or 0.1 m along a line through it."""


def named(kind: str, *, backward: bool) -> dict[str, Array]:
    """States and reactions of a rod that the ground holds, or that holds the ground."""
    ends = ("ground.O", "rod.start")
    joint = pin("A", *(ends[::-1] if backward else ends), kind=kind, along=ALONG)
    told = ("A.fx", "A.fy")
    scene, times = machine([ROD], [joint]), np.linspace(0.0, 0.1, 6)
    motion = moved(TUNED["mujoco"], scene, BEGUN[kind], times, 1e-3, reactions=told)
    sign = -1.0 if backward else 1.0
    return {**motion.states, **{name: sign * motion.reactions[name] for name in told}}


@pytest.mark.parametrize("kind", BEGUN)
def test_a_joint_that_is_named_backward_moves_alike(kind: str) -> None:
    """To the last bit: its axis is the opposite, and so is what it counts."""
    forward, backward = named(kind, backward=False), named(kind, backward=True)
    assert np.any(forward["rod"][-1] != forward["rod"][0])
    for name, rows in forward.items():
        assert np.array_equal(rows, backward[name]), name


@pytest.mark.mutant("axis of a {kind} not turned round where its body is named first")
@pytest.mark.parametrize("kind", BEGUN)
def test_an_axis_that_is_not_turned_round_is_seen(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(built, "_axis", lambda scene, branch, freedom: freedom.axis)
    forward, backward = (named(kind, backward=way)["rod"] for way in (False, True))
    assert np.max(np.abs(forward - backward)) > 0.1
