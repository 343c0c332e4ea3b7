"""What holds of every machine: Newton and Euler body by body, in any direction and in any units."""

import math

import numpy as np
import pytest
from given.drawn_machines import MACHINES, UNITS, Units, in_units, turned, turned_scene
from given.multibody_laws import EXACT, balance, lagrangian
from given.random_machines import Build, mechanism
from given.random_scenes import closed
from given.same_examples import examples
from hypothesis import given
from hypothesis import strategies as st

from textmech.cases.scene import GROUND, Anchor, Damper, Push, Scene, Spring, Torque
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.system import Array

few = examples(12)
T = 0.02  # s: where ramps have begun, and driven points have not torn a loop
# Rows may be as dependent as REGULAR 0.05 allows, which costs digits of the larger ones.
SAME = 1e-11


def begun(build: Build) -> tuple[Multibody, Array, Array]:
    """The mechanism, and places and rates that meet its rows at T; driven points have moved."""
    found = mechanism(build)
    q, v = found.start()
    q = closed(found, T, q)
    rows, g = found.f_a(T, q), found.g(T, q)
    return found, q, v - np.linalg.lstsq(rows, rows @ v - g, rcond=None)[0] if len(rows) else v


@pytest.mark.slow
@few
@given(MACHINES)
def test_accelerations_follow_from_the_energies(build: Build) -> None:
    """(2.60), (2.51)."""
    found, q, v = begun(build)
    assert lagrangian(found, T, q, v) < EXACT
    assert balance(found, T, q, v) < EXACT


@pytest.mark.slow
@few
@given(MACHINES)
def test_every_body_obeys_newton_and_euler(build: Build) -> None:
    """(2.23), (2.27) with forces written down once more, and reactions at the second point."""
    found, q, v = begun(build)
    a, forces = found.accelerations(T, q, v), found.reactions(T, q, v)
    for name, body in build.scene.bodies.items():
        xy, phi = found.where.columns[name]
        acting = list(_acting(build.scene, found, name, q, v, forces))
        total, size = np.sum(acting, axis=0), np.max(np.abs(acting))
        np.testing.assert_allclose(total[:2], body.mass * a[xy : xy + 2], rtol=0, atol=SAME * size)
        if phi is not None:
            np.testing.assert_allclose(total[2], body.moment * a[phi], rtol=0, atol=SAME * size)


def _acting(scene: Scene, m: Multibody, name: str, q: Array, v: Array, reactions):  # type: ignore[no-untyped-def]
    """fx, fy and the moment about the centre of all that acts on a body."""
    state = m.where.poses(q, v)[name]

    def wrench(at: Array, force: Array, moment: float = 0.0) -> list[float]:
        dx, dy = at[0] - state[0], at[1] - state[1]
        return [force[0], force[1], dx * force[1] - dy * force[0] + moment]

    yield [*(scene.bodies[name].mass * np.array(scene.gravity)), 0.0]
    for f in scene.forces.values():
        if isinstance(f, Spring | Damper):
            for here, there in ((f.a, f.b), (f.b, f.a)):
                if here.body == name:
                    at, to = _point(scene, m, here, q, v), _point(scene, m, there, q, v)
                    d, rate = to[:2] - at[:2], to[2:] - at[2:]
                    length = math.hypot(*d)
                    pull = (
                        f.stiffness * (length - f.rest_length)
                        if isinstance(f, Spring)
                        else f.damping * (d @ rate) / length
                    )
                    yield wrench(at[:2], pull * d / length)
        elif isinstance(f, Push) and f.at.body == name:
            yield wrench(_point(scene, m, f.at, q, v)[:2], _signal(f))
        elif isinstance(f, Torque) and f.body == name:
            yield [0.0, 0.0, _signal(f)[0]]
    for joint in scene.joints.values():
        force = np.array([reactions[f"{joint.name}.fx"], reactions[f"{joint.name}.fy"]])
        moment = reactions.get(f"{joint.name}.torque", 0.0)
        at = _point(scene, m, joint.b, q, v)[:2]  # the line of force of a slide passes there
        for end, sign in ((joint.a, -1.0), (joint.b, 1.0)):
            if end.body == name:
                yield wrench(at, sign * force, sign * moment)


def _signal(f: Push | Torque) -> Array:
    signal = f.signal
    wave = math.sin(signal.angular_frequency * T + signal.phase)
    return {"constant": 1.0, "ramp": T, "sine": wave}[signal.law] * np.array(signal.amplitude)


def _point(scene: Scene, m: Multibody, anchor: Anchor, q: Array, v: Array) -> Array:
    """x, y, vx, vy of a point of a body or of the ground."""
    if anchor.body == GROUND:
        point = scene.points[anchor.point]
        return np.array([*(np.array(point.at) + T * np.array(point.velocity)), *point.velocity])
    x, y, angle, vx, vy, omega = m.where.poses(q, v)[anchor.body]
    dx, dy = turned(scene.bodies[anchor.body].points[anchor.point], angle)
    return np.array([x + dx, y + dy, vx - omega * dy, vy + omega * dx])


@pytest.mark.slow
@few
@given(MACHINES, st.floats(-3.0, 3.0))
def test_a_turned_machine_moves_alike(build: Build, turn: float) -> None:
    found, q, v = begun(build)
    scene = turned_scene(build, turn)
    q_turned = _turned(found, q, turn) + turn * found.where.turning
    v_turned, a = _turned(found, v, turn), found.accelerations(T, q, v)
    again = Multibody(scene, (q_turned, v_turned)).accelerations(T, q_turned, v_turned)
    np.testing.assert_allclose(
        again, _turned(found, a, turn), rtol=0, atol=SAME * np.max(np.abs(a))
    )


def _turned(m: Multibody, v: Array, turn: float) -> Array:
    """Places, rates or accelerations of the bodies that were turned."""
    v = v.copy()
    for at in m.where.slots.values():
        xy = at.r
        x, y = v[xy : xy + 2].tolist()
        v[xy : xy + 2] = turned((x, y), turn)
    return v


@pytest.mark.slow
@few
@given(MACHINES, UNITS)
def test_units_do_not_matter(build: Build, units: Units) -> None:
    found, q, v = begun(build)
    scene = in_units(build, units)
    scale = np.where(found.where.turning, 1.0, units.length)
    q_scaled, v_scaled = q * scale, v * scale / units.time
    other = Multibody(scene, (q_scaled, v_scaled))
    a = found.accelerations(T, q, v)
    again = other.accelerations(T * units.time, q_scaled, v_scaled) * units.time**2 / scale
    np.testing.assert_allclose(again, a, rtol=0, atol=SAME * np.max(np.abs(a)))
    forces = other.reactions(T * units.time, q_scaled, v_scaled)
    size = max(map(abs, found.reactions(T, q, v).values()), default=0.0)
    for name, force in found.reactions(T, q, v).items():
        unit = units.force * (units.length if name.endswith("torque") else 1.0)
        assert abs(forces[name] / unit - force) <= SAME * size, name
