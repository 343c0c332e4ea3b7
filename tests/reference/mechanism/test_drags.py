"""What goes with a velocity: forces, laws, and what a power below 1 stops."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.multibody_laws import EXACT, balance, lagrangian
from given.laws.refused import refused
from given.scenes import slowed
from scipy.integrate import quad, solve_ivp

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.forces import drag
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.forces import action
from textmech.reference.mechanism.forces.action import actions
from textmech.reference.mechanism.forces.ingredients import Ingredients
from textmech.reference.mechanism.kinematics.frame import Vec
from textmech.reference.mechanism.modes import mechanism
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.mechanism.modes.stopping import Stopping
from textmech.reference.motion import event_location as crossing
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.start import rates as start_rates


def built() -> Multibody:
    return scenes.mechanism(scenes.parsed(slowed.SLOWED)).base


def violated(mode: Multibody) -> float:
    """(2.60) and (2.51) at the start, and on the way back from there."""
    q, v = mode.start()
    return max(law(mode, 0.0, q, way * v) for law in (lagrangian, balance) for way in (1.0, -1.0))


def test_laws_and_typed_forces() -> None:
    """Of the bob alone: drag 0.3 |v|^1.5 against v, and 2.1 N s/m × v to its right."""
    mode = built()
    assert violated(mode) < EXACT
    q, v = mode.start()
    speed = math.hypot(1.5, -0.4)
    size = 0.3 * speed**1.5 / speed
    expected = [-size * 1.5 + 2.1 * -0.4, size * 0.4 - 2.1 * 1.5 - 0.5 * 9.80665]
    assert mode.applied(0.0, q, v)[-2:] == pytest.approx(expected, rel=1e-14)


def opposite(loads: Any) -> Any:
    return lambda *given: [(part, -F, None if M is None else -M) for part, F, M in loads(*given)]


def straight(along: Any) -> Any:
    """A rail that does not turn."""

    def planted(self: Any, k: Any) -> Any:
        a, b, _, _ = along(self, k)
        u = Vec((1.0, 0.3))
        return a, b, u, u @ (b.r_dot - a.r_dot)

    return planted


PLANTED: dict[str, tuple[Any, str, Any]] = {
    "power law with the wrong sign": (action, "power_law", lambda law: lambda *n: -law(*n)),
    "drag with the wrong sign": (action.Dragged, "loads", opposite),
    "magnetic force of −e": (action.Deflected, "loads", opposite),
    "another power": (
        action, "power_law", lambda law: lambda d, alpha, v: law(d, alpha + 0.01, v),
    ),
    "a dissipation of another power": (
        action.Lost, "__call__", lambda law: lambda *given: law(*given) * 1.01,
    ),
}  # fmt: skip
SHARED: dict[str, tuple[Any, str, Any]] = {
    "the coefficient of the other way": (
        action, "one_way", lambda law: lambda d, speed: law(d, -speed),
    ),
    "a rail that does not turn": (action.Slowed, "_along", straight),
}  # fmt: skip


@pytest.mark.mutant("what goes with a velocity: {planted}")
@pytest.mark.parametrize("planted", PLANTED)
def test_a_planted_mistake_is_seen_by_the_laws(
    planted: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    module, name, change = PLANTED[planted]
    monkeypatch.setattr(module, name, change(getattr(module, name)))
    assert violated(built()) > 1e-4


@pytest.mark.slow
@pytest.mark.mutant("what goes with a velocity: {planted}")
@pytest.mark.parametrize("planted", SHARED)
def test_what_both_derivations_share_is_seen_by_quantities(
    planted: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The power that the cart and the rod lose in the rail is force × speed, as observed."""
    module, name, change = SHARED[planted]
    mode, case = built(), scenes.parsed(slowed.SLOWED)
    motion = solve(case).trajectory
    speed, force = (observe(case.scene, motion, f"oil.{field}")[0] for field in ("speed", "force"))
    q, v = mode.start()

    def lost() -> float:
        oil = actions([case.scene.forces["oil"]])
        return Ingredients(mode.where, oil).D(0.0, q, v) * 2.5

    assert lost() == pytest.approx(-force * speed, rel=1e-12)
    monkeypatch.setattr(module, name, change(getattr(module, name)))
    assert abs(lost() + force * speed) > 1e-2 * abs(force * speed)


