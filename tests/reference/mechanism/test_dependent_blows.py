"""Blows on what more contacts bear than it needs: no order decides, and no rounding.

The second opinion knows no rank and no order: of each way in which contacts may take the blow one
linear programme has impulses and velocities for unknowns, and says how far any velocity may go.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from math import cos, pi, sin
from typing import Any

import numpy as np
import pytest
from given import scenes
from scipy.optimize import linprog

from textmech.reference.mechanism.modes import blow as blows
from textmech.reference.mechanism.modes import impact as impacts
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.mechanism.modes.blow import Condition, Meeting
from textmech.reference.mechanism.modes.element import State
from textmech.reference.mechanism.modes.impact import NoImpact, Several, impact
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array

R = 0.3  # of the disk between the walls
Walls = tuple[dict[str, tuple[float, float, float, float]], float, float]
"""The walls, where on the disk the ball strikes, and how fast the disk drifts upward."""


@dataclass(frozen=True)
class Blow:
    """What `impact` is asked."""

    M: Array
    joints: list[Condition]
    met: list[Meeting]
    v: Array
    columns: dict[str, tuple[int, int]]  # of each body: where its velocities begin and end

    def told(self, after: Array, *, mirrored: bool) -> Array:
        """The velocities of disk and ball, in this order; of a mirrored scene mirrored back."""
        signs = np.array([-1.0, 1.0, -1.0]) if mirrored else np.ones(3)
        return np.concatenate([signs * after[slice(*self.columns[name])] for name in ("d", "ball")])


def groove(random: np.random.Generator) -> Walls:
    """A disk between two walls, and a ball that strikes it from above."""
    a, b = random.uniform(0.3, 1.3, 2)
    left = (-R * sin(a), -R * cos(a), sin(a), cos(a))
    right = (R * sin(b), -R * cos(b), -sin(b), cos(b))
    return {"left": left, "right": right}, random.uniform(0.3, pi - 0.3), 0.0


def shaft(random: np.random.Generator) -> Walls:
    """A disk that slides up between two walls that face each other, and is struck from above."""
    walls = {"left": (-R, 0.0, 1.0, 0.0), "right": (R, 0.0, -1.0, 0.0)}
    return walls, pi / 2, float(random.choice([0.1, 0.2]))


Make = Callable[[np.random.Generator], Walls]


def blow(make: Make, seed: int, *, order: int = 0, mirrored: bool = False) -> Blow:
    """One of them, its contacts and bodies listed in that order, or seen in a mirror."""
    random = np.random.default_rng(seed)
    way, r = -1.0 if mirrored else 1.0, random.uniform(0.05, R)
    walls, at, drifts = make(random)
    mass, e = 10 ** random.uniform(-1, 1), float(random.choice([0.0, 0.5, 1.0]))
    planes = [
        f"{name}: {{at: [{way * x!r}, {y!r}], normal: [{way * nx!r}, {ny!r}]}}"
        for name, (x, y, nx, ny) in walls.items()
    ]
    pairs = {"l": "d, ground.left", "r": "d, ground.right", "hit": "ball, d"}
    rubs = [round(float(random.uniform(0.05, 1.2)), 3) for _ in pairs]
    contacts = [
        f"{name}: {{between: [{both}], friction: {mu}"
        f"{f', restitution: {e}' if name == 'hit' else ''}}}"
        for (name, both), mu in zip(pairs.items(), rubs, strict=True)
    ]
    disks = {"d": (1.0, R), "ball": (mass, r)}
    bodies = [f"{name}: {{disk: {{mass: {m!r}, radius: {b!r}}}}}" for name, (m, b) in disks.items()]
    x, y = (R + r) * cos(at), (R + r) * sin(at)
    down = at + pi + random.uniform(-1.0, 1.0)
    vx, vy, omega = cos(down), sin(down), float(random.uniform(-8.0, 8.0))
    if order % 2:
        bodies, contacts = bodies[::-1], contacts[::-1]
    ordered = contacts[order:] + contacts[:order]
    text = (
        f"scene:\n  planes: {{{', '.join(planes)}}}\n  bodies: {{{', '.join(bodies)}}}\n"
        f"  contacts: {{{', '.join(ordered)}}}\n"
        "initial: {d: {x: 0, y: 0, angle: 0}, ball: {x: 0, y: 9, angle: 0}}\n"
        "allow: {d.x: 1.0e-3}\n"
    )
    case = scenes.parsed(text)
    where = scenes.mechanism(case).base.where
    columns = {name: (xy, xy + 3) for name, (xy, _) in where.columns.items()}
    q, v = np.zeros((2, 6))
    q[slice(*columns["ball"])] = way * x, y, 0.0
    v[slice(*columns["ball"])] = way * vx, vy, way * omega
    v[columns["d"][0] + 1] = drifts
    built = PlanarMechanism(case.scene, (q, v), R).built
    i = [e.name for e in built.elements].index("hit")
    states: Any = tuple("open" if e.name == "hit" else "sticks" for e in built.elements)
    mode = built.name(states)
    _, met = landing._meetings(built, mode, i, 0.0, q, v, rests=False, size=0.0)
    return Blow(built.M, [], met, v, columns)


def velocities(blow: Blow, random: np.random.Generator) -> list[tuple[tuple[State, ...], Array]]:
    """Each way that keeps the laws without creating energy, with two velocities farthest apart."""
    found: list[tuple[tuple[State, ...], Array]] = []
    options: list[Sequence[State]] = [
        ("sticks", "slides +", "slides -", *(() if m.strikes else ("open",))) for m in blow.met
    ]
    toward = random.standard_normal(len(blow.v))
    for states in product(*options):
        for sense in (1.0, -1.0):
            after = _farthest(blow, states, sense * toward)
            if after is not None and blow.M @ after**2 <= (1 + 1e-8) * (blow.M @ blow.v**2):
                found.append((states, after))
    return found


def _farthest(blow: Blow, states: Sequence[State], toward: Array) -> Array | None:
    """Unknown are q̇⁺ (n,), and of each contact its normal and tangent impulse."""
    n, k = len(blow.v), len(blow.met)
    eq, right, low = [], [], []
    for i, mass in enumerate(blow.M):  # M (q̇⁺ − q̇⁻) = Λ f
        row = np.zeros(n + 2 * k)
        row[i] = mass
        row[n::2] = [-m.normal.f[i] for m in blow.met]
        row[n + 1 :: 2] = [-m.tangent.f[i] for m in blow.met]
        eq.append(row)
        right.append(mass * blow.v[i])
    for j, (m, state) in enumerate(zip(blow.met, states, strict=True)):
        normal, tangent, N, T = (np.zeros(n + 2 * k) for _ in range(4))
        normal[:n], tangent[:n], N[n + 2 * j], T[n + 2 * j + 1] = m.normal.f, m.tangent.f, 1.0, 1.0
        mu = m.element.kinetic
        if state == "open":
            eq += [N, T]
            right += [0.0, 0.0]
            low.append(normal)
            continue
        eq.append(normal)
        right.append(m.after)
        low.append(N)
        if state == "sticks":
            eq.append(tangent)
            right.append(0.0)
            low += [mu * N - T, mu * N + T]
        else:
            sense = 1.0 if state == "slides +" else -1.0
            eq.append(T + sense * mu * N)
            right.append(0.0)
            low.append(sense * tangent)
    programme: Any = linprog
    out = programme(
        np.append(toward, np.zeros(2 * k)), A_eq=eq, b_eq=right, A_ub=-np.array(low),
        b_ub=np.zeros(len(low)), bounds=[(-1e3, 1e3)] * n + [(-1e6, 1e6)] * (2 * k),
    )  # fmt: skip
    return out.x[:n] if out.status == 0 else None


ROUNDED = 1e-12  # of speeds of 1 to 10: another order adds up in another order
SOLVED = 1e-7  # as a linear programme knows velocities: its bounds are kept to 1e-9, of impulses
DECIDED = [0, 1, 4, 7, 10, 11, 15, 27, 70]
REFUSED = [43, 60]  # where none is
OPEN = [28, 34]  # where the disk may as well roll out of the groove


def told(found: Blow) -> tuple[Any, dict[str, str]]:
    taken, states = impact(found.M, found.joints, found.met, found.v)
    return taken.v, {m.element.name: s for m, s in zip(found.met, states, strict=True)}


@pytest.mark.parametrize("seed", DECIDED[:4])
def test_no_order_in_the_file_decides(seed: int) -> None:
    """Nor does it matter from which side it is looked at."""
    first = blow(groove, seed)
    after, states = told(first)
    known = first.told(after, mirrored=False)
    for order in (1, 2):
        other = blow(groove, seed, order=order)
        again, others = told(other)
        np.testing.assert_allclose(other.told(again, mirrored=False), known, atol=ROUNDED)
        assert others == states
    mirror = blow(groove, seed, order=1, mirrored=True)
    np.testing.assert_allclose(mirror.told(told(mirror)[0], mirrored=True), known, atol=ROUNDED)


@pytest.mark.slow
@pytest.mark.parametrize("seed", DECIDED[:4])
def test_it_is_the_one_velocity_of_all_that_the_laws_allow(seed: int) -> None:
    found = blow(groove, seed)
    all_of_them = velocities(found, np.random.default_rng(seed))
    assert all_of_them
    for _, v in all_of_them:
        np.testing.assert_allclose(v, told(found)[0], atol=SOLVED)


@pytest.mark.parametrize("seed", REFUSED)
def test_no_velocity_is_taken_where_the_laws_allow_none(seed: int) -> None:
    """It would stay wedged, or create energy."""
    found = blow(groove, seed)
    assert velocities(found, np.random.default_rng(seed)) == []
    with pytest.raises(NoImpact, match="create energy"):
        told(found)


@pytest.mark.slow
@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("seed", OPEN)
def test_what_the_laws_leave_open_is_said(seed: int, order: int) -> None:
    """The disk stays between its walls, or rolls up one of them: the laws are kept by both."""
    found = blow(groove, seed, order=order)
    known = [v for _, v in velocities(found, np.random.default_rng(seed))]
    assert max(np.max(np.abs(v - known[0])) for v in known) > 1e-3
    with pytest.raises(Several, match=r"rigid bodies do not say what the blow does, .* as well as"):
        told(found)


@pytest.mark.slow
@pytest.mark.mutant("of several velocities after a blow the first is taken")
def test_one_of_several_taken_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is one of those that the laws allow, and another is as good."""
    monkeypatch.setattr(impacts, "SAME", 1e300)
    found = blow(groove, OPEN[0])
    known = [v for _, v in velocities(found, np.random.default_rng(OPEN[0]))]
    assert max(np.max(np.abs(v - told(found)[0])) for v in known) > 1e-3


