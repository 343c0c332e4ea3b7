"""All bodies are copied as pymunk's own function copies them, whatever pymunk's inside is like."""

import pymunk
import pytest
from pymunk import batch
from pymunk.batch import BodyFields, Buffer, get_space_bodies

from textmech.engines.pymunk.read import copies

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
        copy = copies.copier(space, FIELDS, ours)
    assert (getattr(copy, "func", None) is get_space_bodies) == bool(lost)
    for _ in range(4):
        copy()
        get_space_bodies(space, FIELDS, theirs)
        space.step(0.01)
    assert bytes(ours.float_buf()) == bytes(theirs.float_buf())
    assert bytes(ours.int_buf()) == bytes(theirs.int_buf())
    assert len(ours.float_buf()) == 4 * 3 * 3 * 8
