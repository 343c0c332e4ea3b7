"""Derived quantities against formulas of this file's own: complex positions, finite differences."""

import pickle
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import simpson

from textmech.cases import scene as scenes
from textmech.cases.scene import (
    Anchor,
    Bounds,
    Contact,
    Damper,
    DryFriction,
    GroundPoint,
    Scene,
    Spring,
    planar_joint,
    shape,
)
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.trajectory import ANGLE, OMEGA, VX, Trajectory

Array = Any  # samples (N,), real or complex: x + i y
Motion = Callable[[Array], tuple[Array, Array]]  # centre and angle at time t

G = (1.5, -9.0)
BAR, WHEEL = (1.2, 1.2 * 0.8**2 / 12), (2.0, 2.0 * 0.25**2 / 2)  # m, J

SCENE = Scene(
    gravity=G,
    points={"O": GroundPoint((0.3, 0.1)), "hook": GroundPoint((1.0, 2.0), (0.5, -0.2))},
    bodies={
        "bar": shape.bar(name="bar", mass=1.2, length=0.8, points={"P": (0.1, 0.2)}),
        "wheel": shape.disk(name="wheel", mass=2.0, radius=0.25, points={}),
    },
    joints={
        "pin": planar_joint("pin", "pin", Anchor("ground", "O"), Anchor("bar", "P")),
        "rail": planar_joint(
            "rail",
            "slide",
            Anchor("bar", "P"),
            Anchor("wheel", "center"),
            (0.6, 0.8),
            dry_friction=DryFriction(Bounds(6.0, 6.0), Bounds(3.0, 3.0)),
        ),
    },
    contacts={"touch": Contact("touch", Anchor("wheel", "center"), 0.5, 0.5, ideal="rolling")},
    forces={
        "coil": Spring("coil", Anchor("bar", "end"), Anchor("ground", "hook"), 40.0, 0.3),
        "oil": Damper("oil", Anchor("wheel", "center"), Anchor("bar", "start"), 3.0),
    },
)


def bar(t: Array) -> tuple[Array, Array]:
    """Centre as a complex number x + i y, and angle."""
    return 0.4 * t**2 + 0.2j * np.sin(3 * t), 0.7 + 1.3 * t - 0.5 * t**2


def wheel(t: Array) -> tuple[Array, Array]:
    return 1.1 - 0.3 * t + 1j * (0.3 + 0.1 * t**2), -2.0 * t + 0.4 * t**3


def at(t: Array, motion: Motion, point: complex = 0j) -> Array:
    center, angle = motion(t)
    return center + point * np.exp(1j * angle)


def rate(f: Callable[[Array], Array], t: Array) -> Array:
    """A central difference of fourth order: off by 1e-11 at these rates."""
    h = 1e-3
    d = [f(t + k * h) for k in (-2, -1, 1, 2)]
    return (d[0] - 8 * d[1] + 8 * d[2] - d[3]) / (12 * h)


T = np.linspace(0.0, 1.0, 11)


def states(motion: Motion) -> Array:
    center, angle = motion(T)
    velocity = rate(lambda t: motion(t)[0], T)
    omega = rate(lambda t: motion(t)[1], T)
    columns = (center.real, center.imag, angle, velocity.real, velocity.imag, omega)
    return np.stack(columns, axis=1)


REACTIONS = {"pin.fx": 3.0 * T, "pin.fy": 4.0 * T, "touch.normal": 1.0 + T}
MOTION = Trajectory(T, {"bar": states(bar), "wheel": states(wheel)}, REACTIONS)


def seen(name: str) -> Array:
    return observe(SCENE, MOTION, name)


def same(name: str, expected: Array) -> None:
    np.testing.assert_allclose(seen(name), expected, rtol=1e-9, atol=1e-9)


def test_bodies() -> None:
    same("bar.x", bar(T)[0].real)
    same("bar.angle", bar(T)[1])
    same("wheel.omega", rate(lambda t: wheel(t)[1], T))
    same("wheel.speed", abs(rate(lambda t: wheel(t)[0], T)))


@pytest.mark.parametrize(("name", "point"), [("P", 0.1 + 0.2j), ("end", 0.4), ("start", -0.4)])
def test_points(name: str, point: complex) -> None:
    position = at(T, bar, point)
    velocity = rate(lambda t: at(t, bar, point), T)
    same(f"bar.{name}.x", position.real)
    same(f"bar.{name}.y", position.imag)
    same(f"bar.{name}.vx", velocity.real)
    same(f"bar.{name}.vy", velocity.imag)
    same(f"bar.{name}.speed", abs(velocity))


def test_joints() -> None:
    same("pin.gap", abs(at(T, bar, 0.1 + 0.2j) - (0.3 + 0.1j)))
    same("pin.force", 5.0 * T)
    along = (0.6 + 0.8j) * np.exp(1j * bar(T)[1])
    apart = wheel(T)[0] - at(T, bar, 0.1 + 0.2j)
    same("rail.gap", (apart * along.conj()).imag)  # the part across the line, with its sign
    same("rail.slip", rate(shifted, T))
    same("rail.shift", shifted(T))
    same("rail.speed", rate(shifted, T))
    same("pin.angle", bar(T)[1])
    same("pin.omega", rate(lambda t: bar(t)[1], T))


def shifted(t: Array) -> Array:
    """How far the wheel's centre is along the line that is fixed in the bar."""
    along = (0.6 + 0.8j) * np.exp(1j * bar(t)[1])
    return ((wheel(t)[0] - at(t, bar, 0.1 + 0.2j)) * along.conj()).real


