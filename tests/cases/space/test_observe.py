"""Derived quantities in space against finite sums of point masses, moved by this test."""

from dataclasses import replace

import numpy as np
import pytest
from given.spatial_motions import Array, T, rate, states, turn

from textmech.cases.scene import Anchor, Damper, GroundPoint, Scene, Signal, Spring
from textmech.cases.scene.body import Body
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.trajectory import Trajectory

G = np.array([0.3, -0.7, -9.0])
MASSES = np.array([0.4, 0.3, 0.6, 0.2, 0.5])
POINTS = np.random.default_rng(3).normal(size=(5, 3)) * 0.3
POINTS -= MASSES @ POINTS / MASSES.sum()
J: Array = sum(
    m * (x @ x * np.eye(3) - np.outer(x, x)) for m, x in zip(MASSES, POINTS, strict=True)
)
SIX = (J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2])
P, END = (0.1, 0.2, -0.3), (0.4, 0.0, 0.1)
CENTER = {"center": (0.0, 0.0, 0.0)}


def place(t: float) -> Array:
    return np.array([0.4 * t**2, 0.2 * np.sin(3 * t), 1.0 - 0.3 * t])


def attitude(t: float) -> Array:
    return turn((1, 2, 0), 0.7 + 1.3 * t) @ turn((0, 1, 3), 2.0 * np.sin(t)) @ turn((1, 0, 0), t)


def bob(t: float) -> Array:
    return np.array([1.0 + np.cos(t), 0.5 * t, 2.0 - t**2])


SCENE = Scene(
    frame=SPACE,
    gravity=(0.3, -0.7, -9.0),
    points={"O": GroundPoint((0.3, 0.1, 0.2), (0.5, -0.2, 0.1))},  # type: ignore[arg-type]
    bodies={
        "cloud": Body("cloud", "rigid", 2.0, SIX, {**CENTER, "P": P, "end": END}, frame=SPACE),
        "bob": Body("bob", "particle", 0.7, (), CENTER, frame=SPACE),
    },
    joints={
        "q": Joint(
            "q", "hinge", Anchor("bob", "center"), Anchor("cloud", "P"),
            (Freedom.turn((0.0, 0.0, 1.0), "angle"),), frame=SPACE,
        ),
    },
    contacts={"touch": spatial_contact("touch", Anchor("cloud", "center"), 0.5, rim=False)},
    forces={
        "coil": Spring("coil", Anchor("cloud", "end"), Anchor("ground", "O"), 40.0, 0.3),
        "oil": Damper("oil", Anchor("bob", "center"), Anchor("cloud", "P"), 3.0),
    },
    drives={"q.omega": Signal("constant", (1.0,))},
)  # fmt: skip
SCENE = replace(
    SCENE, bodies={**SCENE.bodies, "cloud": replace(SCENE.bodies["cloud"], radius=0.25)}
)
REACTIONS = {f"q.{f}": k * T for k, f in enumerate(("fx", "fy", "fz", "mx", "my", "mz", "torque"))}
BODIES = {"cloud": states(place, attitude), "bob": states(bob, lambda t: np.eye(3))}
MOTION = Trajectory(T, BODIES, REACTIONS)


def at(t: float, point: Array) -> Array:
    return place(t) + attitude(t) @ point


def masses() -> list[tuple[float, Array]]:
    """Each point mass with its place and velocity (N, 6)."""
    moved = [
        (m, np.array([[*at(t, x), *rate(lambda s, x=x: at(s, x), t)] for t in T]))
        for m, x in zip(MASSES, POINTS, strict=True)
    ]
    return [*moved, (0.7, np.array([[*bob(t), *rate(bob, t)] for t in T]))]


def same(name: str, expected: Array) -> None:
    np.testing.assert_allclose(observe(SCENE, MOTION, name), expected, rtol=1e-9, atol=1e-9)


def test_energy() -> None:
    kinetic = sum(m / 2 * np.sum(s[:, 3:] ** 2, axis=1) for m, s in masses())
    potential = sum(-m * s[:, :3] @ G for m, s in masses())
    potential = potential + 20.0 * (coil() - 0.3) ** 2
    same("energy.kinetic", kinetic)
    same("energy.potential", potential)
    same("energy.total", kinetic + potential)


def test_momentum() -> None:
    p: Array = sum(m * s[:, 3:] for m, s in masses())
    D: Array = sum(m * np.cross(s[:, :3], s[:, 3:]) for m, s in masses())
    for i, axis in enumerate("xyz"):
        same(f"momentum.{axis}", p[:, i])
        same(f"momentum.angular_{axis}", D[:, i])


@pytest.mark.parametrize(("name", "point"), [("P", P), ("end", END), ("center", (0, 0, 0))])
def test_points(name: str, point: tuple[float, float, float]) -> None:
    velocity = np.array([rate(lambda s: at(s, point), t) for t in T])
    for i, axis in enumerate("xyz"):
        same(f"cloud.{name}.{axis}", np.array([at(t, point)[i] for t in T]))
        same(f"cloud.{name}.v{axis}", velocity[:, i])
    same(f"cloud.{name}.speed", np.linalg.norm(velocity, axis=1))


def test_turning() -> None:
    """ω by the rates of two body axes along the third: no formula of a quaternion."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        turning = [rate(lambda s, j=j: attitude(s)[:, j], t) @ attitude(t)[:, k] for t in T]
        same(f"cloud.omega_{i + 1}", np.array(turning))
    assert observe(SCENE, MOTION, "cloud.attitude").shape == (len(T), 4)


def coil() -> Array:
    hook = np.array([0.3, 0.1, 0.2]) + np.array([0.5, -0.2, 0.1]) * T[:, None]
    return np.linalg.norm([at(t, END) for t in T] - hook, axis=1)


def test_lines() -> None:
    same("coil.length", coil())
    same("coil.force", 40.0 * (coil() - 0.3))
    same("oil.force", np.array([3.0 * rate(lambda s: length(s), t) for t in T]))


def length(t: float) -> float:
    return float(np.linalg.norm(at(t, P) - bob(t)))


def test_every_quantity_is_seen_or_refused() -> None:
    """Only reactions that the producer does not give are refused."""
    missing = []
    for name in table(SCENE):
        try:
            assert len(observe(SCENE, MOTION, name)) == len(T)
        except KeyError:
            missing.append(name)
    assert missing == ["touch.fx", "touch.fy", "touch.normal"]
    same("q.torque", 6 * T)
    same("q.force", np.sqrt(5) * T)
    same("q.moment", np.sqrt(9 + 16 + 25) * T)
    with pytest.raises(KeyError):
        observe(SCENE, MOTION, "cloud.angle")
