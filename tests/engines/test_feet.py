"""Two feet of which one stands: a driver tells engines which."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from given.adapters.planning import SETTINGS, TUNED, begun, every, moved, planned, words
from given.scenes import SHIPPED, solved, typed

from textmech.cases.scene import Anchor, Contact, Scene
from textmech.cases.trajectory import ANGLE, OMEGA, X
from textmech.engines import pymunk
from textmech.engines.engine import Diverged, Engine, Refusal, Start
from textmech.engines.foot_contact import Stride, stride
from textmech.engines.mujoco.adapter.compilation import compiled
from textmech.engines.mujoco.adapter.refuse import why_unbuildable
from textmech.engines.mujoco.callbacks import foot_contact as feet
from textmech.engines.mujoco.read.poses import poses
from textmech.engines.mujoco.read.record import Record
from textmech.engines.pymunk.callbacks import cut
from textmech.engines.pymunk.callbacks.foot import Foot
from textmech.engines.pymunk.stepping import run as steps
from textmech.reference.systems.walkers.compass_walker import CompassWalker
from textmech.reports.compare.events.times import engine_events, reference_events

CASE = SHIPPED["compass_walker"]
STEPS = (1e-3, 2.5e-4)  # s
LEFT = Contact("left", Anchor("l", "end"), 1, 1, ideal="pivot", ahead_of=Anchor("r", "end"))
RIGHT = Contact("right", Anchor("r", "end"), 1, 1, ideal="pivot", ahead_of=Anchor("l", "end"))

# rad and m in six steps, cut at a strike. In pymunk's parts the pins of the hip close no gaps:
# 8.8e-5 and 1.5e-4, 4.0e-5 and 5.9e-5. With strikes at the end of a step they were 20 to 80 fold.
NEAR = {
    "mujoco": ((8e-6, 2e-5), (5e-7, 1.2e-6)),
    "pymunk": ((3e-4, 5e-4), (1.2e-4, 2e-4)),
}


def off(engine: Engine, step: float) -> tuple[float, float]:
    """How far [rad] its legs and [m] its hip are from the reference."""
    exact = solved(CASE.name).trajectory.states
    run = moved(engine, *begun(CASE.name), CASE.times, step, realised="driver").states

    def apart(body: str, column: int) -> float:
        return float(np.abs(run[body][:, column] - exact[body][:, column]).max())

    return max(apart(leg, ANGLE) for leg in ("left", "right")), apart("hip", X)


@pytest.mark.slow
@pytest.mark.parametrize("name", TUNED)
@pytest.mark.parametrize("k", range(len(STEPS)))
def test_a_walker_takes_six_steps(k: int, name: str) -> None:
    found = off(TUNED[name], STEPS[k])
    assert found[0] < NEAR[name][k][0]
    assert found[1] < NEAR[name][k][1]


@pytest.mark.slow
@pytest.mark.mutant("a floor that meets the swinging foot in {name}")
@pytest.mark.parametrize("name", TUNED)
def test_a_floor_that_meets_every_foot_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Midway the swinging foot would be stopped."""

    def look(self: Stride, place: object) -> None:
        self.meets = dict.fromkeys(self.meets, True)

    monkeypatch.setattr(Stride, "look", look)
    assert max(off(TUNED[name], 1e-3)) > 0.1


