"""A bar that lies on two points: they have one slip, and where they stick a sum of frictions."""

import itertools
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.refused import refused

from textmech.cases.case import Case
from textmech.reference import refusal
from textmech.reference.mechanism.modes.element import State
from textmech.reference.mechanism.modes.shared_friction import ways
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve

G = 9.80665
LIES = """\
scene:
  bodies: {{bar: {{bar: {{mass: 1, length: 1}}}}}}
  contacts:
    a: {{between: [bar.start, ground.floor], friction: {a}}}
    b: {{between: [bar.end, ground.floor], friction: {b}}}
  forces: {{pull: {{push: bar.center, {pull}}}}}
initial: {{bar: {{start: [0, 0], angle: 0, vx: {vx}}}}}
allow: {{bar.x: 1.0e-3{more}}}
"""
FALLS = """\
scene:
  bodies: {{bar: {{bar: {{mass: 1, length: 1}}}}}}
  contacts:
    a: {{between: [bar.start, ground.floor], friction: {mu}}}
    b: {{between: [bar.end, ground.floor], friction: {mu}}}
initial: {{bar: {{start: [0, 0], angle: 10 deg, omega: 0}}}}
events: {{lands: {{b.gap: falls to zero}}}}
allow: {{bar.y: 1.0e-3, a.normal: 1.0e-3}}
"""


def lying(tmp_path: Path, pull: str, *, a: float = 0.3, b: float = 0.3, vx: float = 0.0,
          more: str = "") -> Case:  # fmt: skip
    text = LIES.format(pull=pull, a=a, b=b, vx=vx, more=more)
    return scenes.typed(tmp_path, text, tail=scenes.tail(0.6, 7))


def changes(case: Case) -> list[tuple[float, str]]:
    """When the mode changes, and what comes then."""
    found = follow(scenes.mechanism(case), case.times)
    return [(change.time, change.mode_after) for change in found.changes]


@pytest.mark.parametrize("vx", [1.0, -1.0])
@pytest.mark.parametrize(("a", "b"), [(0.3, 0.3), (0.5, 0.1), (0.1, 0.5)])
def test_both_stop_at_once(tmp_path: Path, a: float, b: float, vx: float):
    """At |v| / (μ g), μ their mean; and then one holds what the other leaves."""
    ((t, mode),) = changes(lying(tmp_path, "constant: [0, 0]", a=a, b=b, vx=vx))
    assert t == pytest.approx(1 / (0.3 * G), abs=1e-12)
    assert mode == "a sticks, b sticks"


@pytest.mark.slow
@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize(("a", "b"), [(0.1, 0.1), (0.17, 0.03)])
def test_both_break_loose_at_the_sum(tmp_path: Path, a: float, b: float, way: int):
    """(2.89) At 10 t = (μ_a + μ_b) m g/2, and not where the first has all that it can bear."""
    ((t, mode),) = changes(lying(tmp_path, f"ramp: [{10 * way}, 0]", a=a, b=b))
    sign = "+" if way > 0 else "-"
    assert (mode, t) == (f"a slides {sign}, b slides {sign}", pytest.approx(0.01 * G, abs=1e-12))


def test_a_force_to_and_fro_below_the_sum_moves_nothing(tmp_path: Path):
    shake = "sine: {amplitude: [2.9, 0], angular_frequency: 20}"
    assert changes(lying(tmp_path, shake, a=0.5, b=0.1)) == []


@pytest.mark.parametrize(("push", "a"), [(5.0, 5 - 0.3 * G), (2.0, 0.0)])
def test_from_rest_the_sum_decides(tmp_path: Path, push: float, a: float):
    case = lying(tmp_path, f"constant: [{push}, 0]")
    x = follow(scenes.mechanism(case), case.times).y[:, 0]
    np.testing.assert_allclose(x - 0.5, a * case.times**2 / 2, atol=1e-13)


@pytest.mark.slow
@pytest.mark.parametrize("mu", [1.2, 0.6])
def test_a_bar_that_falls_flat_rests(tmp_path: Path, mu: float):
    case = scenes.typed(tmp_path, FALLS.format(mu=mu), tail=scenes.tail(0.6, 7))
    solution = solve(case)
    assert [check for check in solution.checks if not check.holds] == []
    normal = solution.trajectory.reactions["a.normal"]
    assert normal[-1] == pytest.approx(G / 2, abs=1e-12)


