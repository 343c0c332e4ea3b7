"""Springs that only press or pull, ropes and stops: when they act, and what they catch."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused
from given.scenes import ropes

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.modes import mode_selection as choosing
from textmech.reference.mechanism.modes import unilateral
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.mechanism.modes.modes import Modes
from textmech.reference.mechanism.modes.unilateral import OneSided
from textmech.reference.motion.follow import Followed, follow
from textmech.reference.solve import solve
from textmech.reference.system import Array, Guard

G = 9.80665


def hopper(y: float, vy: float, side: str = "compression") -> Any:
    """A mass on an upright rail, over a leg of 800 N/m that is 0.5 m long."""
    leg = f"{{spring: [ground.O, block.center], stiffness: 800, rest_length: 0.5, only: {side}}}"
    up = f"joints: {{rail: {{along: [0, 1]}}}}, forces: {{leg: {leg}}}, gravity: {G}"
    case = scenes.scene("block_on_rail", f"scene: {{{up}}}", m=2, shift=y, speed=vy)
    return scenes.mechanism(case)


def named(followed: Followed) -> list[str | None]:
    return [change.name for change in followed.changes]


def stance(v: float) -> float:
    """How long [s] a mass that lands on its leg with v [m/s] stays there."""
    w = math.sqrt(800 / 2)
    return 2 * (math.pi - math.atan(v * w / G)) / w


@pytest.mark.slow
@pytest.mark.parametrize("drop", [0.02, 0.3])
def test_hopping_by_its_closed_form(drop: float) -> None:
    """(2.44) a fall, then ÿ = −ω² (y − y_∞) until λ = λ₀ again, and so on: nothing is lost."""
    fall = math.sqrt(2 * drop / G)
    v = G * fall
    down, up = fall, fall + stance(v)
    wanted, flight = [], 2 * fall
    while up < 1.0:
        wanted += [("leg tightens", down), ("leg slackens", up)]
        down, up = up + flight, up + flight + stance(v)
    wanted += [("leg tightens", down)] if down < 1.0 else []
    found = follow(hopper(0.5 + drop, 0.0), np.linspace(0.0, 1.0, 11))
    assert named(found) == [name for name, _ in wanted]
    times = [change.time for change in found.changes]
    assert times == pytest.approx([t for _, t in wanted], abs=1e-12)


STARTS: list[tuple[str, float, float, str]] = [
    ("compression", 0.6, 0.0, "leg slack"),
    ("compression", 0.4, 0.0, "leg acts"),
    ("compression", 0.5, -1.0, "leg acts"),  # at λ₀: by where it goes
    ("compression", 0.5, 1.0, "leg slack"),
    ("tension", 0.6, 0.0, "leg acts"),
    ("tension", 0.4, 0.0, "leg slack"),
    ("tension", 0.5, 1.0, "leg acts"),
    ("tension", 0.5, -1.0, "leg slack"),
]


@pytest.mark.parametrize(("side", "y", "vy", "mode"), STARTS)
def test_its_state_at_the_start(side: str, y: float, vy: float, mode: str) -> None:
    system = hopper(y, vy, side)
    assert system.start()[0] == mode
    q, v = system.start()[1:]
    acts = mode == "leg acts"
    pull = 800 / 2 * (y - 0.5) if acts else 0.0
    assert system.modes[mode].accelerations(0.0, q, v)[1] == pytest.approx(-G - pull, rel=1e-13)


def test_at_rest_on_its_rest_length_it_is_pressed_at_once() -> None:
    """Neither λ nor λ̇ tell; gravity does, in no time."""
    found = follow(hopper(0.5, 0.0), np.linspace(0.0, 0.1, 3))
    assert found.modes == ("leg acts",) * 3
    assert [change.time for change in found.changes] == [0.0]


def test_an_elastic_rope_catches() -> None:
    """Up from the floor to its end: free, then ÿ = −g − ω² (y − λ₀), and free again."""
    v = 3.0
    found = follow(hopper(0.1, v, "tension"), np.linspace(0.0, 0.4, 5))
    reached = (v - math.sqrt(v * v - 2 * G * 0.4)) / G
    speed, w = v - G * reached, 20.0
    held = 2 * math.atan(speed * w / G) / w  # a half turn less what gravity pulls before it
    assert named(found) == ["leg tightens", "leg slackens"]
    times = [change.time for change in found.changes]
    assert times == pytest.approx([reached, reached + held], abs=1e-12)


def test_what_happens_in_one_instant_is_told_in_the_scenes_order() -> None:
    """The one lets go where the other catches, a quarter of a period on: w = 20 rad/s."""
    spring = "stiffness: 800, rest_length: 1, only: compression"
    ends = {"left": "L", "right": "R"}
    forces = [f"{k}: {{spring: [ground.{end}, block.center], {spring}}}" for k, end in ends.items()]
    points = "points: {L: [-1, 0], R: [1, 0]}"
    changes = f"scene: {{{points}, forces: {{{', '.join(forces)}}}}}"
    case = scenes.scene("block_on_rail", changes, m=2, shift=-0.2)
    found = follow(scenes.mechanism(case), np.linspace(0.0, 0.15, 4))
    assert named(found) == ["left slackens", "right tightens"]
    assert [change.time for change in found.changes] == pytest.approx([math.pi / 40] * 2, abs=1e-12)


def test_impossible_states_are_said() -> None:
    system = hopper(0.45, 1.0)
    q, v = system.start()[1:]
    system.built.name(("slack",))
    assert system.possible("leg acts", 0.0, q, v) is None
    assert system.possible("leg slack", 0.0, q, v) == (
        "leg is slack on the wrong side of its rest length"
    )


HELD = f"""
scene:
  gravity: {G}
  forces:
    cord: {{rope: [ground.O, ball.center], length: 1.25}}
    band: {{spring: [ground.O, ball.center], stiffness: 30, rest_length: 1.25, only: tension}}
