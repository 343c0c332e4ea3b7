"""Chipmunk's own calls do what pymunk's public names do, whatever pymunk's inside is like."""

from typing import Any

import pymunk
import pytest
from pymunk import batch
from pymunk.batch import BodyFields, Buffer, get_space_bodies

from textmech.engines.pymunk.model import chipmunk_state as direct

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
