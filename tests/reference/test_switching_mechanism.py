"""The modes of random scenes against the formalisms, and the impact law against its terms."""

import math

import numpy as np
import pytest
from given import scenes

from textmech.cases import shape
from textmech.cases.scene import (
    Anchor,
    Bounds,
    Contact,
    DryFriction,
    GroundPoint,
    Joint,
    Scene,
    Smooth,
    Spring,
)
from textmech.reference.formalisms import energy, lagrange
from textmech.reference.generated.contact import Braking, Coulomb, at_rest, normal, tangent
from textmech.reference.generated.element import elements
from textmech.reference.generated.mechanism import Mechanism
from textmech.reference.generated.mode import Multibody
from textmech.reference.generated.smooth import SmoothMultibody
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Only
from textmech.reference.systems.smooth_friction import SmoothDynamometer

LAW = 1e-9  # of the largest acceleration: random scenes lose up to four digits of 1e-13
WELL = 100.0  # condition of the rows: beyond, rounding shows


def lawful(mechanism: Multibody, t: float, q: Array, v: Array) -> None:
    """The explicit accelerations by (2.60) from the ingredients, and the power (2.51)."""
    a = mechanism.accelerations(t, q, v)
    size = float(np.max(np.abs(a))) + mechanism.terms(t, q, v)[0]
    assert np.max(np.abs(lagrange.multipliers(mechanism, t, q, v)[0] - a)) < LAW * size
    powers = np.abs(lagrange.momentum(mechanism, t, q, v) * a)
    size = float(np.max(powers)) + mechanism.terms(t, q, v)[1]
    assert abs(energy.power_balance(mechanism, t, q, v)) < LAW * size


def with_slides(count: int, *, held: bool) -> list[tuple[Multibody, np.random.Generator]]:
    """Random mechanisms whose slides rest, or sliding with 0.7 N, on parts that turn as well."""
    found = []
    for plain, random in scenes.mechanisms(400):
        slides = [j for j in plain.scene.joints.values() if j.kind == "slide"]
        if not slides:
            continue
        parts = [at_rest(joint, plain.where) for joint in slides]
        braking = [] if held else [Braking(part, lambda t, q, v: -0.7) for part in parts]
        made = Multibody(plain.scene, plain.start(), held=parts if held else [], braking=braking)
        n = len(made.coordinates)
        if scenes.independent(made, random) and len(made.f_a(0.0, np.zeros(n))) < n:
            found.append((made, random))
        if len(found) == count:
            break
    return found


@pytest.mark.parametrize("held", [True, False])
def test_slides_at_rest_and_rubbing(held: bool) -> None:
    for mechanism, random in with_slides(25, held=held):
        t, q, v = scenes.state(random, mechanism)
        if np.linalg.cond(mechanism.f_a(t, q)) < WELL:
            lawful(mechanism, t, q, v)


def rods() -> Scene:
    """Two bars pinned together, a disk pinned to the second; all of them touch the floor."""
    return Scene(
        gravity=(1.0, -9.0),
        points={},
        bodies={
            "one": shape.bar(name="one", mass=0.8, length=1.0, points={"P": (0.3, 0.1)}),
            "two": shape.bar(name="two", mass=1.1, length=0.7, points={}),
            "disk": shape.disk(name="disk", mass=0.5, radius=0.2, points={"Q": (0.1, 0.05)}),
        },
        joints={
            "knee": Joint("knee", "pin", Anchor("one", "end"), Anchor("two", "start")),
            "hub": Joint("hub", "pin", Anchor("two", "end"), Anchor("disk", "Q")),
        },
        contacts={
            "P": Contact("P", Anchor("one", "P"), 0.4, 0.3),
            "rim": Contact("rim", Anchor("disk", "center"), 0.6, 0.5),
        },
        forces={},
    )


@pytest.mark.parametrize("slipping", [(0, 0), (1, 0), (0, -1), (-1, 1)])
def test_contacts_that_stick_roll_and_slide(slipping: tuple[int, int]) -> None:
    scene, random = rods(), np.random.default_rng(seed=3)
    plain = Multibody(scene, (np.zeros(9), np.zeros(9)))
    held, coulomb = [], []
    for contact, s in zip(scene.contacts.values(), slipping, strict=True):
        rows = normal(contact, plain.where), tangent(contact, plain.where)
        held += rows[:1] if s else rows
        coulomb += [Coulomb(*rows, -contact.kinetic * s)] if s else []
    mechanism = Multibody(scene, plain.start(), held=held, coulomb=coulomb)
    for _ in range(20):
        t, q, v = scenes.state(random, mechanism)
        if np.linalg.cond(mechanism.f_a(t, q)) > WELL:
            continue
        lawful(mechanism, t, q, v)
        forces = mechanism.reactions(t, q, v)
        for contact, s in zip(scene.contacts.values(), slipping, strict=True):
            if s:
                N = forces[f"{contact.name}.normal"]
                assert forces[f"{contact.name}.tangent"] == -s * contact.kinetic * N