TAIL = scenes.tail(1.2, 25)
MASS, OIL, SPEED = 1.3, 0.8, 3.0  # kg, N at 1 m/s, m/s


def oiled(law: str, more: str = "", tail: str = TAIL, **parameters: float) -> Case:
    """A point mass on a rail that viscous friction slows; more: other entries of the scene."""
    changes = f"scene: {{forces: {{oil: {{viscous: rail, {law}}}}}{more}}}\n{tail}"
    return scenes.scene("block_on_rail", changes, **parameters)


def slide(alpha: float, samples: int, turned: float = 0.0) -> Case:
    """A slide that oil stops."""
    along = f", joints: {{rail: {{along: [{math.cos(turned)!r}, {math.sin(turned)!r}]}}}}"
    law = f"coefficient: {OIL}, exponent: {alpha}"
    return oiled(law, along, scenes.tail(20, samples), m=MASS, speed=SPEED)


@pytest.mark.slow
@pytest.mark.parametrize(("alpha", "samples"), [(0.3, 41), (0.5, 126), (0.77, 81), (0.9, 101)])
def test_it_stops_where_it_must(alpha: float, samples: int) -> None:
    """(2.88) v^{1−α} = v₀^{1−α} − (1 − α) d t/m; x = v₀^{2−α} m/((2 − α) d) at rest."""
    case = slide(alpha, samples, 0.4)
    found = solve(case)
    assert [check for check in found.checks if not check.holds] == []
    left = SPEED ** (1 - alpha) - (1 - alpha) * OIL / MASS * case.times
    v = np.maximum(0.0, left) ** (1 / (1 - alpha))
    x = (SPEED ** (2 - alpha) - v ** (2 - alpha)) * MASS / ((2 - alpha) * OIL)
    states = found.trajectory.states["block"]
    np.testing.assert_allclose(np.hypot(states[:, 0], states[:, 1]), x, atol=3e-12)
    np.testing.assert_allclose(np.hypot(states[:, 3], states[:, 4]), v, atol=3e-12)


def test_its_time_is_known_as_far_as_it_says() -> None:
    """With α = 0.9 rounding of the speed is a second of the time: nobody knows it better."""
    case = slide(0.9, 41)
    system = scenes.mechanism(case)
    (stop,) = follow(system, case.times).changes
    known = SPEED**0.1 * MASS / (0.1 * OIL)
    assert 0.01 < abs(stop.time - known) < system.blurred


def holds(case: Case) -> bool:
    try:
        return solve(case).holds
    except CaseError:  # the motion cannot be followed
        return False


@pytest.mark.slow
@pytest.mark.mutant("a stop without slope: {name}")
@pytest.mark.parametrize("name", ["by its speed alone", "with the friction of rounding"])
def test_a_stop_that_rounding_decides_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if name == "by its speed alone":
        monkeypatch.setattr(Stopping, "slowing", lambda self, speed: speed)
    else:
        monkeypatch.setattr(Stopping, "idle", lambda self, state: ())
    # Rounding, another one on another processor, decides which of them.
    each = itertools.product((0.5, 0.9, 0.7, 0.3, 0.2), (51, 41, 101))
    assert not all(holds(slide(alpha, n)) for alpha, n in each)


def test_a_root_is_bracketed_by_what_was_asked_for() -> None:
    """An implicit step repeated differs by rounding: of both ends one answer each."""
    asked: list[float] = []

    def g(at: float) -> float:
        asked.append(at)
        return 1e-17 if asked.count(at) == 1 and at == 0.0 else -1e-17

    assert crossing._root(g, 0.0, 1.0) <= 1.0
    assert crossing._root(lambda at: -1.0, 0.25, 1.0) == 0.25


