"""Each kind of constraint: rows and right sides from its residual f alone, and what λ means."""

import numpy as np
import pytest
import scenes

from textmech.cases.joint import FREEDOMS
from textmech.cases.scene import GROUND, Anchor, GroundPoint, Joint, Scene
from textmech.reference.formalisms.derivative import along
from textmech.reference.generated.constraint import Constraint, constraints
from textmech.reference.generated.coordinates import Coordinates
from textmech.reference.generated.mechanism import Mechanism
from textmech.reference.system import Array

ENDS = {
    "bodies": (Anchor("bar", "P"), Anchor("block", "Q")),
    "from ground": (Anchor(GROUND, "O"), Anchor("block", "Q")),
    "to ground": (Anchor("bar", "P"), Anchor(GROUND, "O")),
    "from driven": (Anchor(GROUND, "hook"), Anchor("block", "Q")),
    "to driven": (Anchor("bar", "P"), Anchor(GROUND, "hook")),
    "from particle": (Anchor("dot", "center"), Anchor("block", "Q")),
    "to particle": (Anchor("bar", "P"), Anchor("dot", "center")),
}
KINDS = [f"{kind}: {ends}" for kind in FREEDOMS for ends in ENDS]
EXACT = 1e-13  # a few roundings of terms of size 1 to 30


def jointed(joint: Joint) -> Scene:
    """Two bodies and a particle with one joint, and nothing that pulls but gravity."""
    return Scene(
        gravity=(1.0, -9.0),
        points={"O": GroundPoint((0.3, -0.1)), "hook": GroundPoint((0.2, 0.5), (0.8, -1.1))},
        bodies={
            "bar": scenes.shape.bar(name="bar", mass=1.2, length=0.9, points={"P": (0.3, 0.2)}),
            "block": scenes.shape.block(
                name="block", mass=0.7, width=0.5, height=0.3, points={"Q": (-0.2, 0.4)}
            ),
            "dot": scenes.shape.particle(name="dot", mass=0.4),
        },
        joints={joint.name: joint},
        contacts={},
        forces={},
    )


def made(name: str) -> Scene:
    if name == "rolling":
        return scenes.rolling(np.random.default_rng(3))
    kind, ends = name.split(": ")
    a, b = ENDS[ends]
    return jointed(scenes.joint(np.random.default_rng(3), "j", kind, a, b))


def states(scene: Scene, seed: int = 5) -> list[tuple[float, Array, Array]]:
    random = np.random.default_rng(seed)
    n = len(Coordinates(scene).names)
    return [
        (random.uniform(0, 3), random.uniform(-3, 3, n), random.uniform(-5, 5, n))
        for _ in range(10)
    ]


def filled(c: Constraint, t: complex, q: Array, v: Array) -> tuple[Array, Array, Array]:
    rows = np.zeros((c.size, len(q)), complex)
    g, gamma = np.zeros(c.size, complex), np.zeros(c.size, complex)
    c.fill(complex(t), q.tolist(), v.tolist(), rows, g, gamma, 0)
    return rows, g, gamma


@pytest.mark.parametrize("name", [*KINDS, "rolling"])
def test_rows_and_right_sides_follow_from_the_residual(name: str) -> None:
    """(2.15) f_a = ∂f/∂q, g = −∂f/∂t, γ = −ḟ_a q̇ + ġ: all by the complex step."""
    scene = made(name)
    for t, q, v in states(scene):
        for c in constraints(scene, Coordinates(scene), q.tolist()):
            rows, g, gamma = filled(c, t, q, v)

            def f(t: Array, q: Array, c: Constraint = c) -> Array:
                return np.array([x + 0j for x in c.f(complex(t), q.tolist())])

            still = np.zeros(len(q))
            slopes = [along(f, (t, q), (0.0, e)) for e in np.eye(len(q))]
            np.testing.assert_allclose(rows.real, np.transpose(slopes), atol=EXACT)
            np.testing.assert_allclose(g.real, -along(f, (t, q), (1.0, still)), atol=EXACT)
            moving = along(
                lambda t, q, c=c, v=v: filled(c, t, q, v)[1] - filled(c, t, q, v)[0] @ v,
                (t, q),
                (1.0, v),
            )
            np.testing.assert_allclose(gamma.real, moving, atol=10 * EXACT)  # ω² Δ is 25 × 10


@pytest.mark.parametrize("name", KINDS)
def test_the_reaction_is_the_force_of_the_first_part_on_the_second(name: str) -> None:
    """(2.23), (2.27) m r̈_c = m g + F and J ω̇ = d × F + M of the part that can tell."""
    scene = made(name)
    joint = scene.joints["j"]
    second = joint.b.body != GROUND
    end = joint.b if second else joint.a
    sign = 1.0 if second else -1.0  # on the first part it is the opposite
    for t, q, v in states(scene):
        mechanism = Mechanism(scene, (q, v))
        a, force = mechanism.accelerations(t, q, v), mechanism.reactions(t, q, v)
        body = scene.bodies[end.body]
        xy, phi = mechanism.where.columns[body.name]
        F = sign * np.array([force["j.fx"], force["j.fy"]])
        weight = body.mass * np.array(scene.gravity)
        np.testing.assert_allclose(body.mass * a[xy : xy + 2], weight + F, atol=1e3 * EXACT)
        if phi is not None:
            # A slide that is open by Δ (these are any states) hands its force over at the second.
            at = mechanism.where.point(joint.b if joint.shifts else end, t, q.tolist(), v.tolist())
            d = np.array(at.r) - q[xy : xy + 2]
            moment = d[0] * F[1] - d[1] * F[0] + sign * force.get("j.torque", 0.0)
            np.testing.assert_allclose(body.inertia * a[phi], moment, atol=1e3 * EXACT)


def test_rolling_reactions_hold_the_disk_up_and_turn_it() -> None:
    """(2.27) About the centre only the friction R λ_t turns a disk that nothing else touches."""
    scene = scenes.rolling(np.random.default_rng(3))
    scene = Scene(scene.gravity, {}, {"b0": scene.bodies["b0"]}, {}, scene.contacts, {})
    disk = scene.bodies["b0"]
    for t, q, v in states(scene):
        mechanism = Mechanism(scene, (q, v))
        a, force = mechanism.accelerations(t, q, v), mechanism.reactions(t, q, v)
        assert force["touch.normal"] == pytest.approx(disk.mass * 9.0, rel=EXACT)
        np.testing.assert_allclose(disk.mass * a[0], disk.mass * 2.0 + force["touch.tangent"])
        turning = (disk.radius or 0.0) * force["touch.tangent"]
        np.testing.assert_allclose((disk.inertia or 0.0) * a[2], turning)


def test_a_particle_takes_no_moment() -> None:
    for name in ("slide: to particle", "weld: from particle"):
        scene = made(name)
        t, q, v = states(scene)[0]
        assert Mechanism(scene, (q, v)).reactions(t, q, v)["j.torque"] == 0.0


def test_an_angle_is_held_on_the_turn_at_which_it_starts() -> None:
    scene = made("weld: bodies")
    angle, where = scene.joints["j"].angle, Coordinates(scene)
    q = np.zeros(8)
    q[where.columns["block"][1] or 0] = angle + 4 * np.pi
    locked = constraints(scene, where, q.tolist())[-1]
    assert locked.f(0.0, q.tolist())[0] == pytest.approx(0.0, abs=EXACT)
