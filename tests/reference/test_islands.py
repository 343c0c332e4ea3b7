"""What nothing joins is solved apart: with the same answer, and at a cost that is its own."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.adapters.engine_scenes import machine, pin

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Contact, Scene
from textmech.cases.scene import islands as graph
from textmech.cases.scene.forces.force import FORCES
from textmech.cases.scene.islands import islands
from textmech.cases.scene.joint import FREEDOMS
from textmech.cases.scene.observe import observe
from textmech.cases.scene.pair import Pair
from textmech.cases.scene.shape import bar, disk
from textmech.reference import islands as parts
from textmech.reference import solve as door
from textmech.reference.certificate.agreement import Check, difference
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import Solution, solve

PLANE = """\
title: A pendulum that falls on a spring, a pair on a spring, and a ball that nothing holds
scene:
  points: {O: [0, 0], P: [3, 0]}
  bodies:
    one: {bar: {mass: 1.0, length: 0.4}}
    two: {bar: {mass: 2.0, length: 0.3}}
    left: {bar: {mass: 1.0, length: 0.2}}
    rod: {bar: {mass: 0.5, length: 0.6}}
    right: {particle: {mass: 0.7}}
    ball: {particle: {mass: 1.5}}
  joints:
    p: {pin: [ground.O, one.start]}
    q: {pin: [one.end, two.start]}
    r: {pin: [ground.P, rod.start]}
  forces:
    s: {spring: [left.end, right.center], stiffness: 80.0, rest_length: 0.4}
    d: {damper: [left.end, right.center], damping: 0.3}
    f: {push: ball.center, pulse: {amplitude: [2.0, 0], from: 0.1, until: 0.4}}
initial:
  one: {angle: 0.2}
  two: {angle: -0.4}
  rod: {angle: 0.9, omega: 2.0}
  left: {x: 5.0, y: 0, angle: 0.3, omega: 1.0}
  right: {x: 5.6, y: 0.1, vx: 0.2}
  ball: {x: 9, y: 0, vx: 1.0}
duration: 1.2
samples: 13
allow:
  two.angle: 1.0e-4
  right.x: 1.0e-4
  ball.x: 1.0e-4
  s.force: 1.0e-3
  q.force: 1.0e-3
  energy.total: 1.0e-3
  momentum.angular: 1.0e-3
"""
SPACE = """\
title: A box on a spring to another, and a pendulum
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
    box: {rigid: {mass: 1.0, inertia: [0.1, 0.2, 0.25, 0, 0, 0]}, points: {P: [0.1, 0.2, 0]}}
    arm: {rigid: {mass: 1.0, inertia: [0.1, 0.2, 0.25, 0, 0, 0]}, points: {P: [0, 0, 0.5]}}
    ball: {particle: {mass: 0.4}}
  joints: {p: {hinge: [ground.O, arm.P], axis: [0, 1, 0]}}
  forces: {s: {spring: [box.P, ball.center], stiffness: 60.0, rest_length: 0.4}}
initial:
  box:
    attitude: {axis: [1, 0, 0], angle: 0.4}
    omega: [1, 2, 0]
    x: 2
    y: 0
    z: 0
    vx: 0
    vy: 0.1
    vz: 0
  ball: {x: 2, y: 1, z: 0, vx: 0.3, vy: 0, vz: 0}
  p: {angle: 0.6, omega: 0.4}
