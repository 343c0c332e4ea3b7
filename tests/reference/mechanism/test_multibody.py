"""The generated answer against its own energies and residuals, on scenes nobody chose."""

import numpy as np
import pytest
from given import random_scenes
from given.engine_scenes import BOX, G, machine, pin
from given.multibody_laws import EXACT, Law, balance, lagrangian

from textmech.cases.scene import GROUND, Anchor
from textmech.reference.mechanism.forces.action import NoDirection
from textmech.reference.mechanism.modes.mode import Multibody

COUNT = 60  # random scenes: every kind of body, joint and force comes ten times and more


@pytest.mark.slow
@pytest.mark.parametrize("law", [lagrangian, balance])
def test_law_on_random_scenes(law: Law) -> None:
    found = [
        law(m, *random_scenes.state(random, m)) for m, random in random_scenes.mechanisms(COUNT)
    ]
    assert max(found) < EXACT


@pytest.mark.slow
def test_the_random_scenes_have_everything() -> None:
    """Negative control of the generator: each kind of part appears, loops and driven points too."""
    made = [m.scene for m, _ in random_scenes.mechanisms(COUNT)]
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
        scene = random_scenes.scene(random, free=True, loops=False)
        n = sum(3 if b.turns else 2 for b in scene.bodies.values())
        mechanism = Multibody(scene, (np.zeros(n), np.zeros(n)))
        if not random_scenes.independent(mechanism, random):
            continue
        q = random_scenes.closed(mechanism, 0.0, random.uniform(-2.0, 2.0, n))
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
            moment += body.moment * a[phi] if phi is not None else 0.0
            total += [*F, moment]
            size = max(size, *np.abs(F), abs(moment))
        assert np.max(np.abs(total)) < EXACT * size
        checked += 1


def test_forces_that_nearly_cancel_leave_an_acceleration() -> None:
    """Down a slope of s ≪ 1 a block falls by s² g: the rail's force is short of that alone."""
    slope = np.sqrt(1e-7)
    along = np.cos(slope), -np.sin(slope)
    rail = pin("rail", "ground.O", "box.center", "slide", along=along)
    mechanism = Multibody(machine([BOX], [rail]), (np.zeros(3), np.zeros(3)))
    a = mechanism.accelerations(0.0, np.zeros(3), np.zeros(3))
    assert a == pytest.approx([G * -along[1] * along[0], -G * along[1] ** 2, 0.0], rel=1e-8)
