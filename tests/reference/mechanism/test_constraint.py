"""Each kind of constraint: rows and right sides from its places alone, and what λ means."""

from dataclasses import replace

import numpy as np
import pytest
from given import random_scenes

from textmech.cases.scene import GROUND, Anchor, Contact, GroundPoint, Joint, Scene, shape
from textmech.cases.scene.joint import FREEDOMS
from textmech.reference.formalisms.derivative import along
from textmech.reference.mechanism.constraints.constraint import Constraint, tracked
from textmech.reference.mechanism.constraints.contact import at_rest, normal, tangent
from textmech.reference.mechanism.constraints.joint_constraints import constraints
from textmech.reference.mechanism.kinematics.coordinates import Coordinates
from textmech.reference.mechanism.modes.mode import Multibody
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
            "bar": shape.bar(name="bar", mass=1.2, length=0.9, points={"P": (0.3, 0.2)}),
            "block": shape.block(
                name="block", mass=0.7, width=0.5, height=0.3, points={"Q": (-0.2, 0.4)}
            ),
            "dot": shape.particle(name="dot", mass=0.4),
        },
        joints={joint.name: joint},
        contacts={},
        forces={},
    )


def made(name: str) -> Scene:
    if name == "rolling":
        return random_scenes.rolling(np.random.default_rng(3))
    kind, ends = name.split(": ")
    a, b = ENDS[ends]
    return jointed(random_scenes.joint(np.random.default_rng(3), "j", kind, a, b))


def touching() -> Scene:
    """A rim, a point of a bar, a corner and a particle on the floor; nothing is joined."""
    scene = made("pin: bodies")
    disk = shape.disk(name="disk", mass=0.5, radius=0.2, points={"E": (0.05, 0.1)})
    ends = ("disk.center", "disk.E", "bar.P", "block.Q", "dot.center")
    contacts = {end: Contact(end, Anchor(*end.split(".")), 0.5, 0.4) for end in ends}
    return replace(scene, bodies={**scene.bodies, "disk": disk}, joints={}, contacts=contacts)


def held(name: str, q: Array) -> list[Constraint]:
    """All that a scene holds for good, and what its contacts and slides can hold."""
    scene = touching() if name == "touching" else made(name)
    where = Coordinates(scene)
    switching = [c for c in scene.contacts.values() if c.switches]
    slides = [j for j in scene.joints.values() if j.shifts]
    return [
        *constraints(scene, where, q.tolist()),
        *(row(contact, where) for contact in switching for row in (normal, tangent)),
        *(at_rest(slide, where) for slide in slides),
    ]


def states(scene: Scene, seed: int = 5) -> list[tuple[float, Array, Array]]:
    random = np.random.default_rng(seed)
    n = len(Coordinates(scene).names)
    return [
        (random.uniform(0, 3), random.uniform(-3, 3, n), random.uniform(-5, 5, n))
        for _ in range(10)
    ]


def excess(c: Constraint, t: Array, q: Array, v: Array) -> Array:
    """g − f_a q̇ᵃ, at complex times and places."""
    f_a, g, _ = c.alone.rows(t + 0j, q, v)
    return g - f_a @ v


def point(end: Anchor, where: Coordinates, t: float, q: Array) -> Array:
    return np.array(tracked(end, where).places(t, q.tolist()))


@pytest.mark.parametrize("name", [*KINDS, "rolling", "touching"])
def test_rows_and_right_sides_follow_from_the_places(name: str) -> None:
    """(2.15) f_a = ∂p/∂q, g = −∂p/∂t, γ = −ḟ_a q̇ + ġ of the places p: all by the complex step."""
    for t, q, v in states(touching() if name == "touching" else made(name)):
        for c in held(name, q):
            rows, g, gamma = c.alone.rows(t, q, v)

            def places(t: Array, q: Array, c: Constraint = c) -> Array:
                return np.array([x + 0j for x in c.places(complex(t), q.tolist())])

            still = np.zeros(len(q))
            slopes = [along(places, (t, q), (0.0, e)) for e in np.eye(len(q))]
            np.testing.assert_allclose(rows, np.transpose(slopes), atol=EXACT)
            np.testing.assert_allclose(g, -along(places, (t, q), (1.0, still)), atol=EXACT)
            moving = along(
                lambda t, q, c=c, v=v: excess(c, t, q, v),
                (t, q),
                (1.0, v),
            )
            np.testing.assert_allclose(gamma, moving, atol=10 * EXACT)  # ω² Δ is 25 × 10


@pytest.mark.parametrize("name", [*KINDS, "rolling", "touching"])
def test_what_is_held_has_a_residual_for_each_row(name: str) -> None:
    """(2.14) What sticks or rests somewhere has none, as its place is not known beforehand."""
    for t, q, _ in states(touching() if name == "touching" else made(name)):
        for c in held(name, q):
            assert c.size == len(c.names) == len(c.angular) == len(c.places(t, q.tolist()))
            assert len(c.f(t, q.tolist())) == (c.size if c.holonomic else 0)