duration: 0.8
samples: 9
allow: {box.y: 1.0e-4, ball.z: 1.0e-4, p.angle: 1.0e-4, s.force: 1.0e-2, energy.total: 1.0e-3}
"""


def typed(folder: Path, text: str) -> Case:
    file = folder / "case.yaml"
    file.write_text(text, encoding="utf-8")
    return load(file)[0]


def at_once(case: Case, patch: pytest.MonkeyPatch) -> Solution:
    """All as one dense problem."""
    with patch.context() as patched:
        patched.setattr(door, "parts", lambda case: (case,))
        return solve(case)


def checked(solution: Solution, name: str) -> Check:
    (check,) = (check for check in solution.checks if check.name == name)
    return check


@pytest.mark.slow
@pytest.mark.mutant("the motions of two islands are put together under each other's names")
@pytest.mark.parametrize(("text", "count"), [(PLANE, 4), (SPACE, 2)], ids=["plane", "space"])
def test_islands_move_as_they_do_in_one_problem(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, count: int
) -> None:
    case = typed(tmp_path, text)
    assert len(islands(case.scene)) == len(parts.parts(case)) == count
    apart, whole = solve(case), at_once(case, monkeypatch)
    assert apart.holds
    assert whole.holds
    # both are certified to 1e-12 of their size, or 1e-11 where something changes
    assert difference(apart.trajectory, whole.trajectory) < 1e-11
    assert list(apart.trajectory.states) == list(case.scene.bodies)
    assert apart.trajectory.reactions.keys() == whole.trajectory.reactions.keys()
    for name in case.allow:
        a, b = (observe(case.scene, one.trajectory, name) for one in (apart, whole))
        assert np.max(np.abs(a - b)) < 1e-10 * np.max(np.abs(b))
    assert {c.name for c in whole.checks} <= {c.name for c in apart.checks}
    assert checked(apart, "each island by itself").difference < 1e-13


# What acts on one body. Of a new kind that is not named here, two bodies have to be one island.
ON_ONE = ("push", "torque", "drag", "magnetic")
A, B = Anchor("a", "end"), Anchor("b", "start")
GIVEN = {"name": "f", "a": A, "b": B, "at": A, "body": "a", "first": "a", "second": "b"}
RODS = [bar(name=name, mass=1.0, length=1.0, points={}) for name in "ab"]
DISKS = [disk(name=name, mass=1.0, radius=0.1, points={}) for name in "ab"]
HUNG = [pin("p", "ground.O", "a.start"), pin("q", "ground.O", "b.start")]
FLOOR = [Contact(name, Anchor(name, "center"), 0.5, 0.5) for name in "ab"]
STANDS = Contact("foot", A, 0.5, 0.5, ideal="pivot", ahead_of=B)
TOUCH = Pair("touch", Anchor("a", "center"), "b", None, 0.5, 0.5)


def force(word: str) -> Any:
    """One of the kind between a and b, if it has two ends; its numbers play no part."""
    kind: Any = FORCES[word]
    return kind(**{field.name: GIVEN.get(field.name) for field in fields(kind)} | _about(kind))


def _about(kind: type) -> dict[str, Any]:
    return {"joint": "j"} if "joint" in {field.name for field in fields(kind)} else {}


BETWEEN = {
    **{f"joint {kind}": machine(RODS, [pin("j", "a.end", "b.start", kind)]) for kind in FREEDOMS},
    **{
        word: machine(RODS, forces=[force(word)])
        for word in FORCES
        if word not in ON_ONE and not _about(FORCES[word])
    },
    "pair": replace(machine(DISKS), pairs={"touch": TOUCH}),
    "a foot ahead of another's": machine(RODS, contacts=[STANDS]),
}
NOTHING = {
    "free": machine(RODS),
    "hung on one point of the ground": machine(RODS, HUNG),
    "on one floor": machine(DISKS, contacts=FLOOR),
    **{word: machine(RODS, forces=[force(word)]) for word in ON_ONE},
}


@pytest.mark.mutant("{kind} between two bodies joins nothing: they are solved apart")
@pytest.mark.parametrize("kind", BETWEEN)
def test_what_joins_two_bodies_makes_them_one_island(kind: str) -> None:
    assert islands(BETWEEN[kind]) == (BETWEEN[kind],)


@pytest.mark.parametrize("kind", NOTHING)
def test_the_ground_and_what_acts_on_one_body_join_nothing(kind: str) -> None:
    scene = NOTHING[kind]
    one, two = islands(scene)
    assert (*one.bodies, *two.bodies) == ("a", "b")
    for section in ("joints", "contacts", "forces"):
        assert {**getattr(one, section), **getattr(two, section)} == getattr(scene, section)


def test_what_acts_about_a_joint_goes_with_it() -> None:
    scene = machine(RODS, [pin("j", "ground.O", "b.start")], forces=[force("motor")])
    one, two = islands(scene)
    assert (one.forces, two.forces) == ({}, scene.forces)


@pytest.mark.slow
@pytest.mark.mutant(
    "a spring is forgotten in the graph: its two bodies are solved apart, without it"
)
@pytest.mark.parametrize("text", [PLANE, SPACE], ids=["plane", "space"])
def test_a_joining_that_is_forgotten_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    """Each answer of an island agrees with itself: only the whole scene knows of the spring."""
    real = graph._connections

    def forgets(scene: Scene) -> Iterator[Any]:
        return ((name, () if name in scene.forces else ends) for name, ends in real(scene))

    monkeypatch.setattr(graph, "_connections", forgets)
    case = typed(tmp_path, text)
    solution = solve(replace(case, allow={k: v for k, v in case.allow.items() if k != "s.force"}))
    (broken,) = (check for check in solution.checks if not check.holds)
    assert broken.name == "each island by itself"
    assert broken.difference > 0.1


@pytest.mark.slow
@pytest.mark.mutant("a sum over all islands is certified as well as one of them")
def test_the_error_of_a_sum_is_the_sum_of_errors(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Four islands that know as much: each takes a thousandth of what may be, and 1 nJ."""
    name, real = "error of energy.total", door.certify

    def told(*given: Any) -> tuple[Check, ...]:
        same = Check(name, 1e-3, 0.01, 1e-9, "J")
        return tuple(same if check.name == name else check for check in real(*given))

    monkeypatch.setattr(door, "certify", told)
    found = checked(solve(typed(tmp_path, PLANE)), name)
    assert (found.difference, found.certified) == pytest.approx((4e-3, 4e-9), rel=1e-12)