def test_what_is_not_determined_cannot_be_asked_for(tmp_path: Path):
    mistake = refused(lying(tmp_path, "constant: [1, 0]", vx=1.0, more=", b.tangent: 1.0e-3"))
    assert mistake.where == "allow.b.tangent"
    normal = (
        G / 2
    )  # of each corner, and 0.3 of it most: of the sum 1 N one has what the other lacks
    low, high = 1 - 0.3 * normal, 0.3 * normal
    assert f"b.tangent: anything from {-high:.4g} to {-low:.4g} N" in mistake.what


@pytest.mark.slow
def test_while_both_slide_their_frictions_are_known(tmp_path: Path):
    case = lying(tmp_path, "constant: [5, 0]", b=0.1, more=", b.tangent: 1.0e-3")
    forces = solve(case).trajectory.reactions
    np.testing.assert_allclose(forces["a.tangent"], -0.15 * G, atol=1e-12)
    np.testing.assert_allclose(forces["b.tangent"], -0.05 * G, atol=1e-12)


TIP = "    g0: {between: [b0.end, ground.floor], friction: 0.5}\n"


def feet(count: int) -> str:
    """Bars joined into a line that lies on the floor, each with a foot."""
    ends = [f"    j{i}: {{pin: [b{i}.end, b{i + 1}.start]}}" for i in range(count - 1)]
    rub = [
        f"    f{i}: {{between: [b{i}.start, ground.floor], friction: 0.5}}" for i in range(count)
    ]
    bars = [f"    b{i}: {{bar: {{mass: 1.0, length: 1.0}}}}" for i in range(count)]
    start = ["b0: {x: 0.5, y: 0, angle: 0}", *(f"b{i}: {{angle: 0}}" for i in range(1, count))]
    lines = ["scene:", "  bodies:", *bars, "  joints:", *ends, "  contacts:", *rub]
    return "\n".join([*lines, f"initial: {{{', '.join(start)}}}", "allow: {b0.x: 1.0e-2}\n"])


@pytest.mark.slow
def test_what_is_not_at_its_bound_stays(tmp_path: Path):
    """Two bars in a line break loose where 100 t = μ 2 m g; a block beside them bears its 1 N."""
    rub = "    c: {between: [dot, ground.floor], friction: 0.5}\n"
    text = feet(2).replace("  joints:", "    dot: {particle: {mass: 1.0}}\n  joints:")
    text = text.replace("  contacts:\n", f"  contacts:\n{TIP.replace('b0', 'b1')}{rub}")
    pushes = "pull: {push: b0.center, ramp: [100, 0]}, push: {push: dot.center, constant: [1, 0]}"
    text = text.replace("initial: {", f"  forces: {{{pushes}}}\ninitial: {{dot: {{x: 3, y: 0}}, ")
    case = scenes.typed(tmp_path, text, tail=scenes.tail(0.12, 3))
    assert scenes.mechanism(case).start()[0].endswith("8 rows hold all")  # of two frictions a sum
    mode = "g0 slides +, c sticks, f0 slides +, f1 slides +"
    assert changes(case) == [(pytest.approx(G / 100, abs=1e-12), mode)]


@pytest.mark.slow
def test_very_many_contacts_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """4⁹ ways to stick, slide and open, of 2 ms each: 9 minutes, and 4¹² 9 hours."""
    monkeypatch.setattr(refusal, "LIMIT", 2.0)
    for count in (9, 12):
        case = scenes.typed(tmp_path, feet(count), tail=scenes.tail(0.2, 6))
        mistake = refused(case)
        assert mistake.where == "scene.contacts"
        assert f"{count} elements of bodies that hang together" in mistake.what
        assert f"(f0, f1, f2, f3, f4, f5 and {count - 6} more)" in mistake.what
        assert "what touches and rubs may go on in very many ways" in mistake.what
        assert "--allow-long" in mistake.what


@pytest.mark.mutant("what a body has closed on a plane sticks here and slides there")
def test_ways_are_those_in_which_what_a_body_has_closed_does_alike(tmp_path: Path):
    """Two points of one bar and a foot of another: in the order in which all would be tried."""
    text = feet(2).replace("  contacts:\n", f"  contacts:\n{TIP}")
    elements = scenes.mechanism(scenes.typed(tmp_path, text, tail=scenes.tail(0.2, 6))).elements
    choices: list[tuple[State, ...]] = [("sticks", "slides +", "slides -", "open")] * 3

    def alike(states: tuple[State, ...]) -> bool:
        rubbing = {e.together: s for e, s in zip(elements, states, strict=True) if s != "open"}
        pairs = zip(elements, states, strict=True)
        return all(s == "open" or s == rubbing[e.together] for e, s in pairs)

    all_of_them = [states for states in itertools.product(*choices) if alike(states)]
    assert [*ways(elements, choices)] == all_of_them
    assert len(all_of_them) == 40
    assert [*ways([], [])] == [()]
