"""Claims about states: what is drawn, what can be bounded, and what such a file must not say."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given.scenes import cases_of, mistakes_of
from given.scenes.claims import CHAIN, PLANE, claimed

from textmech.cases import find
from textmech.cases.language.grammar.file import Drawn
from textmech.cases.scene.quantity import table
from textmech.cases.scene.states import States, claimable, coordinates


def test_sound(tmp_path: Path) -> None:
    case = claimed(tmp_path, CHAIN)
    assert case.states == States(5, 7, (-1.0, 1.0), (-2.0, 2.0), (-3.0, 3.0))
    assert case.times.tolist() == [0, 1, 2, 3, 4]
    assert coordinates(case.scene) == {"q1.angle": "rad", "rail.s": "m", "rail.a": "rad"}


def test_drawn_evenly_and_always_the_same(tmp_path: Path) -> None:
    case = claimed(tmp_path, CHAIN.replace("random: 5", "random: 4000"))
    assert case.states is not None
    one, again = (case.states.drawn(case.scene) for _ in range(2))
    both = np.stack(list(one.values()))
    assert np.array_equal(both, np.stack(list(again.values())))
    for column, most in enumerate((1.0, 2.0, 3.0)):
        each = both[:, :, column]
        assert np.all(np.abs(each) <= most)
        # of a mean of 4000: its standard deviation is most / √12000
        assert np.all(np.abs(np.mean(each, axis=1)) < 5 * most / 12000**0.5)
    assert np.max(np.abs(np.corrcoef(both.transpose(0, 2, 1).reshape(9, -1)) - np.eye(9))) < 0.1


def test_another_seed_draws_others(tmp_path: Path) -> None:
    case = claimed(tmp_path, PLANE)
    assert case.states is not None
    other = States(4, 1, (-1.0, 1.0), (-2.0, 2.0), (0.0, 0.0)).drawn(case.scene)
    drawn = case.states.drawn(case.scene)
    assert set(drawn) == {"wheel.x", "wheel.y", "wheel.angle", "bob.x", "bob.y"}
    assert not np.any(drawn["wheel.x"][:, :2] == other["wheel.x"][:, :2])
    assert not np.any(drawn["wheel.x"][:, 2])  # accelerations that are not given are none


def test_what_is_drawn_is_no_claim(tmp_path: Path) -> None:
    known = claimable(claimed(tmp_path, PLANE).scene)
    assert {"wheel.P.x", "wheel.P.ay", "bob.speed", "wheel.inertia"} <= set(known)
    assert not {"wheel.x", "wheel.vy", "wheel.omega", "wheel.center.x", "bob.inertia"} & set(known)
    known = claimable(claimed(tmp_path, CHAIN).scene)
    assert {"box.x", "box.omega_1", "rod.alpha_x", "rod.inertia_23", "rail.a_torque"} <= set(known)
    assert not {"q1.angle", "rail.s_dot", "q1.force", "q1.gap"} & set(known)


def test_a_mass_matrix_of_one_unit_has_one(tmp_path: Path) -> None:
    assert "mass_matrix" not in claimable(claimed(tmp_path, CHAIN).scene)
    turning = CHAIN.replace("s: {slide: [1, 0, 0]}", "s: {hinge: [0, 1, 0]}")
    turning = turning.replace("rail.s_force", "rail.s_torque")
    assert claimable(claimed(tmp_path, turning).scene)["mass_matrix"].unit == "kg m²"
    shifting = CHAIN.replace("a: {hinge: [0, 0, 1]}", "a: {slide: [0, 0, 1]}")
    shifting = shifting.replace("{hinge: [ground.O, rod.start], axis: [0, 3, 4]}",
                                "{slide: [ground.O, rod.start], along: [0, 3, 4]}")  # fmt: skip
    shifting = shifting.replace("q1.torque", "rod.vx")
    assert claimable(claimed(tmp_path, shifting).scene)["mass_matrix"].unit == "kg"


def mistakes(text: str) -> list[tuple[str, str]]:
    return [(m.where, m.what) for m in mistakes_of(text)]


@pytest.mark.parametrize(
    ("old", "new", "where", "what"),
    [
        ("random: 5, ", "", "states.random", "missing key 'random'"),
        ("random: 5", "random: 2", "states.random", "must be at least 3, is 2"),
        ("random: 5", "random: 20000", "states.random", "must be at most 10000, is 20000"),
        ("random: 5", "rundom: 5", "states.rundom", "unknown key 'rundom'; did you mean 'random'?"),
        ("seed: 7", "seed: -1", "states.seed", "must be at least 0, is -1"),
        ("q: [-1, 1]", "q: [1, -1]", "states.q", "should be a list [low, high], is [1, -1]"),
        ("q: [-1, 1]", "q: 1", "states.q", "should be a list, is the number 1"),
        ("q: [-1, 1]", "q: [-1, 1 m]", "states.q.1", "is '1 m', but a plain number was expected"),
        ("allow:", "samples: 5\nallow:", "samples", "stands beside `states`, where nothing moves"),
        ("allow:", "initial: {}\nallow:", "initial", "stands beside `states`, where nothing moves"),
        ("allow:", "step: 1\nallow:", "step", "stands beside `states`, where nothing moves"),
        (
            "box.P.ax", "q1.angle", "allow.q1.angle",
            "'q1.angle' is no claim about states: it is drawn itself, or held by a constraint",
        ),
        (
            "{hinge: [ground.O, rod.start], axis: [0, 3, 4]}", "{ball: [ground.O, rod.start]}",
            "scene.joints.q1", "a ball has no coordinates to draw; write `freedoms`",
        ),
        (
            "[ground.O, rod.start]", "[rod.start, ground.O]",
            "scene.joints.q1.hinge",
            "begins at nothing that hangs on the ground; name the part nearer to it first",
        ),
        (
            "states:", "  drive: {q1.omega: 1.0}\nstates:",
            "scene.drive", "a claim about states is about bodies and joints alone",
        ),
        (
            "states:", "  forces: {hand: {push: box.P, constant: [1, 0, 0]}}\nstates:",
            "scene.forces.hand", "a claim about states is about bodies and joints alone",
        ),
        (
            "O: [0, 0, 0.1]", "O: {at: [0, 0, 0.1], velocity: [1, 0, 0]}",
            "scene.points.O",
            "is driven: a claim about states is about bodies and joints alone",
        ),
        (
            "  joints:\n", "    bob: {particle: {mass: 1.0}}\n  joints:\n"
            "    q2: {slide: [ground.O, bob.center], along: [1, 0, 0]}\n",
            "scene.bodies.bob", "is a particle; a claim about states takes none",
        ),
        (
            "  joints:\n", "    top: {sphere: {mass: 1.0, radius: 0.1}}\n  joints:\n",
            "scene.bodies.top", "hangs on nothing: join it to the ground by `freedoms`",
        ),
        (
            "  joints:\n", "  joints:\n    q2: {hinge: [ground.O, box.P], axis: [1, 0, 0]}\n",
            "scene.joints.rail", "closes a loop: states are drawn of open chains",
        ),
        (
            "allow:", "reach: {some.law: {energy.total: 1.0e-9}}\nallow:", "reach.some.law",
            "states are asked of the engine itself; write its name alone",
        ),
        (
            "allow:",
            "deviates: {some.shipped: {energy.total: {limit: 1, because: it is}}}\nallow:",
            "deviates.some.shipped.energy.total.limit",
            "no step leads to a state, so that there is no limit; write `by`",
        ),
    ],
)  # fmt: skip
def test_mistakes(old: str, new: str, where: str, what: str) -> None:
    assert CHAIN.count(old) >= 1
    assert mistakes(CHAIN.replace(old, new, 1)) == [(where, what)]


def test_joints_of_the_plane_are_refused() -> None:
    text = PLANE.replace("states:", "  joints: {q: {pin: [ground.O, wheel.P]}}\nstates:")
    what = "has no place here: states of the plane are those of free bodies; write `space: 3`"
    assert mistakes(text) == [("scene.joints.q", what)]


DRAG = PLANE.replace(
    "states:", "  forces: {d: {drag: wheel.center, coefficient: 2, exponent: 0}}\nstates:"
)


@pytest.mark.mutant("work of unrelated states is a claim")
def test_no_work_is_done_in_a_state(tmp_path: Path) -> None:
    what = "'d.work' is no claim about states: work is done in time, and here is none"
    assert claimed(tmp_path, DRAG.replace("allow: {", "allow: {d.fx: 1, "))
    found = mistakes(DRAG.replace("allow: {", "allow: {d.work: 1, "))
    assert found == [("allow.d.work", what)]


def test_a_missing_span_is_all_that_is_told() -> None:
    """And not what the drag's exponent would be in a motion."""
    found = mistakes(DRAG.replace(", q_dot: [-2, 2]", ""))
    assert [where for where, _ in found] == ["states.q_dot"]


