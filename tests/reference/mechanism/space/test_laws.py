"""The laws of every machine in space, on scenes nobody chose, and the mistakes that they see.

(2.23) and (2.27) take the reactions as the engine of a joint would: forces and moments at the
second point, in ground axes, on bodies that are cut free.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from functools import cache
from itertools import product
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from given.laws.cut_bodies import matrix
from given.laws.multibody_laws import balance, lagrangian
from given.machines.random_space import MAKES, machine
from given.machines.space_machine import Machine, T
from given.same_examples import examples
from hypothesis import given
from hypothesis import strategies as st

from textmech.cases.scene import GROUND, Anchor, Damper, Push, Spring, Torque
from textmech.cases.scene.quantity import table
from textmech.reference.formalisms import appell, chaplygin, lagrange, voronets
from textmech.reference.mechanism.constraints import constraint_terms as terms
from textmech.reference.mechanism.constraints.equation_table import Table
from textmech.reference.mechanism.forces import action
from textmech.reference.mechanism.kinematics import attitude, spatial_coordinates
from textmech.reference.mechanism.kinematics.frame import SPACE, Vec
from textmech.reference.mechanism.kinematics.kinematics import Row
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.system import Array
from textmech.reports.compare.trial.ladder import wanted_reactions

Law = Callable[[SpatialMultibody, float, Array, Array], float]
EXACT = 1e-12  # of the largest term: the laws are algebra, only rounding may differ
UP = np.array([0.0, 0.0, 1.0])


def multipliers(mode: SpatialMultibody, t: float, q: Array, v: Array) -> float:
    """(2.60) λ of the explicit solution against those of T, U, D, Q₄, f_a and g."""
    known, found = lagrange.multipliers(mode, t, q, v)[1], mode.solve(t, q, v)[1]
    return float(np.max(np.abs(found - known)) / np.max(np.abs(known))) if len(known) else 0.0


def without(form: ModuleType) -> Callable[[SpatialMultibody, float, Array, Array], float | None]:
    """Explicit accelerations against a formalism without multipliers; None: it does not apply."""

    def law(mode: SpatialMultibody, t: float, q: Array, v: Array) -> float | None:
        a, found = mode.accelerations(t, q, v), form.accelerations(mode, t, q, v)
        size = max(float(np.max(np.abs(a))), mode.terms(t, q, v)[0])
        return None if found is None else float(np.max(np.abs(found - a)) / size)

    return law


def bodies(mode: SpatialMultibody, t: float, q: Array, v: Array) -> float:
    """(2.23) m r̈_c = F and (2.33) J ω̇ + ω × (J ω) = M_c of every body that is cut free."""
    a, forces, worst = mode.accelerations(t, q, v), mode.reactions(t, q, v), 0.0
    poses = mode.poses(t, q, v)
    for name, body in mode.scene.bodies.items():
        at = mode.where.slots[name]
        acting = np.array(list(_acting(mode, name, t, poses, forces)))
        change = np.zeros(6)
        change[:3] = body.mass * a[at.r_dot : at.r_dot + 3]
        if at.omega is not None:
            omega, J = np.array(poses[name][10:]), body.tensor
            turning = J @ a[at.omega : at.omega + 3] + np.cross(omega, J @ omega)
            change[3:] = matrix(poses[name]) @ turning
        else:
            acting = acting[:, :3]  # a particle takes no moment
        left = acting.sum(axis=0) - change[: acting.shape[1]]
        worst = max(worst, float(np.max(np.abs(left)) / np.max(np.abs(acting))))
    return worst


def lowest_points(mode: SpatialMultibody, t: float, q: Array, v: Array) -> float:
    """(2.19) The rows of what rolls are the velocity of the body's point that touches the floor."""
    rows, g, _ = mode.rows(t, q, v)
    free = v + np.random.default_rng(5).normal(size=len(v))  # such as slip
    poses = mode.poses(t, q, free)
    worst, slips = 0.0, rows @ free - g
    for name, contact in mode.scene.contacts.items():
        mine = [owner == name for owner in mode.owners]
        pose, at = poses[contact.body], _touching(mode, name, poses)
        arm, omega = at - pose[:3], matrix(pose) @ pose[10:]
        slip = np.array(pose[7:10]) + np.cross(omega, arm)
        worst = max(worst, float(np.max(np.abs(slips[mine] - slip)) / np.max(np.abs(slip))))
    return worst