allow: {{ball.y: 1.0e-3}}
{scenes.tail(2.0, 41)}"""


@pytest.mark.slow
def test_beside_a_rope_that_holds_its_length() -> None:
    """Rounding of a length that is held neither tightens nor slackens: the rope swings alone."""
    case = scenes.scene("free_particle", HELD, m=2, x=0.05, y=-0.2)
    solution = solve(case)
    assert solution.holds
    assert solution.trajectory.switches.size == 1
    alone = HELD.replace("    band: {spring", "    # {spring")
    other = solve(scenes.scene("free_particle", alone, m=2, x=0.05, y=-0.2))
    for name in ("ball.x", "ball.y"):
        x, y = (observe(case.scene, one.trajectory, name) for one in (solution, other))
        assert x == pytest.approx(y, abs=1e-9)


@pytest.mark.slow
@pytest.mark.mutant(
    "a leg that only presses on the other side of its rest length", "a leg that never lets go"
)
def test_a_mistake_in_the_switch_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A guard of the other side, and a leg whose state never changes."""
    sound = follow(hopper(0.8, 0.0), np.linspace(0.0, 1.0, 11))
    monkeypatch.setattr(OneSided, "way", -1.0)
    wrong = follow(hopper(0.8, 0.0), np.linspace(0.0, 1.0, 11))
    assert named(wrong) != named(sound)
    monkeypatch.undo()

    def never(self: PlanarMechanism, mode: str) -> Sequence[Guard]:
        return ()

    monkeypatch.setattr(PlanarMechanism, "guards", never)
    glued = follow(hopper(0.8, 0.0), np.linspace(0.0, 1.0, 11))
    ends: list[Array] = [f.y[-1] for f in (sound, glued)]
    assert np.abs(ends[1] - ends[0]).max() > 0.1


END = scenes.tail(1.0, 26)


@pytest.mark.slow
def test_two_balls_thrown_apart_go_on_about_their_centre() -> None:
    """What is left along the rope is the centre's velocity; across it each keeps its own."""
    case = scenes.parsed(ropes.PAIR, tail=END)
    motion = solve(case).trajectory
    # (½ + 2 t)² + ¼ t² = 1, both in m, the one seen from the other
    t = (-2 + math.sqrt(4 + 4 * 4.25 * 0.75)) / (2 * 4.25)
    assert motion.switches.tolist() == pytest.approx([t], abs=1e-13)
    n = np.array([0.5 + 2 * t, -0.5 * t])
    lost = 2 / 3 * float(n @ (2.0, -0.5)) * n  # the impulse, by the reduced mass of 2/3 kg
    after = {"one": np.array([-1.0, 0.5]) + lost, "two": np.array([1.0, 0.0]) - lost / 2}
    apart = after["two"] - after["one"]
    omega = (n[0] * apart[1] - n[1] * apart[0]) / 1.0**2
    force = observe(case.scene, motion, "rope.force")[-1]
    assert force == pytest.approx(2 / 3 * omega**2, abs=1e-12)  # m ω² L, of the reduced mass
    centre = (after["one"] + 2 * after["two"]) / 3
    end = (motion.states["one"][-1] + 2 * motion.states["two"][-1]) / 3
    assert end[3:5] == pytest.approx(centre, abs=1e-13)