@pytest.mark.slow
@pytest.mark.mutant("rows of a blow that depend on each other solved as if they did not")
def test_a_blow_on_dependent_rows_without_their_rank_is_seen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Two of three ways of the same blow are then far off, or none at all.

    In one groove or another: how much rounding makes of a row too many is chance.
    """
    sound = {seed: told(blow(groove, seed))[0] for seed in DECIDED}
    monkeypatch.setattr(blows, "rank", len)
    monkeypatch.setattr(blows, "NONE", 0.0)

    def same() -> None:
        for seed, known in sound.items():
            np.testing.assert_allclose(told(blow(groove, seed))[0], known, atol=ROUNDED)

    with pytest.raises((NoImpact, np.linalg.LinAlgError, AssertionError)):
        same()


@pytest.mark.slow
@pytest.mark.parametrize("order", [0, 1])
def test_two_walls_that_may_press_as_they_like_leave_a_slip_open(order: int) -> None:
    """Where each presses against the other, nobody knows how they rub."""
    found = blow(shaft, 1, order=order)
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
def test_a_disk_in_a_groove_throws_a_ball_back(order: list[int]) -> None:
    """It stays: v² = 2 · 0.5 m · g, v⁺ = e v, and the ball, which turns, sticks to it."""
    contacts = ", ".join(CONTACTS[i] for i in order)
    case = scenes.parsed(STRUCK.format(contacts=contacts), tail=scenes.tail(0.4, 5))
    mechanism = scenes.mechanism(case)
    (hit,) = follow(mechanism, case.times).changes
    v = np.sqrt(2 * 0.5 * 9.80665)
    # to stop the slip r ω = 0.4 m/s takes 0.4/3 N s, of a cone of μ (1 + e) v = 0.94 N s
    np.testing.assert_allclose(hit.after[6:9], 0.0, atol=ROUNDED)
    np.testing.assert_allclose(np.abs(hit.after[9:11]), [0.4 / 3, v / 2], atol=ROUNDED)
    assert {"l sticks", "r sticks", "hit open"} == set(hit.mode_after.split(";")[0].split(", "))
