"""Walkers: equations, impacts by impulses, limit cycles and their multipliers, planted mistakes."""

import math
from collections.abc import Sequence
from dataclasses import asdict, replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.events import LOCATED, event_errors
from given.examples import PARAMETERS, example
from given.mutants import mutant
from given.scenes import tail, typed
from given.walkers import ENTRIES, SLOPE, UNEVEN, WALKER, Legs, begun, returned
from scipy.integrate import solve_ivp

from textmech.reference.formalisms import energy, lagrange, newton_euler
from textmech.reference.motion.cycle import Cycle, NoCycle, cycle, derivative
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Guard, System
from textmech.reference.systems.walkers.compass_walker import CompassWalker, LightFeet
from textmech.reference.systems.walkers.rimless_wheel import RimlessWheel, SpokeSteps
from textmech.reference.systems.walkers.simplest_walker import SimplestWalker

# The compass walker: its equations, its impact by impulses, and its scene.


def states(count: int = 20) -> list[tuple[Array, Array]]:
    random = np.random.default_rng(1)
    q, v = random.uniform(-1.0, 1.0, (count, 3)), random.uniform(-3.0, 3.0, (count, 3))
    v[:, 0] = 0.0
    return list(zip(q, v, strict=True))


@pytest.mark.parametrize("walker", [WALKER, UNEVEN], ids=["bars", "uneven"])
@pytest.mark.parametrize("name", ["left stands", "right stands"])
def test_accelerations_and_reactions_by_every_formalism(name: str, walker: CompassWalker):
    mode = walker.modes[name]
    for q, v in states():
        a = mode.accelerations(0.0, q, v)
        derived, friction = lagrange.multipliers(mode, 0.0, q, v)
        written, foot = mode.reactions(0.0, q, v), f"{name.split()[0]}_foot"
        size, force = np.abs(a).max(), max(map(abs, written.values()))
        assert a == pytest.approx(derived, abs=1e-12 * size)
        assert friction[0] == pytest.approx(written[f"{foot}.tangent"], abs=1e-12 * force)
        found = newton_euler.balance(mode, 0.0, q, v, a)
        assert found.share() < 1e-12
        assert found.reactions == pytest.approx(written, abs=1e-12 * force)
        assert abs(energy.power_balance(mode, 0.0, q, v)) < 1e-10


def _wrong(lost: str) -> Any:
    """Accelerations with a term that is lost or turned round."""

    def accelerations(self: Any, t: float, q: Array, v: Array) -> Array:
        other = {"gravity": 0.0 * v, "coupling": v}[lost]
        p = self.walker if lost == "coupling" else replace(self.walker, gamma=-self.walker.gamma)
        stance: Any = type(WALKER.modes["left stands"])
        sound = stance(p, self.k)
        a = sound.accelerations(t, q, v)
        if lost == "coupling":  # without what the legs' rates do
            still = sound.accelerations(t, q, 0.0 * other)
            a = 0.5 * (a + still)
        return a

    return accelerations


@pytest.mark.mutant(
    "compass walker on a slope the other way", "half of what the compass walker's rates do left out"
)
@pytest.mark.parametrize("lost", ["gravity", "coupling"])
def test_a_lost_term_is_seen(lost: str):
    off: Any = mutant(WALKER.modes["left stands"], accelerations=_wrong(lost))
    q, v = states(1)[0]
    assert np.abs(off.accelerations(0, q, v) - lagrange.multipliers(off, 0, q, v)[0]).max() > 1e-3
    assert newton_euler.balance(off, 0.0, q, v, off.accelerations(0, q, v)).share() > 1e-4