def guided(mass: float, smooth: Smooth | None) -> Scene:
    """A particle on a slide of the ground, thrown along it."""
    friction = DryFriction(Bounds(3.0, 4.0), Bounds(2.0, 2.5), smooth)
    slide = Joint(
        "rail",
        "slide",
        Anchor("ground", "O"),
        Anchor("dot", "center"),
        along=(0.6, 0.8),
        dry_friction=friction,
    )
    return Scene(
        gravity=(0.0, 0.0),
        points=scenes.scene(np.random.default_rng(1)).points,
        bodies={"dot": shape.particle(name="dot", mass=mass)},
        joints={"rail": slide},
        contacts={},
        forces={},
    )


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_slide_brakes_by_its_own_bound(way: float) -> None:
    """(2.89) v₀ m / F₊ forward, v₀ m / F₋ backward; then it rests, by no force."""
    q, v = np.array([0.1, -0.2]), way * np.array([0.6, 0.8])
    system = Mechanism(guided(1.3, None), (q, v), 1.0)
    followed = follow(system, np.linspace(0.0, 1.0, 11))
    (stop,) = followed.changes
    assert stop.time == pytest.approx(1.3 / (2.0 if way > 0 else 2.5), abs=1e-12)
    assert stop.mode_after == "rail sticks"
    forces = system.modes["rail sticks"].reactions(0.0, *np.split(followed.y[-1], 2))
    assert forces["rail.friction"] == pytest.approx(0.0, abs=1e-12)


def test_smooth_friction_of_a_slide_by_the_formalisms() -> None:
    """(2.95) outside the band is −F₊; the residual by superposition is the sum of the forces."""
    law = Smooth(band=0.05, sharpness=100.0)
    start = np.array([0.1, -0.2]), np.zeros(2)
    system = Mechanism(guided(1.3, law), start, 1.0)
    mechanism = system.modes[system.start()[0]]
    assert isinstance(mechanism, SmoothMultibody)
    for speed in (-1.0, -0.05, 0.0, 0.02, 0.05, 1.0):
        q, v = np.array([0.1, -0.2]), speed * np.array([0.6, 0.8])
        a = mechanism.accelerations(0.0, q, v)
        assert lagrange.multipliers(mechanism, 0.0, q, v)[0] == pytest.approx(a, abs=1e-12)
    v = np.array([0.6, 0.8])
    assert mechanism.accelerations(0.0, q, v) == pytest.approx(-2.0 / 1.3 * v, abs=1e-12)


def test_smooth_friction_on_an_oblique_slide_of_odd_mass() -> None:
    """Forces that cancel leave no rounding behind: from rest, steps would shrink to nothing."""
    friction = DryFriction(Bounds(6.0, 6.0), Bounds(3.0, 3.0), Smooth(band=0.0005, sharpness=1e5))
    ends = Anchor("ground", "O"), Anchor("dot", "center")
    scene = Scene(
        gravity=(0.0, 0.0),
        points={"O": GroundPoint((0.0, 0.0)), "hook": GroundPoint((0.6, 0.8), (1.2, 1.6))},
        bodies={"dot": shape.particle(name="dot", mass=1.3)},
        joints={"rail": Joint("rail", "slide", *ends, along=(0.6, 0.8), dry_friction=friction)},
        contacts={},
        forces={"coil": Spring("coil", Anchor("ground", "hook"), ends[1], 2.0, 1.0)},
    )
    times = np.linspace(0.0, 5.0, 26)
    y = follow(Mechanism(scene, (np.zeros(2), np.zeros(2)), 1.0), times).y
    block = SmoothDynamometer(1.3, 2.0, 2.0, 3.0, 3.0, 6.0, 6.0, 5e-4, 1e5)
    exact = follow(Only(block), times).y
    assert y[:, :2] @ [0.6, 0.8] == pytest.approx(exact[:, 0], abs=1e-9)


def test_every_element_is_found() -> None:
    scene = rods()
    plain = Multibody(scene, (np.zeros(9), np.zeros(9)))
    assert [e.name for e in elements(scene, plain.where)] == ["P", "rim"]


def test_a_disk_that_lands_turning_rolls_or_slides_by_the_cone() -> None:
    """Coulomb's impulse: it rolls if m |slip| / 3 ≤ μ m |v_n|, else v_x jumps by μ |v_n|."""
    for mu, rolls in ((0.4, True), (0.1, False)):
        disk = shape.disk(name="wheel", mass=1.3, radius=0.25, points={})
        touch = Contact("touch", Anchor("wheel", "center"), mu, mu)
        scene = Scene((0.0, -9.80665), {}, {"wheel": disk}, {}, {"touch": touch}, {})
        start = np.array([0.0, 1.25, 0.0]), np.array([1.0, 0.0, 4.0])
        followed = follow(Mechanism(scene, start, 0.25), np.linspace(0.0, 0.46, 3))
        land = followed.changes[0]
        v_n, slip = math.sqrt(2 * 9.80665), 1.0 + 0.25 * 4.0
        jump = -slip / 3 if rolls else -mu * v_n
        assert land.after[3] - land.before[3] == pytest.approx(jump, abs=1e-12)
        assert land.mode_after == ("touch sticks" if rolls else "touch slides +")
