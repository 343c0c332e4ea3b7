"""Blows on what more contacts bear than it needs: no order decides, and no rounding."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.blows import Blow, blow, corridor, groove, shaft, velocities

from textmech.reference.mechanism.modes import blow as blows
from textmech.reference.mechanism.modes import impact as impacts
from textmech.reference.mechanism.modes.blow import Condition
from textmech.reference.mechanism.modes.impact import NoImpact, Several, impact
from textmech.reference.motion.follow import follow

ROUNDED = 1e-12  # of speeds of 1 to 10: another order adds up in another order
SOLVED = 1e-7  # as a linear programme knows velocities: its bounds are kept to 1e-9, of impulses
DECIDED = {groove: [0, 1, 4, 7, 10, 11, 15, 27, 70], corridor: [0, 1]}
REFUSED = [43, 60]  # where none is
OPEN = [28, 33, 34]  # where the disk may as well roll out of the groove


def told(found: Blow) -> tuple[Any, dict[str, str]]:
    taken, states = impact(found.M, found.joints, found.met, found.v)
    return taken.v, {m.element.name: s for m, s in zip(found.met, states, strict=True)}


@pytest.mark.parametrize(
    ("make", "seed"),
    [
        *((groove, seed) for seed in DECIDED[groove]),
        *(pytest.param(corridor, seed, marks=pytest.mark.slow) for seed in DECIDED[corridor]),
    ],
)
def test_no_order_in_the_file_decides(tmp_path: Path, make: Any, seed: int) -> None:
    """Nor does it matter from which side it is looked at."""
    first = blow(tmp_path, make, seed)
    after, states = told(first)
    known = first.told(after, mirrored=False)
    for order in (1, 2):
        other = blow(tmp_path, make, seed, order=order)
        again, others = told(other)
        np.testing.assert_allclose(other.told(again, mirrored=False), known, atol=ROUNDED)
        assert others == states
    mirror = blow(tmp_path, make, seed, order=1, mirrored=True)
    np.testing.assert_allclose(mirror.told(told(mirror)[0], mirrored=True), known, atol=ROUNDED)


@pytest.mark.slow
@pytest.mark.parametrize("seed", DECIDED[groove])
def test_it_is_the_one_velocity_of_all_that_the_laws_allow(tmp_path: Path, seed: int) -> None:
    found = blow(tmp_path, groove, seed)
    all_of_them = velocities(found, np.random.default_rng(seed))
    assert all_of_them
    for _, v in all_of_them:
        np.testing.assert_allclose(v, told(found)[0], atol=SOLVED)


@pytest.mark.parametrize("seed", REFUSED)
def test_no_velocity_is_taken_where_the_laws_allow_none(tmp_path: Path, seed: int) -> None:
    """It would stay wedged, or create energy."""
    found = blow(tmp_path, groove, seed)
    assert velocities(found, np.random.default_rng(seed)) == []
    with pytest.raises(NoImpact, match="create energy"):
        told(found)


@pytest.mark.slow
@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("seed", OPEN)
def test_what_the_laws_leave_open_is_said(tmp_path: Path, seed: int, order: int) -> None:
    """The disk stays between its walls, or rolls up one of them: the laws are kept by both."""
    found = blow(tmp_path, groove, seed, order=order)
    known = [v for _, v in velocities(found, np.random.default_rng(seed))]
    assert max(np.max(np.abs(v - known[0])) for v in known) > 1e-3
    with pytest.raises(Several, match=r"rigid bodies do not say what the blow does, .* as well as"):
        told(found)


@pytest.mark.slow
@pytest.mark.mutant("of several velocities after a blow the first is taken")
def test_one_of_several_taken_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is one of those that the laws allow, and another is as good."""
    monkeypatch.setattr(impacts, "SAME", 1e300)
    found = blow(tmp_path, groove, OPEN[0])
    known = [v for _, v in velocities(found, np.random.default_rng(OPEN[0]))]
    assert max(np.max(np.abs(v - told(found)[0])) for v in known) > 1e-3