def impulsive(walker: CompassWalker, k: int, q: Array, v: Array) -> Array:
    """q̇⁺ by (2.60) over the instant: free bodies, pinned at the hip and at the new foot.

    Nine rates, each leg's x, y and angle, and the hip's x, y; six rows; nothing of one walker's
    coordinates.
    """
    name = ("left", "right")[k]
    poses = walker.modes[f"{name} stands"].poses(0.0, q, v)
    before = np.array([*poses["left"][3:], *poses["right"][3:], *poses["hip"][3:5]])
    M = np.diag([*[walker.m, walker.m, walker.J] * 2, walker.M, walker.M])
    rows = []

    def moves(leg: str, r: float) -> Array:
        """How a point r up a leg from its centre moves, (2, 8)."""
        column = 0 if leg == "left" else 3
        angle = poses[leg][2]
        dx, dy = r * math.cos(angle), r * math.sin(angle)
        row = np.zeros((2, 8))
        row[0, column], row[1, column + 1] = 1.0, 1.0
        row[:, column + 2] = -dy, dx
        return row

    hip = np.zeros((2, 8))
    hip[0, 6] = hip[1, 7] = 1.0
    rows = [moves(leg, walker.c) - hip for leg in ("left", "right")]
    rows.append(moves(("left", "right")[1 - k], walker.c - walker.l))
    F = np.vstack(rows)
    by_mass = np.linalg.solve(M, F.T)
    after = before - by_mass @ np.linalg.solve(F @ by_mass, F @ before)
    return -after[[2, 5]]


@pytest.mark.parametrize("walker", [WALKER, UNEVEN], ids=["bars", "uneven"])
@pytest.mark.parametrize("k", [0, 1])
def test_impact_by_impulsive_multipliers(k: int, walker: CompassWalker):
    for s, s_dot, w_dot in ((0.2, 1.1, -0.3), (0.35, 0.7, 1.4)):
        q = np.array([0.7, s, -s] if k == 0 else [0.7, -s, s])
        v = np.array([0.0, s_dot, w_dot] if k == 0 else [0.0, w_dot, s_dot])
        mode, after, rates = walker.struck(k, q, v)
        assert rates[1:] == pytest.approx(impulsive(walker, k, q, v), rel=1e-12)
        assert mode == f"{('right', 'left')[k]} stands"
        for body, place in walker.modes[mode].poses(0.0, after, v).items():  # none jumps
            before = walker.modes[f"{('left', 'right')[k]} stands"].poses(0.0, q, v)[body]
            assert place[:3] == pytest.approx(before[:3], abs=1e-15)


@pytest.mark.mutant(
    "legs' inertia left out of the walker's impact",
    "legs' inertia counted twice in the walker's impact",
)
@pytest.mark.parametrize("inertia", [0.0, 2 * WALKER.J])
def test_another_impact_is_seen(inertia: float):
    """Legs whose inertia is lost, or counted twice."""
    wrong = Legs(**asdict(WALKER), center=WALKER.c, inertia=inertia)
    q, v = np.array([0.0, 0.2, -0.2]), np.array([0.0, 1.1, -0.3])
    assert np.abs(wrong.struck(0, q, v)[2][1:] - impulsive(WALKER, 0, q, v)).max() > 1e-2


SCENE = """\
scene:
  incline: 0.02
  points: {O: [0, 0]}
  bodies:
    left: {bar: {mass: 5, length: 1}}
    right: {bar: {mass: 5, length: 1}}
    hip: {particle: {mass: 10}}
  joints:
    foot: {pin: [ground.O, left.start]}
    left_hip: {pin: [left.end, hip.center]}
    right_hip: {pin: [right.end, hip.center]}
initial:
  left: {angle: A, omega: -0.8617}
  right: {angle: B, omega: -0.6753}
allow: {left.angle: 1.0e-3}
"""


def test_between_strikes_it_is_the_mechanism_of_its_scene(tmp_path: Path):
    """Two bars and a mass, pinned: in maximal coordinates, with multipliers."""
    text = SCENE.replace("A,", f"{WALKER.left0!r},").replace("B,", f"{WALKER.right0!r},")
    case = typed(tmp_path, text, tail=tail(0.85, 18))
    mechanism = scenes.mechanism(case)
    found, own = follow(mechanism, case.times), follow(WALKER, case.times)
    assert own.events == ()
    for t, y, mode, x in zip(case.times.tolist(), found.y, own.modes, own.y, strict=True):
        poses = WALKER.modes[mode].poses(t, *np.split(x, 2))
        q, v = mechanism.base.place(poses)
        assert np.split(y, 2)[0] == pytest.approx(q, abs=1e-11)
        assert np.split(y, 2)[1] == pytest.approx(v, abs=1e-11)