CARRIED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies:
    c0: {block: {mass: 1, width: 0.3, height: 0.2}}
    c1: {block: {mass: 1, width: 0.3, height: 0.2}}
  joints:
    r0: {slide: [ground.O, c0.center], along: [2, 1]}
    r1: {slide: [c0.center, c1.center], along: [-1, 2]}
  forces: {v0: {viscous: r0, coefficient: 3, exponent: ALPHA}}
initial: {r0: {shift: 0, speed: 0}, r1: {shift: 0.1, speed: 0.7}}
allow: {c1.y: 0.01}
"""


@pytest.mark.mutant("rounding of what another part does sets off a slide that nothing pushes")
@pytest.mark.parametrize("alpha", [0.1, 0.5])
def test_what_coasts_across_sets_nothing_off(alpha: float) -> None:
    """No force acts along the lower slide, which rests: 1e-31 N are left of what turns nothing."""
    text = CARRIED.replace("ALPHA", repr(alpha))
    motion = solve(scenes.parsed(text, tail=scenes.tail(0.2, 11)))
    assert motion.holds
    way = (0.1 + 0.7 * motion.trajectory.times) / math.sqrt(5)
    states = motion.trajectory.states
    assert states["c0"] == pytest.approx(0.0, abs=1e-15)
    np.testing.assert_allclose(states["c1"][:, :2], np.outer(way, [-1, 2]), atol=1e-14)


SKEW = """\
scene:
  points: {O: [0, 1.0], A: [0.7, 0.9]}
  bodies:
    c0: {block: {mass: 1.087, width: 0.3, height: 0.2}}
    c1: {block: {mass: 0.721, width: 0.3, height: 0.2}}
  joints:
    r0: {slide: [ground.O, c0.center], along: [-0.044, 0.761]}
    r1: {slide: [c0.center, c1.center], along: [-0.421, 0.586]}
  forces:
    v0: {viscous: r0, coefficient: 3.655, exponent: 0.1}
    s0: {spring: [ground.A, c0.center], stiffness: 22.352, rest_length: 0.236}
  drive: {r1.speed: {polynomial: {coefficients: [0.565, 0.9, -0.224]}}}
initial: {r0: {shift: -0.169, speed: 0}, r1: {shift: 0.143}}
allow: {v0.force: 1.0e-2}
"""


@pytest.mark.slow
@pytest.mark.mutant("rounding of a speed that is none has a viscous force by its root")
@pytest.mark.parametrize("slows", ["viscous: r0", "drag: c0.center"])
def test_what_starts_at_no_speed_has_no_viscous_force(
    monkeypatch: pytest.MonkeyPatch, slows: str
) -> None:
    """The slides are skew, and of the start's rates 1e-18 m/s are left: 0.05 N by |v|^0.1."""
    case = scenes.parsed(SKEW.replace("viscous: r0", slows), tail=scenes.tail(0.2, 11))
    motion = solve(case)
    assert motion.holds
    assert observe(case.scene, motion.trajectory, "v0.force")[0] == 0.0
    assert abs(observe(case.scene, motion.trajectory, "v0.force")[1]) > 1.0
    monkeypatch.setattr(drag, "ROUNDING", 0.0)
    monkeypatch.setattr(start_rates, "ROUNDING", 0.0)
    rounded = solve(case).trajectory
    assert abs(observe(case.scene, rounded, "v0.force")[0]) > 1e-3


G = 9.80665


def dragged(alpha: float, d: float, tail: str, gravity: float = 0.0, **start: float) -> Case:
    air = f"{{drag: ball.center, coefficient: {d}, exponent: {alpha}}}"
    moves = "allow: {ball.x: null, ball.y: 1.0e-3}\n" if gravity else ""
    changes = f"scene: {{gravity: {gravity}, forces: {{air: {air}}}}}\n{moves}{tail}"
    return scenes.scene("free_particle", changes, m=0.3, **start)