@pytest.mark.slow
@pytest.mark.mutant("rows of a blow that depend on each other solved as if they did not")
def test_a_blow_on_dependent_rows_without_their_rank_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two of three ways of the same blow are then far off, or none at all.

    In one groove or another: how much rounding makes of a row too many is chance.
    """
    sound = {seed: told(blow(tmp_path, groove, seed))[0] for seed in DECIDED[groove]}
    monkeypatch.setattr(blows, "rank", len)
    monkeypatch.setattr(blows, "NONE", 0.0)

    def same() -> None:
        for seed, known in sound.items():
            np.testing.assert_allclose(told(blow(tmp_path, groove, seed))[0], known, atol=ROUNDED)

    with pytest.raises((NoImpact, np.linalg.LinAlgError, AssertionError)):
        same()


@pytest.mark.slow
@pytest.mark.parametrize("order", [0, 1])
def test_two_walls_that_may_press_as_they_like_leave_a_slip_open(
    tmp_path: Path, order: int
) -> None:
    """Where each presses against the other, nobody knows how they rub."""
    found = blow(tmp_path, shaft, 1, order=order)
    downward = {"l": "slides +", "r": "slides -", "hit": "sticks"}
    states: Any = [downward[m.element.name] for m in found.met]
    way = blows.blow(found.M, [], found.met, found.v, states)
    assert way is not None
    assert way.loose
    with pytest.raises(Several):
        told(found)


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_joints_that_hold_again_what_others_hold_change_nothing(seed: int) -> None:
    """A loop of joints with rows to spare; unless they ask for other velocities."""
    random = np.random.default_rng(seed)
    M, f, v = random.uniform(0.1, 9.0, 6), random.standard_normal((3, 6)), random.standard_normal(6)
    repeated = random.standard_normal((2, 3)) @ f
    known, _ = impact(M, [Condition(row, 0.0) for row in f], [], v)
    both = [Condition(row, 0.0) for row in (*repeated, *f)]
    again, _ = impact(M, both, [], v)
    np.testing.assert_allclose(again.v, known.v, atol=ROUNDED)
    np.testing.assert_allclose(f @ again.v, 0.0, atol=ROUNDED)
    with pytest.raises(NoImpact):
        impact(M, [*both, Condition(f[0], 0.3)], [], v)


STRUCK = """\
scene:
  planes: {{left: {{at: [0, 0], normal: [0.6, 0.8]}}, right: {{at: [0, 0], normal: [-0.6, 0.8]}}}}
  bodies: {{d: {{disk: {{mass: 2.0, radius: 0.4}}}}, ball: {{disk: {{mass: 1.0, radius: 0.1}}}}}}
  contacts: {{{contacts}}}
initial: {{d: {{x: 0, y: 0.5, angle: 0}}, ball: {{x: 0, y: 1.5, angle: 0, omega: 4}}}}
allow: {{ball.y: 1.0e-3}}
"""
CONTACTS = [
    "l: {between: [d, ground.left], friction: 0.7}",
    "r: {between: [d, ground.right], friction: 0.7}",
    "hit: {between: [ball, d], friction: 0.2, restitution: 0.5}",
]


@pytest.mark.slow
@pytest.mark.parametrize("order", [[0, 1, 2], [1, 0, 2], [2, 1, 0]])
def test_a_disk_in_a_groove_throws_a_ball_back(tmp_path: Path, order: list[int]) -> None:
    """It stays: v² = 2 · 0.5 m · g, v⁺ = e v, and the ball, which turns, sticks to it."""
    contacts = ", ".join(CONTACTS[i] for i in order)
    case = scenes.typed(tmp_path, STRUCK.format(contacts=contacts), tail=scenes.tail(0.4, 5))
    mechanism = scenes.mechanism(case)
    (hit,) = follow(mechanism, case.times).changes
    v = np.sqrt(2 * 0.5 * 9.80665)
    # to stop the slip r ω = 0.4 m/s takes 0.4/3 N s, of a cone of μ (1 + e) v = 0.94 N s
    np.testing.assert_allclose(hit.after[6:9], 0.0, atol=ROUNDED)
    np.testing.assert_allclose(np.abs(hit.after[9:11]), [0.4 / 3, v / 2], atol=ROUNDED)
    assert {"l sticks", "r sticks", "hit open"} == set(hit.mode_after.split(";")[0].split(", "))
