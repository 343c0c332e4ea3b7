"""The laws of every generated mode at random states, and the mistakes that they see."""

from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from given.adapters.engine_scenes import BOX, G, machine, pin
from given.laws.multibody_laws import EXACT, Law, balance, lagrangian
from given.machines.random_machines import loops, machines, state

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
from textmech.reference.formalisms import appell, chaplygin, voronets
from textmech.reference.mechanism.constraints.constraint_terms import Line
from textmech.reference.mechanism.forces import action
from textmech.reference.mechanism.kinematics.frame import Vec
from textmech.reference.mechanism.kinematics.kinematics import Kinematics, Part, Point, Row
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.system import Array

COUNT = 40  # machines: every kind of body, joint and force comes ten times and more


@pytest.mark.slow
@pytest.mark.parametrize("law", [lagrangian, balance])
def test_law_on_random_machines(law: Law) -> None:
    random = np.random.default_rng(1)
    assert max(law(m, *state(random, m)) for m in machines(COUNT)) < EXACT


@pytest.mark.slow
def test_the_random_machines_have_everything() -> None:
    """Negative control of the generator: each kind of part appears, loops and driven points too."""
    made = [m.scene for m in machines(COUNT)]
    shapes = {b.shape for s in made for b in s.bodies.values()}
    joints = {j.kind for s in made for j in s.joints.values()}
    laws = {(type(f).__name__, f.signal.law) for s in made for f in s.signals()}
    assert shapes == {"bar", "block", "disk", "rigid", "particle"}
    assert joints == {"pin", "slide", "weld"}
    assert len(laws) == 6
    assert sum(loops(s) > 0 for s in made) >= 5
    assert sum(len(s.contacts) for s in made) >= 5
    assert sum(any(p.velocity) for s in made for p in s.points.values()) >= 5


def test_forces_that_nearly_cancel_leave_an_acceleration() -> None:
    """Down a slope of s ≪ 1 a block falls by s² g: the rail's force is short of that alone."""
    slope = np.sqrt(1e-7)
    along = np.cos(slope), -np.sin(slope)
    rail = pin("rail", "ground.O", "box.center", "slide", along=along)
    mechanism = Multibody(machine([BOX], [rail]), (np.zeros(3), np.zeros(3)))
    a = mechanism.accelerations(0.0, np.zeros(3), np.zeros(3))
    assert a == pytest.approx([G * -along[1] * along[0], -G * along[1] ** 2, 0.0], rel=1e-8)


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


def without_moment(k: Kinematics, p: Point, F: Vec) -> Any:
    """d × F of a force off centre is lost."""
    return p.part, F, None


def convective(self: Kinematics, part: Part, x: Any) -> Point:
    """Points with ω × (ω × d) of the wrong sign: in a pin that is all of γ."""
    found = points(self, part, x)
    return replace(found, beside=-found.beside)


def opposite_gamma(self: Line, *given: Any) -> Row:
    """A slide with γ of the wrong sign."""
    row = line(self, *given)
    return Row(row.loads, row.g, -row.gamma)


def without_coriolis(self: Line, k: Kinematics, ends: Any) -> Row:
    """A slide without 2 u̇·Δ̇."""
    row, u_dot = line(self, k, ends), k.carried(ends[self.a].part, self.u).u_dot
    slip = ends[self.b].r_dot - ends[self.a].r_dot
    return Row(row.loads, row.g, row.gamma + 2.0 * (u_dot @ slip))


points, line = Kinematics.fixed_in, Line.row


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
    return max(law(mechanism, *state(random, mechanism, 2.0)) for _ in range(5))


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
    monkeypatch.setattr(action, "pushed", without_moment)
    assert seen(law, mutated()) > 1e-4


@pytest.mark.mutant("{wrong}")
@pytest.mark.parametrize(
    ("kind", "name", "wrong"),
    [
        (Kinematics, "fixed_in", convective),
        (Line, "row", opposite_gamma),
        (Line, "row", without_coriolis),
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


FORMS = (voronets, chaplygin, appell)


def apart(mode: Multibody, form: ModuleType, t: float, q: Array, v: Array) -> float | None:
    """Relative to the accelerations, or what each force alone would give; None: does not apply."""
    a, found = mode.accelerations(t, q, v), form.accelerations(mode, t, q, v)
    size = max(np.max(np.abs(a)), mode.terms(t, q, v)[0])
    return None if found is None else float(np.max(np.abs(found - a)) / size)


@pytest.mark.slow
def test_random_machines_without_multipliers() -> None:
    random, applied = np.random.default_rng(1), dict.fromkeys(FORMS, 0)
    for mode in machines(COUNT):
        at = state(random, mode)
        for form in FORMS:
            found = apart(mode, form, *at)
            applied[form] += found is not None
            assert found is None or found < EXACT
    assert min(applied.values()) > COUNT // 3