@pytest.mark.slow
@pytest.mark.mutant(
    "a strike without an impulse",
    "a strike after which both feet stand",
    "a strike that stops everything",
)
@pytest.mark.parametrize("mistake", ["no impulse", "both stand", "of rest"])
def test_a_strike_that_is_no_impulse_of_one_foot_is_seen(
    mistake: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The pin catches what falls; the foot behind holds too; everything stops."""
    if mistake == "no impulse":
        monkeypatch.setattr(feet, "stop", lambda model, data: None)
    elif mistake == "of rest":
        monkeypatch.setattr(feet, "stop", lambda model, data: data.qvel.fill(0.0))
    else:
        recall = feet.Feet.recall
        held = lambda self, noted: recall(self, {**self.standing, **_stands(noted)})  # noqa: E731
        monkeypatch.setattr(feet.Feet, "recall", held)
    assert max(off(TUNED["mujoco"], 1e-3)) > 1e-3  # 4e-3; 3e-6 if nothing is mistaken


def _stands(noted: feet.Standing) -> feet.Standing:
    return {name: place for name, place in noted.items() if place is not None}


@pytest.mark.slow
def test_its_impulse_is_that_of_the_reference(monkeypatch: pytest.MonkeyPatch) -> None:
    """MuJoCo's M and J against moments of momentum (2.27), at every strike of six steps."""
    (scene, start), walker = begun(CASE.name), CompassWalker(**CASE.parameters)
    sound, seen = feet.stop, []

    def stop(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        rates = [data.qvel.copy()]
        sound(model, data)
        rates.append(data.qvel.copy())
        record = Record(np.array([data.qpos] * 2), np.array(rates), np.empty((2, 0)))
        found = poses(scene, model, data, record, start)
        legs = np.array([found[leg] for leg in ("left", "right")])
        seen.append((np.pi / 2 - legs[:, 0, ANGLE], -legs[:, 0, OMEGA], -legs[:, 1, OMEGA]))

    monkeypatch.setattr(feet, "stop", stop)
    moved(TUNED["mujoco"], scene, start, CASE.times, 1e-3, realised="driver")
    assert len(seen) == 6
    for k, (angles, before, after) in enumerate(seen):
        _, _, v = walker.struck(k % 2, np.array([0.0, *angles]), np.array([0.0, *before]))
        assert after == pytest.approx(v[1:], abs=1e-6)  # the foot that stood gives way by 1e-7


LATE = lambda self, *given: given[-1]  # noqa: E731
EARLY = lambda self, longest: np.nextafter(longest, 0.0) * 1e-3  # noqa: E731
MISTAKES: Mapping[str, tuple[str, object, str, Callable[..., object]]] = {
    "cut at the end of the step in mujoco": ("mujoco", feet.Feet, "_until_down", LATE),
    "cut at the end of the step": ("pymunk", Foot, "after", LATE),
    "never down where it is cut": ("pymunk", Foot, "after", EARLY),
    "no impact": ("pymunk", cut.Lengths, "impact", lambda self: None),
    "impulses of another length": ("pymunk", cut, "forget", lambda space: None),
    "carried along by its curve": ("pymunk", Foot, "_carry", lambda self, slip: None),
    "seen where its body was": ("pymunk", cut.Strikes, "_moved", lambda self: None),
    "lifted by its curve": ("pymunk", Foot, "_depth", lambda self, length: 0.0),
}


@pytest.mark.slow
@pytest.mark.mutant("a foot comes down: {mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    engine, owner, name, planted = MISTAKES[mistake]
    monkeypatch.setattr(owner, name, planted)
    try:
        found = max(off(TUNED[engine], 1e-3))
    except Diverged:
        return
    assert found > 2.5e-4  # 1.5e-4 without; 4.0e-4 where its curve carries it along, else 5e-3


@pytest.mark.slow
@pytest.mark.mutant("a tip's path along its curve, (ω h)² l/2, taken for a leap")
def test_a_foot_that_leaves_by_its_curve_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """At 5 ms it is 5e-6 m off the floor at the end of a step, and would come down in each."""
    look = Foot.look

    def level(self: Foot, step: float) -> None:
        self._far, far = 0.0, self._far
        look(self, step)
        self._far = far

    assert max(off(TUNED["pymunk"], 5e-3)) < 6e-4  # measured 2.1e-4
    monkeypatch.setattr(Foot, "look", level)
    assert max(off(TUNED["pymunk"], 5e-3)) > 0.1


@pytest.mark.slow
@pytest.mark.mutant("a step that is cut has a middle, half a step back along what follows")
def test_what_is_cut_is_where_the_body_was(monkeypatch: pytest.MonkeyPatch) -> None:
    event, exact = CASE.events["right_comes_down"], solved(CASE.name).trajectory
    wanted = reference_events(CASE.scene, every(exact), event)

    def late() -> float:
        (scene, start), engine = begun(CASE.name), TUNED["pymunk"]
        run = moved(engine, scene, start, CASE.times, 2e-3, realised="driver", record=True)
        return float(np.abs(engine_events(scene, every(run), event) - wanted).max())

    assert late() < 1.5e-4  # s; measured 7.6e-5
    monkeypatch.setattr(pymunk, "cuts", lambda scene: False)
    assert late() > 3e-4  # 4.3e-4


def twins(scene: Scene, start: Start) -> tuple[Scene, Start]:
    """The walker and another one, each by itself, that is 0.1 % slower."""

    def other(at: Anchor) -> Anchor:
        return Anchor(f"{at.body}2", at.point)

    bodies = {f"{n}2": replace(body, name=f"{n}2") for n, body in scene.bodies.items()}
    joints = {
        f"{n}2": replace(joint, name=f"{n}2", a=other(joint.a), b=other(joint.b))
        for n, joint in scene.joints.items()
    }
    contacts = {
        f"{n}2": replace(foot, name=f"{n}2", at=other(foot.at), ahead_of=other(foot.ahead_of))
        for n, foot in scene.contacts.items()
        if foot.ahead_of
    }
    both = replace(
        scene,
        bodies={**scene.bodies, **bodies},
        joints={**scene.joints, **joints},
        contacts={**scene.contacts, **contacts},
    )
    slower = {f"{n}2": (*row[:3], *(0.999 * v for v in row[3:])) for n, row in start.items()}
    return both, {**start, **slower}  # type: ignore[dict-item]


def parted(engine: Engine) -> float:
    """rad: how far walkers that strike in one step are from how they walk alone."""
    scene, start = begun(CASE.name)
    both, begins = twins(scene, start)
    slower = {name: begins[f"{name}2"] for name in start}
    times, step = CASE.times[:16], 1e-2
    run = moved(engine, both, begins, times, step, realised="driver").states
    found = []
    for suffix, begin in (("", start), ("2", slower)):
        alone = moved(engine, scene, begin, times, step, realised="driver").states
        found += [np.abs(run[f"{leg}{suffix}"] - alone[leg])[:, ANGLE].max() for leg in start]
    return float(max(found))


@pytest.mark.slow
@pytest.mark.mutant("of two feet that strike in one step the later one first, in {name}")
@pytest.mark.parametrize("name", TUNED)
def test_the_later_of_two_first_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert parted(TUNED[name]) < PARTED[name]
    monkeypatch.setattr(feet if name == "mujoco" else cut, "min", max, raising=False)
    assert parted(TUNED[name]) > 10 * PARTED[name]


PARTED = {"mujoco": 1e-5, "pymunk": 6e-5}  # measured 2.0e-6 and 1.7e-5: parts are other steps

# What stands in a walker's scene, and forbids to cut its steps.
BESIDE = {
    "hand: {push: hip.center, sine: {amplitude: [0, 3], angular_frequency: 30}}": "",
    "hand: {push: hip.center, constant: [0, 3]}": "",
    "air: {drag: hip.center, coefficient: 0.1, exponent: 2}": "",
    "coil: {spring: [ground.O, hip.center], stiffness: 30, rest_length: 0.1}": (
        "points: {O: {at: [0, 9], moves: {sine: {amplitude: [0.1, 0], angular_frequency: 9}}}}"
    ),
    "cord: {rope: [ground.O, hip.center], length: 9}": "points: {O: [0, 1]}",
}


@pytest.mark.mutant("a step that is cut beside {force}")
@pytest.mark.parametrize("force", BESIDE)
def test_what_a_step_of_any_length_does_not_bear_is_not_cut(force: str, tmp_path: Path) -> None:
    """Planted by hand: each of the conditions of `cuts` left out."""
    text = Path(CASE.source.file).read_text(encoding="utf-8")
    scene = text[text.index("parameters:") : text.index("duration:")]
    assert cut.cuts(typed(tmp_path, scene + ALLOWED).scene)
    more = f"scene:\n  {BESIDE[force]}\n  forces: {{{force}}}\n"
    assert not cut.cuts(typed(tmp_path, scene.replace("scene:\n", more) + ALLOWED).scene)


ALLOWED = "allow: {left.angle: 1.0e-2}\n"


def test_what_holds_otherwise_takes_part_in_a_strike() -> None:
    """A loop that comes apart at any rates: it does not afterwards, by forces of its pin alone."""
    scene, start = begun("four_bar")
    plan = planned(TUNED["mujoco"], scene, start)
    model, data = compiled(scene, start, 1e-3, plan)
    data.qvel[:] = before = np.array([1.3, -0.7, 2.1])
    feet.stop(model, data)
    mujoco.mj_forward(model, data)
    rows = data.efc_J.reshape(-1, model.nv)[: data.ne]
    assert np.abs(rows @ before).max() > 0.1
    assert np.abs(rows @ data.qvel).max() < 1e-14
    M = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, M)
    impulse = M @ (data.qvel - before)
    others = np.linalg.svd(rows)[2][2:]  # the ways in which it stays closed
    assert np.abs(others @ impulse).max() < 1e-14


@pytest.mark.slow
@pytest.mark.parametrize("name", TUNED)
def test_a_run_leaves_nothing_to_the_next(name: str) -> None:
    """Which feet the floor meets is part of the model that MuJoCo's runs are lent in turn."""
    assert off(TUNED[name], 1e-3) == off(TUNED[name], 1e-3)


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_no_floor_lets_a_foot_pass_by_itself(engine: Engine) -> None:
    first, *others = engine.plans(*begun(CASE.name))
    assert isinstance(first, Refusal)
    assert first.because.startswith("engine: its floor meets a foot wherever it is low")
    assert [plan.realised for plan in others] == (["driver"] if engine.setting == "tuned" else [])


def test_pymunks_script_steers_the_feet_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """All that the driver does, but that it cuts no step."""
    monkeypatch.setattr(steps, "cuts", lambda scene: False)
    engine = TUNED["pymunk"]
    scene, start = begun(CASE.name)
    text = engine.script(scene, start, 1e-3, planned(engine, scene, start, "driver"))
    run = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    rows = {line.split()[0]: line.split()[1:] for line in run.stdout.splitlines()}
    ends = moved(engine, scene, start, np.array([0.0, 1.0]), 1e-3, realised="driver").states
    for name, states in ends.items():
        assert [float(x) for x in rows[name]] == pytest.approx(states[-1].tolist(), abs=1e-12)


def walked(*places: tuple[tuple[float, float], tuple[float, float]]) -> list[dict[str, bool]]:
    """Which feet meet the floor as the left and the right one are at these places."""
    feet = Stride({"left": LEFT, "right": RIGHT}, 0.01, {"left": True, "right": False})
    found = []
    for left, right in places:
        feet.look(lambda at, left=left, right=right: left if at.body == "l" else right)
        found.append(dict(feet.meets))
    return found


def test_a_foot_meets_the_floor_ahead_and_above_and_lets_the_other_go() -> None:
    stands, both = {"left": True, "right": False}, {"left": True, "right": True}
    assert walked(
        ((0, 0), (-0.4, 0.0)),  # it has just left
        ((0, 0), (-0.2, -0.01)),  # it passes through the floor
        ((0, 0), (0.005, 0.01)),  # beside the other
        ((0, 0), (0.2, -1e-9)),  # ahead, but it has not come out yet
        ((0, 0), (0.2, 0.01)),
        ((0, 1e-9), (0.4, -1e-9)),  # it strikes
        ((-1e-9, 1e-9), (0.4, -1e-9)),
        ((0.6, 0.01), (0.4, -1e-9)),
    ) == [stands] * 4 + [both] + [{"left": False, "right": True}] * 2 + [both]


def test_only_feet_need_a_driver() -> None:
    scene, _ = begun("rimless_wheel")
    assert stride(scene, []) is None
    walker, _ = begun(CASE.name)
    found = stride(walker, ["left_foot"])
    assert found is not None
    assert found.meets == {"left_foot": True, "right_foot": False}
    assert found.stands(lambda at: (0.0, 0.0)) == "left_foot"
    assert why_unbuildable(replace(walker, joints={})) is None