def lengths(mode: SpatialMultibody, t: float, q: Array, v: Array) -> float:
    """What a quaternion's length changes: neither places, rows, energies nor accelerations."""
    r, e = mode.where.attitudes.shape[0], mode.where.attitudes
    long, stretch = q.copy(), np.ones(len(q))
    stretch[e] = np.linspace(0.7, 1.9, r)[:, None]
    long *= stretch

    def all_of(q: Array, stretch: Any) -> Array:
        q_dot = mode.rates(t, q, v)
        places = [x for pose in mode.poses(t, q, v).values() for x in pose]
        numbers = [mode.T(t, q, q_dot), mode.U(t, q), *mode.f(t, q), *mode.accelerations(t, q, v)]
        return np.array([*places, *numbers, *mode.f_a(t, q).ravel(), *(q_dot / stretch)])

    one, other = all_of(q, 1.0), all_of(long, stretch)
    return float(np.max(np.abs(one - other)) / np.max(np.abs(one)))


LAWS: dict[str, Law] = {
    "lagrangian": lagrangian, "balance": balance, "multipliers": multipliers, "bodies": bodies,
    "lowest points": lowest_points, "lengths": lengths,
}  # fmt: skip
REDUCED = {form: without(form) for form in (voronets, appell, chaplygin)}


def _acting(
    mode: SpatialMultibody, name: str, t: float, poses: Any, reactions: dict[str, float]
) -> Iterator[Array]:
    """Force and moment about the centre (6,) of each that acts on a body, in ground axes."""
    scene, centre = mode.scene, np.array(poses[name][:3])

    def wrench(at: Array, force: Array, moment: Any = 0.0) -> Array:
        return np.concatenate([force, np.cross(at - centre, force) + moment])

    yield wrench(centre, scene.bodies[name].mass * np.array(scene.gravity))
    for force in scene.forces.values():
        yield from (wrench(*each) for each in _applied(mode, force, name, t, poses))

    def told(part: str, *fields: str) -> Array:
        return np.array([reactions.get(f"{part}.{field}", 0.0) for field in fields])

    for joint in scene.joints.values():
        at = _point(mode, joint.b, t, poses)[0]
        sign = (joint.b.body == name) - float(joint.a.body == name)
        if sign:
            force, moment = told(joint.name, "fx", "fy", "fz"), told(joint.name, "mx", "my", "mz")
            yield wrench(at, sign * force, sign * moment)
    for contact in scene.contacts.values():
        if contact.body == name:
            at = _touching(mode, contact.name, poses)
            yield wrench(at, told(contact.name, "fx", "fy", "normal"))
    for edge in scene.constraints.values():
        if edge.at.body == name:
            x, y, _ = matrix(poses[name]) @ edge.along
            left = np.array([-y, x, 0.0]) / np.hypot(x, y)
            side, up = told(edge.name, "force", "normal")
            yield wrench(_point(mode, edge.at, t, poses)[0], side * left + up * UP)


def _applied(mode: SpatialMultibody, f: Any, name: str, t: float, poses: Any) -> Iterator[Any]:
    """Where, which force, and which moment."""
    match f:
        case Spring() | Damper():
            for here, there in ((f.a, f.b), (f.b, f.a)):
                if here.body == name:
                    (at, v), (to, w) = (_point(mode, end, t, poses) for end in (here, there))
                    d = to - at
                    long = np.linalg.norm(d)
                    if isinstance(f, Spring):
                        size = f.stiffness * (long - f.rest_length)
                    else:
                        size = f.damping * (d @ (w - v)) / long
                    yield at, size * d / long
        case Push() if f.at.body == name:
            yield _point(mode, f.at, t, poses)[0], _signal(f, t)
        case Torque() if f.body == name:
            yield np.array(poses[name][:3]), np.zeros(3), _signal(f, t)
        case _:
            pass


def _signal(f: Push | Torque, t: float) -> Array:
    wave = np.sin(f.signal.angular_frequency * t + f.signal.phase)
    return {"constant": 1.0, "ramp": t, "sine": wave}[f.signal.law] * np.array(f.signal.amplitude)


def _point(mode: SpatialMultibody, anchor: Anchor, t: float, poses: Any) -> tuple[Array, Array]:
    """r and ṙ of a point of a body or of the ground."""
    if anchor.body == GROUND:
        point = mode.scene.points[anchor.point]
        return np.array(point.at) + t * np.array(point.velocity), np.array(point.velocity)
    pose = poses[anchor.body]
    R, x = matrix(pose), np.array(mode.scene.bodies[anchor.body].points[anchor.point])
    return np.array(pose[:3]) + R @ x, np.array(pose[7:10]) + R @ np.cross(pose[10:], x)