@pytest.mark.slow
def test_a_bar_is_stopped_at_once() -> None:
    """Pin and rope leave it nothing; the rope's moment about the pin is the weight's."""
    case = scenes.parsed(ropes.HELD, tail=END)
    motion = solve(case).trajectory
    (x, _, angle, *rates), force = motion.states["bar"][-1], motion.reactions["rope.force"][-1]
    assert rates == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    end = 0.8 * np.array([math.cos(angle), math.sin(angle)])
    pull = (np.array([0.0, 0.5]) - end) / 1.1
    moment = force * float(end[0] * pull[1] - end[1] * pull[0])
    assert moment == pytest.approx(9.80665 * x, abs=1e-12)
    assert np.linalg.norm(end - (0.0, 0.5)) == pytest.approx(1.1, abs=1e-12)


@pytest.mark.slow
def test_a_hook_that_moves_takes_along_what_it_catches() -> None:
    """Along the rope its end then has the hook's velocity; the rope slackens, and it drifts on."""
    case = scenes.parsed(ropes.TOWED, tail=END)
    motion = solve(case).trajectory
    (t,) = motion.switches
    n = np.array([0.5 * t, -0.2]) / 0.3  # to the hook, from the end 0.2 m above where it began
    lever = -0.4 * n[0]  # r × n, r = (0, 0.4)
    impulse = 0.5 * n[0] / (1 / 1.0 + lever**2 / (1.0 * 0.8**2 / 12))
    known = [*(impulse * n), impulse * lever / (1.0 * 0.8**2 / 12)]
    assert motion.states["sled"][-1, 3:] == pytest.approx(known, abs=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("x: 0.5, y: 0,", "x: 1.2, y: 0,", "rope starts 200 mm longer than it is"),
        ("x: 0.5, y: 0,", "x: 1.0, y: 0,", "rope starts taut, and with its ends parting by 2 m/s"),
    ],
)
def test_starts_that_no_rope_allows(old: str, new: str, what: str) -> None:
    mistake = refused(scenes.parsed(ropes.PAIR.replace(old, new), tail=END))
    assert mistake.where == "initial"
    assert mistake.what == what


@pytest.mark.slow
def test_a_taut_rope_that_need_not_pull_begins_slack() -> None:
    """Its ends neither part nor near: what pushes them together leaves it slack."""
    pushed = ropes.PAIR.replace("vx: -1.0, vy: 0.5", "vx: 0, vy: 0").replace("vx: 1.0", "vx: 0")
    pushed = (
        pushed.replace("x: 0.5", "x: 1.0")
        .replace("length: 1.0}}", "length: 1.0}, hand: {push: one.center, constant: [1, 0]}}")
        .replace(", two.y: 1.0e-2", "")
    )
    found = solve(scenes.parsed(pushed, tail=END))
    assert found.holds
    assert np.all(found.trajectory.reactions["rope.force"] == 0.0)


@pytest.mark.slow
@pytest.mark.mutant("a rope that throws back what it catches")
def test_an_impact_that_throws_back_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A planted restitution: the hand-written ball swings on, and this one comes back."""
    made = unilateral.Roped.__init__
    monkeypatch.setattr(
        unilateral.Roped, "__init__", lambda self, **given: made(self, **given, restitution=0.5)
    )
    assert not solve(scenes.SHIPPED["ball_on_rope.caught"]).holds


@pytest.mark.slow
@pytest.mark.mutant("a limit that nothing keeps, taken for the end of the motion")
def test_a_rope_and_a_stop_that_strike_in_turn_pile_up() -> None:
    """While the bar still flies to its stop the rope's blows have no limit to go on from.

    They are refused where rounding no longer tells which of both strikes; with a limit taken for
    one they go on to a blow of the rope.
    """
    text = """\