@pytest.mark.slow
@pytest.mark.parametrize(("alpha", "vx", "vy"), [(0.3, 0.0, 0.0), (0.5, 0.0, 4.0), (0.9, 2.0, 4.0)])
def test_under_its_weight_it_never_stops(alpha: float, vx: float, vy: float) -> None:
    """Let go, thrown up so that it turns back at rest, or thrown: against scipy's integrator."""
    found = solve(dragged(alpha, 0.8, TAIL, G, y=3.0, vx=vx, vy=vy))
    assert found.holds

    def rates(t: float, y: np.ndarray) -> list[float]:
        speed = math.hypot(y[2], y[3])
        k = 0.8 / 0.3 * speed ** (alpha - 1) if speed else 0.0
        return [y[2], y[3], -k * y[2], -G - k * y[3]]

    known = solve_ivp(rates, (0, 1.2), [0, 3, vx, vy], method="DOP853", rtol=1e-12, atol=1e-13)
    ball = found.trajectory.states["ball"][-1]
    assert ball[[0, 1, 3, 4]] == pytest.approx(known.y[:, -1], abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("alpha", [0.3, 0.9])
def test_alone_it_stops_and_is_refused_from_there_on(alpha: float) -> None:
    """v^{1−α} = v₀^{1−α} − (1 − α) (d/m) t."""
    ends = 2.0 ** (1 - alpha) / ((1 - alpha) * 2.0 / 0.3)
    mistake = refused(dragged(alpha, 2.0, scenes.tail(1.5 * ends, 25), vx=2.0))
    assert mistake.where == "scene.forces.air"
    assert "stops ball.center" in mistake.what
    # it is told where a millionth of the speed is left
    left = 1e-6 ** (1 - alpha) * ends
    told = float(mistake.what.split("t = ")[1].split(" s")[0])
    assert ends - 1.01 * left - 1e-3 * ends <= told <= ends * 1.001
    assert solve(dragged(alpha, 2.0, scenes.tail(0.7 * ends, 25), vx=2.0)).holds


@pytest.mark.slow
@pytest.mark.mutant("a stop of drag by a power below 1 taken for a passing")
def test_a_stop_taken_for_a_passing_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mechanism, "OTHERS", 0.0)
    assert "stops ball.center" not in refused(dragged(0.3, 2.0, scenes.tail(0.4, 11), vx=2.0)).what


TOP = "events: {top: {block.vy: falls to zero}}\n"


@pytest.mark.slow
@pytest.mark.parametrize(("exponent", "named"), [(0.5, TOP), (0.7, "")])
def test_it_turns_back_where_it_should(exponent: float, named: str) -> None:
    """By separation of variables: dt = −dv/(g + d v^α/m), dy = v dt, and the sign turned below."""
    law, thrown = f"coefficient: 0.6, exponent: {exponent}", ", gravity: 9.80665"
    up, until = ", joints: {rail: {along: [0, 1]}}", scenes.tail(1.0, 26)
    solution = solve(oiled(law, thrown + up, named + until, m=0.5, speed=SPEED))
    assert solution.holds
    rises, _ = quad(lambda v: 1 / (G + 1.2 * v**exponent), 0, SPEED, epsabs=1e-13)
    height, _ = quad(lambda v: v / (G + 1.2 * v**exponent), 0, SPEED, epsabs=1e-13)
    motion = solution.trajectory
    if named:
        assert motion.switches == pytest.approx([rises], abs=1e-9)
    y, v = motion.states["block"][-1, [1, 4]]
    falls, _ = quad(lambda w: 1 / (G - 1.2 * w**exponent), 0, -v, epsabs=1e-13)
    down, _ = quad(lambda w: w / (G - 1.2 * w**exponent), 0, -v, epsabs=1e-13)
    assert rises + falls == pytest.approx(1.0, abs=1e-8)
    assert height - down == pytest.approx(y, abs=1e-8)
