"""The modes of contacts and slides against the formalisms, in random states."""

import numpy as np
import pytest
from given import random_scenes

from textmech.cases.scene import (
    Anchor,
    Contact,
    Scene,
    planar_joint,
    shape,
)
from textmech.reference.formalisms import energy, lagrange
from textmech.reference.mechanism.constraints.contact import (
    Braking,
    Coulomb,
    at_rest,
    normal,
    tangent,
)
from textmech.reference.mechanism.modes.element import elements
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.system import Array

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
    for plain, random in random_scenes.mechanisms(400):
        slides = [j for j in plain.scene.joints.values() if j.kind == "slide"]
        if not slides:
            continue
        parts = [at_rest(joint, plain.where) for joint in slides]
        braking = [] if held else [Braking(part, lambda t, q, v: -0.7) for part in parts]
        made = Multibody(plain.scene, plain.start(), held=parts if held else [], braking=braking)
        n = len(made.coordinates)
        if random_scenes.independent(made, random) and len(made.f_a(0.0, np.zeros(n))) < n:
            found.append((made, random))
        if len(found) == count:
            break
    return found


@pytest.mark.slow
@pytest.mark.parametrize("held", [True, False])
def test_slides_at_rest_and_rubbing(held: bool) -> None:
    for mechanism, random in with_slides(25, held=held):
        t, q, v = random_scenes.state(random, mechanism)
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
            "knee": planar_joint("knee", "pin", Anchor("one", "end"), Anchor("two", "start")),
            "hub": planar_joint("hub", "pin", Anchor("two", "end"), Anchor("disk", "Q")),
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
        t, q, v = random_scenes.state(random, mechanism)
        if np.linalg.cond(mechanism.f_a(t, q)) > WELL:
            continue
        lawful(mechanism, t, q, v)
        forces = mechanism.reactions(t, q, v)
        for contact, s in zip(scene.contacts.values(), slipping, strict=True):
            if s:
                N = forces[f"{contact.name}.normal"]
                assert forces[f"{contact.name}.tangent"] == -s * contact.kinetic * N


def test_every_element_is_found() -> None:
    scene = rods()
    plain = Multibody(scene, (np.zeros(9), np.zeros(9)))
    assert [e.name for e in elements(scene, plain.where)] == ["P", "rim"]
