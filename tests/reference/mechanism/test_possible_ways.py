"""Contacts at rest by linear programmes: what they hold, at any number, and where else it goes."""

import math
from typing import Any

import pytest
from given import scenes
from given.laws.refused import refused
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.reference.mechanism.modes import mode_selection, possible_ways
from textmech.reference.mechanism.modes.mode_selection import Undetermined

G = 9.80665
MASSES = (4.0, 1.0, 2.0, 0.5, 3.0)
PULLED = "scene: {forces: {hand: {push: b1.center, constant: [pull, 0]}}}"


def start(case: Case) -> tuple[set[str], dict[str, float]]:
    """What all elements do at the start, and the forces."""
    built = scenes.mechanism(case)
    mode, q, v = built.start()
    return set(mode.partition(";")[0].split(", ")), built.built.forces(mode, 0.0, q, v)


def rests(case: Case) -> bool:
    return all(state.endswith("sticks") for state in start(case)[0])


def boxes(changes: str | None = None, **words: float) -> Case:
    return scenes.scene("stack_of_boxes", changes, **words)


def disks(**words: float) -> Case:
    return scenes.scene("heap_of_disks", None, **words)


def count(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The programmes that are solved from now on."""
    asked, solved = list[Any](), possible_ways._programme
    monkeypatch.setattr(possible_ways, "_programme", lambda *of: asked.append(of) or solved(*of))
    return asked


@pytest.mark.parametrize("mu", [0.0, 0.5])
def test_a_stack_rests_by_one_programme_with_the_weights_above_it(
    monkeypatch: pytest.MonkeyPatch, mu: float
) -> None:
    asked = count(monkeypatch)
    states, forces = start(boxes(mu=mu))
    does = "sticks" if mu else "slides +"
    assert states == {f"{side}{k} {does}" for side in "lr" for k in range(1, 6)}
    for k in range(1, 6):
        half = G * sum(MASSES[k - 1 :]) / 2
        assert [forces[f"{side}{k}.normal"] for side in "lr"] == pytest.approx([half, half])
    assert len(asked) == 1


# Three disks by hand: the line of centres has the angle θ to the vertical, sin θ = x/2R. No moment
# acts on a lower disk, so that both of its frictions are F; N sin θ = F (1 + cos θ), and as the
# upper one stays N = m g/2, F = N tan θ/2. The floor bears 3/2 m g.
HALF = math.asin(0.11 / 0.2) / 2


def test_three_disks_rest_by_the_friction_that_they_need() -> None:
    need = math.tan(HALF)
    _, forces = start(disks())
    assert forces["leans_left.normal"] == pytest.approx(G / 2)
    assert abs(forces["leans_left.tangent"]) == pytest.approx(G / 2 * need)
    assert forces["floor_right.normal"] == pytest.approx(1.5 * G)
    assert rests(disks(mu=1.001 * need))
    assert rests(disks(mu_floor=1.001 * need / 3))


@pytest.mark.parametrize("less", ["mu", "mu_floor"])
def test_with_less_friction_they_part(less: str) -> None:
    need = math.tan(HALF) / (1.0 if less == "mu" else 3.0)
    assert not rests(disks(**{less: 0.999 * need}))


@pytest.mark.parametrize(
    ("pull", "slides"), [(0.99, {}), (1.5, {"1": "+"}), (6.0, {"1": "+", "2": "-"})]
)
def test_what_slides_is_found_among_many(pull: float, slides: dict[str, str]) -> None:
    """Pulled by what the floor holds and more, the lowest box slips, and then from under all."""
    weight, mu = G * sum(MASSES), 0.3
    states, forces = start(boxes(PULLED.replace("pull", str(pull * mu * weight)), mu=mu))
    assert {f"{side}{k} slides {way}" for k, way in slides.items() for side in "lr"} == {
        state for state in states if "slides" in state and state[1] in "12"
    }
    if "2" in slides:
        friction = sum(forces[f"{side}2.tangent"] for side in "lr")
        assert friction == pytest.approx(mu * (weight - 4.0 * G))


WEDGED = """
scene:
  planes: {left: {at: [-0.1, 0], normal: [1, 0]}, right: {at: [0.1, 0], normal: [-1, 0]}}
  bodies: {cork: {block: {mass: 1.0, width: 0.2, height: 0.3}}}
  contacts:
    a: {between: [cork.lower_left, ground.left], friction: 0.5}
    b: {between: [cork.upper_left, ground.left], friction: 0.5}
    c: {between: [cork.lower_right, ground.right], friction: 0.5}
    d: {between: [cork.upper_right, ground.right], friction: 0.5}
initial: {cork: {x: 0, y: 1, angle: 0}}
allow: {cork.y: 1.0e-3}
"""


def test_what_is_wedged_and_might_as_well_fall_is_refused() -> None:
    mistake = refused(scenes.parsed(WEDGED))
    assert "both staying on and leaving" in mistake.what


@pytest.mark.mutant("what forces can hold is taken for what rests")
def test_a_rest_that_is_not_doubted_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    blind = otherwise(possible_ways, "self.gives @ forces < BEGINS", "True")
    monkeypatch.setattr(mode_selection, "possible_ways", blind.possible_ways)
    assert rests(scenes.parsed(WEDGED))


@pytest.mark.slow
@pytest.mark.mutant("in the programmes friction drives what slides")
def test_friction_the_other_way_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    blind = otherwise(possible_ways, "friction.slides[s < 0]", "friction.slides[s > 0]")
    monkeypatch.setattr(mode_selection, "possible_ways", blind.possible_ways)
    with pytest.raises(Undetermined, match="no motion"):
        start(boxes(PULLED.replace("pull", "100")))


@pytest.mark.mutant("what flies beside others at rest may not fall")
def test_what_flies_that_is_held_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    lifted = "initial: {b5: {y: 0.6}}"
    assert {"l5 open", "r5 open"} < start(boxes(lifted))[0]
    blind = otherwise(possible_ways, 'e.only or options == ("open",)', "e.only")
    monkeypatch.setattr(mode_selection, "possible_ways", blind.possible_ways)
    with pytest.raises(Undetermined, match="no motion"):
        start(boxes(lifted))


@pytest.mark.parametrize(("mu", "stays"), [(0.334, True), (0.332, False)])
def test_a_ladder_between_boxes_needs_a_third(mu: float, stays: bool) -> None:
    """By forces at both ends that lean by ρ each, at a slope of 4/3: cot 2ρ = (1 - μ²)/2μ."""
    case = scenes.scene("ladder_on_boxes", None, mu=mu)
    assert rests(case) == stays


LEDGE = """
scene:
  bodies:
    base: {block: {mass: 2.0, width: 0.4, height: 0.2}}
    shelf: {block: {mass: 1.0, width: 0.6, height: 0.1}}
  contacts:
    left: {between: [base.lower_left, ground.floor], friction: 0.5}
    right: {between: [base.lower_right, ground.floor], friction: 0.5}
    inner: {between: [shelf.lower_left, base.top], friction: 0.5}
    edge: {between: [base.upper_right, shelf.bottom], friction: 0.5}
initial: {base: {x: 0, y: 0.1, angle: 0}, shelf: {x: over, y: 0.25, angle: 0}}
allow: {shelf.y: 1.0e-3}
"""


def test_a_wall_of_ten_bricks_rests() -> None:
    assert rests(scenes.SHIPPED["brick_wall"])


@pytest.mark.parametrize(("over", "does"), [("0.199", "sticks"), ("0.201", "open")])
def test_what_is_pushed_over_an_edge_tips(over: str, does: str) -> None:
    states, _ = start(scenes.parsed(LEDGE.replace("over", over)))
    assert f"inner {does}" in states


THROWN = """
scene:
  points: {O: [0, 0]}
  bodies: {hill: {disk: {mass: 1.0, radius: 1.0}}, dot: {particle: {mass: 1.0}}}
  joints: {axle: {pin: [ground.O, hill.center]}}
  contacts: {top: {between: [dot, hill], friction: 0.5}}
initial: {hill: {x: 0, y: 0, angle: 0}, dot: {x: 0, y: 1.0, vx: 4.0, vy: 0}}
allow: {dot.y: 1.0e-3}
"""


@pytest.mark.mutant("in the programmes a rim falls away from under nothing")
def test_a_curve_that_is_left_out_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Above sqrt(g R) what goes over a hill leaves it."""
    monkeypatch.setattr(possible_ways, "FEW", 0)
    assert start(scenes.parsed(THROWN))[0] == {"top open"}
    blind = otherwise(possible_ways, "own - np.array(gammas) / sizes / size", "own")
    monkeypatch.setattr(blind, "FEW", 0)
    monkeypatch.setattr(mode_selection, "possible_ways", blind.possible_ways)
    with pytest.raises(Undetermined, match="no motion"):
        start(scenes.parsed(THROWN))