def test_a_mass_matrix_is_of_space(tmp_path: Path) -> None:
    """Particles of the plane have lengths alone."""
    text = PLANE[: PLANE.index("  bodies:")] + "  bodies: {ball: {particle: {mass: 2}}}\n"
    text += PLANE[PLANE.index("states:") : PLANE.index("allow:")]
    assert claimed(tmp_path, text + "allow: {momentum.x: 1}\n")
    found = mistakes(text + "allow: {mass_matrix: 1}\n")
    assert [where for where, _ in found] == ["allow.mass_matrix"]


def test_a_file_without_states_still_needs_a_motion() -> None:
    text = PLANE.replace("states: {random: 4, seed: 0, q: [-1, 1], q_dot: [-2, 2]}\n", "")
    found = [what for _, what in mistakes(text)]
    assert found[:3] == [f"missing key '{key}'" for key in ("duration", "initial", "samples")]


def test_a_variant_may_draw_others() -> None:
    a, b = cases_of(PLANE + "variants: {a: {}, b: {states: {seed: 9}}}\n")
    assert a.states is not None
    assert b.states is not None
    assert (a.states.seed, b.states.seed, b.states.random) == (0, 9, 4)


STATES = (
    Path(find.__file__).with_name("README.md").read_text(encoding="utf-8")
    .partition("## States\n")[2].partition("\n## ")[0]
)  # fmt: skip


