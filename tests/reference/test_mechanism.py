"""The generated answer against its own energies and residuals, on scenes nobody chose."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene import GROUND, Anchor, Body, Joint, Scene, Spring
from textmech.reference.formalisms import energy, lagrange
from textmech.reference.generated import mode as module
from textmech.reference.generated.action import NoDirection, pulls
from textmech.reference.generated.mode import Multibody
from textmech.reference.generated.rows import GAMMA, Along, Line
from textmech.reference.system import Array

EXACT = 1e-12  # of the largest term
COUNT = 60  # random scenes: every kind of body, joint and force comes ten times and more


def lagrangian(mechanism: Multibody, t: float, q: Array, v: Array) -> float:
    """(2.60) Explicit accelerations against T, U, D, Q₄, f_a, g, relative to the largest term."""
    a, lam = lagrange.multipliers(mechanism, t, q, v)
    terms = [np.abs(a), *(np.abs(mechanism.f_a(t, q) * lam[:, None]) / mechanism.where.masses)]
    return float(np.max(np.abs(mechanism.accelerations(t, q, v) - a)) / np.max(terms))


def balance(mechanism: Multibody, t: float, q: Array, v: Array) -> float:
    """(2.51) The power that is not accounted for, relative to the power of all forces together."""
    lam = lagrange.multipliers(mechanism, t, q, v)[1]
    power = np.abs(mechanism.f_a(t, q) * lam[:, None] * v).sum()
    power += np.abs(mechanism.accelerations(t, q, v) * mechanism.where.masses * v).sum()
    return abs(energy.power_balance(mechanism, t, q, v)) / (power or 1.0)  # 0: nothing can move


Law = Callable[[Multibody, float, Array, Array], float]


@pytest.mark.parametrize("law", [lagrangian, balance])
def test_law_on_random_scenes(law: Law) -> None:
    found = [law(m, *scenes.state(random, m)) for m, random in scenes.mechanisms(COUNT)]
    assert max(found) < EXACT


def test_the_random_scenes_have_everything() -> None:
    """Negative control of the generator: each kind of part appears, loops and driven points too."""
    made = [m.scene for m, _ in scenes.mechanisms(COUNT)]
    shapes = {b.shape for s in made for b in s.bodies.values()}
    joints = {j.kind for s in made for j in s.joints.values()}
    laws = {(type(f).__name__, f.signal.law) for s in made for f in s.signals()}
    assert shapes == {"bar", "block", "disk", "rigid", "particle"}
    assert joints == {"pin", "slide", "weld"}
    assert len(laws) == 6
    assert sum("loop" in s.joints for s in made) >= 5
    assert sum(len(s.contacts) for s in made) >= 5
    assert sum(j.a == Anchor(GROUND, "hook") for s in made for j in s.joints.values()) >= 5


def test_free_scenes_keep_momentum_and_angular_momentum() -> None:
    """(2.22), (2.24) Σ m r̈ = 0 and Σ r × m r̈ + J ω̇ = 0: forces inside come in pairs."""
    random, checked = np.random.default_rng(2), 0
    while checked < 20:
        scene = scenes.scene(random, free=True, loops=False)
        n = sum(3 if b.turns else 2 for b in scene.bodies.values())
        mechanism = Multibody(scene, (np.zeros(n), np.zeros(n)))
        if not scenes.independent(mechanism, random):
            continue
        q = scenes.closed(mechanism, 0.0, random.uniform(-2.0, 2.0, n))
        v = random.uniform(-3.0, 3.0, n)
        try:
            a = mechanism.accelerations(0.0, q, v)
        except NoDirection:  # a spring between points that two pins hold together
            continue
        # Welded together, all may be at rest: then the forces are the largest terms (of ~ 1 kg).
        total, size = np.zeros(3), mechanism.terms(0.0, q, v)[0]
        for body in scene.bodies.values():
            xy, phi = mechanism.where.columns[body.name]
            F = body.mass * a[xy : xy + 2]
            moment = q[xy] * F[1] - q[xy + 1] * F[0]
            moment += body.inertia * a[phi] if body.inertia and phi is not None else 0.0
            total += [*F, moment]
            size = max(size, *np.abs(F), abs(moment))
        assert np.max(np.abs(total)) < EXACT * size
        checked += 1


@pytest.mark.parametrize("name", [c.name for c in scenes.SHIPPED.values() if c.system])
def test_generated_motion_is_the_written_motion(name: str) -> None:
    checks = {check.name: check for check in scenes.solved(name).checks}
    assert checks["generated motion"].difference < 1e-9
    assert checks["generated reactions"].difference < 1e-9


# Planted mistakes, each in the explicit accelerations only, and the law that must see it.


def heavier(body: Body) -> Body:
    return replace(body, inertia=body.inertia * 1.05) if body.inertia else body


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


def convective(kind: type) -> Callable[..., None]:
    """A term with γ of the wrong sign: in a pin that is all of ω² d."""
    add = kind.add

    def wrong(self: Any, ends: Any, row: list[Any]) -> None:
        before = row[GAMMA]
        add(self, ends, row)
        row[GAMMA] -= 2 * (row[GAMMA] - before)

    return wrong


def cross(a: Any, b: Any) -> Any:
    return a[0] * b[1] - a[1] * b[0]


def without_coriolis(add: Callable[..., None]) -> Callable[..., None]:
    """The term of a slide without 2 ω u·Δ̇."""

    def wrong(self: Any, ends: Any, row: list[Any]) -> None:
        add(self, ends, row)
        a, b = ends
        n = self.direction(ends)
        if a.phi is not None:
            row[GAMMA] += 2 * a.omega * cross(n, np.subtract(b.r_dot, a.r_dot))

    return wrong


def mutated(kind: type[Multibody] = Multibody) -> Multibody:
    """Two bodies on the ground by a pin and a slide, with a spring off centre, as `kind`."""
    bar = scenes.shape.bar(name="bar", mass=1.2, length=0.9, points={"P": (0.3, 0.2)})
    block = scenes.shape.block(name="block", mass=0.7, width=0.5, height=0.3, points={})
    scene = Scene(
        gravity=(0.0, -9.80665),
        points={"O": scenes.GroundPoint((0.3, -0.1))},
        bodies={"bar": bar, "block": block},
        joints={
            "hinge": Joint("hinge", "pin", Anchor(GROUND, "O"), Anchor("bar", "start")),
            "rail": Joint(
                "rail", "slide", Anchor("bar", "end"), Anchor("block", "center"), (0.6, 0.8), 0.4
            ),
        },
        contacts={},
        forces={"coil": Spring("coil", Anchor("bar", "P"), Anchor(GROUND, "O"), 30.0, 0.2)},
    )
    return kind(scene, (np.zeros(6), np.zeros(6)))


def seen(law: Law, mechanism: Multibody) -> float:
    random = np.random.default_rng(4)
    return max(law(mechanism, *scenes.state(random, mechanism)) for _ in range(5))


@pytest.mark.parametrize("law", [lagrangian, balance])
def test_the_laws_hold_for_what_is_mutated(law: Law) -> None:
    assert seen(law, mutated()) < EXACT


@pytest.mark.parametrize("law", [lagrangian, balance])
@pytest.mark.parametrize("kind", [Turning, Rising])
def test_law_sees_a_wrong_body(law: Law, kind: type[Multibody]) -> None:
    assert seen(law, mutated(kind)) > 1e-4


@pytest.mark.parametrize("law", [lagrangian, balance])
def test_law_sees_a_lost_moment(law: Law, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "act", without_moment)
    assert seen(law, mutated()) > 1e-4


@pytest.mark.parametrize(
    ("kind", "wrong"),
    [
        (Along, convective(Along)),
        (Line, convective(Line)),
        (Line, without_coriolis(Line.add)),
    ],
    ids=["sign of ω² d in a pin", "sign of γ in a slide", "no Coriolis term in a slide"],
)
def test_lagrange_sees_a_wrong_convective_term(
    kind: type, wrong: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The power balance cannot: reactions do no work, however large they are."""
    monkeypatch.setattr(kind, "add", wrong)
    assert seen(lagrangian, mutated()) > 1e-4
    assert seen(balance, mutated()) < EXACT
