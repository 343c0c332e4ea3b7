"""Impacts alone, and steps of another length than the one before.

Chipmunk begins a step with the impulses of the last one times dt/dt_old, but counts on from what
they were: what touches may then pull with the difference, and what it tells is of no step. So
before a step of another length all impulses are forgotten.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from pymunk.space import Space
from pymunk.vec2d import Vec2d

NO_TIME = 1e-12  # s: forces and speeds do nothing in it, impulses all

Places = list[tuple[Vec2d, float]]


def places(space: Space) -> Places:
    """Where all bodies are."""
    return [(body.position, body.angle) for body in space.bodies]


def put(space: Space, where: Places) -> None:
    """The bodies there."""
    for body, (position, angle) in zip(space.bodies, where, strict=True):
        body.position, body.angle = position, angle


def drift(space: Space, length: float) -> None:
    """The bodies so long [s] along their velocities, or back."""
    for body in space.bodies:
        body.position += length * body.velocity
        body.angle += length * body.angular_velocity


@contextmanager
def open_gaps(space: Space) -> Iterator[None]:
    """Joints stop what would open their gaps, and close none: in a short step that is a blow."""
    held = [(joint, joint.max_bias) for joint in space.constraints]
    for joint, _ in held:
        joint.max_bias = 0.0
    yield
    for joint, fastest in held:
        joint.max_bias = fastest


class Lengths:
    """Steps of any lengths of a space."""

    def __init__(self, space: Space) -> None:
        self._space, self._last = space, 0.0

    def take(self, length: float) -> None:
        """One step so long [s]."""
        if length != self._last:
            forget(self._space)
        self._last = length
        self._space.step(length)

    def impact(self) -> None:
        """The impulses of what touches, and of joints, in no time."""
        where, self._last = places(self._space), 0.0  # another impact may have been the last
        with open_gaps(self._space):
            self.take(NO_TIME)
        put(self._space, where)


def forget(space: Space) -> None:
    """Forget all impulses of the last step: take contacts out, and let joints exert nothing."""
    shapes = [shape for body in space.bodies for shape in body.shapes]
    space.remove(*shapes)
    if space.constraints:
        _slacken(space)
    space.add(*shapes)


def _slacken(space: Space) -> None:
    where = places(space)
    rates = [(body.velocity, body.angular_velocity) for body in space.bodies]
    strengths = [(joint, joint.max_force) for joint in space.constraints]
    for joint, _ in strengths:
        joint.max_force = 0.0
    space.step(NO_TIME)
    for joint, strength in strengths:
        joint.max_force = strength
    put(space, where)
    for body, (velocity, turning) in zip(space.bodies, rates, strict=True):
        body.velocity, body.angular_velocity = velocity, turning