scene:
  points: {O: [0, 1.2]}
  bodies: {bar: {bar: {mass: 1.1, length: 0.32}}, p: {particle: {mass: 2.8}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
  forces:
    R: {rope: [bar.end, p.center], length: 0.196}
    E: {stops: hinge, low: -0.1, high: 0.24, restitution: 0.8}
initial: {bar: {angle: -0.02, omega: -2.92}, p: {x: 0.239, y: 1.09, vx: 0.65, vy: -0.78}}
allow: {bar.angle: 1.0e-1, p.x: 1.0e-1, p.y: 1.0e-1}
"""
    assert solve(scenes.parsed(text, tail=scenes.tail(0.09, 10))).holds
    with pytest.raises(
        CaseError, match=r"E\.low strikes at t = 0.09722 s what R touches and passes on"
    ):
        solve(scenes.parsed(text, tail=scenes.tail(0.52, 27)))


@pytest.mark.slow
def test_a_rope_that_is_let_go_is_not_taut_at_once() -> None:
    """A bar rocks under two ropes, ever faster; between two blows one is slack for some 10 us.

    Its gap is no more than rounding at first, which is no end of it.
    """
    text = """\
scene:
  points: {A: [-0.204, 1.0], B: [0.183, 1.0]}
  bodies:
    b: {rigid: {mass: 1.4, inertia: 0.2834}, points: {L: [-0.324, 0.082], R: [0.303, 0.082]}}
  forces:
    l: {rope: [ground.A, b.L], length: 0.5142}
    r: {rope: [ground.B, b.R], length: 0.5142}
initial: {b: {x: 0, y: 0.445, angle: -0.021, vx: 0.34, vy: 0.23, omega: -0.13}}
allow: {b.x: 1.0e-2, b.y: 1.0e-2, b.angle: 1.0e-2}
"""
    motion = solve(scenes.parsed(text, tail=scenes.tail(0.76, 39)))
    assert motion.holds
    before, last = motion.trajectory.switches[-2:]
    assert 1e-7 < last - before < 1e-5


PRESSED = """
scene:
  gravity: none
  forces:
    s: {stops: hinge, low: 0, restitution: 0}
    m: {motor: hinge, pulse: {amplitude: -4, from: 0.2, until: UNTIL}}
    w: {torsion: hinge, stiffness: STIFFNESS, rest_angle: 0}
allow: {bar.angle: null, s.torque: 1.0}
"""


def pressed(start: float, stiffness: float, until: float) -> float:
    """[N m] the stop's last torque, of a motion that is certified."""
    changes = PRESSED.replace("STIFFNESS", repr(stiffness)).replace("UNTIL", repr(until))
    case = scenes.scene("bar_on_pin", changes, l=0.6, angle=start)
    solution = solve(case)
    assert solution.holds
    return float(observe(case.scene, solution.trajectory, "s.torque")[-1])


@pytest.mark.slow
@pytest.mark.parametrize(("start", "stiffness"), [(0.0, 0.7), (0.5, 1.1843525281307231)])
def test_what_is_pressed_on_a_stop_stays_when_the_push_ends(start: float, stiffness: float) -> None:
    """A spring without a load at the stop leaves 1e-30 N m of either sign, and no friction is."""
    assert pressed(start, stiffness, 0.8) == pytest.approx(0.0, abs=1e-12)
    assert pressed(start, stiffness, 2.0) == pytest.approx(4.0, rel=1e-12)


@pytest.mark.slow
@pytest.mark.mutant("rounding as small as what is left of forces that have ended")
def test_rounding_of_what_is_left_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Modes, "_usual", 0.0)
    with pytest.raises((CaseError, AssertionError)):
        pressed(0.5, 1.1843525281307231, 0.8)


FREE = """
scene:
  gravity: none
  points: {O: [0.1928, -0.4271]}
  forces: {ends: {stops: hinge, low: -1, high: 1}}
allow: {bar.angle: null, bar.x: 0.1, ends.torque: 0.1}
"""


@pytest.mark.slow
@pytest.mark.parametrize("rate", [4.0, 3.0, 2.0])
@pytest.mark.mutant("nothing as small as rounding where no force acts")
def test_what_no_force_moves_stays_at_its_stop(rate: float) -> None:
    """To stay and to leave are one motion, whatever the blow has left of its rate."""
    case = scenes.scene("bar_on_pin", FREE, omega=rate)
    solution = solve(case)
    assert solution.holds
    last = solution.trajectory.states["bar"][-1]
    assert last[2:] == pytest.approx([1.0, 0.0, 0.0, 0.0], abs=1e-14)
    assert observe(case.scene, solution.trajectory, "ends.torque")[-1] == pytest.approx(
        0, abs=1e-14
    )


F_0, DAMPING, SERIES, MASS = 600.0, 2000.0, 20000.0, 10.0
LIFTED = f"""
scene:
  gravity: {G}
  points: {{S: [0, 1.0], O: [0, -0.5]}}
  joints: {{rail: {{slide: [ground.S, block.center], along: [0, 1]}}}}
  contacts: {{touch: {{between: [block, ground.floor], friction: 0}}}}
  forces:
    m:
      linear_muscle: [ground.S, block.center]
      isometric: {F_0}
      damping: {DAMPING}
      series_stiffness: {SERIES}
      parallel_stiffness: 0
      rest_length: 1.0
      contractile_length: 1.0
    cord: {{rope: [ground.O, block.center], length: 0.6}}
allow: {{rail.shift: null, block.y: 1.0e-3, m.force: 1.0}}
{scenes.tail(0.6, 31)}"""
STRUCK = f"""
scene:
  points: {{S: [0, 0.3]}}
  bodies: {{bar: {{points: {{I: [-0.125, 0]}}}}}}
  forces:
    m:
      muscle: [ground.S, bar.I]
      isometric: 600
      hill_a: 150
      hill_b: 0.05
      series_stiffness: 20000
      parallel_stiffness: 0
      rest_length: 0.3
      contractile_length: 0.3
    ends: {{stops: hinge, low: -80 deg, high: 60 deg, restitution: 0.5}}
allow: {{m.force: 1.0}}
{scenes.tail(0.6, 31)}"""


def struck() -> Case:
    return scenes.scene("bar_on_pin", STRUCK, m=1.5, l=0.35, angle=math.radians(-10))


@pytest.mark.slow
def test_a_load_is_lifted_and_caught_by_a_rope() -> None:
    """At rest F₀ − F falls as exp(−c t/b): on the floor until F = m g, and from F₁ on the rope."""
    case = scenes.scene("block_on_rail", LIFTED, m=MASS, shift=-1)
    found = solve(case)
    assert found.holds
    lifts, _, taut = found.trajectory.switches  # once it falls back before it hangs
    assert lifts == pytest.approx(-DAMPING / SERIES * math.log(1 - MASS * G / F_0), abs=1e-12)
    force, times = observe(case.scene, found.trajectory, "m.force"), case.times
    on_floor = F_0 * (1 - np.exp(-SERIES / DAMPING * times))
    np.testing.assert_allclose(force[times < lifts], on_floor[times < lifts], rtol=1e-11)
    held = np.flatnonzero(times > taut)
    dies = np.exp(-SERIES / DAMPING * (times[held] - times[held[0]]))
    np.testing.assert_allclose(F_0 - force[held], (F_0 - force[held[0]]) * dies, rtol=1e-9)
    np.testing.assert_allclose(found.trajectory.states["block"][held, 1], 0.1, rtol=1e-12)


@pytest.mark.slow
def test_a_stop_turns_the_arm_and_not_the_muscle() -> None:
    case = struck()
    assert solve(case).holds
    first, *_, last = follow(scenes.mechanism(case), case.times).events
    assert first.name == last.name == "ends.high strikes"
    np.testing.assert_allclose(first.after[:4], first.before[:4], rtol=0, atol=1e-12)
    np.testing.assert_allclose(first.after[4:], -0.5 * first.before[4:], rtol=1e-12)
    assert last.mode_after == "ends.low open, ends.high acts"
    np.testing.assert_allclose(last.after[:4], last.before[:4], rtol=0, atol=1e-12)


@pytest.mark.slow
@pytest.mark.mutant("a muscle whose inner state is moved by an impact")
def test_a_muscle_that_is_struck_too_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = choosing.placed

    def wrong(M: Array, f: Array, gaps: Array, q: Array) -> Array:
        return np.append(sound(M, f, gaps, q)[:-1], q[-1] + 1e-4)

    monkeypatch.setattr(choosing, "placed", wrong)
    case = struck()
    change = follow(scenes.mechanism(case), case.times).events[-1]
    assert abs(change.after[3] - change.before[3]) > 1e-5
