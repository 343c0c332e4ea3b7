"""MuJoCo's tree of joints, which loops close, and the times of its steps."""

from dataclasses import replace

import numpy as np
import pytest
from given.engine_scenes import ODD_NAMES, ROD, machine, pin
from given.random_machines import chain, loops, tree

from textmech.engines.mujoco.model.tree import spanning_tree
from textmech.engines.mujoco.read.record import all_steps


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