def test_contact() -> None:
    velocity = rate(lambda t: wheel(t)[0], T)
    omega = rate(lambda t: wheel(t)[1], T)
    lowest = velocity + 1j * omega * (-0.25j)
    same("touch.slip", lowest.real)
    same("touch.gap", wheel(T)[0].imag - 0.25)
    same("touch.drift", np.array([rolled(t) for t in T]))
    same("touch.normal", 1.0 + T)


def test_contacts_of_points() -> None:
    """A bar's end and a particle touch with themselves: they have no rim and roll nothing off."""
    ball = states(wheel)
    ball[:, [ANGLE, OMEGA]] = 0.0
    motion = Trajectory(T, {**MOTION.states, "ball": ball}, {"tip.normal": T})
    scene = replace(
        SCENE,
        bodies={**SCENE.bodies, "ball": shape.particle(name="ball", mass=0.2)},
        contacts={
            "tip": Contact("tip", Anchor("bar", "end"), 0.5, 0.5),
            "hit": Contact("hit", Anchor("ball", "center"), 0.5, 0.5),
        },
    )
    for name, path in (("tip", at(T, bar, 0.4)), ("hit", wheel(T)[0])):
        seen = {field: observe(scene, motion, f"{name}.{field}") for field in ("gap", "drift")}
        np.testing.assert_allclose(seen["gap"], path.imag, rtol=1e-12)
        np.testing.assert_allclose(seen["drift"], path.real - path.real[0], atol=1e-12)
    slip = rate(lambda t: at(t, bar, 0.4).real, T)
    np.testing.assert_allclose(observe(scene, motion, "tip.slip"), slip, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(observe(scene, motion, "hit.slip"), ball[:, VX], rtol=1e-15)
    np.testing.assert_array_equal(observe(scene, motion, "tip.normal"), T)


def rolled(t: float) -> float:
    """How far the wheel has moved beyond what its turning accounts for: ∫ slip dt."""
    fine = np.linspace(0.0, t, 201)
    slip = rate(lambda s: wheel(s)[0].real, fine) + 0.25 * rate(lambda s: wheel(s)[1], fine)
    return float(simpson(slip, x=fine)) if t > 0 else 0.0


def coil(t: Array) -> Array:
    return abs(at(t, bar, 0.4) - (1 + 2j + (0.5 - 0.2j) * t))


def oil(t: Array) -> Array:
    return abs(at(t, bar, -0.4) - wheel(t)[0])


def test_lines() -> None:
    same("coil.length", coil(T))
    same("coil.force", 40.0 * (coil(T) - 0.3))
    same("oil.length", oil(T))
    same("oil.force", 3.0 * rate(oil, T))


def test_energy() -> None:
    """The energies of both bodies, and of the spring by its work from rest length to here."""
    potential, kinetic = 20.0 * (coil(T) - 0.3) ** 2, 0 * T
    for (m, J), motion in ((BAR, bar), (WHEEL, wheel)):
        center = motion(T)[0]
        potential = potential - m * (G[0] * center.real + G[1] * center.imag)
        kinetic = kinetic + m / 2 * abs(rate(lambda t, f=motion: f(t)[0], T)) ** 2
        kinetic = kinetic + J / 2 * rate(lambda t, f=motion: f(t)[1], T) ** 2
    same("energy.kinetic", kinetic)
    same("energy.potential", potential)
    same("energy.total", kinetic + potential)


def test_momentum() -> None:
    linear, angular = 0j * T, 0 * T
    for (m, J), motion in ((BAR, bar), (WHEEL, wheel)):
        velocity = rate(lambda t, f=motion: f(t)[0], T)
        linear = linear + m * velocity
        angular = angular + m * (motion(T)[0].conj() * velocity).imag
        angular = angular + J * rate(lambda t, f=motion: f(t)[1], T)
    same("momentum.x", linear.real)
    same("momentum.y", linear.imag)
    same("momentum.angular", angular)


def test_every_quantity_is_seen_or_refused() -> None:
    """Only reactions that the producer does not give are refused."""
    missing = []
    for name in table(SCENE):
        try:
            assert seen(name).shape == T.shape
        except KeyError:
            missing.append(name)
    fields = ("fx", "fy", "force", "torque", "friction")
    given = [f"{body}.{field}" for body in SCENE.bodies for field in ("ax", "ay", "alpha")]
    assert missing == [*given, *(f"rail.{field}" for field in fields), "touch.tangent"]
    with pytest.raises(KeyError):
        seen("bar.angel")


def own_tables() -> bool:
    """Whether two scenes that are asked in turn each tell their own quantities."""
    bar, wheel = (
        replace(SCENE, bodies={name: SCENE.bodies[name]}, joints={}, forces={}, contacts={})
        for name in ("bar", "wheel")
    )
    told = [
        {name for name in ("bar", "wheel") if f"{name}.angle" in table(scene)}
        for scene in (bar, wheel, bar, wheel)
    ]
    return told == [{"bar"}, {"wheel"}] * 2


def test_a_table_is_of_the_scene_that_is_asked() -> None:
    with pytest.raises(TypeError):  # nobody changes what others are given
        table(SCENE)["bar.angle"] = table(SCENE)["bar.x"]  # type: ignore[index]
    assert own_tables()
    assert not vars(pickle.loads(pickle.dumps(SCENE))).keys() - vars(replace(SCENE)).keys()


@pytest.mark.mutant("the quantities of the scene that was asked before")
def test_a_table_of_another_scene_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    shared = dict[str, object]()
    monkeypatch.setattr(scenes, "vars", lambda scene: shared, raising=False)
    assert not own_tables()
