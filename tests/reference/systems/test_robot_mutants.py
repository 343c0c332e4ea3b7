"""Mistakes planted in the five-axis robots: the law that must see each sees it."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any
from unittest import mock

import numpy as np
import pytest
from given import robot_laws
from given.laws import LIMIT
from given.mutants import mutant
from given.robots import PARAMETERS, robot

from textmech.reference.systems.robots import (
    arm,
    driven_robot,
    five_axis_robot,
    robot_knife,
    serial_arm,
)
from textmech.reference.systems.robots.triples import NIL

NAMES = pytest.mark.parametrize("name", PARAMETERS)
MODULES = (arm, driven_robot, five_axis_robot, robot_knife, serial_arm)
outward, inward, mass_matrix = arm.outward, arm.inward, arm.mass_matrix


def without_gyroscopic_term(*given: Any) -> Any:
    """The centres move as they do, but ω × J ω is lost."""
    return [replace(at, omega=NIL) for at in outward(*given)]


def without_carried_rates(where: Any, v: Any, a: Any) -> Any:
    """ω̇ without ω_{k−1} × q̇_k u_k."""
    turns = np.cumsum([np.multiply(x, place.u) for x, place in zip(a, where, strict=True)], axis=0)
    found = zip(outward(where, v, a), turns.tolist(), strict=True)
    return [replace(at, omega_dot=tuple(omega_dot)) for at, omega_dot in found]


def lifted_at_the_tip(where: Any, moving: Any, tip: Any = NIL) -> Any:
    """A force of the hand's weight that nobody applies."""
    return inward(where, moving, (0.0, 0.0, 0.7 * 9.80665))


def without_tensors(where: Any) -> Any:
    with mock.patch.object(arm.Link, "turned", return_value=NIL):
        return mass_matrix(where)


def without_steiner(where: Any) -> Any:
    """The hand's centre on its hinge."""
    return mass_matrix([*where[:-1], replace(where[-1], c=where[-1].p)])


IN_THE_ARM = {
    "outward": (without_gyroscopic_term, without_carried_rates),
    "inward": (lifted_at_the_tip,),
    "mass_matrix": (without_tensors, without_steiner),
}
PLANTED = [
    pytest.param(name, function, wrong, id=f"{name}: {wrong.__name__}")
    for function, mistakes in IN_THE_ARM.items()
    for wrong in mistakes
    for name in PARAMETERS
    if name != "driven_robot" or function != "mass_matrix"  # it needs none
]


@pytest.mark.mutant("{name}: {wrong}")
@pytest.mark.parametrize(("name", "function", "wrong"), PLANTED)
def test_a_mistake_in_the_arm_is_seen_by_lagrange(
    name: str, function: str, wrong: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in MODULES:
        if hasattr(module, function):
            monkeypatch.setattr(module, function, wrong)
    assert robot_laws.equations(robot(name)) > 1e3 * LIMIT


def _poses(self: Any, *given: Any) -> Any:
    return type(self).__mro__[1].poses(self, *given)


def transposed(self: Any, *given: Any) -> Any:
    """E as ground axes in body axes: the conjugate quaternions."""
    return {
        name: (*pose[:4], *(-x for x in pose[4:7]), *pose[7:])
        for name, pose in _poses(self, *given).items()
    }


def in_ground_axes(self: Any, t: Any, q: Any, v: Any) -> Any:
    """ω of every body in ground axes."""
    where, poses = arm.places(q), _poses(self, t, q, v)
    moving = outward(where, v, np.zeros(5))
    rows = zip(poses.items(), moving, strict=True)
    return {name: (*pose[:10], *at.omega) for (name, pose), at in rows}


def of_one_hinge(self: Any, t: Any, q: Any, v: Any) -> Any:
    """ω_{k,k−1} for ω_k."""
    rows = zip(_poses(self, t, q, v).items(), arm.LINKS, v, strict=True)
    return {name: (*pose[:10], *(x * np.eye(3)[link.axis])) for (name, pose), link, x in rows}


def exchanged(self: Any, *given: Any) -> dict[str, float]:
    """What the second body exerts on the first."""
    held = type(self).__mro__[1].reactions(self, *given)
    return {name: -x if name.startswith("q3.") else x for name, x in held.items()}


def of_the_next_axis(self: Any, *given: Any) -> dict[str, float]:
    """Moments about the next hinge for those about this one."""
    held = type(self).__mro__[1].reactions(self, *given)
    return held | {f"q3.m{axis}": held[f"q4.m{axis}"] for axis in "xyz"}


def too_fast(self: Any, *given: Any) -> Any:
    """5 % on the accelerations."""
    return 1.05 * type(self).__mro__[1].accelerations(self, *given)


def upward(self: Any, t: Any, q: Any) -> Any:
    return -type(self).__mro__[1].U(self, t, q)


IN_THE_MODE = {
    "transposed E": ({"poses": transposed}, robot_laws.moves),
    "ω in ground axes": ({"poses": in_ground_axes}, robot_laws.moves),
    "ω of one hinge": ({"poses": of_one_hinge}, robot_laws.moves),
    "parts exchanged": ({"reactions": exchanged}, robot_laws.cut_free),
    "moment about another point": ({"reactions": of_the_next_axis}, robot_laws.cut_free),
    "accelerations off": ({"accelerations": too_fast}, robot_laws.power),
    "weight upward": ({"U": upward}, robot_laws.equations),
}


@pytest.mark.mutant("{name}: {mistake}")
@NAMES
@pytest.mark.parametrize("mistake", IN_THE_MODE)
def test_a_mistake_in_the_mode_is_seen(name: str, mistake: str) -> None:
    methods, law = IN_THE_MODE[mistake]
    assert law(mutant(robot(name), **methods)) > 1e3 * LIMIT