def _touching(mode: SpatialMultibody, contact: str, poses: Any) -> Array:
    """The lowest point of a rim or a sphere, the lower end of the steepest diameter."""
    body = mode.scene.bodies[mode.scene.contacts[contact].body]
    pose, radius = poses[body.name], body.radius or 0.0
    if body.axle is None:
        return np.array(pose[:3]) - radius * UP
    axle = matrix(pose) @ body.axle
    level = np.cross(UP, axle)
    steep = radius * np.cross(level, axle) / np.linalg.norm(level)
    ends = np.array(pose[:3]) + steep, np.array(pose[:3]) - steep
    return min(ends, key=lambda end: float(end[2]))


SEEDS = st.integers(0, 10_000)


@pytest.mark.slow
@pytest.mark.parametrize("kind", MAKES)
@examples(15)
@given(seed=SEEDS, driven=st.booleans())
def test_every_machine_obeys(kind: str, seed: int, *, driven: bool) -> None:
    """(2.60), (2.51), (2.23), (2.33), (2.19), and without multipliers (2.66), (2.80).

    The rates of a quaternion are bound, so that these two apply to all, and (2.67) to none.
    """
    made = machine(seed, kind, driven=driven)
    at = made.mode, T, made.q, made.v()
    assert {name: x for name, law in LAWS.items() if (x := law(*at)) >= EXACT} == {}
    voronets_off, appell_off = (REDUCED[form](*at) for form in (voronets, appell))
    assert voronets_off is not None
    assert appell_off is not None
    assert max(voronets_off, appell_off) < EXACT
    assert REDUCED[chaplygin](*at) is None


@pytest.mark.slow
def test_every_force_that_can_be_asked_for_is_told() -> None:
    """Also what drives a slide, a hinge and a named freedom."""
    for seed, kind in product(range(1, 40, 4), MAKES):
        made = machine(seed, kind, driven=True)
        scene, told = made.mode.scene, made.mode.reactions(T, made.q, made.v())
        assert {*wanted_reactions(scene, table(scene))} <= told.keys()


@pytest.mark.slow
def test_the_machines_have_everything() -> None:
    """Negative control of the generator: each kind of joint, body, row and law, and all close."""
    made = [machine(seed, kind, driven=bool(seed % 2)) for kind in MAKES for seed in range(20)]
    joints = Counter(joint.kind for m in made for joint in m.joints.values())
    shapes = Counter(body.shape for m in made for body in m.bodies.values())
    rows = Counter(
        type(term).__name__
        for m in made
        for part in m.mode.permanent
        for terms in part.rows
        for term in terms
    )
    laws = {(type(f).__name__, f.signal.law) for m in made for f in m.mode.scene.signals()}
    assert min(joints[kind] for kind in ("hinge", "ball", "universal", "freedoms", "slide")) > 3
    assert shapes.keys() == {"rigid", "bar", "particle", "disk", "sphere"}
    assert rows.keys() == {"Along", "Line", "Dot", "Lowest", "Turn", "Given", "Heading"}
    assert min(rows.values()) > 3
    assert len(laws) == 6
    assert max(np.max(np.abs(m.mode.f(T, m.q)), initial=0.0) for m in made) < 1e-14  # m


SEEN = 1e-3  # of the largest term: a mistake, and no rounding
Patch = Callable[[pytest.MonkeyPatch], None]


@cache
def drawn() -> list[tuple[Machine, Any]]:
    """Machines of each kind with their rates, some of them driven."""
    made = [machine(seed, kind, driven=seed % 2 == 1) for kind in MAKES for seed in range(4)]
    return [(each, each.v()) for each in made]


def worst(law: str) -> float:
    """The largest violation of a law by any of the machines, each made anew."""
    anew = {id(made): SpatialMultibody(made.mode.scene, made.mode.start()) for made, _ in drawn()}
    return max(LAWS[law](anew[id(made)], T, made.q, v) for made, v in drawn())


def in_ground_axes(patch: pytest.MonkeyPatch) -> None:
    """q̇ = ½ (0, ω) ∘ q: ω as if it stood in ground axes."""

    def turned(q: Any, omega: Any) -> Any:
        return attitude.rates(q, np.einsum("kji,kj->ki", attitude.matrices(q), omega))

    patch.setattr(spatial_coordinates, "rates", turned)


def transposed(patch: pytest.MonkeyPatch) -> None:
    """E for its inverse: from ground axes to those of the body."""
    rotation = type(SPACE).rotation

    def inverse(self: Any, maths: Any, e: Any) -> Any:
        w, x, y, z = e
        return rotation(self, maths, (w, -x, -y, -z))

    patch.setattr(type(SPACE), "rotation", inverse)


def without_gyroscopic(patch: pytest.MonkeyPatch) -> None:
    """Without −ω × J ω of (2.33)."""
    patch.setattr(action.Gyroscopic, "loads", lambda self, k: [])


