"""Mistakes planted in the explicit accelerations only, and the law that must see each."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import random_scenes
from given.multibody_laws import EXACT, Law, balance, lagrangian

from textmech.cases.scene import (
    GROUND,
    Anchor,
    Body,
    GroundPoint,
    Scene,
    Spring,
    planar_joint,
    shape,
)
from textmech.reference.mechanism.constraints.constraint_jacobian import Levers
from textmech.reference.mechanism.constraints.constraint_terms import Line
from textmech.reference.mechanism.forces.action import pulls
from textmech.reference.mechanism.kinematics.coordinates import Point
from textmech.reference.mechanism.modes import mode as module
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.system import Array


def heavier(body: Body) -> Body:
    return replace(body, inertia=tuple(1.05 * J for J in body.inertia))


class Turning(Multibody):
    """Every J 5 % too large in the explicit accelerations."""

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        made = {name: heavier(body) for name, body in self.scene.bodies.items()}
        return Multibody(replace(self.scene, bodies=made), self.start()).accelerations(t, q, v)


class Rising(Multibody):
    """Gravity with the wrong sign in the explicit accelerations."""

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        x, y = self.scene.gravity
        scene = replace(self.scene, gravity=(-x, -y))
        return Multibody(scene, self.start()).accelerations(t, q, v)


def without_moment(force: Any, where: Any, t: Any, q: Any, v: Any, Q: Any) -> None:
    """d × F of a force off centre is lost."""
    if not isinstance(force, Spring):
        original(force, where, t, q, v, Q)
        return
    for F, p in pulls(force, where, t, q, v):
        if p.xy is not None:
            Q[p.xy : p.xy + 2] += F


original = module.act


def convective(self: Levers, t: Any, q: Any, v: Any) -> list[Any]:
    """The levers with γ of the wrong sign: in a pin that is all of ω² d."""
    cross, gamma = levers(self, t, q, v)
    return [cross, -gamma]


levers = Levers.__call__


def opposite_gamma(self: Line, a: Point, b: Point) -> tuple[Any, ...]:
    """A slide with γ of the wrong sign."""
    *f, gamma = line(self, a, b)
    return *f, -gamma


def without_coriolis(self: Line, a: Point, b: Point) -> tuple[Any, ...]:
    """A slide without 2 ω u·Δ̇."""
    *f, gamma = line(self, a, b)
    u, slip = self.direction((a, b)), np.subtract(b.r_dot, a.r_dot)
    return *f, gamma + 2 * a.omega * (u[0] * slip[1] - u[1] * slip[0])


line = Line.numbers


def mutated(kind: type[Multibody] = Multibody) -> Multibody:
    """Two bodies on the ground by a pin and a slide, with a spring off centre, as `kind`."""
    bar = shape.bar(name="bar", mass=1.2, length=0.9, points={"P": (0.3, 0.2)})
    block = shape.block(name="block", mass=0.7, width=0.5, height=0.3, points={})
    scene = Scene(
        gravity=(0.0, -9.80665),
        points={"O": GroundPoint((0.3, -0.1))},
        bodies={"bar": bar, "block": block},
        joints={
            "hinge": planar_joint("hinge", "pin", Anchor(GROUND, "O"), Anchor("bar", "start")),
            "rail": planar_joint(
                "rail", "slide", Anchor("bar", "end"), Anchor("block", "center"), (0.6, 0.8), 0.4
            ),
        },
        contacts={},
        forces={"coil": Spring("coil", Anchor("bar", "P"), Anchor(GROUND, "O"), 30.0, 0.2)},
    )
    return kind(scene, (np.zeros(6), np.zeros(6)))


def seen(law: Law, mechanism: Multibody) -> float:
    random = np.random.default_rng(4)
    return max(law(mechanism, *random_scenes.state(random, mechanism)) for _ in range(5))


@pytest.mark.parametrize("law", [lagrangian, balance])
def test_the_laws_hold_for_what_is_mutated(law: Law) -> None:
    assert seen(law, mutated()) < EXACT


@pytest.mark.mutant("{kind}")
@pytest.mark.parametrize("law", [lagrangian, balance])
@pytest.mark.parametrize("kind", [Turning, Rising])
def test_law_sees_a_wrong_body(law: Law, kind: type[Multibody]) -> None:
    assert seen(law, mutated(kind)) > 1e-4


@pytest.mark.mutant("moment d × F of a force off centre left out")
@pytest.mark.parametrize("law", [lagrangian, balance])
def test_law_sees_a_lost_moment(law: Law, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "act", without_moment)
    assert seen(law, mutated()) > 1e-4


@pytest.mark.mutant("{wrong}")
@pytest.mark.parametrize(
    ("kind", "name", "wrong"),
    [
        (Levers, "__call__", convective),
        (Line, "numbers", opposite_gamma),
        (Line, "numbers", without_coriolis),
    ],
    ids=["sign of ω² d in a pin", "sign of γ in a slide", "no Coriolis term in a slide"],
)
def test_lagrange_sees_a_wrong_convective_term(
    kind: type, name: str, wrong: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The power balance cannot: reactions do no work, however large they are."""
    monkeypatch.setattr(kind, name, wrong)
    assert seen(lagrangian, mutated()) > 1e-4
    assert seen(balance, mutated()) < EXACT
