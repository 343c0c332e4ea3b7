"""Bodies cut free: what a force does about a centre, and the balance of bodies in space."""

from typing import Any

import numpy as np
import pytest
from given.laws import difference
from given.machines.formal import EXACT, FORMAL, drawn
from given.machines.turning_bodies import J
from given.mutants import mutant

from textmech.reference.formalisms import newton_euler
from textmech.reference.formalisms.wrench import wrench
from textmech.reference.laws.rotation import axes
from textmech.reference.system import Load, Mass, Mode

TURNED = (0.5, 0.5, 0.5, 0.5)  # x → y → z → x: body axis 1 is y of the ground, 2 is z, 3 is x


def test_wrench() -> None:
    """(2.26) M_c = x × F + M, x from the centre to the point."""
    np.testing.assert_array_equal(wrench((2.0, 3.0), (1.0, 1.0), (4.0, 5.0), 6.0), [4.0, 5.0, 3.0])
    np.testing.assert_array_equal(wrench((2.0, 3.0), (2.0, 3.0), (0.0, 0.0), -6.0), [0, 0, -6.0])


def test_wrench_in_space() -> None:
    """(2.26) the force in ground axes, M_c = (1, 0, 0) × (0, 4, 5) + (7, 8, 9) in body axes."""
    pose = (1.0, 2.0, 3.0, *TURNED, *[0.0] * 6)
    found = wrench((2.0, 2.0, 3.0), pose, (0.0, 4.0, 5.0), (7.0, 8.0, 9.0))
    np.testing.assert_allclose(found, [0.0, 4.0, 5.0, 3.0, 13.0, 7.0], atol=1e-14)


def balance(mode: Mode, name: str) -> float:
    """(2.23), (2.33) What stays unbalanced."""
    states = drawn(name)
    return max(newton_euler.balance(mode, *at, mode.accelerations(*at)).share() for at in states)


@pytest.mark.parametrize("name", FORMAL)
def test_bodies_are_balanced(name: str) -> None:
    assert balance(FORMAL[name], name) < EXACT


@pytest.mark.parametrize("name", FORMAL)
def test_accelerations_are_those_of_the_bodies(name: str) -> None:
    mode = FORMAL[name]
    for at in drawn(name):
        # Weakly driven, a wheel hardly speeds up: 1 m/s² or rad/s² is what that is small against.
        found = newton_euler.accelerations(mode, *at)[0]
        assert difference(mode.accelerations(*at), found, 1.0) < EXACT


@pytest.mark.parametrize("name", [name for name in FORMAL if name != "free body"])
def test_reactions_by_hand_are_those_of_the_bodies(name: str) -> None:
    mode = FORMAL[name]
    for at in drawn(name):
        written = mode.reactions(*at)
        found = newton_euler.balance(mode, *at, mode.accelerations(*at)).reactions
        if name == "upright wheel":  # its weight, and the couple J₁ θ̈ − J₃ φ̇ θ̇ about the heading
            (_, _, theta_dot, phi_dot), side = at[2], at[1][2]
            across = found["touch.fy"] * np.cos(side) - found["touch.fx"] * np.sin(side)
            couple = -(0.09 * phi_dot * theta_dot) - 0.4 * across
            written = {"touch.normal": 9.9, "upright.couple": couple}
        assert difference(list(written.values()), [found[key] for key in written]) < EXACT


def test_a_free_body_needs_no_cut() -> None:
    at = next(drawn("free body"))
    assert newton_euler.balance(FORMAL["free body"], *at, np.zeros(6)).reactions == {}


@pytest.mark.mutant("{name}: gyroscopic term left out")
@pytest.mark.parametrize("name", ["free body", "top"])
def test_a_lost_gyroscopic_term_is_seen(name: str) -> None:
    sound = FORMAL[name]

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        return sound.accelerations(t, q, np.concatenate([v[:-3], 0.0 * v[-3:]]))

    assert balance(mutant(sound, accelerations=accelerations), name) > 1e-3


@pytest.mark.mutant("{name}: products of inertia left out")
@pytest.mark.parametrize("name", ["free body", "top"])
def test_another_inertia_is_seen(name: str) -> None:
    body = next(iter(FORMAL[name].masses))
    transposed = mutant(FORMAL[name])
    object.__setattr__(transposed, "masses", {body: Mass(1.7, np.diag(np.diag(J)))})
    assert balance(transposed, name) > 1e-3


@pytest.mark.mutant("{name}: attitude transposed")
@pytest.mark.parametrize("name", ["free body", "top"])
def test_an_attitude_from_ground_to_body_axes_is_seen(name: str) -> None:
    """E transposed: the conjugate quaternion, with all else as it is."""
    sound = FORMAL[name]

    def poses(self: Mode, t: Any, q: Any, v: Any) -> Any:
        ((body, pose),) = sound.poses(t, q, v).items()
        return {body: (*pose[:4], *(-np.array(pose[4:7])), *pose[7:])}

    assert balance(mutant(sound, poses=poses), name) > 1e-3


@pytest.mark.mutant("top: ω in ground axes")
def test_a_spin_in_ground_axes_is_seen() -> None:
    sound = FORMAL["top"]

    def poses(self: Mode, t: Any, q: Any, v: Any) -> Any:
        pose = sound.poses(t, q, v)["top"]
        return {"top": (*pose[:10], *(np.array(pose[10:]) @ axes(q)))}

    assert balance(mutant(sound, poses=poses), "top") > 1e-3


@pytest.mark.mutant("free body: moment of a load in body axes")
def test_a_moment_in_body_axes_is_seen() -> None:
    """Loads stand in ground axes."""
    sound = FORMAL["free body"]

    def loads(self: Mode, t: float, q: Any, v: Any) -> list[Load]:
        (load,) = sound.loads(t, q, v)
        return [Load(load.body, load.at, load.force, (t, 2 * t, 3 * t))]

    assert balance(mutant(sound, loads=loads), "free body") > 1e-3


@pytest.mark.mutant("free body: ω̇ 1 % off")
def test_a_body_that_only_turns_is_balanced() -> None:
    """Nothing acts on it: what J ω̇ and ω × J ω leave is small against each of them."""
    sound = FORMAL["free body"]
    free = mutant(sound, loads=lambda self, t, q, v: [])
    t, q, v = next(drawn("free body"))
    a = sound.accelerations(0.0, q, v) * [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]
    assert newton_euler.balance(free, t, q, v, a).share() < EXACT
    assert newton_euler.balance(free, t, q, v, 0.99 * a).share() > 1e-3