def test_the_readme_loads_and_says_every_key(tmp_path: Path) -> None:
    (example,) = re.findall(r"```yaml\n(.*?)```", STATES, flags=re.DOTALL)
    assert claimed(tmp_path, example).states == States(100, 1, (-2.5, 2.5), (-3, 3), (-5, 5))
    assert set(Drawn.model_fields) <= set(re.findall(r"`?([a-z_]+)`?", STATES))


def test_the_readme_says_every_quantity_of_states_alone(tmp_path: Path) -> None:
    """By the words body, point and joint; the units of an effort and of a mass matrix are two."""
    rows = re.findall(r"^\| (`.*?) \| (.*?) \|", STATES, flags=re.MULTILINE)
    said = {name: unit for names, unit in rows for name in re.findall(r"`(.*?)`", names)}
    found: dict[str, str] = {}
    for text in (CHAIN, PLANE):
        scene = claimed(tmp_path, text).scene
        new = {q: of for q, of in claimable(scene).items() if q not in table(scene)}
        for name, quantity in new.items():
            part, _, field = name.rpartition(".")
            point = ".point" if "." in part else ""
            known = "joint" if part in scene.joints else f"body{point}"
            found[f"{known}.{field}"] = quantity.unit
    efforts = {"joint.s_force": "N", "joint.a_torque": "N m", "joint.torque": "N m"}
    assert {q: found.pop(q) for q in efforts} == efforts
    assert said.pop("mass_matrix") == "kg m², kg"
    assert {said.pop(f"joint.{q}") for q in ("torque", "theta_torque", "s_force")} == {"N m, N"}
    assert said == found


@pytest.mark.mutant("states drawn in the order of the scene")
def test_where_a_body_stands_in_the_file_is_no_part_of_what_is_drawn(tmp_path: Path) -> None:
    """Another body beside it, or before it, changes nothing of its places and rates."""
    case = claimed(tmp_path, PLANE)
    assert case.states is not None
    bodies = dict(reversed([*case.scene.bodies.items()]))
    turned = replace(case.scene, bodies=bodies)
    alone = replace(case.scene, bodies=dict([*case.scene.bodies.items()][-1:]))
    every = case.states.drawn(case.scene)
    assert len(bodies) > 1
    for scene in (turned, alone):
        for name, numbers in case.states.drawn(scene).items():
            assert np.array_equal(numbers, every[name])