@pytest.mark.slow
@pytest.mark.mutant("of one check of many islands one that holds is told")
@pytest.mark.parametrize("wrong", range(4))
def test_one_wrong_island_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, wrong: int
) -> None:
    case, real = typed(tmp_path, PLANE), door.certify
    names = [*parts.parts(case)[wrong].scene.bodies]

    def spoilt(part: Case, *rest: Any) -> tuple[Check, ...]:
        found = real(part, *rest)
        mine = [*part.scene.bodies] == names
        return tuple(
            replace(check, difference=1.0) if mine and check.name.startswith("power") else check
            for check in found
        )

    monkeypatch.setattr(door, "certify", spoilt)
    (broken,) = (check for check in solve(case).checks if not check.holds)
    assert broken.name == "power balance (2.51)"


@pytest.mark.slow
def test_the_mistakes_of_all_islands_are_told_at_once(tmp_path: Path) -> None:
    text = PLANE.replace("  ball: {x: 9, y: 0, vx: 1.0}\n", "").replace(
        "  rod: {angle: 0.9", "  rod: {"
    )
    with pytest.raises(CaseError) as caught:
        solve(typed(tmp_path, text.replace("{, ", "{")))
    told = [mistake.what for mistake in caught.value.mistakes]
    assert len(told) == 2
    assert any("rod.angle" in what for what in told)
    assert any("ball.x" in what for what in told)


@pytest.mark.mutant("an island is sampled by its own corners: 0.4 and 0.39999999999999997 s")
def test_all_islands_have_the_samples_of_the_case(tmp_path: Path) -> None:
    """A corner but for rounding on a sample is that sample, also where the law does not act."""
    case = typed(tmp_path, PLANE)
    assert 0.4 in case.times
    assert 0.4 not in np.arange(case.samples) * case.interval
    for part in parts.parts(case):
        assert part.times.tolist() == case.times.tolist()


@pytest.mark.parametrize(
    "more", ["events: {low: {one.omega: falls to zero}}", "near: {one: {angle: 0.2}}"]
)
def test_what_is_looked_at_together_is_solved_together(tmp_path: Path, more: str) -> None:
    """An event is read from one record of one motion."""
    case = typed(tmp_path, PLANE + more)
    assert len(parts.parts(case)) == (1 if case.events else 4)


def balls(count: int) -> str:
    """Pairs of bars on springs, each pair by itself and stiffer than the one before."""
    bodies = ", ".join(f"b{i}: {{bar: {{mass: 1.0, length: 0.1}}}}" for i in range(2 * count))
    springs = ", ".join(
        f"s{i}: {{spring: [b{2 * i}.end, b{2 * i + 1}.start], stiffness: {30 + i}, "
        "rest_length: 0.9}"
        for i in range(count)
    )
    start = ", ".join(f"b{i}: {{x: {i}.0, y: 0, angle: 0, omega: 0.5}}" for i in range(2 * count))
    return (
        f"title: Pairs\nscene: {{bodies: {{{bodies}}}, forces: {{{springs}}}}}\n"
        f"initial: {{{start}}}\nduration: 0.2\nsamples: 3\nallow: {{b0.x: 1.0e-2}}\n"
    )


@pytest.mark.slow
@pytest.mark.mutant("all islands are one dense problem")
def test_work_grows_with_the_number_of_islands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Coordinates of all evaluations, not seconds: with Jacobians of all it would be the square."""
    calls: Counter[str] = Counter()

    def counted(name: str) -> None:
        original = getattr(Multibody, name)

        def again(mode: Multibody, *given: Any) -> Any:
            calls[name] += len(mode.coordinates)
            return original(mode, *given)

        monkeypatch.setattr(Multibody, name, again)

    for name in ("accelerations", "T", "U"):
        counted(name)
    work = []
    for count in (3, 12):
        calls.clear()
        assert solve(typed(tmp_path, balls(count))).holds
        work.append(dict(calls))
    few, many = work
    assert {name: many[name] / few[name] for name in few} == pytest.approx(
        dict.fromkeys(few, 4.0),
        rel=0.3,  # each spring is another one
    )
