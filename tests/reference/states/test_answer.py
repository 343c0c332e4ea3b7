"""The reference of claims about states: derivations agree, and each planted mistake is seen."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.scenes.claims import CHAIN, claimed

from textmech.cases.case import Case, Placement
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Bounds, Drag, Scene, Signal
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array, Trajectory
from textmech.reference.laws import inertia, momentum, rotation
from textmech.reference.mechanism.forces import action
from textmech.reference.mechanism.kinematics.frame import Vec
from textmech.reference.solve import mechanism, solve
from textmech.reference.stated import Stated
from textmech.reference.states import spatial_chain as chain
from textmech.reference.states.answer import LAW as POINTS_LAW
from textmech.reference.states.answer import answered, generated_mode, misread, rows
from textmech.reference.states.derived import derived, efforts
from textmech.reference.states.spatial_chain import Moving, SpatialChain
from textmech.reference.system import Vector
from textmech.reference.systems.robots import arm
from textmech.reference.systems.states import (
    hung_shapes,
    moving_body,
    planar_bodies,
    sliding_points,
)
from textmech.reference.systems.states.stated import STATED

# The reference of claims about states: derivations agree, and each planted mistake is seen.

WRITTEN = [name for name, case in scenes.CLAIMS.items() if case.system is not None]
LAW = 1e-12  # of the largest: algebra alone


def few(name: str) -> Case:
    """A shipped claim with as many states as a mistake needs to be seen."""
    case = scenes.CLAIMS[name]
    assert case.states is not None
    return replace(case, states=replace(case.states, random=4), samples=4, duration=3.0)


def apart(case: Case) -> float:
    """How far the hand-written answer is from the scene's."""
    return next(c.difference for c in answered(case)[1] if c.name == "generated states")


@pytest.mark.slow
@pytest.mark.parametrize("name", scenes.CLAIMS)
def test_shipped_claims_hold(name: str) -> None:
    solution = scenes.solved(name)
    assert solution.holds
    assert {c.name for c in solution.checks} >= {f"error of {q}" for q in scenes.CLAIMS[name].allow}