@pytest.mark.mutant("a foot that passes the other one behind it strikes")
def test_no_foot_strikes_behind_the_other():
    """However far forward the leg leans that stands: behind, the other is above the floor."""
    (guard,) = WALKER.guards("left stands")
    random = np.random.default_rng(2)
    for s in random.uniform(-1.0, 1.0, 100).tolist():
        w = random.uniform(s, 1.5)  # against the normal: its foot is behind
        assert guard.g(0.0, np.array([0.0, s, w]), np.zeros(3)) > 0.0
    with pytest.raises(ArithmeticError, match="leans forward where the other passes"):
        WALKER.struck(0, np.array([0.0, 0.05, 0.049]), np.zeros(3))


def test_what_cannot_walk_is_said():
    q = np.array([0.0, -0.2, 0.2])
    says = WALKER.possible("left stands", 0.0, q, np.array([0.0, 9.0, 0.0]))
    assert "would have to pull" in str(says)
    says = replace(WALKER, mu=0.1).possible("left stands", 0.0, q, np.array([0.0, 0.8, 0.6]))
    assert "to pivot it needs friction" in str(says)


# The simplest walker before its limit: its gait, and how it comes to the published one.

G = 9.80665
SHIPPED: LightFeet = example("light_feet")  # type: ignore[assignment]
# Garcia et al. 1998, on a slope of 0.009, with the time in √(l/g).
PUBLISHED = np.array([0.200310900544287, 0.199832473004977 * math.sqrt(G)])


@cache
def gait(m: float) -> Cycle:
    """On feet of m [kg], whose area goes with m: in the limit they are points."""
    walker = replace(SHIPPED, m=m, J_f=SHIPPED.J_f * (m / SHIPPED.m) ** 2)

    def step(x: Array) -> Array:
        return returned(begun(walker, x), ENTRIES, until=1.6)[0]

    theta, rate = PUBLISHED
    return cycle(step, np.array([theta, rate, rate * math.cos(2 * theta)]))


@pytest.mark.slow
def test_the_shipped_walker_repeats_itself_and_is_stable() -> None:
    found = gait(SHIPPED.m)
    lean = SHIPPED.left0 - math.pi / 2
    assert found.error < 1e-14
    assert found.stable
    assert found.state == pytest.approx([lean, SHIPPED.w0, SHIPPED.u0], abs=1e-13)
    assert math.pi - SHIPPED.left0 == pytest.approx(SHIPPED.right0, abs=1e-15)


@pytest.mark.slow
def test_its_feet_without_mass_walk_as_published() -> None:
    """m/M → 0: an error of that order, and of its square when it is taken off."""
    places = [gait(m).state[:2] for m in (0.1, 0.05, 0.025)]
    apart = [np.abs(place - PUBLISHED).max() for place in places]
    assert apart[0] / apart[1] == pytest.approx(2.0, rel=0.02)
    assert apart[1] / apart[2] == pytest.approx(2.0, rel=0.01)
    first = [2 * finer - coarser for coarser, finer in pairwise(places)]
    second = (4 * first[1] - first[0]) / 3
    assert second == pytest.approx(PUBLISHED, abs=1e-7)