def test_residuals_of_floor_and_rolling() -> None:
    """(2.18) y − R = 0 of a rim, y = 0 of a point; (2.17) x + R φ = C₁, which the start gives."""
    scene = touching()
    t, q, _ = states(scene)[0]
    heights = {c.part: c.f(t, q.tolist()) for c in held("touching", q) if c.holonomic}
    sin, cos = np.sin(q[10]), np.cos(q[10])
    assert heights["disk.center"] == [pytest.approx(q[9] - 0.2, abs=EXACT)]
    assert heights["disk.E"] == [pytest.approx(q[9] + 0.05 * sin + 0.1 * cos, abs=EXACT)]
    assert heights["dot.center"] == [q[7]]
    (_, q0, _), (t, q, _), *_ = states(made("rolling"))
    pin, floor, rolls = held("rolling", q0)
    assert (pin.part, floor.part, rolls.part) == ("j1", "touch", "touch")
    assert floor.f(t, q.tolist()) == [q[1] - 0.4]
    C1 = q0[0] + 0.4 * q0[2]
    assert rolls.f(t, q.tolist()) == [pytest.approx(q[0] + 0.4 * q[2] - C1, abs=EXACT)]
    assert not constraints(made("rolling"), Coordinates(made("rolling")))[-1].holonomic


@pytest.mark.parametrize("name", KINDS)
def test_what_a_joint_leaves_free_and_holds(name: str) -> None:
    """(2.14) r_B − r_A, of a slide its part across, of a rod l − |r_B − r_A|; φ_B − φ_A − angle."""
    scene = made(name)
    joint, where = scene.joints["j"], Coordinates(scene)
    for t, q, _ in states(scene):
        ends = (joint.a, joint.b)
        columns = [where.columns.get(end.body, (0, None))[1] for end in ends]
        phi_a, phi_b = (0.0 if column is None else q[column] for column in columns)
        x, y = np.subtract(*(point(end, where, t, q) for end in reversed(ends)))
        ux, uy = joint.along if joint.shifts else (1.0, 0.0)
        turn = phi_a + np.arctan2(uy, ux)
        expected = [y * np.cos(turn) - x * np.sin(turn)] if joint.shifts else [x, y]
        if joint.swings:
            expected = [1.3 - np.hypot(x, y)]
        if not joint.turns and "particle" not in name:
            expected.append(phi_b - phi_a - joint.angle)
        (c,) = constraints(scene, where)
        np.testing.assert_allclose(c.f(t, q.tolist()), expected, atol=EXACT)
        if joint.shifts:
            shift = x * np.cos(turn) + y * np.sin(turn)
            np.testing.assert_allclose(at_rest(joint, where).places(t, q.tolist()), shift)


@pytest.mark.parametrize("name", KINDS)
def test_the_reaction_is_the_force_of_the_first_part_on_the_second(name: str) -> None:
    """(2.23), (2.27) m r̈_c = m g + F and J ω̇ = d × F + M of the part that can tell."""
    scene = made(name)
    joint = scene.joints["j"]
    second = joint.b.body != GROUND
    end = joint.b if second else joint.a
    sign = 1.0 if second else -1.0  # on the first part it is the opposite
    for t, q, v in states(scene):
        mechanism = Multibody(scene, (q, v))
        a, force = mechanism.accelerations(t, q, v), mechanism.reactions(t, q, v)
        body = scene.bodies[end.body]
        xy, phi = mechanism.where.columns[body.name]
        F = sign * np.array([force["j.fx"], force["j.fy"]])
        weight = body.mass * np.array(scene.gravity)
        np.testing.assert_allclose(body.mass * a[xy : xy + 2], weight + F, atol=1e3 * EXACT)
        if phi is not None:
            # A slide that is open by Δ (these are any states) hands its force over at the second.
            at = point(joint.b if joint.shifts else end, mechanism.where, t, q)
            d = at - q[xy : xy + 2]
            moment = d[0] * F[1] - d[1] * F[0] + sign * force.get("j.torque", 0.0)
            np.testing.assert_allclose(body.moment * a[phi], moment, atol=1e3 * EXACT)


def test_rolling_reactions_hold_the_disk_up_and_turn_it() -> None:
    """(2.27) About the centre only the friction R λ_t turns a disk that nothing else touches."""
    scene = random_scenes.rolling(np.random.default_rng(3))
    scene = Scene(scene.gravity, {}, {"b0": scene.bodies["b0"]}, {}, scene.contacts, {})
    disk = scene.bodies["b0"]
    for t, q, v in states(scene):
        mechanism = Multibody(scene, (q, v))
        a, force = mechanism.accelerations(t, q, v), mechanism.reactions(t, q, v)
        assert force["touch.normal"] == pytest.approx(disk.mass * 9.0, rel=EXACT)
        np.testing.assert_allclose(disk.mass * a[0], disk.mass * 2.0 + force["touch.tangent"])
        turning = (disk.radius or 0.0) * force["touch.tangent"]
        np.testing.assert_allclose(disk.moment * a[2], turning)


def test_a_particle_takes_no_moment() -> None:
    for name in ("slide: to particle", "weld: from particle"):
        scene = made(name)
        t, q, v = states(scene)[0]
        assert Multibody(scene, (q, v)).reactions(t, q, v)["j.torque"] == 0.0


def test_an_angle_is_held_on_the_turn_at_which_it_starts() -> None:
    scene = made("weld: bodies")
    angle, where = scene.joints["j"].angle, Coordinates(scene)
    q = np.zeros(8)
    q[where.columns["block"][1] or 0] = angle + 4 * np.pi
    (weld,) = constraints(scene, where, q.tolist())
    assert weld.angular == (False, False, True)
    assert weld.f(0.0, q.tolist())[2] == pytest.approx(0.0, abs=EXACT)