def as_printed(patch: pytest.MonkeyPatch) -> None:
    """Erratum 1: in the second component of (2.33) the sign before J₁ⱼ ωⱼ ω₃."""
    right = action.Gyroscopic.loads

    def printed(self: Any, k: Any) -> Any:
        ((part, F, M),) = right(self, k)
        assert M is not None
        J, omega = k.scene.bodies[self.name].tensor.tolist(), part.omega
        wrong = 2.0 * ((Vec(J[0]) @ omega) * omega[2])
        return [(part, F, M + Vec((0.0, wrong, 0.0)))]

    patch.setattr(action.Gyroscopic, "loads", printed)


def long_energies(patch: pytest.MonkeyPatch) -> None:
    """ω of a quaternion that has not the length 1, as if it had."""

    def stretched(q: Any, q_dot: Any) -> Any:
        return attitude.spin(q, q_dot) * np.sum(q * q, axis=0)

    patch.setattr(spatial_coordinates, "spin", stretched)


def long_places(patch: pytest.MonkeyPatch) -> None:
    """E of such a quaternion, as if it had."""
    rotation = type(SPACE).rotation

    def stretched(self: Any, maths: Any, e: Any) -> Any:
        squared = e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]
        return tuple(column * squared for column in rotation(self, maths, e))

    patch.setattr(type(SPACE), "rotation", stretched)


def without_arm(patch: pytest.MonkeyPatch) -> None:
    """The moment of a force about the centre is lost."""
    patch.setattr(action, "pushed", lambda k, p, F: (p.part, F, None))


def changed(kind: Any, change: Callable[[Row], Row]) -> Patch:
    """Rows of a kind with a mistake."""
    sound = kind.row
    return lambda patch: patch.setattr(kind, "row", lambda *given: change(sound(*given)))


def without_moment(row: Row) -> Row:
    """The slip of the centre for that of the rim's point."""
    return Row([(part, F, None) for part, F, _ in row.loads], row.g, row.gamma)


def without_gamma(row: Row) -> Row:
    """What f_a v̇ is without its γ."""
    return Row(row.loads, row.g, 0.0)


def on_the_other(patch: pytest.MonkeyPatch) -> None:
    """Reactions as the second part exerts them."""
    told = Table.reactions
    patch.setattr(
        Table, "reactions", lambda self, *at: {name: -x for name, x in told(self, *at).items()}
    )


# The laws that see a mistake, and one that cannot, as it is of something else.
MISTAKES: dict[str, tuple[Patch, tuple[str, ...], str]] = {
    "spin in ground axes": (in_ground_axes, ("lagrangian",), "bodies"),
    "transposed attitude": (transposed, ("bodies", "lowest points"), "lengths"),
    "no gyroscopic moment": (without_gyroscopic, ("lagrangian", "bodies"), "lengths"),
    "(2.33) as printed": (as_printed, ("lagrangian", "bodies", "balance"), "lengths"),
    "energies of long quaternions": (long_energies, ("lengths",), "lagrangian"),
    "places of long quaternions": (long_places, ("lengths",), "lagrangian"),
    "a force without its arm": (without_arm, ("bodies",), "lengths"),
    "slip of the centre": (
        changed(terms.Lowest, without_moment), ("lowest points", "bodies"), "lengths",
    ),
    "reactions on the other": (on_the_other, ("bodies",), "multipliers"),
} | {
    f"no gamma of {kind.__name__}": (
        changed(kind, without_gamma), ("lagrangian", "multipliers"), "bodies",
    )
    for kind in (terms.Along, terms.Dot, terms.Line, terms.Lowest, terms.Given, terms.Heading)
}  # fmt: skip


@pytest.mark.slow
def test_the_laws_hold_where_nothing_is_planted() -> None:
    assert max(map(worst, LAWS)) < EXACT


@pytest.mark.slow
@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_planted_mistake_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    plant, laws, blind = MISTAKES[mistake]
    drawn()
    plant(monkeypatch)
    for law in laws:
        assert worst(law) > SEEN, law
    assert worst(blind) < EXACT


@pytest.mark.slow
@pytest.mark.mutant("sign of β in (2.65), in what rolls and in what has a blade")
@pytest.mark.parametrize("kind", MAKES)
def test_the_sign_of_beta_is_seen(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """(2.65): where rates cannot be integrated; elsewhere β is zero. Appell knows no β."""
    right = voronets.beta
    monkeypatch.setattr(voronets, "beta", lambda *at: -right(*at))
    mine = [(made, v) for made, v in drawn() if kind == made.kind]
    by = {form: [REDUCED[form](m.mode, T, m.q, v) or 0.0 for m, v in mine] for form in REDUCED}
    assert max(by[appell]) < EXACT
    if kind in ("rolling", "blade"):
        assert max(by[voronets]) > SEEN
    else:
        assert max(by[voronets]) < EXACT
