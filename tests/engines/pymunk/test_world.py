"""What pymunk is given: a user's own loop bit for bit, checked by the audit, and its limits."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pymunk
import pytest
from given import scenes
from given.adapters.engine_scenes import (
    BOX,
    RADIUS,
    WHEEL,
    G,
    guided,
    incline,
    machine,
    pin,
    touching,
)
from given.adapters.planning import CASES, SHIPPED, TUNED, begun, moved, planned
from pymunk import batch
from pymunk.batch import BodyFields, Buffer, get_space_bodies
from pymunk.body import Body
from pymunk.constraints import PivotJoint
from pymunk.space import Space

from textmech.cases.scene import Bounds
from textmech.cases.trajectory import Trajectory, X
from textmech.engines.engine import Diverged
from textmech.engines.pymunk.model import chipmunk_state as direct
from textmech.engines.pymunk.model.contact import closed
from textmech.engines.pymunk.stepping import scene as builder
from textmech.reports.compare.trial.audit import EQUAL, audit
from textmech.reports.compare.trial.trial import Trial


def heavier(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(builder, "Body", lambda m=0.0, J=0.0, **kw: Body(m, 1.05 * J, **kw))


def other_rule_of_friction(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(builder, "FLOOR_FRICTION", 0.5)  # as if pymunk took the mean


@pytest.mark.mutant(
    "J of a wheel 5 % off in pymunk's world", "friction's product rule broken in pymunk's world"
)
@pytest.mark.parametrize(
    ("mutant", "quantity", "told"),
    [
        (heavier, "wheel.inertia", "wheel.inertia"),
        (other_rule_of_friction, "touch.friction", "touch.friction"),
    ],
    ids=["inertia 5 % off", "friction's product rule broken"],
)
def test_the_audit_sees_a_mutant(
    monkeypatch: pytest.MonkeyPatch,
    mutant: Callable[[pytest.MonkeyPatch], None],
    quantity: str,
    told: str,
) -> None:
    """It tells the largest difference, relative to the number itself."""
    engine, name = TUNED["pymunk"], "rolling_wheel.downhill"
    scene, start = begun(name)
    begin = Trajectory(np.zeros(1), {n: np.array([row]) for n, row in start.items()}, {})
    trial = Trial(CASES[name], begin, engine, planned(engine, scene, start))
    right = engine.measure(scene, start)[quantity]
    assert audit(trial)[0] <= EQUAL
    mutant(monkeypatch)
    assert abs(engine.measure(scene, start)[quantity] / right - 1) > 0.04
    worst, because = audit(trial)
    assert worst > 1e-3
    assert because.startswith(f"{told} is ")


def test_shipped_is_what_a_user_writes() -> None:
    """Bit for bit: nothing of pymunk's own is touched."""
    scene, poses = begun("bar_pendulum")
    space, rod = Space(), Body(1.2, 1.2 * 0.8**2 / 12)
    space.gravity = (0.0, -G)
    x, y, rod.angle, *_ = poses["bar"]
    rod.position = (x, y)
    hinge = PivotJoint(space.static_body, rod, (0.0, 0.0), (-0.4, 0.0))
    space.add(rod, hinge)
    for _ in range(100):
        space.step(0.01)
    wanted, times = ("hinge.force",), np.array([0.0, 1.0])
    end = moved(SHIPPED["pymunk"], scene, poses, times, 0.01, reactions=wanted)
    assert end.states["bar"][1, :3].tolist() == [*rod.position, rod.angle]
    assert end.reactions["hinge.force"][1] == hinge.impulse / 0.01


def test_a_floor_and_a_rail_end_where_ours_do() -> None:
    """pymunk's have ends; MuJoCo's have none. 150 m away both are as at home."""
    far, times = 150.0, np.linspace(0.0, 2.0, 21)
    scene = incline(WHEEL, touching("wheel", 0.2))
    near, away = (
        moved(TUNED["pymunk"], scene, {"wheel": (x, RADIUS, 0, 2.0, 0, 20.0)}, times, 1e-3)
        for x in (0.0, far)
    )
    moved_by = away.states["wheel"][:, X] - far
    assert moved_by == pytest.approx(near.states["wheel"][:, X], abs=1e-11)
    guide, start = guided(None, Bounds(2, 2), Bounds(2, 2)), {"block": (far, 0, 0, 1.0, 0, 0)}
    block = moved(TUNED["pymunk"], guide, start, times, 1e-3).states["block"]
    assert block[-1, X] == pytest.approx(far + 0.25, abs=1e-6)


def test_a_wheel_that_leaves_the_floor_says_whose_limit_it_is() -> None:
    scene, start = begun("rolling_wheel.downhill")
    said = (
        r"a body left touch's floor, of which our adapter builds 10000 m to each side, at t = 100"
    )
    with pytest.raises(Diverged, match=said):
        moved(SHIPPED["pymunk"], scene, start, np.linspace(0.0, 120.0, 13), 0.02)