MISTAKES: dict[str, tuple[str, Any, str, Callable[..., Any]]] = {
    "ω × (ω × x) is lost": (
        "moving_body", moving_body, "acceleration",
        lambda a, alpha, omega, x: a + np.cross(alpha, x),
    ),
    "ω̇ × x is turned round": (
        "moving_body", moving_body, "acceleration",
        lambda a, alpha, omega, x: rotation.acceleration(a, -alpha, omega, x),
    ),
    "ω the other way round": (
        "moving_body", moving_body, "angular_velocity",
        lambda E, E_dot: -rotation.angular_velocity(E, E_dot),
    ),
    "Steiner lost": ("moving_body", moving_body, "steiner", lambda J, m, a: J),
    "half of (2.53) lost": (
        "moving_body", moving_body, "of_general_point",
        lambda m, J, v, omega, x: momentum.of_general_point(m, J, v, omega, 0 * x),
    ),
    "(2.28) without m r̈_A × a": (
        "moving_body", moving_body, "moment_change", lambda M, m, a_A, a: M
    ),
    "gyroscopic moment lost": (
        "moving_body", moving_body, "spin_change", lambda J, omega, omega_dot: J @ omega_dot
    ),
    "a tensor turned back": (
        "hung_shapes", hung_shapes, "rotated", lambda J, E: inertia.rotated(J, E.T)
    ),
    "a disk's moments exchanged": (
        "hung_shapes", hung_shapes, "disk", lambda m, R: inertia.disk(m, R)[::-1, ::-1]
    ),
    "the bar about its end": (
        "hung_shapes", hung_shapes, "bar", lambda m, l: 4 * inertia.bar(m, l)
    ),
    "products without the minus": (
        "hung_shapes", hung_shapes, "steiner",
        lambda J, m, a: J + m * (a @ a * np.eye(3) + np.outer(a, a)),
    ),
    "König without spin": (
        "planar_bodies", planar_bodies, "of_center", lambda m, J, v, omega: m * v @ v / 2
    ),
    "D₀ without r × p": (
        "planar_bodies", planar_bodies, "angular_momentum",
        lambda m, J, r, v, omega: momentum.angular_momentum(m, J, 0 * r, v, omega),
    ),
    "arm without gyroscopic moments": (
        "robot_states", arm, "cross",
        lambda a, b: tuple(0.999 * x for x in np.cross(a, b).tolist()),
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_in_a_law_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    name, module, law, wrong = MISTAKES[mistake]
    case = few(name)
    assert apart(case) <= LAW
    monkeypatch.setattr(module, law, wrong)
    assert apart(case) > 1e-6


@pytest.mark.slow
@pytest.mark.mutant("{name}: mass of a body 5 % off in the scene alone")
@pytest.mark.parametrize("name", WRITTEN)
def test_a_scene_of_another_mass_is_seen(name: str) -> None:
    """5 % of the first body's, of which the hand-written system does not know."""
    case = few(name)
    first, *_ = case.scene.bodies.values()
    bodies = {**case.scene.bodies, first.name: replace(first, mass=1.05 * first.mass)}
    assert apart(replace(case, scene=replace(case.scene, bodies=bodies))) > 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("text", [CHAIN, "robot_states"])
def test_a_chain_is_the_mechanism_with_driven_joints(text: str, tmp_path: Path) -> None:
    """In maximal coordinates with multipliers (2.60), started by Newton's method, every freedom
    driven with its rate and acceleration: the torques and accelerations are those of the chain."""
    case = few(text) if text in scenes.CLAIMS else claimed(tmp_path, CHAIN)
    scene, chain = case.scene, generated_mode(case)
    for q, v, a in rows(case, chain):
        mode = driven(case, scene, chain, q, v, a).base
        at, moving = mode.start()
        poses, own = mode.poses(0.0, at, moving), chain.poses(0.0, q, v)
        for name in poses:
            one, other = np.array(poses[name], float), np.array(own[name], float)
            if one[3:7] @ other[3:7] < 0:
                one[3:7] *= -1.0
            assert one == pytest.approx(other, abs=1e-11)
        wanted = derived(chain, scene, {"box.ax", "hand.ax"}, q, v, a)
        exerted = mode.reactions(0.0, at, moving)
        for _, effort in efforts(scene):
            assert exerted[effort] == pytest.approx(wanted[effort], rel=1e-9, abs=1e-9), effort
        changes = mode.accelerations(0.0, at, moving)
        last = next(name for name in ("box", "hand") if name in poses)
        place = mode.where.slots[last].r_dot
        assert changes[place] == pytest.approx(wanted[f"{last}.ax"], rel=1e-9, abs=1e-9)


def driven(case: Case, scene: Scene, chain: Stated, q: Array, v: Array, a: Array) -> Any:
    """Its mechanism with each rate driven as A sin(t + φ): at t = 0 it is v and rises by a."""
    drives, initial = {}, {}
    for joint in scene.joints.values():
        given = {}
        for freedom in joint.freedoms:
            at = chain.coordinates.index(f"{joint.name}.{freedom.name}")
            rate = freedom.rate
            drives[f"{joint.name}.{rate}"] = Signal(
                "sine", (math.hypot(v[at], a[at]),), 1.0, math.atan2(v[at], a[at])
            )
            given[freedom.name] = q[at]
        initial[joint.name] = Placement(given)
    moved = replace(case, scene=replace(scene, drives=drives), initial=initial, states=None)
    return mechanism(moved)


class Heavier(SpatialChain):
    """Its kinetic energy is 5 % too large."""

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        return 1.05 * super().T(t, q, v)


@pytest.mark.slow
@pytest.mark.mutant("kinetic energy of a chain 5 % too large")
def test_energy_against_virtual_work(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    case = claimed(tmp_path, CHAIN)
    (check,) = [c for c in answered(case)[1] if "d'Alembert" in c.name]
    assert check.holds
    monkeypatch.setattr("textmech.reference.states.answer.SpatialChain", Heavier)
    (check,) = [c for c in answered(case)[1] if "d'Alembert" in c.name]
    assert not check.holds


def refused(case: Case) -> list[tuple[str, str]]:
    with pytest.raises(CaseError) as caught:
        solve(case)
    return [(m.where, m.what) for m in caught.value.mistakes]


@pytest.mark.slow
def test_a_bound_beyond_what_is_known_is_refused() -> None:
    case = few("robot_states")
    ((where, what),) = refused(replace(case, allow={**case.allow, "q2.torque": 1e-14}))
    assert where == "allow.q2.torque"
    assert "asks more than can be certified" in what


@pytest.mark.slow
def test_what_is_the_same_in_every_state_is_no_claim() -> None:
    case = few("robot_states")
    ((where, what),) = refused(replace(case, allow={"base.alpha_x": 1e-10}))
    assert (where, what) == ("allow.base.alpha_x", "is the same in every state; leave it out")


def test_a_system_of_motions_answers_no_states_and_the_other_way() -> None:
    ((where, what),) = refused(replace(few("robot_states"), system="five_axis_robot"))
    assert where == "system"
    assert "answers for a motion; of states there are arm_states" in what
    ((where, what),) = refused(replace(scenes.SHIPPED["bar_pendulum"], system="arm_states"))
    assert where == "system"
    assert "answers for states" in what


def test_a_system_of_other_coordinates_is_refused() -> None:
    parameters = scenes.CLAIMS["hung_shapes"].parameters
    other = replace(few("robot_states"), system="hung_shapes", parameters=parameters)
    ((where, what),) = refused(other)
    assert where == "system"
    assert "has the coordinates rod_hinge.angle" in what


def test_every_system_of_states_has_a_claim() -> None:
    assert {scenes.CLAIMS[name].system for name in WRITTEN} == set(STATED)


# A chain that is put together wrongly is seen by what its joints hold, or read back.

CHECKS = ("joints hold (2.10), (2.15)", "coordinates read back")
AT, SHIFTED, TURNED = Moving.at, Moving.shifted, Moving.turned


def broken(case: Any) -> set[str]:
    """Which of the checks do not hold."""
    return {c.name for c in answered(case)[1] if c.name in CHECKS and not c.holds}


def without_spin(self: Moving, x: Any) -> Moving:
    """ω × R x is lost."""
    return replace(AT(self, x), r_dot=self.r_dot)


def backward(self: Moving, u: Any, s: Any, s_dot: Any) -> Moving:
    return SHIFTED(self, u, -s, -s_dot)


def along_ground(self: Moving, u: Any, s: Any, s_dot: Any) -> Moving:
    """Its rate is that of a line which stands still."""
    return replace(SHIFTED(self, u, s, s_dot), r_dot=self.r_dot + np.multiply.outer(u, s_dot))


def twice(self: Moving, u: Any, phi: Any, phi_dot: Any) -> Moving:
    return TURNED(self, u, 2 * phi, phi_dot)


def about_ground(self: Moving, u: Any, phi: Any, phi_dot: Any) -> Moving:
    """ω grows by φ̇ u of the ground's axes."""
    return replace(TURNED(self, u, phi, phi_dot), omega=self.omega + np.multiply.outer(u, phi_dot))


HELD_MISTAKES: dict[str, tuple[Any, str, Callable[..., Any]]] = {
    "ω × x lost": (Moving, "at", without_spin),
    "a slide the other way": (Moving, "shifted", backward),
    "a slide's line that does not turn": (Moving, "shifted", along_ground),
    "twice the angle": (Moving, "turned", twice),
    "an axis that does not turn": (Moving, "turned", about_ground),
    "turns in the other order": (chain, "_product", lambda a, b: PRODUCT(b, a)),
    "the second point forgotten": (
        SpatialChain, "_point",
        lambda self, anchor: POINT(self, anchor) * (0.0 if anchor.point == "in" else 1.0),
    ),
}  # fmt: skip
PRODUCT, POINT = chain._product, SpatialChain._point


@pytest.mark.parametrize("coordinate", ["q1.angle", "rail.s", "rail.a"])
def test_what_is_read_back_is_each_coordinate(coordinate: str, tmp_path: Path) -> None:
    """Of the drawn ones, which are 1 at most, one is told 1e-4 m or rad beside where it is."""
    case = claimed(tmp_path, CHAIN)
    assert case.states is not None
    found, drawn = answered(case)[0], case.states.drawn(case.scene)
    drawn[coordinate] = drawn[coordinate] + [1e-4, 0.0, 0.0]
    told = misread(case.scene, found, drawn)
    assert told == pytest.approx(1e-4, rel=1e-3)  # of places up to 1.0001


def test_a_sound_chain(tmp_path: Path) -> None:
    assert broken(claimed(tmp_path, CHAIN)) == set()


@pytest.mark.mutant("chain of bodies: {mistake}")
@pytest.mark.parametrize("mistake", HELD_MISTAKES)
def test_mistakes(mistake: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(*HELD_MISTAKES[mistake])
    assert broken(claimed(tmp_path, CHAIN)) != set()


# Friction at unrelated states: three writings of its laws, and mistakes planted in each.

CASE = scenes.CLAIMS["sliding_points"]


def writings_apart() -> float:
    """By hand against −∂D/∂ṙ, relative."""
    _, checks = answered(CASE)
    return max(check.difference for check in checks if check.name == "generated states")


@pytest.mark.slow
def test_by_hand_from_its_dissipation_and_as_observed() -> None:
    assert writings_apart() < POINTS_LAW
    found, _ = answered(CASE)
    bare = Trajectory(found.times, found.states, {})
    for name in CASE.allow:
        told = found.reactions[name]
        assert observe(CASE.scene, bare, name) == pytest.approx(told, abs=1e-12 * np.ptp(told))


@pytest.mark.slow
def test_friction_takes_energy_and_of_an_edge_not_only_against_the_velocity() -> None:
    """Dry, the ball's always has its size μ F_N; the sled's is between F₊ and that of a slip."""
    found, _ = answered(CASE)
    ball = found.states["ball"][:, 3:5]
    pad = np.column_stack([found.reactions[f"pad.{field}"] for field in ("fx", "fy")])
    assert np.hypot(*pad.T) == pytest.approx(2.1, rel=1e-14)
    assert np.sum(pad * ball, axis=1) == pytest.approx(-2.1 * np.hypot(*ball.T), rel=1e-14)
    sizes = np.unique(np.round(found.reactions["scales.force"], 12))
    assert sizes == pytest.approx([np.hypot(1.5, 9.0), np.hypot(4.0, 9.0)])


def unturned(ways: Any) -> Any:
    """An edge along the axes of the ground, wherever its body is turned to."""

    def planted(self: Any, k: Any) -> Any:
        along, r_dot = Vec(self.force.along), k.point(self.force.at).r_dot
        both = (along, Vec((-along[1], along[0])))
        return [(d, e, e @ r_dot) for d, e in zip(self.force.ways, both, strict=True)]

    return planted


def powered(*, edge: bool) -> Any:
    """A power that is 1 % off, of edges or of points: these go all ways alike, and say 1."""

    def change(law: Any) -> Any:
        def planted(self: Any, squared: Any, way: Any) -> Any:
            alpha = self.alpha * (1.01 if edge == (way != 1.0) else 1.0)
            return law(replace(self, alpha=alpha), squared, way)

        return planted

    return change


PLANTED: dict[str, tuple[Any, str, Any]] = {
    "an edge that does not turn": (action.Dragged, "_ways", unturned),
    "forward for backward": (
        action, "one_way", lambda law: lambda d, v: law(Bounds(d.backward, d.forward), v),
    ),
    "a power of an edge that is 1 % off": (action.Lost, "__call__", powered(edge=True)),
    "a power of a point that is 1 % off": (action.Lost, "__call__", powered(edge=False)),
    "dry friction that pushes": (
        sliding_points, "coulomb", lambda law: lambda mu, F, v: -law(mu, F, v),
    ),
    "a wrong bound": (
        sliding_points, "stiction", lambda law: lambda dry, v, F: law(dry, -v, F),
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("sliding points: {planted}")
@pytest.mark.parametrize("planted", PLANTED)
def test_a_planted_mistake_is_seen(planted: str, monkeypatch: pytest.MonkeyPatch) -> None:
    module, name, change = PLANTED[planted]
    monkeypatch.setattr(module, name, change(getattr(module, name)))
    with pytest.raises(AssertionError):
        assert writings_apart() < 1e-3


@pytest.mark.slow
@pytest.mark.mutant("sliding points: an observed edge 0.1 rad off")
def test_an_observed_edge_that_does_not_turn_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    found, _ = answered(CASE)
    turned = Trajectory(found.times, dict(found.states), {})
    turned.states["sled"][:, 2] += 0.1  # type: ignore[index]
    off = observe(CASE.scene, turned, "skate.fx") - found.reactions["skate.fx"]
    assert np.abs(off).max() > 0.1


def test_a_drag_without_an_edge_has_no_sides() -> None:
    runner = CASE.scene.forces["skate"]
    assert isinstance(runner, Drag)
    assert runner.ways == (Bounds(0.8, 1.9), Bounds(6.0, 6.0))
    assert runner.corner
    assert not CASE.scene.forces["air"].corner
    assert CASE.scene.forces["pad"].ends
