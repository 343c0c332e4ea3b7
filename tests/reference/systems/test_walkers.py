"""Walkers: equations, impacts by impulses, limit cycles and their multipliers, planted mistakes."""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from functools import cache, partial
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from given.laws.events import LOCATED, event_errors
from given.machines.examples import PARAMETERS, example
from given.machines.walkers import ENTRIES, SLOPE, UNEVEN, WALKER, Legs, begun, returned
from given.mutants import mutant
from scipy.optimize import root

from textmech.reference.formalisms import lagrange, newton_euler
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


def cycle(step: Callable[[Array], Array], guess: Array) -> Array:
    """The state near the guess that a step leads back to itself."""
    state: Array = root(lambda x: step(x) - x, guess, tol=1e-14).x
    assert step(state) == pytest.approx(state, abs=1e-13)
    return state


def gain(step: Callable[[Array], Array], state: Array) -> float:
    """The largest multiplier of a cycle, by differences: below 1 a disturbance dies away."""
    ways = 1e-5 * np.eye(len(state))
    slopes = [(step(state + way) - step(state - way)) / 2e-5 for way in ways]
    return float(np.abs(np.linalg.eigvals(np.array(slopes))).max())


def stepped(walker: CompassWalker, x: Array) -> Array:
    return returned(begun(walker, x), ENTRIES, until=1.6)[0]


@cache
def gait(m: float) -> Array:
    """On feet of m [kg], whose area goes with m: in the limit they are points."""
    walker = replace(SHIPPED, m=m, J_f=SHIPPED.J_f * (m / SHIPPED.m) ** 2)
    theta, rate = PUBLISHED
    return cycle(partial(stepped, walker), np.array([theta, rate, rate * math.cos(2 * theta)]))


@pytest.mark.slow
def test_the_shipped_walker_repeats_itself_and_is_stable() -> None:
    lean, state = SHIPPED.left0 - math.pi / 2, gait(SHIPPED.m)
    assert state == pytest.approx([lean, SHIPPED.w0, SHIPPED.u0], abs=1e-13)
    assert gain(partial(stepped, SHIPPED), state) < 1.0
    assert math.pi - SHIPPED.left0 == pytest.approx(SHIPPED.right0, abs=1e-15)


@pytest.mark.slow
def test_its_feet_without_mass_walk_as_published() -> None:
    """m/M → 0: an error of that order, and of its square when it is taken off."""
    places = [gait(m)[:2] for m in (0.1, 0.05, 0.025)]
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


def walker(x: Array, *, slope: float = SLOPE) -> SimplestWalker:
    """With l = g the time is that of the paper."""
    return SimplestWalker(G, slope, float(x[0]), float(x[1]))


def walked(x: Array) -> Array:
    return returned(walker(x), (0, 2))[0]


@cache
def found() -> Array:
    return cycle(walked, np.array([0.2, -0.2]))


@pytest.mark.slow
def test_limit_cycle_is_the_published_one():
    assert found() == pytest.approx(SIMPLEST_PUBLISHED, abs=1e-12)
    assert gain(walked, found()) < 1.0
    assert returned(walker(found()), (0, 2))[1] == pytest.approx(LASTS, abs=1e-3)


@pytest.mark.slow
@pytest.mark.mutant(
    "simplest walker: no slope",
    "simplest walker: a strike that keeps all speed",
    "simplest walker: a swinging leg that the hip does not pull",
)
@pytest.mark.parametrize("wrong", ["gravity", "impact", "swing"])
def test_a_mistake_is_seen_in_the_cycle(wrong: str, monkeypatch: pytest.MonkeyPatch):
    """Gravity straight down; a strike that keeps all; a swinging leg that the hip does not pull."""
    x = found()
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
    """Each strike keeps η; the rocking ends with a mode of its own."""
    wheel = example("rimless_wheel", w0=0.5)
    found = follow(wheel, np.linspace(0.0, 1.0, 11))
    assert found.phases[-1] == "rests 0"
    assert found.y[-1] == pytest.approx([0.0, 0.0], abs=1e-15)
    assert wheel.closed_events(1.0) is None
    assert wheel.closed_form(1.0) is None


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