def test_a_rails_end_throws_nothing_back() -> None:
    """Nor between two samples, here 30 m apart: 1 s ended 230 m off, and nobody was told."""
    scene = machine([BOX], [pin("rail", "ground.O", "box.center", "slide")])
    times = np.linspace(0.0, 1.0, 11)

    def thrown(speed: float) -> Trajectory:
        return moved(TUNED["pymunk"], scene, {"box": (0, 0, 0, speed, 0, 0)}, times, 1e-3)

    assert thrown(300.0).states["box"][:, X] == pytest.approx(300.0 * times, abs=1e-9)
    with pytest.raises(Diverged, match="came to the end of rail's groove, of which our adapter"):
        thrown(15e3)


def test_samples_that_no_step_meets() -> None:
    """MuJoCo's run does not check it: the ladder gives whole multiples only."""
    times = CASES["bar_pendulum"].times
    with pytest.raises(ValueError, match=r"no whole multiples of the step 0\.003"):
        moved(TUNED["pymunk"], *begun("bar_pendulum"), times, 3e-3)


STANDS = """\
scene:
  bodies: {rod: {bar: {mass: 1, length: 0.8}}}
  contacts: {tip: {between: [rod.start, ground.floor], friction: 0.1}}
initial: {rod: {start: [0, 0], angle: 60 deg}}
allow: {rod.angle: 1.0e-2}
"""


@pytest.mark.mutant("a contact's point is taken to rise where its body turns the other way")
@pytest.mark.parametrize(
    ("omega", "vy", "stays"),
    [(2.0, 0.4, True), (2.0, 0.3, True), (2.0, 0.5, False), (-2.0, -0.3, False)],
)
def test_a_contact_is_closed_unless_its_point_rises(
    omega: float, vy: float, stays: bool, tmp_path: Path
) -> None:
    """The start, 0.2 m left of the centre at 60 deg, moves up by vy − 0.2 m ω."""
    scene = scenes.typed(tmp_path, STANDS).scene
    angle = math.radians(60)
    x, y = 0.4 * math.cos(angle), 0.4 * math.sin(angle)
    start = {"rod": (x, y, angle, 0.0, vy, omega)}
    assert [contact.name for contact in closed(scene, start)] == ["tip"] * stays


# Chipmunk's own calls do what pymunk's public names do, whatever pymunk's inside is like.


FIELDS = BodyFields.BODY_ID | BodyFields.POSITION | BodyFields.ANGULAR_VELOCITY


def falling() -> pymunk.Space:
    space = pymunk.Space()
    space.gravity = (0.0, -10.0)
    for i in range(3):
        body = pymunk.Body(1.0 + i, 2.0)
        body.position, body.angular_velocity = (0.5 * i, 1.0), 0.3 * i
        space.add(body)
    return space


@pytest.mark.parametrize("lost", [None, "lib", "ffi"])
def test_copies_are_pymunks(lost: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    space, ours, theirs = falling(), Buffer(), Buffer()
    with monkeypatch.context() as patch:
        if lost:
            patch.setattr(batch, lost, object())
        copy = direct.copier(space, FIELDS, ours)
    assert (getattr(copy, "func", None) is get_space_bodies) == bool(lost)
    for _ in range(4):
        copy()
        get_space_bodies(space, FIELDS, theirs)
        space.step(0.01)
    assert bytes(ours.float_buf()) == bytes(theirs.float_buf())
    assert bytes(ours.int_buf()) == bytes(theirs.int_buf())
    assert len(ours.float_buf()) == 4 * 3 * 3 * 8


def driven(space: pymunk.Space) -> list[Any]:
    """What is read of a body that is pushed and turned for some steps, by our calls."""
    (_, body, _), found = space.bodies, []
    step, read, spin = space.step, direct.reading(body), direct.spinning(body)
    push, turn = direct.pushing(body), direct.turning(body)
    for n in range(5):
        push((1.0, 0.3 * n), (0.2, 0.7))
        turn(0.4)
        turn(0.1 * n)
        step(0.01)
        found.append((*read(), *spin()))
    return found


def plainly_driven(space: pymunk.Space) -> list[Any]:
    """The same by pymunk's public names."""
    (_, body, _), found = space.bodies, []
    for n in range(5):
        body.apply_force_at_world_point((1.0, 0.3 * n), (0.2, 0.7))
        body.torque += 0.4
        body.torque += 0.1 * n
        space.step(0.01)
        spin = body.angle, body.angular_velocity
        state = (*body.position, body.angle, *body.velocity, body.angular_velocity)
        found.append((*state, *spin))
    return found


@pytest.mark.parametrize("lost", [False, True])
def test_a_loop_moves_and_reads_as_by_public_names(
    lost: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    space = falling()
    with monkeypatch.context() as patch:
        if lost:
            patch.setattr(batch, "lib", object())
        found = driven(space)
    assert found == plainly_driven(falling())


@pytest.mark.mutant("a body's rates are read in another order")
def test_a_state_in_another_order_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    def turned(body: pymunk.Body) -> Any:
        return lambda: (*body.position, body.angle, body.angular_velocity, *body.velocity)

    monkeypatch.setattr(direct, "reading", turned)
    assert driven(falling()) != plainly_driven(falling())