@pytest.mark.mutant(
    "simplest walker: mass of a leg 1 % up", "simplest walker: a leg with the inertia of a bar"
)
@pytest.mark.parametrize("mistake", ["c", "J"])
def test_a_leg_whose_mass_is_elsewhere_is_seen(
    mistake: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """1 % of the leg up, or the inertia of a bar: the walker is no longer where it was."""
    wrong = {"c": lambda walker: 0.99 * walker.l, "J": CompassWalker.J.fget}[mistake]
    monkeypatch.setattr(LightFeet, mistake, property(wrong))
    lean = SHIPPED.left0 - math.pi / 2
    after, _ = returned(SHIPPED, ENTRIES, until=1.6)
    assert abs(after[0] - lean) > 1e-4


# The simplest walker: its limit cycle, found again by other means, and published numbers.

# Garcia, Chatterjee, Ruina and Coleman 1998, for a slope of 0.009 and legs of one unit: given to 13
# digits or so; the time in √(l/g).
SIMPLEST_PUBLISHED = (0.200310900544287, -0.199832473004977)
LASTS = 3.882


def walker(x: Array, *, slope: float = SLOPE, l: float = G) -> SimplestWalker:
    """With l = g the time is that of the paper."""
    return SimplestWalker(l, slope, float(x[0]), float(x[1]))


@cache
def found(slope: float = SLOPE) -> Cycle:
    return cycle(lambda x: returned(walker(x, slope=slope), (0, 2))[0], np.array([0.2, -0.2]))


@pytest.mark.slow
def test_limit_cycle_is_the_published_one():
    assert found().error < 1e-14
    assert found().state == pytest.approx(SIMPLEST_PUBLISHED, abs=1e-12)
    after, lasts = returned(walker(found().state), (0, 2))
    assert after == pytest.approx(found().state, abs=1e-14)
    assert lasts == pytest.approx(LASTS, abs=1e-3)


def slopes(t: float, y: Array) -> Array:
    """(θ, φ, θ̇, φ̇) and a 4 × 4 matrix of its variations, in units of √(l/g)."""
    theta, phi, theta_dot, _ = y[:4]
    sin, cos = math.sin(theta - SLOPE), math.cos(theta - SLOPE)
    pulled = theta_dot**2 - cos
    f = [y[2], y[3], sin, sin + pulled * math.sin(phi)]
    jacobian = np.zeros((4, 4))
    jacobian[0, 2] = jacobian[1, 3] = 1.0
    jacobian[2, 0] = cos
    jacobian[3] = [
        cos + sin * math.sin(phi),
        pulled * math.cos(phi),
        2 * theta_dot * math.sin(phi),
        0.0,
    ]
    return np.concatenate([f, (jacobian @ y[4:].reshape(4, 4)).ravel()])


@pytest.mark.slow
def test_multipliers_are_those_of_the_variational_equations():
    """Φ along the step, then what a later or earlier strike makes of it, then the impact."""
    theta, theta_dot = found().state
    start = [theta, 2 * theta, theta_dot, (1 - math.cos(2 * theta)) * theta_dot]
    # how the state after a strike follows from θ and θ̇
    enters = np.array(
        [
            [1.0, 0.0],
            [2.0, 0.0],
            [0.0, 1.0],
            [2 * math.sin(2 * theta) * theta_dot, 1 - math.cos(2 * theta)],
        ]
    )

    def strikes(t: float, y: Array) -> float:
        return float(y[1] - 2 * y[0]) if t > 2.0 else -1.0

    strikes.terminal = True  # type: ignore[attr-defined]
    y0 = np.concatenate([start, np.eye(4).ravel()])
    run: Any = solve_ivp(slopes, (0.0, 5.0), y0, "DOP853", events=strikes, rtol=1e-13, atol=1e-14)
    end, phi = run.y_events[0][0][:4], run.y_events[0][0][4:].reshape(4, 4)
    flow, normal = slopes(0.0, run.y_events[0][0])[:4], np.array([-2.0, 1.0, 0.0, 0.0])
    phi = phi - np.outer(flow, normal @ phi) / (normal @ flow)
    a, w = float(end[0]), float(end[2])
    leaves = np.array([[-1.0, 0, 0, 0], [-2 * math.sin(2 * a) * w, 0, math.cos(2 * a), 0]])
    values = np.linalg.eigvals(leaves @ phi @ enters)
    assert np.sort_complex(values) == pytest.approx(np.sort_complex(found().multipliers), abs=1e-10)


@pytest.mark.slow
@pytest.mark.mutant(
    "simplest walker: no slope",
    "simplest walker: a strike that keeps all speed",
    "simplest walker: a swinging leg that the hip does not pull",
)
@pytest.mark.parametrize("wrong", ["gravity", "impact", "swing"])
def test_a_mistake_is_seen_in_the_cycle(wrong: str, monkeypatch: pytest.MonkeyPatch):
    """Gravity straight down; a strike that keeps all; a swinging leg that the hip does not pull."""
    x = found().state
    if wrong == "gravity":
        off = walker(x, slope=0.0)
    elif wrong == "impact":
        off = walker(np.array([x[0], x[1] / math.cos(2 * x[0])]))
    else:
        off = walker(x)
        mode: Any = off.modes["lifts"]
        sound = type(mode).accelerations

        def pulled(self: Any, t: float, q: Array, v: Array) -> Array:
            return sound(self, t, q, v) - [0.0, v[0] ** 2 * math.sin(q[1])]

        monkeypatch.setattr(type(mode), "accelerations", pulled)
    with pytest.raises((AssertionError, IndexError)):
        assert returned(off, (0, 2))[0] == pytest.approx(x, abs=1e-4)


def test_a_map_without_a_fixed_point_is_said():
    with pytest.raises(NoCycle, match="no cycle near"):
        cycle(lambda x: np.array([math.cos(x[0]) + x[0] + 2.0]), np.array([0.3]))


def test_derivative_is_of_eighth_order():
    slope = derivative(lambda x: np.exp(x), np.array([1.0]), part=0.1)
    assert slope[0, 0] == pytest.approx(math.e, rel=1e-10)
    assert slope[0, 0] != pytest.approx(math.e, rel=1e-14)


# The rimless wheel: its impact, its limit cycle and the multiplier, how it rocks to rest.

WHEEL = PARAMETERS["rimless_wheel"]


def steps(**changed: float) -> SpokeSteps:
    p = {**WHEEL, **changed}
    return SpokeSteps(p["n"], p["l"], p["J"] / (p["m"] * p["l"] ** 2), p["gamma"])


def struck(wheel: System, until: float) -> list[float]:
    """φ̇ just after each strike, by the motion."""
    found = follow(wheel, np.linspace(0.0, until, 3))
    return [float(change.after[1]) for change in found.changes]


def test_impact_keeps_the_angular_momentum_about_the_new_tip():
    """m r × v + J ω before and after, r and v of the hub from the two tips in turn."""
    wheel: Any = example("rimless_wheel")
    change = follow(wheel, np.linspace(0.0, 0.3, 3)).changes[0]
    momenta = []
    for name, y in (("spoke 1", change.before), ("spoke 2", change.after)):
        x, y_c, _, vx, vy, omega = wheel.modes[name].poses(0.0, y[:1], y[1:])["wheel"]
        tip = 3 * WHEEL["l"] * math.sin(math.pi / 8)
        momenta.append(WHEEL["m"] * ((x - tip) * vy - y_c * vx) + WHEEL["J"] * omega)
    assert momenta[1] == pytest.approx(momenta[0], rel=1e-14)


@pytest.mark.parametrize("w0", [3.3, 2.2, 6.0])
def test_motion_comes_to_the_limit_cycle_with_its_multiplier(w0: float):
    """(ω⁺² − ω*²)/(ω² − ω*²) = η², by the followed motion; measured 2e-13."""
    after = np.array([w0, *struck(example("rimless_wheel", w0=w0), 1.6)])
    cycle = steps().limit_cycle()
    apart = after**2 - cycle**2
    assert len(after) > 4
    assert apart[1:] == pytest.approx(apart[:-1] * steps().kept ** 2, rel=1e-10)


@pytest.mark.slow
def test_too_slow_it_rocks_to_rest_on_two_spokes():
    """Each strike keeps η; the rocking lasts 0.6842 s and ends with a mode of its own."""
    wheel = example("rimless_wheel", w0=0.5)
    found = follow(wheel, np.linspace(0.0, 1.0, 11))
    assert found.phases[-1] == "rests 0"
    assert found.y[-1] == pytest.approx([0.0, 0.0], abs=1e-15)
    assert found.changes[-1].time == pytest.approx(_rocking(0.5), rel=1e-6)
    assert wheel.closed_events(1.0) is None
    assert wheel.closed_form(1.0) is None


def _rocking(omega: float) -> float:
    """How long [s] it rocks: back and forth on a spoke twice ∫ dθ/φ̇, η less each time."""
    one, total, forth = steps(), 0.0, True
    for _ in range(80):  # the last one lasts 1e-8 of the first
        total += 2 * _until_it_turns(omega, one, forth=forth)
        omega, forth = omega * one.kept, not forth
    return total


def _until_it_turns(omega: float, one: SpokeSteps, *, forth: bool) -> float:
    """∫ ds/√(ω² − 2 κ sin(δ − s/2) sin(s/2)) = ∫ dx 2 x/…, with s = end − x², to where it turns."""
    kappa = 2 * 9.80665 / WHEEL["l"] / (1 + one.rho)
    delta = one.between / 2 - (one.gamma if forth else -one.gamma)

    def left(s: Any) -> Any:
        return omega**2 - 2 * kappa * np.sin(delta - s / 2) * np.sin(s / 2)

    low, high = 0.0, delta
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if left(middle) > 0 else (low, middle)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x = math.sqrt(low) / 2 * (nodes + 1)
    # left(low − x²) without its cancellation near the end
    drop = 2 * kappa * np.sin(x**2 / 2) * np.sin(delta - low + x**2 / 2)
    return float(np.sum(weights * 2 * x / np.sqrt(drop)) * math.sqrt(low) / 2)


def _with_eta(wheel: RimlessWheel, eta: float) -> System:
    def guards(self: System, mode: str) -> Sequence[Guard]:
        def then(g: Guard) -> Any:
            def struck(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
                mode, q, _ = g.then(t, q, v)
                return mode, q, eta * v

            return struck

        return [replace(g, then=then(g)) for g in wheel.guards(mode)]

    return mutant(wheel, guards=guards)


@pytest.mark.mutant(
    "rimless wheel: cos α for cos 2α in its impact",
    "rimless wheel: J left out of its impact",
    "rimless wheel: an impact that loses nothing",
)
def test_another_impact_of_the_rimless_wheel_is_seen():
    """η with cos α in place of cos 2α, without J, or all of the speed kept."""
    wheel: Any = example("rimless_wheel")
    ml2 = WHEEL["m"] * WHEEL["l"] ** 2
    angle = math.pi / WHEEL["n"]
    wrong = [
        (WHEEL["J"] + ml2 * math.cos(angle)) / (WHEEL["J"] + ml2),
        math.cos(2 * angle),
        1.0,
    ]
    assert max(event_errors(wheel, wheel, 1.0)) <= LOCATED
    for eta in wrong:
        late = event_errors(wheel, _with_eta(wheel, eta), 0.6)
        assert max(late) > 1e-2


@pytest.mark.mutant("rimless wheel: another {name}")
@pytest.mark.parametrize("name", ["n", "l", "J", "gamma", "w0"])
def test_a_parameter_that_is_off_is_seen_in_the_strikes(name: str):
    changed = WHEEL[name] + 1 if name == "n" else 1.05 * WHEEL[name]
    wheel = example("rimless_wheel")
    assert max(event_errors(wheel, example("rimless_wheel", **{name: changed}), 0.5)) > 1e-4


def test_modes_that_cannot_be_are_said():
    def says(wheel: System, mode: str, phi: float, phi_dot: float) -> str:
        return str(wheel.possible(mode, 0.0, np.array([phi]), np.array([phi_dot])))

    wheel = example("rimless_wheel")
    assert says(wheel, "spoke 1", 0.3, 3.0) == "None"
    assert "would have to pull" in says(wheel, "spoke 1", 0.3, 9.0)
    assert "next tip is in the floor" in says(wheel, "spoke 1", 0.9, 1.0)
    assert "needs friction" in says(example("rimless_wheel", mu=0.1), "spoke 1", 0.0, 0.1)
